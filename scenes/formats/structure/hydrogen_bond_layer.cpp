#include "scenes/formats/structure/hydrogen_bond_layer.hpp"

#include "scenes/formats/structure/atom_grid.hpp"
#include "scenes/formats/structure/bonds.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::scenes {

using core::Vec3d;

namespace {

constexpr Element hydrogen = 1, nitrogen = 7, oxygen = 8, fluorine = 9;
constexpr double longest_from_hydrogen = 2.5, longest_from_donor = 3.5, longest_carbonyl = 1.3;
constexpr double min_apart = 1.2; // angstrom: nearer atoms are two places of one atom, or bonded
constexpr std::size_t max_candidates =
    1000; // atoms within that distance of each other in any sample

/// The search for hydrogen bonds in a structure with known bonds.
class Search {
  public:
    Search(const Structure& structure, const std::vector<Bond>& bonds)
        : structure_(structure), neighbours_(structure.size()) {
        for (const Bond& bond : bonds) {
            neighbours_[bond.a].push_back(bond.b);
            neighbours_[bond.b].push_back(bond.a);
        }
        for (AtomIndex atom = 0; atom < structure.size(); ++atom)
            donors_.push_back(find_donor(atom));
    }

    std::vector<std::pair<AtomIndex, AtomIndex>> find() {
        std::vector<AtomIndex> atoms, donors;
        bool has_hydrogen = false;
        for (AtomIndex atom = 0; atom < structure_.size(); ++atom) {
            if (is_polar(atom)) atoms.push_back(atom);
            if (donor_of(atom) == atom) continue;
            has_hydrogen = true;
            atoms.push_back(atom);
        }
        const double reach = has_hydrogen ? longest_from_hydrogen : longest_from_donor;
        const AtomGrid grid(structure_.positions, atoms, static_cast<float>(reach));
        std::vector<std::pair<AtomIndex, AtomIndex>> found;
        grid.for_each([&](AtomIndex a, const AtomGrid::Near& others) {
            if (has_hydrogen ? donor_of(a) == a : !may_donate(a)) return;
            std::size_t looked_at = 0;
            others.each([&](AtomIndex b) {
                if (b != a && is_polar(b) && may_accept(b) && distance(a, b) < reach &&
                    distance(a, b) > min_apart && (has_hydrogen ? fits(a, b) : fits_without(a, b)))
                    found.emplace_back(a, b);
                return ++looked_at < max_candidates;
            });
        });
        std::sort(found.begin(), found.end());
        if (has_hydrogen) return found;
        // A pair of which both may donate is found twice.
        std::erase_if(found, [&](const auto& pair) {
            return pair.first > pair.second &&
                   std::binary_search(found.begin(), found.end(),
                                      std::pair{pair.second, pair.first});
        });
        return found;
    }

  private:
    /// Returns true for atoms that may donate or accept. A file may bond an atom to any number of
    /// others; those with more than max_bonds are left out, so that are_near() is quick.
    bool is_polar(AtomIndex atom) const {
        const Element z = structure_.element(atom);
        return (z == nitrogen || z == oxygen || z == fluorine) &&
               neighbours_[atom].size() <= max_bonds;
    }
    /// Returns the polar atom that a hydrogen atom is bonded to; otherwise the atom itself.
    AtomIndex donor_of(AtomIndex atom) const { return donors_[atom]; }
    AtomIndex find_donor(AtomIndex atom) const {
        if (structure_.element(atom) != hydrogen) return atom;
        for (const AtomIndex other : neighbours_[atom])
            if (is_polar(other)) return other;
        return atom;
    }
    Vec3d at(AtomIndex atom) const { return core::convert<double>(structure_.positions[atom]); }
    double distance(AtomIndex a, AtomIndex b) const { return core::length(at(b) - at(a)); }
    /// Returns the cosine of the angle of two atoms at another one.
    double cosine(AtomIndex a, AtomIndex corner, AtomIndex b) const {
        const Vec3d u = at(a) - at(corner), v = at(b) - at(corner);
        return core::dot(u, v) / (core::length(u) * core::length(v));
    }

    bool may_donate(AtomIndex atom) const {
        const auto& near = neighbours_[atom];
        if (structure_.element(atom) == nitrogen) return near.size() <= 2;
        return structure_.element(atom) == oxygen && near.size() <= 1 &&
               (near.empty() || distance(atom, near[0]) > longest_carbonyl);
    }
    bool may_accept(AtomIndex atom) const {
        const auto heavy = static_cast<std::size_t>(std::count_if(
            neighbours_[atom].begin(), neighbours_[atom].end(),
            [&](AtomIndex bonded) { return structure_.element(bonded) != hydrogen; }));
        return structure_.element(atom) != nitrogen || heavy <= 2;
    }
    /// Returns true if the atoms are bonded, or bonded to the same atom.
    bool are_near(AtomIndex a, AtomIndex b) const {
        for (const AtomIndex neighbour : neighbours_[a])
            if (neighbour == b || std::find(neighbours_[b].begin(), neighbours_[b].end(),
                                            neighbour) != neighbours_[b].end())
                return true;
        return false;
    }
    bool fits(AtomIndex hydrogen_atom, AtomIndex acceptor) const {
        const AtomIndex donor = donor_of(hydrogen_atom);
        return donor != acceptor && !are_near(donor, acceptor) &&
               cosine(donor, hydrogen_atom, acceptor) < -0.5;
    }
    bool fits_without(AtomIndex donor, AtomIndex acceptor) const {
        const auto is_behind = [&](AtomIndex end, AtomIndex other) {
            return std::all_of(neighbours_[end].begin(), neighbours_[end].end(),
                               [&](AtomIndex atom) { return cosine(atom, end, other) < 0.0; });
        };
        return !are_near(donor, acceptor) && is_behind(donor, acceptor) &&
               is_behind(acceptor, donor);
    }

    const Structure& structure_;
    std::vector<std::vector<AtomIndex>> neighbours_;
    std::vector<AtomIndex> donors_;
};

} // namespace

std::vector<std::pair<AtomIndex, AtomIndex>> find_hydrogen_bonds(const Structure& structure,
                                                                 const std::vector<Bond>& bonds) {
    return Search(structure, bonds).find();
}

std::vector<std::pair<Vec3d, Vec3d>> dashes_of(const Vec3d& from, const Vec3d& to) {
    constexpr double usual_dash = 0.15;
    const double size = core::length(to - from);
    if (!(size > 0.0 && size < 1e3)) return {};
    const int pairs = std::max(2, static_cast<int>(std::lround(size / (2.0 * usual_dash))));
    std::vector<std::pair<Vec3d, Vec3d>> dashes;
    dashes.reserve(static_cast<std::size_t>(pairs));
    for (int k = 0; k < pairs; ++k)
        dashes.emplace_back(from + (k + 0.25) / pairs * (to - from),
                            from + (k + 0.75) / pairs * (to - from));
    return dashes;
}

std::size_t add_hydrogen_bonds(const DrawnAtoms& atoms, DrawnShapes& shapes) {
    constexpr float radius = 0.045F;
    const core::MaterialIndex material =
        Palette(shapes.builder(), 1.0F, atoms.finish).of(0x4A90C8, [] {
            return std::string("hydrogen bond");
        });
    const Structure& structure = atoms.all();
    std::size_t count = 0;
    for (const auto& [a, b] : find_hydrogen_bonds(structure, atoms.bonds)) {
        const AtomPair pair = {atoms.original(a), atoms.original(b)};
        if (atoms.representations[pair[0]] == DrawnAtoms::hidden ||
            atoms.representations[pair[1]] == DrawnAtoms::hidden)
            continue;
        const auto is_kept = [&](AtomIndex atom) {
            return keep_point(core::convert<double>(structure.positions[atom]), shapes.cuts());
        };
        if (!is_kept(a) || !is_kept(b)) continue;
        ++count;
        for (const auto& [from, to] : dashes_of(core::convert<double>(structure.positions[a]),
                                                core::convert<double>(structure.positions[b]))) {
            shapes.add(core::CappedCylinder{core::convert<float>(from),
                                            core::convert<float>(to - from), radius},
                       material, Style::licorice, 1.0F, pair);
        }
    }
    return count;
}

} // namespace raylane::scenes
