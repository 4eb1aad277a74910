#include "bench/elementary_unit.hpp"

raylane::bench::ElementaryUnit raylane::bench::elementary_avx2() {
    return ElementaryArrays<simd::Avx2>::unit;
}
