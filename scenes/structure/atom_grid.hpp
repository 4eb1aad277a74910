#pragma once

#include "scenes/structure/structure.hpp"

#include <vector>

namespace raylane::scenes {

/// Atoms sorted into the cells of a grid: who is near whom, in time linear in the atoms.
class AtomGrid {
  public:
    /// Of some atoms; cells are `size` wide, or wider so that there are no more than atoms.
    AtomGrid(const std::vector<core::Vec3f>& positions, std::vector<AtomIndex> atoms, float size);

    /// Calls visit(a, b) once for each two of them that may be as near to each other as `size`.
    template <class Visit>
    void for_each_pair(const Visit& visit) const {
        for (long z = 0; z < count_[2]; ++z)
            for (long y = 0; y < count_[1]; ++y)
                for (long x = 0; x < count_[0]; ++x) {
                    const std::size_t here = number(x, y, z);
                    for (std::size_t i = first_[here]; i < first_[here + 1]; ++i) {
                        for (std::size_t j = i + 1; j < first_[here + 1]; ++j)
                            visit(atoms_[i], atoms_[j]);
                        // Half of the neighbours: the others have this cell among theirs.
                        for_each_cell(x, y, z, [&](std::size_t there) {
                            if (there <= here) return;
                            for (std::size_t j = first_[there]; j < first_[there + 1]; ++j)
                                visit(atoms_[i], atoms_[j]);
                        });
                    }
                }
    }

    /// Calls visit(a) for each of them that may be as near to a point as `size`.
    template <class Visit>
    void for_each_near(const core::Vec3f& point, const Visit& visit) const {
        long place[3];
        for (int axis = 0; axis < 3; ++axis) {
            const double along = (static_cast<double>(point[axis]) - lower_[axis]) / size_;
            if (!(along >= -1.0) || !(along <= static_cast<double>(count_[axis]) + 1.0)) return;
            place[axis] = static_cast<long>(along + 1.0) - 1; // downwards
        }
        for_each_cell(place[0], place[1], place[2], [&](std::size_t cell) {
            for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i)
                visit(atoms_[i]);
        });
    }

  private:
    std::size_t number(long x, long y, long z) const {
        return static_cast<std::size_t>((z * count_[1] + y) * count_[0] + x);
    }
    std::size_t cell_of(const core::Vec3f& at) const;

    template <class Visit>
    void for_each_cell(long x, long y, long z, const Visit& visit) const {
        for (long w = std::max(z - 1, 0L); w <= z + 1 && w < count_[2]; ++w)
            for (long v = std::max(y - 1, 0L); v <= y + 1 && v < count_[1]; ++v)
                for (long u = std::max(x - 1, 0L); u <= x + 1 && u < count_[0]; ++u)
                    visit(number(u, v, w));
    }

    std::vector<AtomIndex> atoms_; // by cell
    double lower_[3], size_;
    long count_[3] = {1, 1, 1};
    std::vector<std::size_t> first_; // by cell: of its atoms, up to that of the next
};

} // namespace raylane::scenes
