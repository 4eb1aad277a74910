#include "tests/simd/elementary_check.hpp"

void raylane::simd::elementary_avx2(const ElementaryArrays& arrays) {
    ElementaryCheck<Avx2>::fill(arrays);
}
