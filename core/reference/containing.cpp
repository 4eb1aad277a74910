#include "core/reference/containing.hpp"

#include "core/reference/enclosing.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::core {

PointSearcher::PointSearcher(const Scene& scene) : scene_(scene), parts_(scene) {
    const Solids& solids = scene.solids();
    for (Solids::Index solid = 0; solid < solids.nodes().size(); solid = solids.node(solid).end) {
        const Bounds& bounds = solids.bounds(solid);
        if (!is_finite(bounds) && bounds.lower.x <= bounds.upper.x) unbounded_.push_back(solid);
    }
}

void PointSearcher::add_containing(const Vec3d& point, std::vector<Containing>& found) {
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(point[axis])) return;
    Bounds around;
    include_point(around, point);
    const std::size_t first = found.size();
    solids_ = unbounded_;
    parts_.each_block(around, [&](Kind kind, std::uint32_t block) {
        with_table(scene_.shapes(), kind, [&]<class Shape>(const Table<Shape>& table) {
            for_each_in_block(table, block, [&](Place place, ShapeId id) {
                if (const Solids::Index part = scene_.solids().part_of(id); part != Solids::none) {
                    solids_.push_back(scene_.solids().root_of(part));
                } else if constexpr (is_solid<Shape>) {
                    const Side side = core::side_of(table.get(place), point);
                    if (side != Side::outside) found.push_back({id, side == Side::surface});
                }
            });
        });
        return true;
    });
    std::sort(solids_.begin(), solids_.end());
    solids_.erase(std::unique(solids_.begin(), solids_.end()), solids_.end());
    for (const Solids::Index solid : solids_) {
        if (scene_.solids().node(solid).open) continue;
        const Side side = side_of(solid, point);
        if (side != Side::outside)
            found.push_back({scene_.solids().node(solid).shape, side == Side::surface});
    }
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(),
              [](const Containing& a, const Containing& b) { return a.shape < b.shape; });
}

Side PointSearcher::side_of(Solids::Index index, const Vec3d& point) {
    const Solids::Node& node = scene_.solids().node(index);
    if (node.op == Solids::Op::part) {
        const Side side =
            with_table(scene_.shapes(), node.kind, [&]<class Shape>(const Table<Shape>& table) {
                if constexpr (has_inside<Shape>)
                    return core::side_of(table.get(node.place), point);
                else
                    return Side::outside;
            });
        return node.reversed ? static_cast<Side>(-static_cast<int>(side)) : side;
    }
    const bool of_all = node.op == Solids::Op::all;
    Side side = of_all ? Side::inside : Side::outside;
    const auto look = [&](Solids::Index child) {
        const Side of_child = side_of(child, point);
        side = of_all ? std::max(side, of_child) : std::min(side, of_child);
        return side != (of_all ? Side::outside : Side::inside);
    };
    if (node.many) {
        Bounds around;
        include_point(around, point);
        parts_.each_child(index, around, look);
    } else {
        scene_.solids().each_child(index, look);
    }
    return side;
}

} // namespace raylane::core
