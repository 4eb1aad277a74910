#include "simd/isa.hpp"

#include "simd/built_isas.hpp"
#include "simd/processor.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>

namespace raylane::simd {

bool is_built(Isa isa) {
    return std::find(std::begin(built_isas), std::end(built_isas), isa) != std::end(built_isas);
}

bool is_available(Isa isa) {
    return is_built(isa) && processor_runs(isa);
}

Isa narrowest_isa() {
    const auto* first = std::find_if(std::begin(all_isas), std::end(all_isas), is_available);
    if (first != std::end(all_isas)) return *first;
    std::string built;
    for (const Isa isa : built_isas)
        built += (built.empty() ? "" : ", ") + std::string(name_of(isa));
    throw std::runtime_error(
        "the processor must support one of the instruction sets that raylane was built for: " +
        built);
}

Isa best_isa() {
    const Isa narrowest = narrowest_isa();
    const auto widest = std::find_if(std::rbegin(all_isas), std::rend(all_isas), is_available);
    return widest != std::rend(all_isas) ? *widest : narrowest;
}

} // namespace raylane::simd
