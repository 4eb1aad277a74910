#include "simd/isa/isa.hpp"

#include "simd/isa/built_isas.hpp"
#include "simd/isa/processor.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace raylane::simd {

bool is_built(Isa isa) {
    return std::find(std::begin(built_isas), std::end(built_isas), isa) != std::end(built_isas);
}

bool is_available(Isa isa) {
    return is_built(isa) && processor_runs(isa);
}

std::span<const Isa> available_isas() {
    static const std::vector<Isa> available = [] {
        std::vector<Isa> isas;
        std::copy_if(std::begin(all_isas), std::end(all_isas), std::back_inserter(isas),
                     is_available);
        if (!isas.empty()) return isas;
        std::string built;
        for (const Isa isa : built_isas)
            built += (built.empty() ? "" : ", ") + std::string(name_of(isa));
        throw std::runtime_error(
            "the processor must support one of the instruction sets that raylane was built for: " +
            built);
    }();
    return available;
}

} // namespace raylane::simd
