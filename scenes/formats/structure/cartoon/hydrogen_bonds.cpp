#include "scenes/formats/structure/cartoon/hydrogen_bonds.hpp"

#include "scenes/formats/structure/atom_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace raylane::scenes {

namespace {

using core::Vec3d;

/// Returns the pairs of residues whose CA are near each other, ascending. A residue in a crowd, as
/// in no protein, has none as the first of a pair: the time must not be quadratic.
std::vector<std::pair<AtomIndex, AtomIndex>> near_pairs(const std::vector<PeptideAtoms>& residues) {
    constexpr double reach = 9.0;
    constexpr std::size_t crowd = 1000; // in 27 cells of 9 angstrom; 150 in proteins
    std::vector<core::Vec3f> places;
    places.reserve(residues.size());
    for (const PeptideAtoms& residue : residues)
        places.push_back(core::convert<float>(residue.ca));
    std::vector<AtomIndex> atoms(residues.size());
    std::iota(atoms.begin(), atoms.end(), AtomIndex{0});
    std::vector<std::pair<AtomIndex, AtomIndex>> pairs;
    AtomGrid(places, atoms, static_cast<float>(reach))
        .for_each([&](AtomIndex a, const AtomGrid::Near& near) {
            const std::size_t before = pairs.size();
            std::size_t visited = 0;
            const bool is_usual = near.each([&](AtomIndex b) {
                const Vec3d between = residues[b].ca - residues[a].ca;
                if (a < b && core::dot(between, between) < reach * reach) pairs.emplace_back(a, b);
                return ++visited < crowd;
            });
            if (!is_usual) pairs.resize(before);
        });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

/// Returns the energy of the bond from a hydrogen to an acceptor, in kcal/mol.
double energy_of(const Vec3d& nitrogen, const Vec3d& hydrogen, const PeptideAtoms& acceptor) {
    constexpr double coupling = 27.888, lowest = -9.9, nearest = 0.5; // 332 * 0.42 * 0.2
    const double ho = core::length(acceptor.o - hydrogen), hc = core::length(acceptor.c - hydrogen);
    const double nc = core::length(acceptor.c - nitrogen), no = core::length(acceptor.o - nitrogen);
    if (std::min({ho, hc, nc, no}) < nearest) return lowest;
    const double energy = coupling / hc - coupling / ho + coupling / no - coupling / nc;
    return std::max(std::round(energy * 1000.0) / 1000.0, lowest);
}

} // namespace

HydrogenBonds::HydrogenBonds(const std::vector<PeptideAtoms>& residues) : best_(residues.size()) {
    std::vector<Vec3d> hydrogens;
    for (std::size_t i = 0; i < residues.size(); ++i) {
        hydrogens.push_back(residues[i].n);
        if (!residues[i].follows) continue;
        const Vec3d carbonyl = residues[i - 1].c - residues[i - 1].o;
        const double size = core::length(carbonyl);
        if (size > 0.0) hydrogens.back() += 1.0 / size * carbonyl;
    }
    const auto add_bond = [&](std::size_t donor, std::size_t acceptor) {
        if (!residues[donor].is_proline)
            add(donor, acceptor,
                energy_of(residues[donor].n, hydrogens[donor], residues[acceptor]));
    };
    for (const auto& [a, b] : near_pairs(residues)) {
        add_bond(a, b);
        if (b != a + 1) add_bond(b, a);
    }
}

void HydrogenBonds::add(std::size_t donor, std::size_t acceptor, double energy) {
    auto& [first, second] = best_[donor];
    if (energy < first.energy) {
        second = first;
        first = {acceptor, energy};
    } else if (energy < second.energy) {
        second = {acceptor, energy};
    }
}

bool HydrogenBonds::has(std::size_t donor, std::size_t acceptor) const {
    const auto& bonds = best_[donor];
    return std::any_of(bonds.begin(), bonds.end(), [&](const Bonded& bond) {
        return bond.acceptor == acceptor && bond.energy < highest_energy;
    });
}

} // namespace raylane::scenes
