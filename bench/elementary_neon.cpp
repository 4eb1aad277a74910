#include "bench/elementary_unit.hpp"

raylane::bench::ElementaryUnit raylane::bench::elementary_neon() {
    return ElementaryArrays<simd::Neon>::unit;
}
