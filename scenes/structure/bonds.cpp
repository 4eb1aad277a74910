#include "scenes/structure/bonds.hpp"

#include "scenes/structure/atom_grid.hpp"

#include <algorithm>

namespace raylane::scenes {

namespace {

constexpr float tolerance = 0.4F, least_distance = 0.4F;

/// Those that form no molecules with each other: alkali and alkaline earth metals, transition and
/// rare earth metals, and what follows them but for metalloids.
bool is_metal(Element z) {
    return z == 3 || z == 4 || (z >= 11 && z <= 13) || (z >= 19 && z <= 31) ||
           (z >= 37 && z <= 50) || (z >= 55 && z <= 84) || z >= 87;
}

bool is_before(const Bond& x, const Bond& y) {
    return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.order > y.order;
}

} // namespace

std::vector<Bond> find_bonds(const Structure& structure) {
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
    const AtomGrid grid(structure.positions, std::move(atoms), 2 * longest + tolerance);
    grid.for_each_pair([&](AtomIndex a, AtomIndex b) {
        const core::Vec3f apart = structure.positions[a] - structure.positions[b];
        const float squared = core::dot(apart, apart);
        const Element of_a = structure.element(a), of_b = structure.element(b);
        const float most =
            data_of(of_a).covalent_radius + data_of(of_b).covalent_radius + tolerance;
        if (squared > most * most || squared < least_distance * least_distance) return;
        if (is_metal(of_a) && is_metal(of_b)) return;
        bonds.push_back({std::min(a, b), std::max(a, b), 1});
    });
    std::sort(bonds.begin(), bonds.end(), is_before);
    bonds.erase(std::unique(bonds.begin(), bonds.end(),
                            [](const Bond& x, const Bond& y) { return x.a == y.a && x.b == y.b; }),
                bonds.end());
    return bonds;
}

} // namespace raylane::scenes
