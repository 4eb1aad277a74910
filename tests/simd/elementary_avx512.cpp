#include "tests/simd/elementary_check.hpp"

void raylane::simd::elementary_avx512(const ElementaryArrays& arrays) {
    ElementaryCheck<Avx512>::fill(arrays);
}
