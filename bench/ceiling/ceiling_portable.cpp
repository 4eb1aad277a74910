#include "bench/ceiling/loops.hpp"

raylane::bench::CeilingUnit raylane::bench::ceiling_portable() {
    return CeilingLoops<simd::Portable>::unit;
}
