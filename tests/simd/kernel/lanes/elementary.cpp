#include "tests/simd/kernel/lanes/elementary_check.hpp"

namespace raylane::simd {

template <Isa isa>
void elementary(const ElementaryArrays& arrays) {
    ElementaryCheck<ArchOf<isa>>::fill(arrays);
}
template void elementary<Isa::RAYLANE_ISA>(const ElementaryArrays&);

} // namespace raylane::simd
