#include "simd/isa/processor.hpp"

#include <cstdio>

/// Prints the widest instruction set that this processor runs, for RAYLANE_ISAS=native.
int main() {
    using raylane::simd::Isa;
    using raylane::simd::processor_runs;
    std::puts(processor_runs(Isa::avx512)  ? "avx512"
              : processor_runs(Isa::avx2)  ? "avx2"
              : processor_runs(Isa::sse42) ? "sse42"
              : processor_runs(Isa::neon)  ? "neon"
                                           : "portable");
}
