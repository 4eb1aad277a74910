#include "scenes/formats/structure/bonds.hpp"

#include "scenes/formats/structure/atom_grid.hpp"

#include <algorithm>
#include <cstddef>

namespace raylane::scenes {

namespace {

constexpr float tolerance = 0.4F, min_distance = 0.4F;
/// Uranium in U(C5H5)4 has 20 bonds by these distances. In diamond, the widest cells around an atom
/// hold 700 atoms.
constexpr std::size_t max_near = 4096;

/// Returns true for elements that form no molecules with each other: alkali and alkaline earth
/// metals, transition and rare earth metals, and the elements after them except metalloids.
bool is_metal(Element z) {
    return z == 3 || z == 4 || (z >= 11 && z <= 13) || (z >= 19 && z <= 31) ||
           (z >= 37 && z <= 50) || (z >= 55 && z <= 84) || z >= 87;
}

bool is_before(const Bond& x, const Bond& y) {
    return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.order > y.order;
}

} // namespace

std::vector<Bond> find_bonds(const Structure& structure, std::size_t* crowded_atoms) {
    std::vector<Bond> bonds = structure.bonds;
    std::vector<AtomIndex> atoms;
    float longest = 0.0F;
    if (!structure.has_all_bonds)
        for (AtomIndex atom = 0; atom < structure.size(); ++atom) {
            const float radius = data_of(structure.element(atom)).covalent_radius;
            if (radius == 0.0F) continue;
            longest = std::max(longest, radius);
            atoms.push_back(atom);
        }
    std::vector<char> is_crowded(structure.size());
    const AtomGrid grid(structure.positions, atoms, 2 * longest + tolerance);
    grid.for_each([&](AtomIndex a, const AtomGrid::Near& others) {
        const Element of_a = structure.element(a);
        const std::size_t before = bonds.size();
        std::size_t looked_at = 0, neighbours = 0;
        const bool has_room = others.each([&](AtomIndex b) {
            if (b == a) return true;
            if (++looked_at > max_near) return false;
            const core::Vec3f apart = structure.positions[a] - structure.positions[b];
            const float squared = core::dot(apart, apart);
            const Element of_b = structure.element(b);
            const float most =
                data_of(of_a).covalent_radius + data_of(of_b).covalent_radius + tolerance;
            if (squared > most * most) return true;
            const bool is_too_near = squared < min_distance * min_distance;
            if (!is_too_near && is_metal(of_a) && is_metal(of_b)) return true;
            if (++neighbours > max_bonds) return false;
            if (!is_too_near && a < b) bonds.push_back({a, b, 1});
            return true;
        });
        if (has_room) return;
        bonds.resize(before);
        is_crowded[a] = 1;
    });
    const auto found = bonds.begin() + static_cast<std::ptrdiff_t>(structure.bonds.size());
    bonds.erase(std::remove_if(found, bonds.end(),
                               [&](const Bond& bond) {
                                   return is_crowded[bond.a] != 0 || is_crowded[bond.b] != 0;
                               }),
                bonds.end());
    if (crowded_atoms != nullptr)
        *crowded_atoms =
            static_cast<std::size_t>(std::count(is_crowded.begin(), is_crowded.end(), 1));
    std::sort(bonds.begin(), bonds.end(), is_before);
    bonds.erase(std::unique(bonds.begin(), bonds.end(),
                            [](const Bond& x, const Bond& y) { return x.a == y.a && x.b == y.b; }),
                bonds.end());
    return bonds;
}

} // namespace raylane::scenes
