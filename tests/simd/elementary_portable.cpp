#include "tests/simd/elementary_check.hpp"

void raylane::simd::elementary_portable(const ElementaryArrays& arrays) {
    ElementaryCheck<Portable>::fill(arrays);
}
