#include "bench/elementary_unit.hpp"

raylane::bench::ElementaryUnit raylane::bench::elementary_sse42() {
    return ElementaryArrays<simd::Sse42>::unit;
}
