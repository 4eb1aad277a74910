#include "tests/scenes/api/c_rows.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

#include <bit>
#include <cstring>
#include <string>
#include <thread>
#include <variant>

/// Tests of transforms, groups, generators, values by name, and shapes that are given back, of the
/// C interface against the C++ library.
using namespace raylane;
using namespace raylane::tests;

namespace {

using TransformHandle = std::unique_ptr<raylane_transform, Release<raylane_transform_release>>;
using GroupHandle = std::unique_ptr<raylane_group, Release<raylane_group_release>>;

void says(raylane_status status, const std::string& text) {
    CHECK(status == RAYLANE_INVALID_VALUE);
    CHECK(raylane_error_text() == text);
}

GroupHandle group_in_c() {
    return made<GroupHandle>(raylane_group_create);
}

constexpr raylane_double_cylinder rod = {{-1, 0, 0}, {2, 0, 0}, 0.1};
constexpr raylane_double_sphere balls[] = {{{-1, 0, 0}, 0.3}, {{1, 0, 0}, 0.3}};
constexpr raylane_double_sphere dent = {{1.25, 0, 0}, 0.1};
constexpr double matrix[12] = {1, 0.25, 0, 0.5, 0, 1, 0, 0, 0, 0, 1.5, -0.125};

/// Returns a rod with two balls of material 0, one of which has a dent.
GroupHandle dumbbell_in_c() {
    GroupHandle group = group_in_c();
    REQUIRE(raylane_group_add_capped_cylinders(group.get(), &rod, 1, RAYLANE_NO_MATERIAL) ==
            RAYLANE_OK);
    REQUIRE(raylane_group_add_spheres(group.get(), balls, 1, 0) == RAYLANE_OK);
    const auto ball = [](const raylane_double_sphere& sphere) {
        return made<SolidHandle>([&](raylane_solid** to) {
            return raylane_solid_sphere(&sphere, RAYLANE_NO_MATERIAL, to);
        });
    };
    const SolidHandle solid = ball(balls[1]), hole = ball(dent);
    const raylane_solid* const holes[] = {hole.get()};
    const SolidHandle dented = made<SolidHandle>([&](raylane_solid** to) {
        return raylane_solid_difference(solid.get(), holes, 1, RAYLANE_NO_MATERIAL, to);
    });
    const GroupHandle last = group_in_c();
    REQUIRE(raylane_group_add_solid(last.get(), dented.get(), RAYLANE_NO_MATERIAL) == RAYLANE_OK);
    REQUIRE(raylane_group_add_group(group.get(), last.get(), 0) == RAYLANE_OK);
    CHECK(raylane_group_size(group.get()) == 3);
    return group;
}

Group dumbbell() {
    const auto ball = [](const auto& sphere) { return std::bit_cast<SphereOf<double>>(sphere); };
    Group group;
    group.add(std::bit_cast<CappedCylinderOf<double>>(rod));
    group.add(ball(balls[0]), 0);
    group.add(difference_of(ball(balls[1]), {ball(dent)}), 0);
    return group;
}

/// Returns turn * 30 degrees about z, a shear by `matrix`, and a way along z.
TransformHandle transform_in_c(int turn) {
    TransformHandle transform = made<TransformHandle>(raylane_transform_create);
    raylane_transform* const map = transform.get();
    CHECK(raylane_transform_scale(map, {2, 2, 2}) == RAYLANE_OK);
    CHECK(raylane_transform_rotate(map, {0, 0, 30.0 * turn}) == RAYLANE_OK);
    const TransformHandle sheared = made<TransformHandle>(
        [](raylane_transform** to) { return raylane_transform_matrix(matrix, to); });
    if (turn % 2 != 0) CHECK(raylane_transform_then(map, sheared.get()) == RAYLANE_OK);
    CHECK(raylane_transform_translate(map, {0, 0, 0.7 * turn}) == RAYLANE_OK);
    return transform;
}

Transform transform(int turn) {
    Transform map = Transform().scaled(2).rotated({0, 0, 30.0 * turn});
    if (turn % 2 != 0)
        map = map.then(Transform({{{1, 0.25, 0, 0.5}, {0, 1, 0, 0}, {0, 0, 1.5, -0.125}}}));
    return map.translated({0, 0, 0.7 * turn});
}

/// Checks that all shapes of a type come back from C as from C++. Returns their number.
template <template <class> class ShapeOf, class CShape>
std::size_t check_shapes(const SceneHandle& in_c, const Scene& scene,
                         raylane_status (*shapes)(const raylane_scene*, std::uint32_t*,
                                                  std::uint32_t*, CShape*, std::size_t,
                                                  std::size_t*)) {
    const auto returned = scene.shapes<ShapeOf>();
    std::size_t count = 77;
    CHECK(shapes(in_c.get(), nullptr, nullptr, nullptr, 0, &count) == RAYLANE_OK);
    CHECK(count == returned.id.size());
    const auto size = returned.id.size();
    std::vector<std::uint32_t> ids(size), materials(size);
    std::vector<CShape> given(size + 1);
    CHECK(shapes(in_c.get(), ids.data(), materials.data(), given.data(), size + 1, nullptr) ==
          RAYLANE_OK);
    CHECK(ids == returned.id);
    CHECK(materials == returned.material);
    if (size != 0)
        CHECK(std::memcmp(given.data(), returned.shape.data(), size * sizeof(CShape)) == 0);
    if (size > 1) {
        std::uint32_t one[] = {77, 77};
        CHECK(shapes(in_c.get(), one, nullptr, nullptr, 1, &count) == RAYLANE_OK);
        CHECK(one[0] == ids[0]);
        CHECK(one[1] == 77);
    }
    return size;
}

void check_each_shape(const SceneHandle& in_c, const Scene& scene) {
    REQUIRE(raylane_shape_count(in_c.get()) == scene.shape_count());
    for (ShapeId id = 0; id < scene.shape_count(); ++id) {
        int type = -1;
        double numbers[RAYLANE_MAX_NUMBERS];
        REQUIRE(raylane_scene_shape(in_c.get(), id, &type, numbers) == RAYLANE_OK);
        const ShapeVariant shape = scene.shape(id);
        CHECK(static_cast<std::size_t>(type) == shape.index());
        std::visit(
            [&](const auto& given) { CHECK(std::memcmp(numbers, &given, sizeof given) == 0); },
            shape);
    }
}

} // namespace

TEST_CASE("transformed groups and solids in C are those of C++") {
    const Builder in_c = builder_in_c();
    SceneBuilder builder;
    raylane_material metal{};
    REQUIRE(raylane_material_preset("metal", &metal) == RAYLANE_OK);
    for (const char* name : {"metal", ""}) {
        std::uint32_t index = 77;
        CHECK(raylane_add_named_material(in_c.get(), &metal, name, &index) == RAYLANE_OK);
        CHECK(builder.add_material(material_preset("metal"), name) == index);
    }
    const GroupHandle group = dumbbell_in_c();
    for (int turn = 0; turn < 4; ++turn) {
        const TransformHandle map = transform_in_c(turn);
        const GroupHandle instance = made<GroupHandle>([&](raylane_group** to) {
            return raylane_group_transformed(group.get(), map.get(), to);
        });
        std::uint32_t first = 77;
        CHECK(raylane_add_group(in_c.get(), instance.get(), 1, &first) == RAYLANE_OK);
        CHECK(builder.add(dumbbell().transformed(transform(turn)), 1) == first);
        const GroupHandle of_metal = made<GroupHandle>(
            [&](raylane_group** to) { return raylane_group_of_material(instance.get(), 1, to); });
        const SolidHandle joined = made<SolidHandle>(
            [&](raylane_solid** to) { return raylane_solid_group(of_metal.get(), 0, to); });
        const SolidHandle moved = made<SolidHandle>([&](raylane_solid** to) {
            return raylane_solid_transformed(joined.get(), map.get(), to);
        });
        const SolidHandle painted = made<SolidHandle>(
            [&](raylane_solid** to) { return raylane_solid_of_material(moved.get(), 1, to); });
        CHECK(raylane_add_solid(in_c.get(), painted.get(), RAYLANE_NO_MATERIAL, &first) ==
              RAYLANE_OK);
        CHECK(builder.add(solid_of(dumbbell().transformed(transform(turn)).of(1))
                              .of(0)
                              .transformed(transform(turn))
                              .of(1)) == first);
    }
    const SceneHandle scene_in_c = built(in_c);
    const Scene scene = builder.build();
    check_each_shape(scene_in_c, scene);
    for (ShapeId id = 0; id < scene.shape_count(); ++id) {
        std::uint32_t material = 77;
        CHECK(raylane_scene_material_of(scene_in_c.get(), id, &material) == RAYLANE_OK);
        CHECK(material == scene.material_of(id));
    }
    CHECK(check_crossings(scene_in_c, scene, rays_through_all(200, 31)).t.size() > 40);
    char name[4] = "abc";
    std::size_t length = 0;
    CHECK(raylane_scene_material_name(scene_in_c.get(), 0, name, sizeof name, &length) ==
          RAYLANE_OK);
    CHECK(std::string(name) == "met");
    CHECK(length == 5);
    CHECK(raylane_scene_material_name(scene_in_c.get(), 1, name, sizeof name, nullptr) ==
          RAYLANE_OK);
    CHECK(std::string(name).empty());
    CHECK(raylane_scene_material_name(scene_in_c.get(), 0, nullptr, 0, &length) == RAYLANE_OK);
}

TEST_CASE("copies of groups in C are those of C++, kept or not") {
    const raylane_placement in_c[] = {
        {{0, 0, 0}, {0, 0, 0}, 1}, {{3, 0, 0}, {0, 0, 30}, 0.5}, {{0, 3, 1}, {90, 0, 0}, 2}};
    const Placement in_cpp[] = {{},
                                {{3, 0, 0}, {0, 0, 30}, 0.5},
                                {.translate = {0, 3, 1}, .rotate = {90, 0, 0}, .scale = 2}};
    CHECK(raylane_default_placement().scale == 1);
    const GroupHandle group = group_in_c();
    REQUIRE(raylane_group_add_spheres(group.get(), balls, 2, RAYLANE_NO_MATERIAL) == RAYLANE_OK);
    REQUIRE(raylane_group_add_capped_cylinders(group.get(), &rod, 1, 0) == RAYLANE_OK);
    Group same;
    for (const raylane_double_sphere& ball : balls)
        same.add(std::bit_cast<SphereOf<double>>(ball));
    same.add(std::bit_cast<CappedCylinderOf<double>>(rod), 0);
    for (const std::size_t keep_from : {std::size_t{10}, std::size_t{9}}) {
        const Builder builder = builder_in_c();
        SceneBuilder cpp;
        for (int i = 0; i < 2; ++i) {
            const raylane_material material = raylane_default_material();
            CHECK(raylane_add_material(builder.get(), &material, nullptr) == RAYLANE_OK);
            cpp.add_material({});
        }
        CHECK(raylane_set_keep_from(builder.get(), keep_from) == RAYLANE_OK);
        std::uint32_t first = 77;
        CHECK(raylane_add_copies(builder.get(), group.get(), in_c, 3, 1, &first) == RAYLANE_OK);
        CHECK(first == 0);
        cpp.keep_from = keep_from;
        cpp.add(same, in_cpp, 1);
        const SceneHandle scene = built(builder);
        const Scene expected = cpp.build();
        check_each_shape(scene, expected);
        check_crossings(scene, expected, rays_through_all(300, 5));
        // Kept copies have no closest points.
        const TracerHandle tracer = tracer_of(scene);
        const float zero = 0.0F;
        const raylane_points point{1, &zero, &zero, &zero, nullptr};
        const raylane_closest_points none{};
        CHECK((raylane_closest(tracer.get(), &point, nullptr, &none) == RAYLANE_OK) ==
              (keep_from > 9));
    }
    const Builder builder = builder_in_c();
    const raylane_material material = raylane_default_material();
    REQUIRE(raylane_add_material(builder.get(), &material, nullptr) == RAYLANE_OK);
    raylane_placement wrong = raylane_default_placement();
    wrong.scale = 0;
    says(raylane_add_copies(builder.get(), group.get(), &wrong, 1, 0, nullptr),
         "placements/0/scale: must be positive, got 0");
    says(raylane_add_copies(builder.get(), group.get(), nullptr, 1, 0, nullptr),
         "placements: must not be NULL");
    says(raylane_add_copies(builder.get(), nullptr, &wrong, 1, 0, nullptr),
         "group: must not be NULL");
    says(raylane_set_keep_from(nullptr, 1), "builder: must not be NULL");
}

TEST_CASE("a scene of all types gives its shapes back in C") {
    Heap setup = heap(false, 3, 32);
    SceneHandle in_c;
    { // through a file, as C has no other way to this scene
        const TemporaryDirectory folder;
        const std::string path = (folder.path() / "all.rl").string();
        save(setup.scene, path);
        in_c =
            made<SceneHandle>([&](raylane_scene** to) { return raylane_load(path.c_str(), to); });
    }
    check_each_shape(in_c, setup.scene);
#define RAYLANE_CHECK(Shape, shapes)                                                               \
    CHECK(check_shapes<Shape##Of>(in_c, setup.scene, raylane_scene_##shapes) >= 2);
    RAYLANE_CHECK(Sphere, spheres)
    RAYLANE_CHECK(Plane, planes)
    RAYLANE_CHECK(Disc, discs)
    RAYLANE_CHECK(Triangle, triangles)
    RAYLANE_CHECK(SmoothTriangle, smooth_triangles)
    RAYLANE_CHECK(Box, boxes)
    RAYLANE_CHECK(OpenCylinder, open_cylinders)
    RAYLANE_CHECK(CappedCylinder, capped_cylinders)
    RAYLANE_CHECK(OpenCone, open_cones)
    RAYLANE_CHECK(CappedCone, capped_cones)
    RAYLANE_CHECK(Quadric, quadrics)
    RAYLANE_CHECK(Ellipsoid, ellipsoids)
#undef RAYLANE_CHECK
    int type = 0;
    double numbers[RAYLANE_MAX_NUMBERS];
    CHECK(raylane_scene_shape(in_c.get(), RAYLANE_NO_SHAPE, &type, numbers) ==
          RAYLANE_INVALID_VALUE);
    says(raylane_scene_shape(in_c.get(), 0, nullptr, numbers), "type: must not be NULL");
    says(raylane_scene_shape(in_c.get(), 0, &type, nullptr), "numbers: must not be NULL");
    says(raylane_scene_spheres(nullptr, nullptr, nullptr, nullptr, 0, nullptr),
         "scene: must not be NULL");
}

TEST_CASE("generators, cameras by name and lights in C are those of C++") {
    const Builder in_c = builder_in_c();
    SceneBuilder builder;
    raylane_sphereflake flake = raylane_default_sphereflake();
    flake.depth = 2;
    std::uint32_t first = 77;
    CHECK(raylane_add_sphereflake(in_c.get(), &flake, RAYLANE_NO_MATERIAL, &first) == RAYLANE_OK);
    CHECK(builder.add(Sphereflake{.depth = 2}) == first);
    raylane_lattice lattice = raylane_default_lattice();
    lattice.n = 2;
    lattice.corner = {3, 0.1, 0};
    CHECK(raylane_add_lattice(in_c.get(), &lattice, RAYLANE_NO_MATERIAL, RAYLANE_NO_MATERIAL,
                              &first) == RAYLANE_OK);
    CHECK(builder.add(Lattice{.corner = {3, 0.1, 0}, .n = 2}) == first);

    raylane_auto_camera corner = raylane_default_auto_camera();
    CHECK(corner.zoom == AutoCamera{}.zoom);
    REQUIRE(raylane_named_view("corner", &corner) == RAYLANE_OK);
    CHECK(raylane_set_auto_camera(in_c.get(), &corner) == RAYLANE_OK);
    CHECK(raylane_set_camera_lights(in_c.get(), 1) == RAYLANE_OK);
    const double wavelengths[] = {450, 600};
    CHECK(raylane_set_wavelengths(in_c.get(), wavelengths, 2) == RAYLANE_OK);
    builder.auto_camera = named_view("corner");
    builder.camera_lights = true;
    builder.wavelengths = {450, 600};

    const SceneHandle scene_in_c = built(in_c);
    const Scene scene = builder.build();
    check_each_shape(scene_in_c, scene);
    const raylane_camera camera = raylane_scene_camera(scene_in_c.get());
    CHECK(Vec3{camera.from.x, camera.from.y, camera.from.z} == scene.camera().from);
    CHECK(camera.field_of_view == scene.camera().field_of_view);
    CHECK(raylane_scene_background(scene_in_c.get()).x == scene.background().x);
    CHECK(raylane_scene_fog(scene_in_c.get()).end == scene.fog().end);
    std::size_t count = 0;
    raylane_light lights[3];
    CHECK(raylane_scene_lights(scene_in_c.get(), lights, 3, &count) == RAYLANE_OK);
    REQUIRE(count == 2);
    for (std::size_t i = 0; i < count; ++i) {
        CHECK(lights[i].kind == static_cast<std::uint8_t>(scene.lights()[i].kind));
        CHECK(lights[i].direction.y == scene.lights()[i].direction.y);
    }

    raylane_camera fitted{};
    CHECK(raylane_camera_on_all(scene_in_c.get(), {1, 0, 0}, 2, &fitted) == RAYLANE_OK);
    const Camera same = scene.camera_on_all({1, 0, 0}, 2);
    CHECK(Vec3{fitted.from.x, fitted.from.y, fitted.from.z} == same.from);
    const SceneHandle seen = made<SceneHandle>(
        [&](raylane_scene** to) { return raylane_seen_by(scene_in_c.get(), &fitted, to); });
    CHECK(raylane_scene_camera(seen.get()).from.x == same.from.x);
    std::vector<double> origins(3 * 5 * 4), directions(3 * 5 * 4);
    CHECK(raylane_camera_rays(&fitted, 5, 4, origins.data(), directions.data()) == RAYLANE_OK);
    CHECK(origins == camera_rays(same, 5, 4).origins);
    CHECK(directions == camera_rays(same, 5, 4).directions);
    says(raylane_camera_rays(&fitted, 0, 4, origins.data(), directions.data()),
         "width: must be from 1 to 65535, got 0");
}

TEST_CASE("values by name in C are those of C++") {
    raylane_material glass{};
    REQUIRE(raylane_material_preset("glass", &glass) == RAYLANE_OK);
    CHECK(glass.transmission == material_preset("glass").transmission);
    says(raylane_material_preset("gold", &glass),
         "preset: must be one of \"matte\", \"plastic\", \"metal\", \"mirror\", \"glass\", "
         "\"water\", \"diamond\", got \"gold\"");
    REQUIRE(raylane_catalogue_glass("N-BK7", glass.glass.B, glass.glass.C) == RAYLANE_OK);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(glass.glass.B[i] == catalogue_glass("N-BK7").B[i]);
        CHECK(glass.glass.C[i] == catalogue_glass("N-BK7").C[i]);
    }
    raylane_vec3 color{};
    REQUIRE(raylane_color_from_srgb("#ff8000", &color) == RAYLANE_OK);
    CHECK(Color{color.x, color.y, color.z} == color_from_srgb("#ff8000"));
    says(raylane_color_from_srgb("red", &color), "color: must be \"#rrggbb\", got \"red\"");
    says(raylane_color_from_srgb(nullptr, &color), "text: must not be NULL");
    raylane_double_box box{};
    REQUIRE(raylane_aligned_box({1, 2, 3}, {2, 4, 6}, &box) == RAYLANE_OK);
    CHECK(box.corner.y == 2);
    CHECK(box.edge_w.z == 3);
    CHECK(raylane_version_number() == RAYLANE_VERSION_NUMBER);
}

TEST_CASE("the formula of a scene's material can be read in C") {
    const std::string text = R"json({"camera": "auto", "materials": {"wave": {"pattern":
            {"type": "formula", "color": ["abs(sin(x))", "y", "0.5"]}}}, "objects":
            [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "wave"}]})json";
    const SceneHandle scene = made<SceneHandle>(
        [&](raylane_scene** to) { return raylane_parse(text.data(), text.size(), "a.json", to); });
    raylane_material material{};
    REQUIRE(raylane_scene_material(scene.get(), 0, &material) == RAYLANE_OK);
    REQUIRE(material.pattern.kind == RAYLANE_FORMULA);
    CHECK(std::string(material.pattern.formula[0]) == "abs(sin(x))");
}

TEST_CASE("mistakes in groups and transforms are reported in C") {
    const GroupHandle group = group_in_c();
    const raylane_double_sphere bad[] = {{{0, 0, 0}, 1}, {{0, 0, 0}, -1}};
    says(raylane_group_add_spheres(group.get(), bad, 2, 0), "1/radius: must be positive, got -1");
    CHECK(raylane_group_size(group.get()) == 1);
    says(raylane_group_add_spheres(group.get(), nullptr, 1, 0), "shapes: must not be NULL");
    says(raylane_group_add_spheres(nullptr, bad, 1, 0), "group: must not be NULL");
    const TransformHandle map = made<TransformHandle>(raylane_transform_create);
    says(raylane_transform_scale(map.get(), {1, 0, 1}), "scale/1: must not be 0, got 0");
    says(raylane_transform_then(map.get(), nullptr), "next: must not be NULL");
    raylane_transform* none = nullptr;
    const double singular[12] = {};
    says(raylane_transform_matrix(singular, &none),
         "transform: must not be singular, got one of determinant 0");
    says(raylane_transform_matrix(nullptr, &none), "rows: must not be NULL");
    CHECK(none == nullptr);
    raylane_solid* solid = nullptr;
    says(raylane_solid_group(group_in_c().get(), 0, &solid),
         "must have at least one member, got none");
    CHECK(raylane_group_size(nullptr) == 0);
    raylane_group_release(nullptr);
    raylane_transform_release(nullptr);
}

TEST_CASE("atoms are read with options in C") {
    const std::string atoms = "2\n\nC 0 0 0\nO 1.2 0 0\n";
    const raylane_atom_option looks[] = {{"representations", "element O: spheres"}};
    const SceneHandle one = made<SceneHandle>([&](raylane_scene** to) {
        return raylane_parse_atoms(atoms.data(), atoms.size(), "a.xyz", looks, 1, to);
    });
    CHECK(raylane_shape_count(one.get()) == 1);
    const TemporaryFile file(atoms, ".xyz");
    const auto count = [&](const raylane_atom_option* options, std::size_t size) {
        return raylane_shape_count(made<SceneHandle>([&](raylane_scene** to) {
                                       return raylane_load_atoms(file.path().c_str(), options, size,
                                                                 to);
                                   }).get());
    };
    CHECK(count(looks, 1) == 1);
    CHECK(count(nullptr, 0) == parse(atoms, "a.xyz").shape_count());
    raylane_scene* none = nullptr;
    const raylane_atom_option wrong[] = {{"style", nullptr}};
    says(raylane_load_atoms(file.path().c_str(), wrong, 1, &none), "options: must not be NULL");
}

TEST_CASE("annotations are written to a file in C") {
    const std::string atoms = "2\n\nC 0 0 0\nO 1.2 0 0\n";
    const raylane_atom_option labels[] = {{"label", "element O: {element}"}, {"scale_bar", "auto"}};
    const SceneHandle scene = made<SceneHandle>([&](raylane_scene** to) {
        return raylane_parse_atoms(atoms.data(), atoms.size(), "a.xyz", labels, 2, to);
    });
    const TemporaryFile file("", ".svg");
    const std::string name = file.path().string();
    raylane_settings settings = raylane_default_settings();
    settings.width = settings.height = 64;
    std::vector<float> rgb(std::size_t{3} * 64 * 64);
    raylane_render_options options = raylane_default_render_options();
    options.settings = &settings;
    options.annotations = name.c_str();
    raylane_image image{};
    image.rgb = rgb.data();
    REQUIRE(raylane_render_image(scene.get(), &options, &image) == RAYLANE_OK);
    CHECK(content_of(name).find(">O</text>") != std::string::npos);
    CHECK(std::string(raylane_remarks()).starts_with("scale_bar holds at the depth"));
}

TEST_CASE("remarks on files can be read in C") {
    const std::string pov = "camera { location <0, 0, -5> look_at 0 }\n"
                            "light_source { <1, 2, -3> color rgb 1 shadowless }\n"
                            "sphere { 0, 1 pigment { color rgb 1 } no_shadow }\n";
    std::vector<std::string> remarks;
    static_cast<void>(parse(pov, "a.pov", [&](const std::string& it) { remarks.push_back(it); }));
    REQUIRE(remarks.size() > 1);
    std::string expected = remarks[0];
    for (std::size_t i = 1; i < remarks.size(); ++i)
        expected += "\n" + remarks[i];
    const auto parsed = [](const std::string& text) {
        return made<SceneHandle>([&](raylane_scene** to) {
            return raylane_parse(text.data(), text.size(), "a.pov", to);
        });
    };
    const SceneHandle scene = parsed(pov);
    CHECK(raylane_remarks() == expected);
    std::thread([] { CHECK(std::string(raylane_remarks()).empty()); }).join();
    const TemporaryFile file(pov, ".pov");
    static_cast<void>(made<SceneHandle>(
        [&](raylane_scene** to) { return raylane_load(file.path().c_str(), to); }));
    CHECK(std::string(raylane_remarks()).find('\n') != std::string::npos);
    raylane_scene* none = nullptr;
    CHECK(raylane_load(nullptr, &none) == RAYLANE_INVALID_VALUE);
    CHECK(std::string(raylane_remarks()).empty());
}

TEST_CASE("parts, alpha and AOVs of images in C are those of C++") {
    const std::string text =
        R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]}, "lights": [], "image": {"width": 24, "height": 16},
            "background": [0.25, 0.5, 0.75], "materials": {"m": {"ambient": 1}}, "objects": [
            {"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "m"}]})";
    const SceneHandle scene = made<SceneHandle>(
        [&](raylane_scene** to) { return raylane_parse(text.data(), text.size(), "a.json", to); });
    const Scene same = parse(text, "a.json");
    RenderOptions of_cpp{.settings = same.settings(), .crop = PixelRect{3, 2, 10, 9}, .aovs = true};
    of_cpp.settings->alpha = true;
    const Image truth = render(same, of_cpp);
    const std::size_t count = 10 * 9;
    std::vector<float> rgb(3 * count), alpha(count), depth(count), normal(3 * count);
    std::vector<std::uint32_t> shape_id(count), material(count), samples(count);
    raylane_render_options options = raylane_default_render_options();
    options.crop_x = 3;
    options.crop_y = 2;
    options.crop_width = 10;
    options.crop_height = 9;
    const raylane_image image = {rgb.data(),      alpha.data(),    depth.data(),  normal.data(),
                                 shape_id.data(), material.data(), samples.data()};
    REQUIRE(raylane_render_image(scene.get(), &options, &image) == RAYLANE_OK);
    CHECK(rgb == truth.rgb);
    CHECK(alpha == truth.alpha);
    CHECK(depth == truth.aovs.depth);
    CHECK(normal == truth.aovs.normal);
    CHECK(shape_id == truth.aovs.shape_id);
    CHECK(material == truth.aovs.material);
    CHECK(samples == truth.aovs.samples);
    CHECK(std::count(shape_id.begin(), shape_id.end(), 0U) > 5);
    CHECK(std::count(alpha.begin(), alpha.end(), 0.0F) > 5);

    std::vector<float> pixels(3 * 24 * 16);
    raylane_image colors{};
    colors.rgb = pixels.data();
    REQUIRE(raylane_render_image(scene.get(), nullptr, &colors) == RAYLANE_OK);
    CHECK(pixels == render(same).rgb);
    options.crop_x = 20;
    says(raylane_render_image(scene.get(), &options, &image), message_of<InvalidValue>([&] {
             render(same, {.crop = PixelRect{20, 2, 10, 9}});
         }));
    says(raylane_render_image(scene.get(), nullptr, nullptr), "image: must not be NULL");
}
