#include "bench/ceiling/loops.hpp"

raylane::bench::CeilingUnit raylane::bench::ceiling_sse42() {
    return CeilingLoops<simd::Sse42>::unit;
}
