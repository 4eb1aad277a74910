#include "bench/ceiling/loops.hpp"

raylane::bench::CeilingUnit raylane::bench::ceiling_avx2() {
    return CeilingLoops<simd::Avx2>::unit;
}
