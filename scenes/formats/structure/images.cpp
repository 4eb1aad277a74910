#include "scenes/formats/structure/images.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::scenes {

using core::Vec3d;

Vec3d offset_in(const Cell& cell, const std::array<int, 3>& cells) {
    // An edge that is not a number is unused if there is one cell along it.
    const auto along = [&](std::size_t edge) {
        return cells[edge] == 0 ? Vec3d(0.0) : static_cast<double>(cells[edge]) * cell.edges[edge];
    };
    return along(0) + along(1) + along(2);
}

std::optional<std::array<Vec3d, 3>> reciprocal_edges(const Cell& cell) {
    const Vec3d &u = cell.edges[0], &v = cell.edges[1], &w = cell.edges[2];
    const double volume = core::dot(u, core::cross(v, w));
    if (!(std::abs(volume) > 0.0 && std::abs(volume) < 1e60)) return std::nullopt;
    const double times = 1.0 / volume;
    return {{times * core::cross(v, w), times * core::cross(w, u), times * core::cross(u, v)}};
}

std::array<int, 3> cells_between(const Cell& cell, const Vec3d& a, const Vec3d& b) {
    const std::optional<std::array<Vec3d, 3>> across = reciprocal_edges(cell);
    if (!across) return {};
    std::array<int, 3> cells{};
    const Vec3d way = b - a;
    for (std::size_t k = 0; k < 3; ++k) {
        const double part = core::dot(way, (*across)[k]);
        if (!cell.periodic[k] || !(std::abs(part) < 1e6)) continue;
        cells[k] = -static_cast<int>(std::lround(part));
    }
    // In an oblique cell, one of the surrounding cells may be nearer.
    const auto squared = [&](const std::array<int, 3>& cell_counts) {
        const Vec3d at = way + offset_in(cell, cell_counts);
        return core::dot(at, at);
    };
    // If images are equally near, the original one is taken.
    std::array<int, 3> best{};
    for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
            for (int k = -1; k <= 1; ++k) {
                const std::array<int, 3> by = {i, j, k};
                std::array<int, 3> counts = cells;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    if (cell.periodic[axis]) counts[axis] += by[axis];
                if (squared(counts) < squared(best)) best = counts;
            }
    return best;
}

std::vector<Vec3d> offsets_of_images(const Cell& cell, const std::array<int, 3>& repeat) {
    std::vector<Vec3d> offsets;
    for (int u = 0; u < repeat[0]; ++u)
        for (int v = 0; v < repeat[1]; ++v)
            for (int w = 0; w < repeat[2]; ++w)
                offsets.push_back(offset_in(cell, {u, v, w}));
    return offsets;
}

Structure with_images(const Structure& structure, const std::array<int, 3>& repeat) {
    Structure repeated;
    repeated.of_kind = structure.of_kind;
    repeated.has_all_bonds = structure.has_all_bonds;
    for (const Vec3d& offset : offsets_of_images(structure.cell, repeat)) {
        const auto by = core::convert<float>(offset);
        for (const core::Vec3f& at : structure.positions)
            repeated.positions.push_back(at + by);
        repeated.kinds.insert(repeated.kinds.end(), structure.kinds.begin(), structure.kinds.end());
    }
    const auto count = static_cast<AtomIndex>(structure.size());
    const auto index_of = [&](const std::array<int, 3>& image) {
        return static_cast<AtomIndex>((image[0] * repeat[1] + image[1]) * repeat[2] + image[2]);
    };
    for (const Bond& bond : structure.bonds) {
        const std::array<int, 3> cells =
            structure.cell.any()
                ? cells_between(structure.cell, core::convert<double>(structure.positions[bond.a]),
                                core::convert<double>(structure.positions[bond.b]))
                : std::array<int, 3>{};
        std::array<int, 3> image{};
        for (image[0] = 0; image[0] < repeat[0]; ++image[0])
            for (image[1] = 0; image[1] < repeat[1]; ++image[1])
                for (image[2] = 0; image[2] < repeat[2]; ++image[2]) {
                    std::array<int, 3> other = image;
                    bool is_there = true;
                    for (std::size_t k = 0; k < 3; ++k) {
                        other[k] += cells[k];
                        is_there = is_there && other[k] >= 0 && other[k] < repeat[k];
                    }
                    if (!is_there) continue;
                    const AtomIndex a = index_of(image) * count + bond.a;
                    const AtomIndex b = index_of(other) * count + bond.b;
                    repeated.bonds.push_back({std::min(a, b), std::max(a, b), bond.order});
                }
    }
    return repeated;
}

} // namespace raylane::scenes
