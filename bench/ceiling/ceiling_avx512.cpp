#include "bench/ceiling/loops.hpp"

raylane::bench::CeilingUnit raylane::bench::ceiling_avx512() {
    return CeilingLoops<simd::Avx512>::unit;
}
