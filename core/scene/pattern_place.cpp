#include "core/scene/pattern_place.hpp"

#include "core/scene/shape_coordinates.hpp"

namespace raylane::core {

namespace {

/// Returns true for shapes whose u is a turn, and whose v ends at 0 and 1.
bool is_round(Kind kind) {
    return kind == Kind::sphere || kind == Kind::ellipsoid || kind == Kind::open_cylinder ||
           kind == Kind::capped_cylinder || kind == Kind::open_cone || kind == Kind::capped_cone;
}

bool needs_coordinates(const Pattern& pattern) {
    return pattern.kind == PatternKind::image ||
           (pattern.kind == PatternKind::formula && pattern.formula.program().needs_shape);
}

} // namespace

PatternPlace place_in_pattern(const Scene& scene, const Pattern& pattern,
                              const SurfacePlace& surface) {
    std::optional<ObjectSpace> space;
    if (pattern.follows_objects()) space = scene.object_space(surface.shape);
    PatternPlace result{space ? space->point(surface.point) : surface.point, {}};
    if (needs_coordinates(pattern))
        result.on_shape =
            coordinates_on(scene.shapes(), surface.kind, surface.place, surface.face, surface.point,
                           space ? &*space : nullptr, convert<double>(pattern.axis));
    return result;
}

Vec3d image_at(const Scene& scene, const Pattern& pattern, const SurfacePlace& surface) {
    return color_in_image(pattern, place_in_pattern(scene, pattern, surface).on_shape,
                          is_round(surface.kind));
}

} // namespace raylane::core
