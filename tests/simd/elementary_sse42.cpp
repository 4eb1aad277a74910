#include "tests/simd/elementary_check.hpp"

void raylane::simd::elementary_sse42(const ElementaryArrays& arrays) {
    ElementaryCheck<Sse42>::fill(arrays);
}
