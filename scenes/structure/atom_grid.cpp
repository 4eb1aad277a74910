#include "scenes/structure/atom_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raylane::scenes {

AtomGrid::AtomGrid(const std::vector<core::Vec3f>& positions, std::vector<AtomIndex> atoms,
                   float size)
    : size_(std::max(static_cast<double>(size), 1e-6)) {
    double length[3];
    for (int axis = 0; axis < 3; ++axis) {
        float least = std::numeric_limits<float>::max(), most = -least;
        for (const AtomIndex atom : atoms) {
            least = std::min(least, positions[atom][axis]);
            most = std::max(most, positions[atom][axis]);
        }
        lower_[axis] = static_cast<double>(least);
        length[axis] = atoms.empty() ? 0.0 : static_cast<double>(most) - lower_[axis];
    }
    const double most_cells = std::max(64.0, static_cast<double>(atoms.size()));
    const auto cells = [&] {
        double all = 1.0;
        for (const double along : length)
            all *= std::floor(along / size_) + 1.0;
        return all;
    };
    while (!(cells() <= most_cells))
        size_ *= 1.25;
    for (int axis = 0; axis < 3; ++axis)
        count_[axis] = static_cast<long>(length[axis] / size_) + 1;

    // Sorted by counting.
    std::vector<std::uint32_t> cell(atoms.size());
    first_.assign(number(0, 0, count_[2]) + 1, 0);
    for (std::size_t i = 0; i < atoms.size(); ++i)
        ++first_[(cell[i] = static_cast<std::uint32_t>(cell_of(positions[atoms[i]]))) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i)
        first_[i] += first_[i - 1];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    atoms_.resize(atoms.size());
    for (std::size_t i = 0; i < atoms.size(); ++i)
        atoms_[next[cell[i]]++] = atoms[i];
}

std::size_t AtomGrid::cell_of(const core::Vec3f& at) const {
    long place[3];
    for (int axis = 0; axis < 3; ++axis)
        place[axis] =
            std::min(static_cast<long>((static_cast<double>(at[axis]) - lower_[axis]) / size_),
                     count_[axis] - 1);
    return number(place[0], place[1], place[2]);
}

} // namespace raylane::scenes
