#include "scenes/structure/legend.hpp"

namespace raylane::scenes {

namespace {

std::string words_for(const Structure& structure, AtomIndex atom) {
    std::string text = "atom " + std::to_string(atom + 1) + ", ";
    const AtomKind& kind = structure.of_kind[structure.kinds[atom]];
    text += structure.names.empty() ? kind.label : structure.names[atom];
    if (!structure.residues.empty()) {
        const Residue& residue = structure.of_residue[structure.residues[atom]];
        text += " of " + residue.name + " " + std::to_string(residue.number);
        if (residue.insertion != ' ') text += residue.insertion;
        const std::string& chain = structure.chains[residue.chain];
        if (!chain.empty()) text += " in chain " + chain;
    }
    if (kind.element != 0) text += " (" + std::string(data_of(kind.element).symbol) + ")";
    return text;
}

} // namespace

std::string Legend::of(core::ShapeId shape) const {
    if (shape >= atoms_of_shape.size() || atoms_of_shape[shape] == no_atoms) return {};
    const auto [a, b] = atoms_of_shape[shape];
    if (a == b) return words_for(structure, a);
    return "bond of " + words_for(structure, a) + ", and " + words_for(structure, b);
}

} // namespace raylane::scenes
