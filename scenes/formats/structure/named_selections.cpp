#include "scenes/formats/structure/named_selections.hpp"

#include "scenes/formats/structure/cartoon/secondary_structure.hpp"
#include "scenes/formats/structure/labels.hpp"
#include "scenes/formats/structure/selection_words.hpp"

#include <cstdlib>

namespace raylane::scenes {

namespace {

bool is_water(const Residue& residue) {
    return is_water_residue(residue.name);
}
bool is_amino_acid(const Residue& residue) {
    return is_any_word(residue.name,
                       {"ala", "arg", "asn", "asp", "cys", "gln", "glu", "gly", "his", "ile", "leu",
                        "lys", "met", "phe", "pro", "ser", "thr", "trp", "tyr", "val", "asx", "glx",
                        "sec", "pyl", "mse", "hid", "hie", "hip", "hsd", "hse", "hsp", "cyx"});
}
bool is_nucleotide(const Residue& residue) {
    return is_any_word(residue.name,
                       {"a", "c", "g", "u", "t", "i", "da", "dc", "dg", "dt", "du", "di"});
}

/// Selects residues with carbon, except water and parts of polymers.
Selected ligands(const Structure& structure) {
    if (structure.residues.empty()) return Selected(structure.size());
    const std::size_t count = structure.of_residue.size();
    std::vector<char> has_carbon(count), is_like_amino_acid(count);
    for (AtomIndex i = 0; i < structure.size(); ++i) {
        const std::uint32_t residue = structure.residues[i];
        if (structure.element(i) == 6) has_carbon[residue] = 1;
        if (!structure.names.empty() && structure.names[i] == "CA" && structure.element(i) == 6)
            is_like_amino_acid[residue] = 1;
    }
    // A modified amino acid is next to another residue of its chain.
    const auto is_linked = [&](std::size_t k, std::size_t other) {
        if (other >= count) return false;
        const Residue &a = structure.of_residue[k], &b = structure.of_residue[other];
        return a.chain == b.chain && std::abs(std::int64_t{a.number} - b.number) <= 1 &&
               is_amino_acid(b);
    };
    std::vector<char> result(count);
    for (std::size_t k = 0; k < count; ++k) {
        const Residue& residue = structure.of_residue[k];
        const bool is_modified =
            is_like_amino_acid[k] != 0 && (is_linked(k, k - 1) || is_linked(k, k + 1));
        if (has_carbon[k] != 0 && !is_modified && !is_water(residue) && !is_amino_acid(residue) &&
            !is_nucleotide(residue) && !is_polymer_residue(residue.name))
            result[k] = 1;
    }
    return where(structure, [&](AtomIndex i) { return result[structure.residues[i]] != 0; });
}

/// Selects residues of one atom that are not water.
Selected ions(const Structure& structure) {
    if (structure.residues.empty()) return Selected(structure.size());
    std::vector<std::size_t> atoms(structure.of_residue.size());
    for (const std::uint32_t residue : structure.residues)
        ++atoms[residue];
    return where(structure, [&](AtomIndex i) {
        const std::uint32_t residue_index = structure.residues[i];
        const Residue& residue = structure.of_residue[residue_index];
        return atoms[residue_index] == 1 && !is_water(residue) && !is_amino_acid(residue) &&
               !is_nucleotide(residue);
    });
}

Selected backbone(const Structure& structure) {
    Selected of_protein = where_residue(structure, is_amino_acid);
    if (structure.names.empty()) return of_protein;
    return where(structure, [&](AtomIndex i) {
        return of_protein[i] != 0 && is_any_word(structure.names[i], {"n", "ca", "c", "o", "oxt"});
    });
}

/// Selects residues of one secondary structure, which is computed unless the file has it.
Selected of_secondary(const Structure& structure, Secondary wanted) {
    if (structure.residues.empty()) return Selected(structure.size());
    const std::vector<Secondary> secondary = secondary_structure(structure, backbone_of(structure));
    return where(structure,
                 [&](AtomIndex i) { return secondary[structure.residues[i]] == wanted; });
}

} // namespace

std::optional<Selected> named_selection(const Structure& structure, std::string_view word) {
    const auto is_hydrogen = [&](AtomIndex i) { return structure.element(i) == 1; };
    if (word == "all") return Selected(structure.size(), 1);
    if (word == "none") return Selected(structure.size(), 0);
    if (word == "protein") return where_residue(structure, is_amino_acid);
    if (word == "nucleic") return where_residue(structure, is_nucleotide);
    if (word == "polymer")
        return where_residue(structure, [](const Residue& residue) {
            return is_amino_acid(residue) || is_nucleotide(residue);
        });
    if (word == "helix") return of_secondary(structure, Secondary::helix);
    if (word == "strand") return of_secondary(structure, Secondary::strand);
    if (word == "water") return where_residue(structure, is_water);
    if (word == "hetero")
        return where_residue(structure, [](const Residue& residue) { return residue.is_hetero; });
    if (word == "ligand") return ligands(structure);
    if (word == "ion") return ions(structure);
    if (word == "metal")
        return where(structure, [&](AtomIndex i) { return is_metal(structure.element(i)); });
    if (word == "hydrogen") return where(structure, is_hydrogen);
    if (word == "noh") return opposite(where(structure, is_hydrogen));
    if (word == "backbone") return backbone(structure);
    if (word == "sidechain")
        return without(where_residue(structure, is_amino_acid), backbone(structure));
    return std::nullopt;
}

} // namespace raylane::scenes
