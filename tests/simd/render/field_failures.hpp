#pragma once

#include "core/scene/camera_rays.hpp"
#include "core/shapes/shapes.hpp"
#include "core/shapes/solve.hpp"
#include "core/shapes/types.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/oracle/first_hit.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"

#include <cmath>
#include <optional>
#include <vector>

/// Scenes that other renderers rendered wrongly. Images are compared with the oracle, pixel by
/// pixel. The textbook's formulas in float fail on these scenes.
namespace field {

using namespace raylane;
using namespace little_scene;

/// If true, scenes have shapes in double. Their numbers are not floats, but so close to floats that
/// no pixel changes.
inline bool shapes_in_double = false; // NOLINT: tests run one after the other

class FieldBuilder : public Builder {
  public:
    template <class Shape>
    ShapeId add(const Shape& shape, MaterialIndex material) {
        if (!shapes_in_double) return SceneBuilder::add(shape, material);
        auto numbers = numbers_of(to_doubles(shape));
        for (double& number : numbers)
            number *= 1.0 + 0x1p-44;
        return SceneBuilder::add(shape_of<InDouble<Shape>>(numbers), material);
    }
    template <class Shape>
    ShapeId add_shape(const Shape& shape, const Material& material) {
        return add(shape, add_material(material));
    }
};

/// Returns a material that is slightly luminous, so that hits differ from misses. It is matte or,
/// like plastic, has a highlight.
inline Material chalk(float specular = 0.0F) {
    Material material = luminous();
    material.ambient = 0.25F;
    material.diffuse = 0.5F;
    material.specular = specular;
    material.exponent = 16.0F;
    return material;
}

inline Light sun_along(const Vec3f& direction) {
    return {.kind = LightKind::directional, .direction = direction};
}

inline Film drawn(const Scene& scene) {
    return simd::render(scene, scene.settings(), {}).film;
}

/// Calls visit(ray, colour) for each pixel of a scene's image.
template <class Visit>
void for_each_pixel(const Scene& scene, const Visit& visit) {
    const Film film = drawn(scene);
    const CameraRays<double> rays(scene.camera(), scene.settings());
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x)
            visit(rays.ray(x, y, 0), film.at(x, y));
}

struct Seen {
    double t;
    Vec3d point;
    Vec3d normal; ///< towards the viewer
};

/// Returns the first of some shapes that the oracle finds along a ray.
template <class Shape>
std::optional<Seen> first_seen(const std::vector<Shape>& shapes, const Ray<double>& ray) {
    std::optional<Seen> first;
    for (const Shape& shape : shapes) {
        const auto truth = oracle::first_hit(shape, ray);
        if (!truth) continue;
        const auto t = truth->t.template convert_to<double>();
        if (first && first->t <= t) continue;
        // The oracle knows no faces.
        std::uint64_t widened = 0;
        Face face = body;
        for (const Crossing<double>& crossing : solve(shape, ray, Start{}, widened))
            if (crossing.entering == truth->entering) face = crossing.face;
        const Vec3d point = mul_add(t, ray.direction, ray.origin);
        const Vec3d normal = outward_normal(shape, point, face);
        first = Seen{t, point, dot(normal, ray.direction) > 0.0 ? -normal : normal};
    }
    return first;
}

struct Comparison {
    int hits = 0;
    int wrong = 0;      ///< hits for misses, and the reverse
    double worst = 0.0; ///< difference of brightness where both hit
};

inline constexpr double invisible = 1e-5; // in brightness

/// Checks that enough pixels show the shapes, and that none differs visibly.
inline void check_right(const Comparison& ours, double min_hits) {
    CHECK(ours.hits > min_hits);
    CHECK(ours.wrong == 0);
    CHECK(ours.worst < invisible);
}

/// Returns chalk's brightness in unobstructed light.
inline double brightness(const Vec3d& normal, const Vec3d& to_light, double specular) {
    const double cos = std::max(dot(normal, to_light), 0.0);
    return 0.25 + 0.5 * cos + (cos > 0.0 ? specular * std::pow(cos, 16.0) : 0.0);
}

/// Compares a scene of chalk, lit from `to_light`, with the oracle's hits shaded without shadows.
/// If there is a highlight, the view must be from the light.
template <class Shape>
Comparison compare(const Scene& scene, const std::vector<Shape>& shapes, const Vec3d& to_light,
                   double specular = 0.0) {
    Comparison result;
    for_each_pixel(scene, [&](const Ray<double>& ray, const Color& color) {
        const auto seen = first_seen(shapes, ray);
        result.hits += seen ? 1 : 0;
        if (seen.has_value() != (color.x > 0.2F)) {
            ++result.wrong;
            return;
        }
        if (!seen) return;
        const double expected = brightness(seen->normal, to_light, specular);
        result.worst = std::max(result.worst, std::abs(static_cast<double>(color.x) - expected));
    });
    return result;
}

/// Roots as textbooks print them, in float: b^2 - 4 a c, and both roots from it.
struct Roots {
    float first, second;
};
inline std::optional<Roots> textbook_roots(float a, float b, float c) {
    const float discriminant = b * b - 4.0F * a * c;
    if (!(discriminant >= 0.0F)) return std::nullopt;
    const float root = std::sqrt(discriminant);
    return Roots{(-b - root) / (2.0F * a), (-b + root) / (2.0F * a)};
}

inline std::optional<float> textbook_hit(const Sphere& sphere, const Ray<float>& ray, float least) {
    const Vec3f f = ray.origin - sphere.center, d = ray.direction;
    const auto roots =
        textbook_roots(dot(d, d), 2.0F * dot(f, d), dot(f, f) - sphere.radius * sphere.radius);
    if (roots)
        for (const float t : {roots->first, roots->second})
            if (t > least) return t;
    return std::nullopt;
}

/// Solves |p|^2 - (p.a)^2 = (r0 + k p.a)^2 for the unit axis a.
template <class Axial>
std::optional<float> textbook_axial_hit(const Axial& shape, float r0, float r1,
                                        const Ray<float>& ray, float least) {
    const float height = length(shape.axis), k = (r1 - r0) / height;
    const Vec3f a = shape.axis / height, f = ray.origin - shape.base, d = ray.direction;
    const float fa = dot(f, a), da = dot(d, a), width = r0 + k * fa, grows = k * da;
    const auto roots = textbook_roots(dot(d, d) - da * da - grows * grows,
                                      2.0F * (dot(f, d) - fa * da - width * grows),
                                      dot(f, f) - fa * fa - width * width);
    if (roots)
        for (const float t : {roots->first, roots->second})
            if (t > least && fa + t * da >= 0.0F && fa + t * da <= height) return t;
    return std::nullopt;
}
template <Ends ends>
std::optional<float> textbook_hit(const Cylinder<ends>& cylinder, const Ray<float>& ray,
                                  float least) {
    return textbook_axial_hit(cylinder, cylinder.radius, cylinder.radius, ray, least);
}
template <Ends ends>
std::optional<float> textbook_hit(const Cone<ends>& cone, const Ray<float>& ray, float least) {
    return textbook_axial_hit(cone, cone.base_radius, cone.top_radius, ray, least);
}

inline Ray<float> rounded(const Ray<double>& ray) {
    return {convert<float>(ray.origin), convert<float>(ray.direction)};
}

/// Makes the same comparison for the textbook's formulas, with shadow rays that begin at `epsilon`.
/// Caps of bodies must not be visible.
template <class Shape>
Comparison compare_textbook(const Scene& scene, const std::vector<Shape>& shapes,
                            const Vec3d& to_light, float epsilon) {
    Comparison result;
    const auto first = [&](const Ray<float>& ray, float least) {
        std::pair<std::optional<float>, const Shape*> best;
        for (const Shape& shape : shapes) {
            const auto t = textbook_hit(shape, ray, least);
            if (t && (!best.first || *t < *best.first)) best = {t, &shape};
        }
        return best;
    };
    for_each_pixel(scene, [&](const Ray<double>& exact, const Color&) {
        const auto seen = first_seen(shapes, exact);
        const Ray<float> ray = rounded(exact);
        const auto [t, shape] = first(ray, 0.0F);
        result.hits += seen ? 1 : 0;
        result.wrong += seen.has_value() != t.has_value() ? 1 : 0;
        if (!seen || !t) return;
        const Vec3f point = ray.origin + *t * ray.direction;
        Vec3f normal = outward_normal(*shape, point, body);
        if (dot(normal, ray.direction) > 0.0F) normal = -normal;
        const bool dark = first({point, convert<float>(to_light)}, epsilon).first.has_value();
        const double found = dark ? 0.25 : brightness(convert<double>(normal), to_light, 0.0);
        result.worst =
            std::max(result.worst, std::abs(found - brightness(seen->normal, to_light, 0.0)));
    });
    return result;
}

/// Renders mirrors in a white room. With one reflection, a convex mirror cannot be seen, and is
/// black where the reflection hits it again. Without reflections it is black.
inline Film in_white_room(FieldBuilder builder, int reflections) {
    builder.background = Color(1.0F);
    builder.settings.max_depth = reflections;
    return drawn(builder.finish());
}
inline int count_not_white(const Film& film) {
    int count = 0;
    for (const Color& color : film.pixels())
        count += color == Color(1.0F) ? 0 : 1;
    return count;
}

/// Returns the number of camera rays whose reflection meets the shape again by the textbook's
/// formulas.
template <class Shape>
int textbook_self_hits(const Scene& scene, const Shape& shape, float epsilon) {
    int count = 0;
    for_each_pixel(scene, [&](const Ray<double>& exact, const Color&) {
        const Ray<float> ray = rounded(exact);
        const auto t = textbook_hit(shape, ray, 0.0F);
        if (!t) return;
        const Vec3f point = ray.origin + *t * ray.direction;
        const Vec3f onward = reflected(ray.direction, outward_normal(shape, point, body));
        count += textbook_hit(shape, {point, onward}, epsilon) ? 1 : 0;
    });
    return count;
}

/// Returns a builder for a small square image.
inline FieldBuilder square(int pixels, const Camera& camera) {
    FieldBuilder builder;
    builder.settings.width = builder.settings.height = pixels;
    builder.settings.grid = 1;
    builder.camera = camera;
    return builder;
}

inline Camera perspective(const Vec3f& from, const Vec3f& at, float field_of_view,
                          const Vec3f& up = {0, 1, 0}) {
    return {Projection::perspective, from, at, up, field_of_view, 2.0F};
}
inline Camera orthographic(const Vec3f& from, const Vec3f& at, float height,
                           const Vec3f& up = {0, 1, 0}) {
    return {Projection::orthographic, from, at, up, 45.0F, height};
}

} // namespace field
