#pragma once

#include "scenes/formats/structure/structure.hpp"

#include <utility>
#include <vector>

namespace raylane::tests {

/// Returns atoms, each of another kind.
inline scenes::Structure of_atoms(const std::vector<std::pair<const char*, core::Vec3f>>& atoms) {
    scenes::Structure structure;
    for (const auto& [symbol, at] : atoms) {
        structure.of_kind.push_back({symbol, scenes::element_of(symbol)});
        structure.kinds.push_back(static_cast<std::uint16_t>(structure.of_kind.size() - 1));
        structure.positions.push_back(at);
    }
    return structure;
}

/// Returns two residues in chain A, and water in chain b.
inline scenes::Structure peptide() {
    scenes::Structure structure = of_atoms({{"N", {0, 0, 0}},
                                            {"C", {1.4F, 0, 0}},
                                            {"H", {0, 1, 0}},
                                            {"C", {10, 0, 0}},
                                            {"O", {12, 0, 0}}});
    structure.names = {"N", "CA", "H", "CB", "O"};
    structure.chains = {"A", "b"};
    structure.of_residue = {
        {"ALA", -1, ' ', 0, false}, {"GLY", 20, ' ', 0, false}, {"HOH", 301, ' ', 1, true}};
    structure.residues = {0, 0, 0, 1, 2};
    structure.properties = {{"b_factor", {10, 20, 30, 40, 50}}};
    return structure;
}

} // namespace raylane::tests
