#include "tests/simd/kernel/lanes/bounded_lanes.hpp"
#include "tests/simd/kernel/lanes/lanes_check.hpp"
#include "tests/simd/kernel/lanes/queue_check.hpp"

namespace raylane::simd {

template <Isa isa>
int lanes_failures() {
    return LanesCheck<ArchOf<isa>>::failures();
}
template int lanes_failures<Isa::RAYLANE_ISA>();

template <Isa isa>
int queue_failures() {
    return QueueCheck<ArchOf<isa>>::failures();
}
template int queue_failures<Isa::RAYLANE_ISA>();

template <Isa isa>
int bounded_operation(int operation, const BoundedColumns& a, const BoundedColumns& b,
                      BoundedColumns& result) {
    return BoundedCheck<ArchOf<isa>>::operate(operation, a, b, result);
}
template int bounded_operation<Isa::RAYLANE_ISA>(int, const BoundedColumns&, const BoundedColumns&,
                                                 BoundedColumns&);

} // namespace raylane::simd
