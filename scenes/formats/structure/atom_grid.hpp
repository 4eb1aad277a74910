#pragma once

#include "scenes/formats/structure/structure.hpp"

#include <array>
#include <compare>
#include <cstddef>
#include <span>
#include <vector>

namespace raylane::scenes {

/// Atoms sorted into the cells of a grid. The grid has no more cells than atoms, however far apart
/// the atoms are.
class AtomGrid {
  public:
    /// Sorts atoms into cells of this width.
    AtomGrid(const std::vector<core::Vec3f>& positions, const std::vector<AtomIndex>& atoms,
             float width);

    /// The atoms in a cell and in the cells around it.
    class Near {
      public:
        /// Calls visit(atom) until it returns false. Returns true if it never does.
        template <class Visit>
        bool each(const Visit& visit) const {
            for (std::size_t row = 0; row < count_; ++row)
                for (const AtomIndex atom : rows_[row])
                    if (!visit(atom)) return false;
            return true;
        }

      private:
        friend class AtomGrid;
        std::array<std::span<const AtomIndex>, 9> rows_;
        std::size_t count_ = 0;
    };

    /// Calls visit(atom, near) for all atoms. `near` has all atoms within a cell's width, and
    /// others.
    template <class Visit>
    void for_each(const Visit& visit) const {
        std::array<std::size_t, 9> begin{};
        for (std::size_t cell = 0; cell + 1 < cells_.size(); ++cell) {
            const Near others = near(cells_[cell].place, begin);
            for (std::size_t i = cells_[cell].first; i < cells_[cell + 1].first; ++i)
                visit(atoms_[i], others);
        }
    }

  private:
    /// In cell widths. These are whole numbers, which are exact as doubles at any distance.
    struct Place {
        double z, y, x;
        auto operator<=>(const Place&) const = default; // NOLINT: no pointer
    };
    struct Cell {
        Place place;
        std::size_t first; ///< its first atom; its atoms end at the first of the next cell
    };

    Place place_of(const core::Vec3f& point) const;
    static Place first_of_row(const Place& place, std::size_t row);
    /// `begin`: for each row, a cell that is not after the row's first cell.
    Near near(const Place& place, std::array<std::size_t, 9>& begin) const;

    double width_;
    std::vector<AtomIndex> atoms_; // by cell
    std::vector<Cell> cells_;      // and one after the last
};

} // namespace raylane::scenes
