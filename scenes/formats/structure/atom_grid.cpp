#include "scenes/formats/structure/atom_grid.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::scenes {

/// Makes cells slightly wider than `width`, so that rounding does not put near atoms further apart.
AtomGrid::AtomGrid(const std::vector<core::Vec3f>& positions, const std::vector<AtomIndex>& atoms,
                   float width)
    : width_(std::max(static_cast<double>(width) * (1.0 + 0x1p-20), 1e-6)) {
    struct Placed {
        Place place;
        AtomIndex atom;
        auto operator<=>(const Placed&) const = default; // NOLINT: no pointer
    };
    std::vector<Placed> placed;
    placed.reserve(atoms.size());
    for (const AtomIndex atom : atoms)
        placed.push_back({place_of(positions[atom]), atom});
    std::sort(placed.begin(), placed.end());
    atoms_.reserve(atoms.size());
    for (const Placed& next : placed) {
        if (cells_.empty() || cells_.back().place != next.place)
            cells_.push_back({next.place, atoms_.size()});
        atoms_.push_back(next.atom);
    }
    cells_.push_back({{}, atoms_.size()});
}

AtomGrid::Place AtomGrid::place_of(const core::Vec3f& point) const {
    const auto along = [&](float coordinate) {
        return std::floor(static_cast<double>(coordinate) / width_);
    };
    return {along(point.z), along(point.y), along(point.x)};
}

/// Returns the first of three cells in one of the nine rows around a place.
AtomGrid::Place AtomGrid::first_of_row(const Place& place, std::size_t row) {
    const std::size_t z = row / 3, y = row % 3;
    return {place.z + static_cast<double>(z) - 1.0, place.y + static_cast<double>(y) - 1.0,
            place.x - 1.0};
}

AtomGrid::Near AtomGrid::near(const Place& place, std::array<std::size_t, 9>& begin) const {
    Near near;
    for (std::size_t row = 0; row < begin.size(); ++row) {
        const Place first = first_of_row(place, row);
        // Far from the origin, adding 1 gives the same number.
        if (row % 3 != 0 && first_of_row(place, row - 1).y == first.y) continue;
        if (row >= 3 && first_of_row(place, row - 3).z == first.z) continue;
        std::size_t& cell = begin[row];
        const std::size_t end_of_all = cells_.size() - 1;
        while (cell < end_of_all && cells_[cell].place < first)
            ++cell;
        std::size_t end = cell;
        const Place last{first.z, first.y, place.x + 1.0};
        while (end < end_of_all && cells_[end].place <= last)
            ++end;
        near.rows_[near.count_++] =
            std::span(atoms_).subspan(cells_[cell].first, cells_[end].first - cells_[cell].first);
    }
    return near;
}

} // namespace raylane::scenes
