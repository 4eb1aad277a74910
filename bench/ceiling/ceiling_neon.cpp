#include "bench/ceiling/loops.hpp"

raylane::bench::CeilingUnit raylane::bench::ceiling_neon() {
    return CeilingLoops<simd::Neon>::unit;
}
