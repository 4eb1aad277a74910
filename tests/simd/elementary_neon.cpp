#include "tests/simd/elementary_check.hpp"

void raylane::simd::elementary_neon(const ElementaryArrays& arrays) {
    ElementaryCheck<Neon>::fill(arrays);
}
