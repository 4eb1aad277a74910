#include "bench/elementary_unit.hpp"

raylane::bench::ElementaryUnit raylane::bench::elementary_avx512() {
    return ElementaryArrays<simd::Avx512>::unit;
}
