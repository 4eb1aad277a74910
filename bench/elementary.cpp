#include "bench/elementary_unit.hpp"

namespace raylane::bench {

template <simd::Isa isa>
ElementaryUnit elementary() {
    return ElementaryArrays<simd::ArchOf<isa>>::unit;
}
template ElementaryUnit elementary<simd::Isa::RAYLANE_ISA>();

} // namespace raylane::bench
