#include "tests/simd/kernel/shade/formulas_check.hpp"

namespace raylane::simd {

template <Isa isa>
void formulas(const FormulaArrays& arrays) {
    FormulasCheck<ArchOf<isa>>::fill(arrays);
}
template void formulas<Isa::RAYLANE_ISA>(const FormulaArrays&);

} // namespace raylane::simd
