#include "core/scene/surface.hpp"

#include "core/scene/copy_walk.hpp"
#include "core/shapes/solve.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::core {

namespace {

/// No plane contains all three directions.
constexpr double directions[3][3] = {{3, 4, 12}, {12, 3, -4}, {-4, 12, 3}};

/// Returns true if the point is on the surface: a ray that starts there crosses it at t = 0, for
/// one of the three directions.
template <class Shape>
bool is_on(const Shape& shape, const Vec3f& point) {
    for (const auto& d : directions) {
        std::uint64_t widened = 0;
        const Ray<double> ray{convert<double>(point), {d[0], d[1], d[2]}};
        for (const Crossing<double>& crossing : solve(shape, ray, Start{}, widened))
            if (crossing.t == 0.0) return true;
    }
    return false;
}

/// Returns true if the segment from a point of the surface to the eye enters the shape there, and
/// leaves it again.
template <class Shape>
bool hides(const Shape& shape, const Vec3f& point, const Vec3f& eye) {
    if (point == eye) return false;
    const Vec3d origin = convert<double>(point);
    const Ray<double> ray{origin, convert<double>(eye) - origin};
    std::uint64_t widened = 0;
    bool is_inside = false;
    for (const Crossing<double>& crossing : solve(shape, ray, Start{}, widened)) {
        if (is_inside && crossing.t > 0.0 && crossing.t < 1.0) return true;
        is_inside = crossing.t == 0.0 && crossing.entering;
    }
    return false;
}

struct Found {
    ShapeId id = no_shape;
    bool hides = false;
};

template <class Shape>
void find_in_block(const Table<Shape>& table, std::uint32_t index, const Vec3f& point,
                   const Vec3f& eye, Found& lowest) {
    for_each_in_block(table, index, [&](Place place, ShapeId id) {
        const auto& shape = table.get(place);
        if (id < lowest.id && is_on(shape, point)) lowest = {id, hides(shape, point, eye)};
    });
}

/// A ray from the point enters the copies whose bounds contain it at t = 0.
void find_in_copies(const Scene& scene, const Vec3f& point, const Vec3f& eye, Found& lowest) {
    const Copies* const copies = scene.copies();
    if (copies == nullptr) return;
    CopyWalk walk(*copies);
    walk.start({convert<double>(point), {1.0, 0.0, 0.0}});
    std::uint32_t number = 0;
    while (walk.next(0.0, number)) {
        const Copies::Copy copy = copies->copy_at(number);
        for_each_bounded_table(scene.shapes(), [&]<class Shape>(const Table<Shape>& table) {
            const auto kind = static_cast<std::size_t>(kind_of<Shape>);
            for (std::uint32_t i = 0; i < copy.set.block_count[kind]; ++i) {
                const std::uint32_t block = Copies::block_of(copy, kind_of<Shape>, i);
                copies->make(kind_of<Shape>, block);
                find_in_block(table, block, point, eye, lowest);
            }
        });
    }
}

/// Returns the shape with the lowest id whose surface contains the point.
Found find(const Scene& scene, const Vec3f& point, const Vec3f& eye) {
    Found lowest;
    for_each_unbounded_table(scene.shapes(), [&](const auto& table) {
        for (std::uint32_t index = 0; index < table.blocks().size(); ++index)
            find_in_block(table, index, point, eye, lowest);
    });

    const BigArray<WideNode>& nodes = scene.hierarchy().nodes;
    std::vector<Child> pending;
    if (!nodes.empty()) pending.push_back(Child::node(0));
    while (!pending.empty()) {
        const WideNode& node = nodes[pending.back().index()];
        pending.pop_back();
        for (int i = 0; i < block_size; ++i) {
            const Child child = node.children[i];
            if (child.empty() || !node.bounds(i).contains(point)) continue;
            if (!child.is_block()) {
                pending.push_back(child);
                continue;
            }
            with_table(scene.shapes(), child.kind(), [&](const auto& table) {
                find_in_block(table, child.index(), point, eye, lowest);
            });
        }
    }
    find_in_copies(scene, point, eye, lowest);
    return lowest;
}

} // namespace

ShapeId surface_through(const Scene& scene, const Vec3f& point) {
    return find(scene, point, point).id;
}

std::optional<Vec3f> point_beside_surface(const Scene& scene, const Vec3f& point,
                                          const Camera& camera) {
    const Vec3d origin = convert<double>(point), eye = convert<double>(camera.from);
    Vec3d aside = point == camera.from ? Vec3d(convert<double>(camera.at) - eye) : eye - origin;
    double size = length(aside);
    for (int axis = 0; axis < 3; ++axis)
        size = std::max(size, std::abs(origin[axis]));
    if (find(scene, point, camera.from).hides) aside = -aside;
    const auto clear = [&](const Vec3d& direction, double step) -> std::optional<Vec3f> {
        const auto beside = convert<float>(Vec3d(origin + step / length(direction) * direction));
        if (surface_through(scene, beside) != no_shape) return std::nullopt;
        return beside;
    };
    for (double step = size * 0x1p-12; step < size * 0x1p-4; step *= 2.0) {
        if (const auto beside = clear(aside, step)) return beside;
        for (const auto& d : directions)
            for (const double side : {step, -step})
                if (const auto beside = clear({d[0], d[1], d[2]}, side)) return beside;
    }
    return std::nullopt;
}

} // namespace raylane::core
