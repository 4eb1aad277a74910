#include "tests/scenes/api/c_rows.hpp"

#include <array>
#include <bit>
#include <optional>
#include <set>

/// Tests of shapes in double, solids and materials of the C interface against the C++ library.
using namespace raylane;
using namespace raylane::tests;

namespace {

/// The type and the functions of C for a core shape.
template <class CoreShape>
struct InC;
#define RAYLANE_IN_C(Shape, one, all, c_shape)                                                     \
    template <>                                                                                    \
    struct InC<core::Shape> {                                                                      \
        using Type = raylane_double_##c_shape;                                                     \
        static constexpr auto add = raylane_add_##all##_doubles;                                   \
        static constexpr auto solid = raylane_solid_##one;                                         \
    };
RAYLANE_IN_C(Sphere, sphere, spheres, sphere)
RAYLANE_IN_C(Plane, plane, planes, plane)
RAYLANE_IN_C(Disc, disc, discs, disc)
RAYLANE_IN_C(Triangle, triangle, triangles, triangle)
RAYLANE_IN_C(SmoothTriangle, smooth_triangle, smooth_triangles, smooth_triangle)
RAYLANE_IN_C(Box, box, boxes, box)
RAYLANE_IN_C(OpenCylinder, open_cylinder, open_cylinders, cylinder)
RAYLANE_IN_C(CappedCylinder, capped_cylinder, capped_cylinders, cylinder)
RAYLANE_IN_C(OpenCone, open_cone, open_cones, cone)
RAYLANE_IN_C(CappedCone, capped_cone, capped_cones, cone)
RAYLANE_IN_C(Quadric, quadric, quadrics, quadric)
RAYLANE_IN_C(Ellipsoid, ellipsoid, ellipsoids, ellipsoid)
#undef RAYLANE_IN_C

/// Returns the shape with numbers that are no floats.
template <class CoreShape>
typename InC<CoreShape>::Type in_double(const CoreShape& shape) {
    constexpr std::size_t count = sizeof(CoreShape) / sizeof(float);
    const auto floats = std::bit_cast<std::array<float, count>>(shape);
    std::array<double, count> numbers{};
    for (std::size_t i = 0; i < count; ++i)
        numbers[i] = static_cast<double>(floats[i]) * (1.0 + 0x1p-30);
    return std::bit_cast<typename InC<CoreShape>::Type>(numbers);
}

/// Adds rays that are aimed at a shape, from all around it.
template <class CoreShape>
void aim_at(const CoreShape& shape, Random& random, DoubleRays& rays) {
    for (const Set set : ray_sets::all_sets)
        for (int i = 0; i < 20; ++i) {
            const core::Ray<float> ray = ray_sets::make_ray(shape, set, random);
            rays.add({core::convert<double>(ray.origin), core::convert<double>(ray.direction)}, 0.0,
                     endless);
        }
}

template <class CoreShape>
using InCpp = typename InLibrary<core::InDouble<CoreShape>>::Type;

std::uint32_t add_material_in_c(const Builder& builder) {
    const raylane_material plain = raylane_default_material();
    std::uint32_t index = 0;
    REQUIRE(raylane_add_material(builder.get(), &plain, &index) == RAYLANE_OK);
    return index;
}

template <class CShape>
SolidHandle solid_in_c(raylane_status (*make)(const CShape*, std::uint32_t, raylane_solid**),
                       const CShape& shape, std::uint32_t material = RAYLANE_NO_MATERIAL) {
    return made<SolidHandle>([&](raylane_solid** to) { return make(&shape, material, to); });
}

constexpr raylane_double_sphere everything = {{0, 0, 0}, 1e6};
constexpr raylane_double_sphere big_ball = {{0.1, 0.2, 0.3}, 1.1};
constexpr raylane_double_box brick = {{-1.1, -0.7, -0.6}, {2.3, 0, 0}, {0, 1.3, 0}, {0, 0.1, 1.7}};
constexpr raylane_double_cylinder bore = {{-3, 0.1, 0.1}, {6, 0.1, 0}, 0.4};

constexpr raylane_double_sphere outer_ball = {{0, 0, 0}, 1.25};

/// Returns a brick joined with a ball, both cut by a larger ball of another material, and bored.
SolidHandle body_in_c() {
    const auto join = [](auto combine, const SolidHandle& a, const SolidHandle& b,
                         std::uint32_t material) {
        const raylane_solid* const parts[] = {a.get(), b.get()};
        return made<SolidHandle>(
            [&](raylane_solid** to) { return combine(parts, 2, material, to); });
    };
    const SolidHandle both = join(raylane_solid_union, solid_in_c(raylane_solid_box, brick, 1),
                                  solid_in_c(raylane_solid_sphere, big_ball), RAYLANE_NO_MATERIAL);
    const SolidHandle whole_solid =
        join(raylane_solid_intersection, both, solid_in_c(raylane_solid_sphere, outer_ball), 2);
    const SolidHandle hole = solid_in_c(raylane_solid_capped_cylinder, bore);
    const raylane_solid* const holes[] = {hole.get()};
    return made<SolidHandle>([&](raylane_solid** to) {
        return raylane_solid_difference(whole_solid.get(), holes, 1, RAYLANE_NO_MATERIAL, to);
    });
}

raylane::Solid body() {
    const auto ball = [](const auto& sphere) { return std::bit_cast<SphereOf<double>>(sphere); };
    const raylane::Solid both =
        union_of({raylane::Solid(std::bit_cast<BoxOf<double>>(brick), 1), ball(big_ball)});
    return difference_of(intersection_of({both, ball(outer_ball)}).of(2),
                         {std::bit_cast<CappedCylinderOf<double>>(bore)});
}

constexpr Lens lens = {.vertex = {0, 0, -2.5},
                       .radii = {3.1, -2.9},
                       .conics = {0, -1},
                       .thickness = 0.9,
                       .radius = 1.1};

SolidHandle lens_in_c() {
    raylane_lens same = raylane_default_lens();
    CHECK(same.axis.z == Lens{}.axis.z);
    same.vertex.z = lens.vertex.z;
    std::copy(std::begin(lens.radii), std::end(lens.radii), same.radii);
    same.conics[1] = lens.conics[1];
    same.thickness = lens.thickness;
    same.radius = lens.radius;
    return made<SolidHandle>([&](raylane_solid** to) { return raylane_solid_lens(&same, 1, to); });
}

} // namespace

TEST_CASE("C adds shapes in double of every kind as C++ does") {
    Random random(11);
    const Builder in_c = builder_in_c();
    SceneBuilder builder;
    const std::uint32_t material = add_material_in_c(in_c);
    builder.add_material({});
    DoubleRays rays;
    core::for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
        const Shape floats[] = {ray_sets::Target<Shape>::make(random, false),
                                ray_sets::Target<Shape>::make(random, false)};
        for (const Shape& shape : floats)
            aim_at(shape, random, rays);
        const typename InC<Shape>::Type shapes[] = {in_double(floats[0]), in_double(floats[1])};
        std::uint32_t first = 77;
        CHECK(InC<Shape>::add(in_c.get(), shapes, 2, material, &first) == RAYLANE_OK);
        CHECK(first == builder.shape_count());
        for (const auto& shape : shapes)
            builder.add(std::bit_cast<InCpp<Shape>>(shape), material);
    });
    const raylane_double_triangle halves[] = {
        {{-9.1, -9.1, 0.1}, {9.1, -9.1, 0.1}, {9.1, 9.1, 0.1}},
        {{-9.1, -9.1, 0.1}, {9.1, 9.1, 0.1}, {-9.1, 9.1, 0.1}}};
    CHECK(raylane_add_polygon_doubles(in_c.get(), halves, 2, material, nullptr) == RAYLANE_OK);
    builder.add_polygon(std::bit_cast<std::array<TriangleOf<double>, 2>>(halves), material);
    for (const double x : {-1.0, 1.0})
        rays.add({{x, -x, 5.0}, {0.0, 0.0, -1.0}}, 0.0, endless);
    const std::size_t count = builder.shape_count();
    const CrossingRows rows = check_crossings(built(in_c), builder.build(), rays);
    // Random quadrics may have no surface within their boxes.
    const std::set<ShapeId> met(rows.shape_id.begin(), rows.shape_id.end());
    CHECK(met.size() + 2 >= count);
}

TEST_CASE("C makes solids of every kind of shape as C++ does") {
    Random random(13);
    core::for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
        const auto floats = ray_sets::Target<Shape>::make(random, false);
        const auto shape = in_double(floats);
        const Builder in_c = builder_in_c();
        SceneBuilder builder;
        const std::uint32_t material = add_material_in_c(in_c);
        builder.add_material(Material{});
        const SolidHandle whole_solid =
            solid_in_c<typename InC<Shape>::Type>(InC<Shape>::solid, shape);
        const SolidHandle by = solid_in_c(raylane_solid_sphere, everything);
        const raylane_solid* const all_by[] = {by.get()};
        const SolidHandle part = made<SolidHandle>([&](raylane_solid** to) {
            return raylane_solid_clipped(whole_solid.get(), all_by, 1, RAYLANE_NO_MATERIAL, to);
        });
        const raylane_status status = raylane_add_solid(in_c.get(), part.get(), material, nullptr);
        std::optional<std::string> refusal;
        try {
            builder.add(clipped(std::bit_cast<InCpp<Shape>>(shape),
                                {std::bit_cast<SphereOf<double>>(everything)}),
                        material);
        } catch (const InvalidValue& error) {
            refusal = error.what();
        }
        CHECK((status == RAYLANE_OK) == !refusal);
        if (refusal) {
            CHECK(raylane_error_text() == *refusal);
            return;
        }
        DoubleRays rays;
        aim_at(floats, random, rays);
        CHECK(!check_crossings(built(in_c), builder.build(), rays).t.empty());
    });
}

TEST_CASE("unions and intersections and differences and lenses in C are those of C++") {
    const Builder in_c = builder_in_c();
    SceneBuilder builder;
    for (int i = 0; i < 3; ++i) {
        add_material_in_c(in_c);
        builder.add_material({});
    }
    std::uint32_t first = 77, lens_id = 77;
    CHECK(raylane_add_solid(in_c.get(), body_in_c().get(), 0, &first) == RAYLANE_OK);
    CHECK(first == builder.add(body(), 0));
    CHECK(raylane_add_solid(in_c.get(), lens_in_c().get(), 0, &lens_id) == RAYLANE_OK);
    CHECK(lens_id == builder.add(solid_of(lens).of(1), 0));

    const SceneHandle scene_in_c = built(in_c);
    const Scene scene = builder.build();
    const DoubleRays rays = rays_through_all(3000, 15);
    const CrossingRows rows = check_crossings(scene_in_c, scene, rays);
    for (ShapeId id = 0; id < scene.shape_count(); ++id) {
        std::uint32_t material = 77, solid = 77;
        CHECK(std::count(rows.shape_id.begin(), rows.shape_id.end(), id) > 0);
        CHECK(raylane_scene_material_of(scene_in_c.get(), id, &material) == RAYLANE_OK);
        CHECK(material == scene.material_of(id));
        CHECK(raylane_scene_solid_of(scene_in_c.get(), id, &solid) == RAYLANE_OK);
        CHECK(solid == scene.solid_of(id));
    }
    check_lengths(scene_in_c, scene, rays);
}

TEST_CASE("C takes glass and gives the materials of a scene back") {
    const Builder builder = builder_in_c();
    raylane_material glass = raylane_default_material();
    constexpr double B[] = {1.03961212, 0.231792344, 1.01046945},
                     C[] = {0.00600069867, 0.0200179144, 103.560653};
    std::copy(std::begin(B), std::end(B), glass.glass.B);
    std::copy(std::begin(C), std::end(C), glass.glass.C);
    glass.transmission = 0.9F;
    CHECK(raylane_add_material(builder.get(), &glass, nullptr) == RAYLANE_OK);
    const SceneHandle scene = built(builder);
    raylane_material found = raylane_default_material();
    CHECK(raylane_scene_material(scene.get(), 0, &found) == RAYLANE_OK);
    CHECK(std::equal(std::begin(B), std::end(B), found.glass.B));
    CHECK(std::equal(std::begin(C), std::end(C), found.glass.C));
    CHECK(found.transmission == 0.9F);
    CHECK(found.index == Approx(1.5168).margin(1e-4)); // of BK7
    CHECK(raylane_scene_material(scene.get(), 1, &found) == RAYLANE_INVALID_VALUE);
    std::uint32_t none = 77;
    CHECK(raylane_scene_material_of(scene.get(), 0, &none) == RAYLANE_INVALID_VALUE);
    CHECK(raylane_scene_solid_of(scene.get(), 0, &none) == RAYLANE_INVALID_VALUE);
    CHECK(none == 77);
}

TEST_CASE("mistakes about solids in C have a line of text") {
    const auto says = [](raylane_status status, const std::string& text) {
        CHECK(status == RAYLANE_INVALID_VALUE);
        CHECK(raylane_error_text() == text);
    };
    const SolidHandle ball = solid_in_c(raylane_solid_sphere, big_ball);
    const raylane_solid* const parts[] = {ball.get(), nullptr};
    raylane_solid* none = nullptr;
    says(raylane_solid_union(parts, 2, 0, &none), "parts/1: must not be NULL");
    says(raylane_solid_intersection(nullptr, 2, 0, &none), "parts: must not be NULL");
    says(raylane_solid_difference(nullptr, parts, 1, 0, &none), "whole: must not be NULL");
    says(raylane_solid_clipped(ball.get(), parts, 2, 0, &none), "by/1: must not be NULL");
    says(raylane_solid_sphere(nullptr, 0, &none), "shape: must not be NULL");
    says(raylane_solid_lens(nullptr, 0, &none), "lens: must not be NULL");
    says(raylane_solid_sphere(&big_ball, 0, nullptr), "solid: must not be NULL");
    const raylane_lens flat = raylane_default_lens();
    CHECK(raylane_solid_lens(&flat, 0, &none) == RAYLANE_INVALID_VALUE);
    CHECK(none == nullptr);

    const Builder builder = builder_in_c();
    add_material_in_c(builder);
    says(raylane_add_solid(builder.get(), nullptr, 0, nullptr), "solid: must not be NULL");
    CHECK(raylane_add_solid(builder.get(), ball.get(), 1, nullptr) == RAYLANE_INVALID_VALUE);
    raylane_double_sphere negative = big_ball;
    negative.radius = -1;
    const SolidHandle bad = solid_in_c(raylane_solid_sphere, negative);
    says(raylane_add_solid(builder.get(), bad.get(), 0, nullptr),
         "radius: must be positive, got -1");
    says(raylane_add_spheres_doubles(builder.get(), &negative, 1, 0, nullptr),
         "0/radius: must be positive, got -1");
    raylane_solid_release(nullptr);
}
