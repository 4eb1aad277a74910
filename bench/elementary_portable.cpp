#include "bench/elementary_unit.hpp"

raylane::bench::ElementaryUnit raylane::bench::elementary_portable() {
    return ElementaryArrays<simd::Portable>::unit;
}
