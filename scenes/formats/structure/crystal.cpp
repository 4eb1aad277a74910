#include "scenes/formats/structure/crystal.hpp"

#include "scenes/formats/structure/bonds.hpp"
#include "scenes/formats/structure/images.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace raylane::scenes {

using core::Vec3d;

namespace {

using Cells = std::array<int, 3>;
using Rows = std::array<Vec3d, 3>;

constexpr double on_face = 0.05; // angstrom

Cells operator+(const Cells& a, const Cells& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Cells operator-(const Cells& a, const Cells& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Returns the cell that contains a place, along periodic edges; 0 along the others. A place at
/// most `tolerance` below a face is on it.
Cells cell_of(const Cell& cell, const Rows& rows, const Vec3d& place, double tolerance) {
    Cells result{};
    for (std::size_t k = 0; k < 3; ++k) {
        if (!cell.periodic[k]) continue;
        const double at = core::dot(rows[k], place) + tolerance * core::length(rows[k]);
        if (std::abs(at) < 1e6) result[k] = static_cast<int>(std::floor(at));
    }
    return result;
}

Vec3d place_in_cell(const Structure& structure, AtomIndex atom) {
    return core::convert<double>(structure.positions[atom]) - structure.cell.origin;
}

/// The atoms of a cell, and their images within the length of a bond.
struct Cluster {
    Structure structure;
    std::vector<AtomIndex> originals; ///< of the images
    std::vector<Cells> cells;         ///< of each atom: the image's cell relative to the file's
};

std::optional<Cluster> cluster_of(const Structure& structure, const Rows& rows) {
    const auto reach = static_cast<double>(longest_bond(structure));
    const std::size_t count = structure.size();
    Cells cells{};
    auto images = static_cast<double>(count);
    const double max_images = 30.0 * images + 20'000.0; // 27 each in all but tiny or flat cells
    for (std::size_t k = 0; k < 3; ++k) {
        if (!structure.cell.periodic[k]) continue;
        const double along = std::ceil(reach * core::length(rows[k]));
        images *= 2.0 * along + 1.0;
        if (!(images <= max_images)) return std::nullopt;
        cells[k] = static_cast<int>(along);
    }
    Cluster cluster;
    cluster.structure.of_kind = structure.of_kind;
    const auto add = [&](AtomIndex atom, const Cells& cell) {
        cluster.structure.positions.push_back(
            core::convert<float>(place_in_cell(structure, atom) + offset_in(structure.cell, cell)));
        cluster.structure.kinds.push_back(structure.kinds[atom]);
        cluster.cells.push_back(cell);
    };
    for (AtomIndex atom = 0; atom < count; ++atom)
        add(atom, Cells{} - cell_of(structure.cell, rows, place_in_cell(structure, atom), 0.0));
    const auto is_near = [&](const Vec3d& place) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double at = core::dot(rows[k], place), edge = reach * core::length(rows[k]);
            if (structure.cell.periodic[k] && !(at >= -edge && at <= 1.0 + edge)) return false;
        }
        return true;
    };
    Cells by{};
    for (by[0] = -cells[0]; by[0] <= cells[0]; ++by[0])
        for (by[1] = -cells[1]; by[1] <= cells[1]; ++by[1])
            for (by[2] = -cells[2]; by[2] <= cells[2]; ++by[2]) {
                if (by == Cells{}) continue;
                for (AtomIndex atom = 0; atom < count; ++atom) {
                    const Cells cell = cluster.cells[atom] + by;
                    if (!is_near(place_in_cell(structure, atom) + offset_in(structure.cell, cell)))
                        continue;
                    add(atom, cell);
                    cluster.originals.push_back(atom);
                }
            }
    return cluster;
}

/// A crystal's molecules: finite sets of bonded atoms. Atoms of infinite networks are alone.
class Molecules {
  public:
    Molecules(const Structure& structure, const PeriodicBonds& bonds, const Rows& rows,
              bool whole_molecules)
        : structure_(structure), bonds_(bonds), shift_(structure.size()),
          middle_(structure.size()) {
        std::vector<char> is_done(structure.size());
        for (AtomIndex atom = 0; atom < structure.size(); ++atom) {
            if (is_done[atom] != 0) continue;
            std::vector<AtomIndex> members = {atom};
            is_done[atom] = 1;
            bool is_finite = whole_molecules;
            if (whole_molecules) is_finite = collect(members, is_done);
            if (is_finite) {
                place(members, rows);
                continue;
            }
            for (const AtomIndex member : members) {
                shift_[member] = {};
                place({member}, rows);
            }
        }
    }

    /// Returns the cells by which an atom is moved to be in the first cell, with its molecule.
    const Cells& shift(AtomIndex atom) const { return shift_[atom]; }
    /// Returns the place of the mean of the atom's molecule in the first cell.
    const Vec3d& middle(AtomIndex atom) const { return middle_[atom]; }

  private:
    /// Adds all atoms of the first member's component, and their cells relative to the first.
    /// Returns false for a network that reaches its own image.
    bool collect(std::vector<AtomIndex>& members, std::vector<char>& is_done) {
        bool is_finite = true;
        for (std::size_t i = 0; i < members.size(); ++i)
            for (const PeriodicBond& bond : bonds_.of(members[i])) {
                const Cells cell = shift_[bond.a] + bond.cell;
                if (is_done[bond.b] == 0) {
                    is_done[bond.b] = 1;
                    shift_[bond.b] = cell;
                    members.push_back(bond.b);
                }
                is_finite = is_finite && shift_[bond.b] == cell;
            }
        return is_finite;
    }

    void place(const std::vector<AtomIndex>& members, const Rows& rows) {
        Vec3d sum(0.0);
        for (const AtomIndex member : members)
            sum = sum + place_in_cell(structure_, member) +
                  offset_in(structure_.cell, shift_[member]);
        const Vec3d mean = 1.0 / static_cast<double>(members.size()) * sum;
        const Cells cell = cell_of(structure_.cell, rows, mean, on_face);
        const Vec3d middle = mean - offset_in(structure_.cell, cell);
        for (const AtomIndex member : members) {
            shift_[member] = shift_[member] - cell;
            middle_[member] = middle;
        }
    }

    const Structure& structure_;
    const PeriodicBonds& bonds_;
    std::vector<Cells> shift_;
    std::vector<Vec3d> middle_;
};

/// The copies of a crystal's atoms by atom and cell.
class CopyIndex {
  public:
    explicit CopyIndex(const std::vector<AtomCopy>& copies) {
        for (std::size_t i = 0; i < copies.size(); ++i)
            index_.emplace_back(copies[i].atom, copies[i].cell, static_cast<AtomIndex>(i));
        std::sort(index_.begin(), index_.end());
    }
    std::optional<AtomIndex> find(AtomIndex atom, const Cells& cell) const {
        const std::tuple<AtomIndex, Cells, AtomIndex> wanted{atom, cell, 0};
        const auto found = std::lower_bound(index_.begin(), index_.end(), wanted);
        if (found == index_.end() || std::get<0>(*found) != atom || std::get<1>(*found) != cell)
            return std::nullopt;
        return std::get<2>(*found);
    }

  private:
    std::vector<std::tuple<AtomIndex, Cells, AtomIndex>> index_;
};

} // namespace

PeriodicBonds::PeriodicBonds(std::vector<PeriodicBond> bonds, std::size_t atoms)
    : bonds_(std::move(bonds)), first_(atoms + 1) {
    const auto key = [](const PeriodicBond& bond) { return std::tie(bond.a, bond.b, bond.cell); };
    // The first of equal bonds has the largest order.
    std::sort(bonds_.begin(), bonds_.end(), [&](const PeriodicBond& x, const PeriodicBond& y) {
        return key(x) != key(y) ? key(x) < key(y) : x.order > y.order;
    });
    bonds_.erase(std::unique(bonds_.begin(), bonds_.end(),
                             [&](const auto& x, const auto& y) { return key(x) == key(y); }),
                 bonds_.end());
    for (const PeriodicBond& bond : bonds_)
        ++first_[bond.a + 1];
    for (std::size_t i = 1; i < first_.size(); ++i)
        first_[i] += first_[i - 1];
}

std::optional<PeriodicBonds> periodic_bonds(const Structure& structure, std::size_t* crowded_atoms,
                                            std::vector<char>* is_metallic) {
    constexpr double longest_edge =
        1e6; // angstrom: copies of atoms stay in the range of coordinates
    for (const Vec3d& edge : structure.cell.edges)
        if (!(core::length(edge) <= longest_edge)) return std::nullopt;
    const std::optional<Rows> rows = reciprocal_edges(structure.cell);
    if (!rows) return std::nullopt;
    std::optional<Cluster> cluster = cluster_of(structure, *rows);
    if (!cluster) return std::nullopt;
    cluster->structure.has_all_bonds = structure.has_all_bonds;
    const std::size_t count = structure.size();
    std::vector<PeriodicBond> bonds;
    const auto add = [&](AtomIndex a, AtomIndex b, const Cells& cell, std::uint8_t order) {
        bonds.push_back({a, b, cell, order});
        bonds.push_back({b, a, Cells{} - cell, order});
    };
    for (const Bond& bond :
         find_bonds(cluster->structure, crowded_atoms, is_metallic, cluster->originals)) {
        const AtomIndex b = bond.b < count ? bond.b : cluster->originals[bond.b - count];
        add(bond.a, b, cluster->cells[bond.b] - cluster->cells[bond.a], bond.order);
    }
    for (const Bond& bond : structure.bonds)
        add(bond.a, bond.b,
            cells_between(structure.cell, place_in_cell(structure, bond.a),
                          place_in_cell(structure, bond.b)),
            bond.order);
    return PeriodicBonds(std::move(bonds), count);
}

std::vector<AtomCopy> fill_cells(const Structure& structure, const PeriodicBonds& bonds,
                                 const CrystalLook& look) {
    const Rows rows = reciprocal_edges(structure.cell).value();
    const Molecules molecules(structure, bonds, rows, look.whole);
    const auto is_on_face = [&](AtomIndex atom, std::size_t k) {
        return std::abs(core::dot(rows[k], molecules.middle(atom))) <=
               on_face * core::length(rows[k]);
    };
    Cells last{};
    for (std::size_t k = 0; k < 3; ++k)
        last[k] = look.repeat[k] - (look.boundary && structure.cell.periodic[k] ? 0 : 1);
    std::vector<AtomCopy> copies;
    Cells cell{};
    for (cell[0] = 0; cell[0] <= last[0]; ++cell[0])
        for (cell[1] = 0; cell[1] <= last[1]; ++cell[1])
            for (cell[2] = 0; cell[2] <= last[2]; ++cell[2])
                for (AtomIndex atom = 0; atom < structure.size(); ++atom) {
                    bool is_there = true;
                    for (std::size_t k = 0; k < 3; ++k)
                        is_there = is_there && (cell[k] < look.repeat[k] || is_on_face(atom, k));
                    if (is_there) copies.push_back({atom, molecules.shift(atom) + cell});
                }
    return copies;
}

void add_neighbours(const PeriodicBonds& bonds, const std::vector<char>& is_center,
                    std::vector<AtomCopy>& copies) {
    std::vector<std::pair<AtomIndex, Cells>> neighbours;
    for (const AtomCopy& copy : copies)
        if (is_center[copy.atom] != 0)
            for (const PeriodicBond& bond : bonds.of(copy.atom))
                neighbours.emplace_back(bond.b, copy.cell + bond.cell);
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    const CopyIndex index(copies);
    for (const auto& [atom, cell] : neighbours)
        if (!index.find(atom, cell)) copies.push_back({atom, cell});
}

CrystalAtoms atoms_of(const Structure& structure, const PeriodicBonds& bonds,
                      const std::vector<AtomCopy>& copies) {
    CrystalAtoms result;
    result.structure.of_kind = structure.of_kind;
    const CopyIndex index(copies);
    for (std::size_t i = 0; i < copies.size(); ++i) {
        const auto [atom, cell] = copies[i];
        result.originals.push_back(atom);
        result.structure.kinds.push_back(structure.kinds[atom]);
        result.structure.positions.push_back(core::convert<float>(
            core::convert<double>(structure.positions[atom]) + offset_in(structure.cell, cell)));
        for (const PeriodicBond& bond : bonds.of(atom))
            if (const auto other = index.find(bond.b, cell + bond.cell); other && *other > i)
                result.bonds.push_back({static_cast<AtomIndex>(i), *other, bond.order});
    }
    std::sort(result.bonds.begin(), result.bonds.end(),
              [](const Bond& x, const Bond& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
    return result;
}

} // namespace raylane::scenes
