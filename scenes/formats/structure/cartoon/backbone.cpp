#include "scenes/formats/structure/cartoon/backbone.hpp"

#include "scenes/formats/structure/labels.hpp"

#include <string_view>
#include <utility>

namespace raylane::scenes {

namespace {

using core::Vec3d;

constexpr double longest_link = 2.5;       // of C and N: Kabsch and Sander (1983)
constexpr double longest_between_ca = 4.6; // 3.8 in ideal chains
constexpr double longest_between_p = 8.5;  // 7.0 in extended chains
constexpr Element carbon = 6;

constexpr std::pair<std::string_view, BackboneAtom> names_of_atoms[] = {
    {"CA", BackboneAtom::ca},  {"N", BackboneAtom::n},    {"C", BackboneAtom::c},
    {"O", BackboneAtom::o},    {"OT1", BackboneAtom::o},  {"OC1", BackboneAtom::o},
    {"O1", BackboneAtom::o},   {"P", BackboneAtom::p},    {"O5'", BackboneAtom::o5},
    {"O5*", BackboneAtom::o5}, {"C5'", BackboneAtom::c5}, {"C5*", BackboneAtom::c5},
    {"C4'", BackboneAtom::c4}, {"C4*", BackboneAtom::c4}, {"C1'", BackboneAtom::c1},
    {"C1*", BackboneAtom::c1}, {"O3'", BackboneAtom::o3}, {"O3*", BackboneAtom::o3}};

/// Returns the polymer that a residue with these atoms belongs to, if it is bonded to others.
Polymer polymer_of(const BackboneResidue& atoms, const Residue& residue) {
    using enum BackboneAtom;
    const bool is_usual = !residue.is_hetero || is_polymer_residue(residue.name);
    if (atoms.has(ca) && ((atoms.has(n) && atoms.has(c)) || is_usual)) return Polymer::peptide;
    if (atoms.has(c1) && (atoms.has(p) || atoms.has(o5)) && atoms.has(o3)) return Polymer::nucleic;
    if (is_usual && (atoms.has(p) || (atoms.has(c4) && atoms.has(o3)))) return Polymer::nucleic;
    return Polymer::none;
}

/// Finds the atoms of all residues. The name of an atom is looked up by its first letter.
std::vector<BackboneResidue> residues_of(const Structure& structure) {
    BackboneResidue empty;
    empty.atoms.fill(no_atom);
    std::vector<BackboneResidue> residues(structure.of_residue.size(), empty);
    for (AtomIndex atom = 0; atom < structure.size(); ++atom) {
        BackboneResidue& residue = residues[structure.residues[atom]];
        if (residue.first == no_atom) residue.first = atom;
        residue.last = atom;
        const std::string_view name = structure.names[atom];
        if (name.empty() || name.size() > 3) continue;
        for (const auto& [known, is] : names_of_atoms) {
            if (name != known) continue;
            AtomIndex& place = residue.atoms[static_cast<std::size_t>(is)];
            const Element element = structure.element(atom);
            const bool is_calcium = is == BackboneAtom::ca && element != carbon && element != 0;
            if (place == no_atom && !is_calcium) place = atom;
        }
    }
    return residues;
}

class Links {
  public:
    explicit Links(const Structure& structure) : structure_(structure) {}

    /// Returns true if the second residue continues the first one's chain.
    bool joined(const BackboneResidue& a, const BackboneResidue& b) const {
        using enum BackboneAtom;
        if (a.polymer != b.polymer ||
            structure_.of_residue[a.residue].chain != structure_.of_residue[b.residue].chain)
            return false;
        if (a.polymer == Polymer::peptide)
            return a.has(c) && b.has(n) ? are_within(a.atom(c), b.atom(n), longest_link)
                                        : are_within(a.atom(ca), b.atom(ca), longest_between_ca);
        return a.has(o3) && b.has(p) ? are_within(a.atom(o3), b.atom(p), longest_link)
                                     : are_within(a.guide(), b.guide(), longest_between_p);
    }

  private:
    bool are_within(AtomIndex a, AtomIndex b, double reach) const {
        const Vec3d between = core::convert<double>(structure_.positions[b]) -
                              core::convert<double>(structure_.positions[a]);
        return core::dot(between, between) <= reach * reach;
    }

    const Structure& structure_;
};

} // namespace

AtomIndex BackboneResidue::guide() const {
    using enum BackboneAtom;
    for (const BackboneAtom name : {ca, p, o5, c5, c4})
        if (has(name)) return atom(name);
    return no_atom;
}

Backbone backbone_of(const Structure& structure) {
    Backbone backbone;
    if (structure.residues.empty() || structure.names.empty()) return backbone;
    const Links links(structure);
    std::vector<BackboneResidue> residues = residues_of(structure);
    for (std::uint32_t i = 0; i < residues.size(); ++i) {
        BackboneResidue& residue = residues[i];
        const Residue& in_structure = structure.of_residue[i];
        residue.residue = i;
        if (residue.first == no_atom) continue;
        residue.polymer = polymer_of(residue, in_structure);
        if (residue.polymer == Polymer::none) {
            if (!in_structure.is_hetero && is_polymer_residue(in_structure.name))
                backbone.without_path.push_back(residue);
            continue;
        }
        std::vector<Segment>& segments = backbone.segments;
        if (segments.empty() || !links.joined(segments.back().back(), residue))
            segments.emplace_back();
        segments.back().push_back(residue);
    }
    std::erase_if(backbone.segments, [&](const Segment& segment) {
        return segment.size() == 1 && structure.of_residue[segment[0].residue].is_hetero;
    });
    return backbone;
}

} // namespace raylane::scenes
