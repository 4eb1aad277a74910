#include "core/scene/camera_rays.hpp"
#include "tests/scenes/api/ray_arrays.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <type_traits>
#include <vector>

/// Tests of shapes that a scene returns, and of the rays of its camera.
using namespace raylane;
using namespace raylane::tests;

namespace {

template <class CoreShape>
struct Given {
    ShapeId id;
    MaterialIndex material;
    core::InDouble<CoreShape> shape;
};
template <class CoreShape>
using AllGiven = std::vector<Given<CoreShape>>;

/// Adds a shape to a builder and to a list. `in_double`: with numbers that are not floats.
template <class CoreShape>
void give(SceneBuilder& builder, const CoreShape& shape, bool in_double, MaterialIndex material,
          AllGiven<CoreShape>& given) {
    core::Numbers<core::InDouble<CoreShape>> numbers = core::numbers_of(core::to_doubles(shape));
    for (double& number : numbers)
        if (in_double) number *= 1.0 + 0x1p-40;
    const auto exact = core::shape_of<core::InDouble<CoreShape>>(numbers);
    const ShapeId id = in_double ? add(builder, exact, material) : add(builder, shape, material);
    given.push_back({id, material, exact});
}

/// Returns true if a shape of the library has the bits of a shape of core.
template <class Shape, class CoreShape>
bool is_same(const Shape& shape, const CoreShape& other) {
    return core::numbers_of(std::bit_cast<CoreShape>(shape)) == core::numbers_of(other);
}

/// Checks all that a scene returns about shapes of one kind. `ShapeOf`: the library's template.
template <class CoreShape, template <class> class ShapeOf>
void check_kind(const Scene& scene, const AllGiven<CoreShape>& given) {
    const ShapesOf<ShapeOf<double>> shapes = scene.shapes<ShapeOf>();
    REQUIRE(shapes.id.size() == given.size());
    REQUIRE(shapes.material.size() == given.size());
    REQUIRE(shapes.shape.size() == given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
        CAPTURE(i);
        CHECK(shapes.id[i] == given[i].id);
        CHECK(shapes.material[i] == given[i].material);
        CHECK(is_same(shapes.shape[i], given[i].shape));
        const ShapeVariant one = scene.shape(given[i].id);
        REQUIRE(std::holds_alternative<ShapeOf<double>>(one));
        CHECK(is_same(std::get<ShapeOf<double>>(one), given[i].shape));
    }
}

} // namespace

TEST_CASE("a scene returns each shape with the numbers that it was given") {
    Random random(31);
    for (const bool merge : {true, false})
        for (const int doubles : {0, 1, 2}) { // no shape, some, all
            CAPTURE(merge, doubles);
            SceneBuilder builder;
            builder.merge_duplicates = merge;
            for (int i = 0; i < 3; ++i)
                builder.add_material({});
            core::OfEachShape<AllGiven> given_shapes;
            for (int round = 0; round < 24; ++round)
                core::for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
                    auto& given = std::get<AllGiven<Shape>>(given_shapes);
                    const auto material = static_cast<MaterialIndex>(random.integer(0, 2));
                    const bool in_double = doubles == 2 || (doubles == 1 && round % 2 == 0);
                    give(builder, ray_sets::Target<Shape>::make(random, false), in_double, material,
                         given);
                    // Some shapes are given again, with the same material or another one.
                    if (round % 3 != 0) return;
                    const Given<Shape> other =
                        given[static_cast<std::size_t>(random.integer(0, round))];
                    const MaterialIndex material_index = round % 2 == 0 ? other.material : 0;
                    given.push_back(
                        {add(builder, other.shape, material_index), material_index, other.shape});
                });
            const Scene scene = builder.build();
#define RAYLANE_CHECK(Shape, name, text)                                                           \
    check_kind<core::Shape, Shape##Of>(scene, std::get<AllGiven<core::Shape>>(given_shapes));
            RAYLANE_SHAPES(RAYLANE_CHECK)
#undef RAYLANE_CHECK
        }
}

TEST_CASE("a scene returns the parts of solids by their ids alone") {
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    const ShapeId ball = builder.add(Sphere{{9, 0, 0}, 1}, material);
    const CappedCylinderOf<double> hole{{0.1, 0, -2}, {0, 0, 4}, 0.3};
    const PlaneOf<double> plane{{0, 0.1, 0}, {0, 0.3, 0.1}};
    const ShapeId first = builder.add(
        difference_of(intersection_of({SphereOf<double>{{0, 0, 0}, 1.1}, plane}), {hole}),
        material);
    const Scene scene = builder.build();
    CHECK(scene.shapes<SphereOf>().id == std::vector<ShapeId>{ball});
    CHECK(scene.shapes<CappedCylinderOf>().id.empty());
    CHECK(scene.shapes<PlaneOf>().id.empty());
    CHECK(scene.shapes<QuadricOf>().id.empty());
    CHECK(std::get<SphereOf<double>>(scene.shape(first)).radius == 1.1);
    const auto of_plane = std::get<PlaneOf<double>>(scene.shape(first + 1));
    CHECK((of_plane.point == plane.point && of_plane.normal == plane.normal));
    const auto of_hole = std::get<CappedCylinderOf<double>>(scene.shape(first + 2));
    CHECK(
        (of_hole.base == hole.base && of_hole.axis == hole.axis && of_hole.radius == hole.radius));
    CHECK(message_of<InvalidValue>([&] { static_cast<void>(scene.shape(4)); }) ==
          "must be one of 4 shapes, got 4");
    CHECK_THROWS_AS(scene.shape(no_shape), InvalidValue);
}

TEST_CASE("camera rays are those of the renderer's camera, with one sample a pixel") {
    constexpr int width = 7, height = 4;
    for (const Projection projection : {Projection::perspective, Projection::orthographic})
        for (const float lens : {0.0F, 0.3F}) {
            const Camera camera{.projection = projection,
                                .from = {1, 2, 9},
                                .at = {0.3F, 0, 0},
                                .up = {0.1F, 1, 0},
                                .field_of_view = 33,
                                .height = 3,
                                .lens_radius = lens,
                                .focus_distance = 5};
            const PixelRays rays = camera_rays(camera, width, height);
            core::Settings settings;
            settings.width = width;
            settings.height = height;
            const core::CameraRays<double> camera_rays(
                {.projection = static_cast<core::Projection>(projection),
                 .from = {1, 2, 9},
                 .at = {0.3F, 0, 0},
                 .up = {0.1F, 1, 0},
                 .field_of_view = 33,
                 .height = 3,
                 .lens_radius = lens,
                 .focus_distance = 5},
                settings);
            const DoubleRaySpan span = rays.span();
            REQUIRE(span.origin_z.size() == width * height);
            for (std::size_t i = 0; i < width * height; ++i) {
                const core::Ray<double> ray =
                    camera_rays.ray(static_cast<int>(i % width), static_cast<int>(i / width), 0);
                CHECK(core::Vec3d(span.origin_x[i], span.origin_y[i], span.origin_z[i]) ==
                      ray.origin);
                CHECK(core::Vec3d(span.direction_x[i], span.direction_y[i], span.direction_z[i]) ==
                      ray.direction);
            }
        }
    CHECK(message_of<InvalidValue>([] { camera_rays({}, 0, 4); }) ==
          "width: must be from 1 to 65535, got 0");
    CHECK_THROWS_AS(camera_rays({.field_of_view = 0}, 4, 4), InvalidValue);
}

TEST_CASE("the hits of camera rays have the depths of an image") {
    SceneBuilder builder;
    builder.camera = {.from = {0, 1, 9}, .at = {0, 0, 0}, .field_of_view = 40};
    builder.settings.width = 33;
    builder.settings.height = 22;
    const MaterialIndex material = builder.add_material({});
    builder.add(Sphere{{0, 0, 0}, 2}, material);
    builder.add(Box{{1, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, material);
    builder.add(CappedCone{{-2, -1, 0}, {0, 2, 0}, 1, 0}, material);
    const Scene scene = builder.build();
    const Image image = render(scene, {.aovs = true});
    const PixelRays rays = camera_rays(scene.camera(), image.width, image.height);
    std::vector<double> t(image.aovs.depth.size());
    std::vector<ShapeId> shape(t.size());
    Tracer(scene).intersect(rays.span(), {.shape_id = shape, .t_double = t});
    CHECK(shape == image.aovs.shape_id);
    for (std::size_t i = 0; i < t.size(); ++i)
        CHECK(static_cast<float>(t[i]) == image.aovs.depth[i]);
}
