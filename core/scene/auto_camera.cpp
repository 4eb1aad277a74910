#include "core/scene/auto_camera.hpp"

#include "core/numbers/elementary.hpp"
#include "core/numbers/primitives.hpp"
#include "core/scene/scene.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raylane::core {

namespace {

/// Includes any bounded shape, by a description that is cheap to compute.
template <class Shape>
void include_shape(const Shape& shape, Frame& frame) {
    constexpr Kind kind = kind_of<Shape>;
    if constexpr (kind == Kind::sphere) {
        frame.include(shape.center, shape.radius);
    } else if constexpr (kind == Kind::disc) {
        frame.include_disc(shape.center, shape.normal, shape.radius);
    } else if constexpr (kind == Kind::open_cylinder || kind == Kind::capped_cylinder) {
        frame.include_disc(shape.base, shape.axis, shape.radius);
        frame.include_disc(shape.base + shape.axis, shape.axis, shape.radius);
    } else if constexpr (kind == Kind::open_cone || kind == Kind::capped_cone) {
        frame.include_disc(shape.base, shape.axis, shape.base_radius);
        frame.include_disc(shape.base + shape.axis, shape.axis, shape.top_radius);
    } else if constexpr (kind == Kind::triangle || kind == Kind::smooth_triangle) {
        for (const Vec3d& corner : {shape.a, shape.b, shape.c})
            frame.include(corner, 0.0);
    } else {
        frame.include(bounds_of(shape));
    }
}

/// Returns true for a union, also if up to three half-spaces cut it, which enclose nothing by
/// themselves. Parts of it that rays do not cross then matter nowhere. Also returns true for an
/// intersection of shapes.
bool is_union_in_open_space(const Solids& solids, Solids::Index root) {
    int intersections = 0, planes = 0;
    for (Solids::Index index = root; index < solids.node(root).end; ++index) {
        const Solids::Node& node = solids.node(index);
        if (node.op == Solids::Op::all)
            ++intersections;
        else if (node.flat || node.kind == Kind::plane)
            ++planes;
        else if (node.reversed)
            return false;
    }
    return intersections == 0 ||
           (intersections == 1 && solids.node(root).op == Solids::Op::all && planes <= 3);
}

/// Finds bounded parts that contain a solid together, and sets them in `contain`. Returns whether
/// there are any. `skips_hidden`: parts that rays do not cross do not matter.
bool find_containing(const Solids& solids, Solids::Index index, bool skips_hidden,
                     std::vector<char>& contain) {
    const Solids::Node& node = solids.node(index);
    if (node.op == Solids::Op::part) {
        const bool is_bounded = !node.reversed && !node.flat && node.kind != Kind::plane &&
                                node.kind != Kind::quadric && node.shape != no_shape;
        contain[index] = is_bounded && node.traced ? 1 : 0;
        return is_bounded && (node.traced || skips_hidden);
    }
    const bool is_union = node.op == Solids::Op::any;
    bool is_contained = is_union;
    solids.each_child(index, [&](Solids::Index child) {
        is_contained = find_containing(solids, child, skips_hidden, contain);
        return is_contained == is_union;
    });
    if (!is_contained) std::fill(contain.begin() + index, contain.begin() + node.end, 0);
    return is_contained;
}

/// Returns the middle of all bounded shapes.
Vec3d center_of(const Scene& scene) {
    Bounds scene_bounds;
    for_each_bounded_shape(scene, [&](const auto& shape, ShapeId id) {
        if (!scene.solids().has(id)) scene_bounds.include(bounds_of(shape));
    });
    for (Solids::Index i = 0; i < scene.solids().nodes().size(); i = scene.solids().node(i).end)
        if (is_finite(scene.solids().bounds(i))) scene_bounds.include(scene.solids().bounds(i));
    if (!is_finite(scene_bounds)) return Vec3d(0.0);
    return 0.5 * (convert<double>(scene_bounds.lower) + convert<double>(scene_bounds.upper));
}

/// Returns the fog that did not come with the camera.
Fog own_fog_of(const Scene& scene) {
    return scene.auto_camera().depth_cue > 0.0F ? Fog{} : scene.fog();
}

/// Returns fog in the background's colour, between the nearest and the farthest point.
Fog depth_cue(const Scene& scene, const AutoCamera& auto_camera, const Frame& frame,
              const Camera& camera) {
    const auto [near, far] = frame.depths(camera);
    // Flat contents have less depth to show.
    const double cue =
        static_cast<double>(auto_camera.depth_cue) * std::min(1.0, (far - near) / frame.width());
    if (!(cue > 0.0 && far > near && far > 0.0)) return own_fog_of(scene);
    return {.kind = FogKind::linear,
            .color = scene.background(),
            .start = static_cast<float>(std::max(near, 0.0)),
            .end = static_cast<float>(near + (far - near) / cue)};
}

/// Returns the lights: a sky above the image, and a lamp over the left shoulder.
std::vector<Light> lights_of(const Frame& frame, const Camera& camera) {
    const auto [near, far] = frame.depths(camera);
    const double depth = frame.empty() ? 0.0 : std::max(far - near, 1e-20);
    const Vec3d at = convert<double>(camera.at);
    const double distance = 4.0 * std::max(depth, length(convert<double>(camera.from) - at));
    const Vec3d to_lamp = -0.55 * frame.right() + 0.75 * frame.up() + 0.9 * frame.back();
    return {{.kind = LightKind::sky,
             .direction = convert<float>(-frame.up()),
             .color = {0.8F, 0.85F, 0.9F},
             .ground = {0.38F, 0.33F, 0.31F}},
            {.kind = LightKind::sphere,
             .position = convert<float>(at + distance / length(to_lamp) * to_lamp),
             .color = {22.0F, 20.5F, 18.5F},
             .radius = static_cast<float>(0.19 * distance)}};
}

} // namespace

Frame empty_frame(const Scene& scene, const AutoCamera& auto_camera, const Settings& settings) {
    Frame frame(auto_camera.fit_camera ? *auto_camera.fit_camera : fit_camera_of(scene.camera()),
                static_cast<double>(settings.width) / settings.height);
    if (auto_camera.turning && auto_camera.fit_camera) frame.turn_about(center_of(scene));
    return frame;
}

void include_shapes(const Scene& scene, Frame& frame) {
    const Solids& solids = scene.solids();
    Frame boxes = frame.cleared(), parts = frame.cleared();
    std::vector<char> contain(solids.nodes().size());
    for (Solids::Index root = 0; root < contain.size(); root = solids.node(root).end) {
        boxes.include(solids.bounds(root));
        if (!find_containing(solids, root, is_union_in_open_space(solids, root), contain))
            parts.include(solids.bounds(root));
    }
    for_each_bounded_shape(scene, [&](const auto& shape, ShapeId id) {
        if (!solids.has(id))
            include_shape(shape, frame);
        else if (contain[solids.part_of(id)] != 0)
            include_shape(shape, parts);
    });
    if (!boxes.empty()) frame.include_common(boxes, parts.empty() ? boxes : parts);
}

View staged(const Scene& scene, const AutoCamera& auto_camera, const Frame& frame) {
    View view{.camera = scene.camera(), .fog = own_fog_of(scene), .lights = {}};
    if (auto_camera.fit_camera) {
        if (frame.empty())
            throw InvalidValue("camera", "must have a bounded shape to frame, got none");
        view.camera = frame.camera();
    }
    if (auto_camera.depth_cue > 0.0F && !frame.empty())
        view.fog = depth_cue(scene, auto_camera, frame, view.camera);
    if (auto_camera.lights) view.lights = lights_of(frame, view.camera);
    return view;
}

View staged(const Scene& scene, const AutoCamera& auto_camera, const Settings& settings) {
    Frame frame = empty_frame(scene, auto_camera, settings);
    include_shapes(scene, frame);
    return staged(scene, auto_camera, frame);
}

View turned(const View& view, const Vec3f& up, double degrees) {
    const auto turn =
        Elementary<double>::sin_cos(std::fmod(degrees, 360.0) * std::numbers::pi / 180.0);
    const Vec3d axis = 1.0 / length(convert<double>(up)) * convert<double>(up);
    const Vec3d at = convert<double>(view.camera.at);
    // Rodrigues' formula.
    const auto direction = [&](const Vec3d& v) {
        const Vec3d along = dot(v, axis) * axis;
        return along + turn.cosine * (v - along) + turn.sine * cross(axis, v);
    };
    const auto point = [&](const Vec3f& p) {
        return convert<float>(at + direction(convert<double>(p) - at));
    };
    View result = view;
    result.camera.from = point(view.camera.from);
    result.camera.up = convert<float>(direction(convert<double>(view.camera.up)));
    for (Light& light : result.lights) {
        light.position = point(light.position);
        light.direction = convert<float>(direction(convert<double>(light.direction)));
    }
    return result;
}

} // namespace raylane::core
