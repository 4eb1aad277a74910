#include "simd/isa/processor.hpp"

#include <cstdio>

/// Prints the instruction sets that this processor runs, the widest one last, for
/// RAYLANE_ISAS=runnable and native: semicolons between them. Prints portable if it runs none of
/// them.
int main() {
    using raylane::simd::Isa;
    constexpr struct {
        Isa isa;
        const char* name;
    } all[] = {
        {Isa::sse42, "sse42"}, {Isa::avx2, "avx2"}, {Isa::avx512, "avx512"}, {Isa::neon, "neon"}};
    const char* separator = "";
    for (const auto& [isa, name] : all) {
        if (!raylane::simd::processor_runs(isa)) continue;
        std::printf("%s%s", separator, name);
        separator = ";";
    }
    if (*separator == '\0') std::puts("portable");
}
