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
constexpr std::size_t max_others = 128; // of another kind near a metal atom; more are ignored

/// Returns the largest distance at which two atoms are bonded. Two metals may be.
float reach_of(Element a, Element b) {
    if (is_metal(a) && is_metal(b)) return 1.1F * (metallic_radius(a) + metallic_radius(b));
    return data_of(a).covalent_radius + data_of(b).covalent_radius + tolerance;
}

bool is_between_metals(const Structure& structure, const Bond& bond) {
    return is_metal(structure.element(bond.a)) && is_metal(structure.element(bond.b));
}

float squared_distance(const Structure& structure, AtomIndex a, AtomIndex b) {
    const core::Vec3f apart = structure.positions[a] - structure.positions[b];
    return core::dot(apart, apart);
}

/// Returns 1 for each element whose atoms form a metal, by the bonds of the first atoms.
/// `others`: the atoms near a metal atom that are no metals.
std::vector<char> metallic_elements(const Structure& structure, const std::vector<Bond>& bonds,
                                    std::size_t count,
                                    const std::vector<std::vector<AtomIndex>>& others) {
    const auto has_between = [&](const Bond& bond) {
        const float apart = squared_distance(structure, bond.a, bond.b);
        const std::vector<AtomIndex>& near = others[bond.a];
        return std::any_of(near.begin(), near.end(), [&](AtomIndex other) {
            return squared_distance(structure, bond.a, other) < apart &&
                   squared_distance(structure, bond.b, other) < apart;
        });
    };
    std::vector<std::size_t> atoms(element_count), to_metals(element_count);
    for (AtomIndex atom = 0; atom < count; ++atom)
        ++atoms[structure.element(atom)];
    for (const Bond& bond : bonds) {
        if (!is_between_metals(structure, bond) || has_between(bond)) continue;
        for (const AtomIndex atom : {bond.a, bond.b})
            if (atom < count) ++to_metals[structure.element(atom)];
    }
    std::vector<char> is_metallic(element_count);
    for (Element z = 1; z < element_count; ++z)
        if (is_metal(z) && to_metals[z] > 0 && to_metals[z] >= atoms[z]) is_metallic[z] = 1;
    return is_metallic;
}

/// Returns the atoms whose bonds are found by distance.
std::vector<AtomIndex> atoms_to_bond(const Structure& structure) {
    std::vector<AtomIndex> atoms;
    if (structure.has_all_bonds) return atoms;
    for (AtomIndex atom = 0; atom < structure.size(); ++atom)
        if (data_of(structure.element(atom)).covalent_radius > 0.0F) atoms.push_back(atom);
    return atoms;
}

/// Sorts bonds by atoms. Between two atoms, only the bond of the largest order stays.
void sort_once_each(std::vector<Bond>& bonds) {
    std::sort(bonds.begin(), bonds.end(), [](const Bond& x, const Bond& y) {
        return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.order > y.order;
    });
    bonds.erase(std::unique(bonds.begin(), bonds.end(),
                            [](const Bond& x, const Bond& y) { return x.a == y.a && x.b == y.b; }),
                bonds.end());
}

} // namespace

float longest_bond(const Structure& structure) {
    float longest = tolerance;
    for (const AtomKind& kind : structure.of_kind)
        if (const float radius = data_of(kind.element).covalent_radius; radius > 0.0F)
            longest = std::max(
                longest, std::max(2 * radius + tolerance, reach_of(kind.element, kind.element)));
    return longest;
}

std::vector<Bond> find_bonds(const Structure& structure, std::size_t* crowded_atoms,
                             std::vector<char>* is_metallic, std::span<const AtomIndex> originals) {
    std::vector<Bond> bonds = structure.bonds;
    const std::size_t count = structure.size() - originals.size();
    const auto original = [&](AtomIndex atom) {
        return atom < count ? atom : originals[atom - count];
    };
    // Atoms that would have too many bonds, and among them those of metals with each other.
    std::vector<char> is_crowded(structure.size()), is_dense_metal(structure.size());
    std::vector<std::vector<AtomIndex>> near_others(structure.size()); // metals
    const AtomGrid grid(structure.positions, atoms_to_bond(structure), longest_bond(structure));
    grid.for_each([&](AtomIndex a, const AtomGrid::Near& others) {
        if (a >= count) return; // an image
        const Element of_a = structure.element(a);
        const std::size_t before = bonds.size();
        const float reach_of_metal = is_metal(of_a) ? reach_of(of_a, of_a) : 0.0F;
        std::size_t looked_at = 0, neighbours = 0, metals = 0;
        const auto add = [&](AtomIndex b) {
            if (b == a) return true;
            if (++looked_at > max_near) return false;
            const float squared = squared_distance(structure, a, b);
            const Element of_b = structure.element(b);
            if (!is_metal(of_b) && squared <= reach_of_metal * reach_of_metal &&
                near_others[a].size() < max_others)
                near_others[a].push_back(b);
            const float most = reach_of(of_a, of_b);
            if (squared > most * most) return true;
            const bool is_too_near = squared < min_distance * min_distance;
            if (!is_too_near && is_metal(of_a) && is_metal(of_b)) {
                if (++metals > max_bonds) is_dense_metal[a] = 1;
            } else if (++neighbours > max_bonds) {
                return false;
            }
            if (!is_too_near && a < b && a < count) bonds.push_back({a, b, 1});
            return true;
        };
        if (others.each(add)) return;
        bonds.resize(before);
        is_crowded[a] = 1;
    });
    const auto remove_found = [&](const auto& is_wrong) {
        const auto found = bonds.begin() + static_cast<std::ptrdiff_t>(structure.bonds.size());
        bonds.erase(std::remove_if(found, bonds.end(), is_wrong), bonds.end());
    };
    remove_found([&](const Bond& bond) {
        const AtomIndex a = original(bond.a), b = original(bond.b);
        return is_crowded[a] != 0 || is_crowded[b] != 0 ||
               (is_between_metals(structure, bond) &&
                (is_dense_metal[a] != 0 || is_dense_metal[b] != 0));
    });
    const std::vector<char> metallic = metallic_elements(structure, bonds, count, near_others);
    remove_found([&](const Bond& bond) {
        return is_between_metals(structure, bond) && (metallic[structure.element(bond.a)] == 0 ||
                                                      metallic[structure.element(bond.b)] == 0);
    });
    if (is_metallic != nullptr) *is_metallic = metallic;
    if (crowded_atoms != nullptr)
        *crowded_atoms = static_cast<std::size_t>(std::count(
            is_crowded.begin(), is_crowded.begin() + static_cast<std::ptrdiff_t>(count), 1));
    sort_once_each(bonds);
    return bonds;
}

} // namespace raylane::scenes
