#include "scenes/formats/structure/cell_layer.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace raylane::scenes {

using core::Vec3d;
using core::Vec3f;

namespace {

Vec3d unit(const Vec3d& v) {
    return 1.0 / core::length(v) * v;
}

/// Returns the positions of the corners of all cells that have a length along each edge.
std::vector<Vec3d> corners_of(const DrawnAtoms& atoms) {
    const Cell& cell = atoms.structure.cell;
    std::vector<Vec3d> corners;
    for (const Vec3f& image : atoms.images)
        for (int corner = 0; corner < 8; ++corner) {
            Vec3d at = cell.origin + core::convert<double>(image);
            for (int k = 0; k < 3; ++k)
                if ((corner >> k & 1) != 0) at = at + cell.edges[static_cast<std::size_t>(k)];
            corners.push_back(at);
        }
    return corners;
}

struct Range {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    void include(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
};

} // namespace

core::NamedView view_of_cell(const Cell& cell) {
    constexpr double left = 0.42, above = 0.28; // of the part along a
    const Vec3d c = unit(cell.edges[2]);
    const Vec3d a = unit(core::cross(cell.edges[1], cell.edges[2]));
    const Vec3d to_camera = a + left * core::cross(c, a) + above * c;
    return {"", core::convert<float>(-to_camera), core::convert<float>(c)};
}

core::NamedView view_along_edge(const Cell& cell, std::string_view name) {
    const auto edge = static_cast<std::size_t>(
        std::find(edge_names.begin(), edge_names.end(), name) - edge_names.begin());
    const auto direction = core::convert<float>(Vec3d(0.0) - unit(cell.edges[edge]));
    const Vec3d& up = cell.edges[edge == 2 ? 1 : 2];
    const double length = core::length(up);
    const bool is_flat = !(core::length(core::cross(cell.edges[edge], up)) >
                           1e-5 * length * core::length(cell.edges[edge]));
    return {name, direction,
            is_flat ? core::upright(direction) : core::convert<float>(1.0 / length * up)};
}

core::NamedView best_view_of_cell(const Cell& cell, const std::array<int, 3>& repeat) {
    constexpr double equal = 1.001;
    std::size_t shortest = 2;
    const auto size = [&](std::size_t k) { return repeat[k] * core::length(cell.edges[k]); };
    for (const std::size_t k : {1U, 0U})
        if (size(k) * equal < size(shortest)) shortest = k;
    return view_along_edge(cell, edge_names[shortest]);
}

void add_cell_edges(const DrawnAtoms& atoms, DrawnShapes& shapes) {
    constexpr double thickness = 0.002; // radius, of the extent
    const core::MaterialIndex dark = Palette(shapes.builder(), 1.0F, atoms.finish).of(0x505050, [] {
        return std::string("cell");
    });
    const Cell& cell = atoms.structure.cell;
    std::array<Vec3f, 3> edges;
    int flat = 0; // bits of edges without a length, as of a slab or a chain
    for (std::size_t k = 0; k < 3; ++k) {
        edges[k] = core::convert<float>(cell.edges[k]);
        if (edges[k] == Vec3f(0.0F)) flat |= 1 << k;
    }
    const std::vector<Vec3d> corners = corners_of(atoms);
    const auto radius =
        static_cast<float>(thickness * core::length(corners.back() - corners.front()));
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const int corner = static_cast<int>(i % 8);
        if ((corner & flat) != 0) continue;
        const auto from = core::convert<float>(corners[i]);
        shapes.add_whole(core::Sphere{from, radius}, dark, no_atoms);
        for (int k = 0; k < 3; ++k)
            if (((corner | flat) >> k & 1) == 0)
                shapes.add_whole(
                    core::CappedCylinder{from, edges[static_cast<std::size_t>(k)], radius}, dark,
                    no_atoms);
    }
}

void add_axes(const DrawnAtoms& atoms, const core::FitCamera& camera, double radius,
              DrawnShapes& shapes) {
    constexpr double share = 0.13; // length, of the extent
    const Vec3d forward = unit(core::convert<double>(camera.direction));
    const Vec3d right = unit(core::cross(forward, core::convert<double>(camera.up)));
    const Vec3d up = core::cross(right, forward);
    Range across, upward, depth;
    const auto include = [&](const Vec3d& at) {
        across.include(core::dot(at, right));
        upward.include(core::dot(at, up));
        depth.include(core::dot(at, forward));
    };
    atoms.for_each([&](AtomIndex, const Vec3f& at) { include(core::convert<double>(at)); });
    for (const Vec3d& corner : corners_of(atoms))
        include(corner);
    const double length =
        share * std::max({across.most - across.least, upward.most - upward.least, 1.0});
    Range across_axes, upward_axes;
    across_axes.include(0.0);
    upward_axes.include(0.0);
    std::array<Vec3d, 3> axes;
    for (std::size_t k = 0; k < 3; ++k) {
        axes[k] = length * unit(atoms.structure.cell.edges[k]);
        across_axes.include(core::dot(axes[k], right));
        upward_axes.include(core::dot(axes[k], up));
    }
    const Vec3d at = (across.least - radius - 0.35 * length - across_axes.most) * right +
                     (upward.least - upward_axes.least) * up +
                     (depth.least - radius) * forward; // before the depth cue pales colours
    Palette palette(shapes.builder(), 1.0F, atoms.finish);
    constexpr std::uint32_t colors[] = {0xC83C32, 0x3C9646, 0x325AC8};
    const auto thin = static_cast<float>(0.04 * length), wide = static_cast<float>(0.1 * length);
    for (std::size_t k = 0; k < 3; ++k) {
        const core::MaterialIndex material = palette.of(
            colors[k], [&] { return std::string("axis ") + static_cast<char>('a' + k); });
        const auto base = core::convert<float>(at);
        const auto head = core::convert<float>(at + 0.68 * axes[k]);
        shapes.add_whole(core::CappedCylinder{base, head - base, thin}, material, no_atoms);
        shapes.add_whole(core::CappedCone{head, core::convert<float>(0.32 * axes[k]), wide, 0.0F},
                         material, no_atoms);
    }
    shapes.add_whole(core::Sphere{core::convert<float>(at), 1.5F * thin},
                     palette.of(0x808080, [] { return std::string("axes"); }), no_atoms);
}

} // namespace raylane::scenes
