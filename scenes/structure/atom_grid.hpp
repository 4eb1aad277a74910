#pragma once

#include "scenes/structure/structure.hpp"

#include <array>
#include <compare>
#include <cstddef>
#include <span>
#include <vector>

namespace raylane::scenes {

/// Atoms sorted into the cells of a grid. It has no more cells than atoms, however far apart these
/// are.
class AtomGrid {
  public:
    /// Sorts atoms into cells of a width.
    AtomGrid(const std::vector<core::Vec3f>& positions, const std::vector<AtomIndex>& atoms,
             float width);

    /// The atoms in a cell and in those around it.
    class Near {
      public:
        /// Calls visit(atom) until it returns false; true if it never does.
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

    /// Calls visit(atom, those that are as near to it, and others) for all atoms.
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
    /// In widths. Whole numbers, which doubles hold however far out they are.
    struct Place {
        double z, y, x;
        auto operator<=>(const Place&) const = default; // NOLINT: no pointer
    };
    struct Cell {
        Place place;
        std::size_t first; ///< of its atoms, up to that of the next
    };

    Place place_of(const core::Vec3f& point) const;
    static Place first_of_row(const Place& place, std::size_t row);
    /// `begin`: of each row, a cell that is not behind its first.
    Near near(const Place& place, std::array<std::size_t, 9>& begin) const;

    double width_;
    std::vector<AtomIndex> atoms_; // by cell
    std::vector<Cell> cells_;      // and one behind them
};

} // namespace raylane::scenes
