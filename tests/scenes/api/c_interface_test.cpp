#include "tests/places.hpp"
#include "tests/scenes/api/c_handles.hpp"
#include "tests/scenes/api/ray_arrays.hpp"
#include "tests/support/catch.hpp"

#include <cstring>
#include <string>
#include <tuple>

using namespace raylane;
using namespace raylane::tests;

/// Tests of the C interface against the C++ library.

namespace {

/// Returns a scene of two balls and one light.
SceneHandle balls_in_c() {
    const Builder builder = builder_in_c();
    std::uint32_t material = 7, first = 7;
    const raylane_material shiny = [] {
        raylane_material made = raylane_default_material();
        made.specular = 0.5F;
        return made;
    }();
    CHECK(raylane_add_material(builder.get(), &shiny, &material) == RAYLANE_OK);
    CHECK(material == 0);
    const raylane_sphere balls[] = {{{0, 0, 0}, 1}, {{1.5F, 0, 0}, 1}};
    CHECK(raylane_add_spheres(builder.get(), balls, 2, material, &first) == RAYLANE_OK);
    CHECK(first == 0);
    const raylane_light light = raylane_default_light();
    raylane_light placed = light;
    placed.position = {4, 6, 5};
    CHECK(raylane_add_light(builder.get(), &placed) == RAYLANE_OK);
    raylane_settings settings = raylane_default_settings();
    settings.width = 32;
    settings.height = 24;
    settings.outline.width = 2.0F;
    CHECK(raylane_set_settings(builder.get(), &settings) == RAYLANE_OK);
    return built(builder);
}

Scene balls() {
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({.specular = 0.5F});
    builder.add(Sphere{{0, 0, 0}, 1}, material);
    builder.add(Sphere{{1.5F, 0, 0}, 1}, material);
    builder.add_light({.position = {4, 6, 5}});
    builder.settings.width = 32;
    builder.settings.height = 24;
    builder.settings.outline.width = 2.0F;
    return builder.build();
}

} // namespace

TEST_CASE("scenes and queries and images of the C interface equal those of C++") {
    const SceneHandle in_c = balls_in_c();
    const Scene scene = balls();
    CHECK(raylane_shape_count(in_c.get()) == 2);
    CHECK(raylane_material_count(in_c.get()) == 1);
    CHECK(raylane_scene_settings(in_c.get()).width == 32);
    raylane_vec3 lower{}, upper{};
    raylane_scene_bounds(in_c.get(), &lower, &upper);
    CHECK(lower.x == scene.bounds().lower.x);
    CHECK(upper.z == scene.bounds().upper.z);

    Random random(3);
    Rays rays;
    for (int i = 0; i < 200; ++i) {
        const core::Vec3f from = core::convert<float>(random.cube(3.0));
        const core::Vec3f along = core::convert<float>(random.direction());
        rays.add({from.x, from.y, from.z}, {along.x, along.y, along.z});
        rays.t_max.push_back(i % 2 == 0 ? 2.0F : infinity);
    }
    const Tracer tracer(scene);
    const Hits truth = intersect(tracer, rays);
    const std::vector<std::uint8_t> blocked = occluded(tracer, rays);

    const TracerHandle asked = tracer_of(in_c);
    Hits hits(rays.size());
    std::vector<std::uint8_t> face(rays.size()), found(rays.size(), 77);
    std::vector<double> t_double(rays.size());
    DoubleNormals normals(rays.size()), true_normals(rays.size());
    HitSpan in_double;
    true_normals.add_to(in_double);
    tracer.intersect(rays.span(), in_double);
    const raylane_rays to_c = {
        rays.size(),    rays.x.data(),  rays.y.data(), rays.z.data(),     rays.dx.data(),
        rays.dy.data(), rays.dz.data(), nullptr,       rays.t_max.data(), nullptr,
        nullptr,        nullptr,        nullptr};
    const raylane_hits from_c = {hits.t.data(),    hits.nx.data(),    hits.ny.data(),
                                 hits.nz.data(),   hits.shape.data(), hits.entering.data(),
                                 face.data(),      t_double.data(),   normals.x.data(),
                                 normals.y.data(), normals.z.data()};
    CHECK(raylane_intersect(asked.get(), &to_c, &from_c) == RAYLANE_OK);
    CHECK(hits == truth);
    CHECK(normals == true_normals);
    CHECK(raylane_occluded(asked.get(), &to_c, found.data()) == RAYLANE_OK);
    CHECK(found == blocked);
    std::vector<std::uint64_t> counts(rays.size(), 77), true_counts(rays.size());
    CHECK(raylane_count_crossings(asked.get(), &to_c, counts.data()) == RAYLANE_OK);
    tracer.count_crossings(rays.span(), true_counts);
    CHECK(counts == true_counts);

    const auto wide = [](const std::vector<float>& values) {
        return std::vector<double>(values.begin(), values.end());
    };
    const std::vector<double> x = wide(rays.x), y = wide(rays.y), z = wide(rays.z),
                              dx = wide(rays.dx), dy = wide(rays.dy), dz = wide(rays.dz);
    std::vector<double> t(rays.size());
    std::uint64_t refused = 77;
    const raylane_double_rays doubles = {rays.size(), x.data(),  y.data(), z.data(), dx.data(),
                                         dy.data(),   dz.data(), nullptr,  nullptr,  nullptr,
                                         nullptr,     nullptr,   &refused};
    raylane_hits only_t{};
    only_t.t_double = t.data();
    CHECK(raylane_intersect_doubles(asked.get(), &doubles, &only_t) == RAYLANE_OK);
    CHECK(refused == 0);
    CHECK(raylane_occluded_doubles(asked.get(), &doubles, found.data()) == RAYLANE_OK);
    CHECK(raylane_count_crossings_doubles(asked.get(), &doubles, counts.data()) == RAYLANE_OK);
    CHECK(raylane_count_crossings_doubles(asked.get(), &doubles, nullptr) == RAYLANE_INVALID_VALUE);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        CHECK((found[i] == 1) == (t[i] < 1e300));
        CHECK((found[i] == 1) == (counts[i] != 0));
        if (truth.shape[i] != no_shape) CHECK(t[i] == t_double[i]);
    }

    const Image image = render(scene);
    std::vector<float> rgb(image.rgb.size());
    CHECK(raylane_render(in_c.get(), nullptr, 1, RAYLANE_EXACT, nullptr, nullptr, rgb.data()) ==
          RAYLANE_OK);
    CHECK(rgb == image.rgb);
}

TEST_CASE("C renders a scene with alpha over black with or without explicit settings") {
    const std::string text = R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
        "image": {"width": 16, "height": 12, "alpha": true}, "background": [1, 0.5, 0],
        "lights": [{"type": "point", "position": [4, 6, 5]}], "materials": {"m": {}},
        "objects": [{"type": "sphere", "material": "m", "center": [0, 0, 0], "radius": 1}]})";
    raylane_scene* made = nullptr;
    REQUIRE(raylane_parse(text.data(), text.size(), "a.json", &made) == RAYLANE_OK);
    const SceneHandle scene(made);
    const raylane_settings own = raylane_scene_settings(scene.get());
    std::vector<float> images[2];
    for (const raylane_settings* settings : {static_cast<const raylane_settings*>(nullptr), &own}) {
        std::vector<float>& rgb = images[settings != nullptr ? 1 : 0];
        rgb.resize(std::size_t{16} * 12 * 3);
        CHECK(raylane_render(scene.get(), settings, 1, RAYLANE_EXACT, nullptr, nullptr,
                             rgb.data()) == RAYLANE_OK);
    }
    CHECK(images[0] == images[1]);
    CHECK(images[0][0] == 0.0F); // the background is black
}

TEST_CASE("C copies the texts of a formula, and reports its mistake") {
    const Builder builder = builder_in_c();
    raylane_material material = raylane_default_material();
    material.pattern.kind = RAYLANE_FORMULA;
    CHECK(raylane_add_material(builder.get(), &material, nullptr) == RAYLANE_INVALID_VALUE);
    std::string red = "abs(cos(x))";
    material.pattern.formula[0] = red.c_str();
    material.pattern.formula[1] = "y +";
    material.pattern.formula[2] = "0.5";
    CHECK(raylane_add_material(builder.get(), &material, nullptr) == RAYLANE_INVALID_VALUE);
    CHECK(std::string(raylane_error_text())
              .find("pattern/formula/1: must be a formula: line 1, "
                    "column 4") != std::string::npos);
    material.pattern.formula[1] = "y";
    CHECK(raylane_add_material(builder.get(), &material, nullptr) == RAYLANE_OK);
}

TEST_CASE("C makes images of arrays, shares them between materials and gives them back") {
    using TextureHandle = std::unique_ptr<raylane_texture, Release<raylane_texture_release>>;
    const Builder builder = builder_in_c();
    raylane_material material = raylane_default_material();
    CHECK(material.pattern.image == nullptr);
    CHECK(material.pattern.width == 1.0F);
    CHECK(material.pattern.axis.y == 1.0F);
    material.pattern.kind = RAYLANE_IMAGE;
    material.ambient = 1;
    material.diffuse = 0;
    CHECK(raylane_add_material(builder.get(), &material, nullptr) == RAYLANE_INVALID_VALUE);
    CHECK(std::string(raylane_error_text()) == "pattern/image: must be an image, got none");
    std::uint32_t index = 0;
    {
        const float linear[] = {0.25F, 0.5F, 0.75F, 1.0F, 2.0F, 0.0F};
        const auto texture = made<TextureHandle>([&](raylane_texture** handle) {
            return raylane_texture_from_floats(2, 1, linear, handle);
        });
        material.pattern.image = texture.get();
        material.pattern.width = 2;
        CHECK(raylane_add_material(builder.get(), &material, &index) == RAYLANE_OK);
    } // the material keeps the pixels
    const raylane_plane wall = {{0, 0, 0}, {0, 0, 1}};
    CHECK(raylane_add_planes(builder.get(), &wall, 1, index, nullptr) == RAYLANE_OK);
    raylane_light light = raylane_default_light();
    light.position = {0, 0, 9};
    CHECK(raylane_add_light(builder.get(), &light) == RAYLANE_OK);
    raylane_settings settings = raylane_default_settings();
    settings.width = settings.height = 1;
    CHECK(raylane_set_settings(builder.get(), &settings) == RAYLANE_OK);
    raylane_camera camera = raylane_default_camera();
    camera.from = {0.5F, 0, 5};
    camera.at = {0.5F, 0, 0};
    CHECK(raylane_set_camera(builder.get(), &camera) == RAYLANE_OK);
    const SceneHandle scene = built(builder);
    float rgb[3] = {};
    CHECK(raylane_render(scene.get(), nullptr, 1, RAYLANE_EXACT, nullptr, nullptr, rgb) ==
          RAYLANE_OK);
    CHECK(rgb[0] == 0.25F); // the middle of the left pixel
    CHECK(rgb[1] == 0.5F);
    CHECK(rgb[2] == 0.75F);
    raylane_material again{};
    CHECK(raylane_scene_material(scene.get(), index, &again) == RAYLANE_OK);
    REQUIRE(again.pattern.image != nullptr);
    CHECK(raylane_add_material(builder.get(), &again, nullptr) == RAYLANE_OK);
}

TEST_CASE("C refuses images without pixels and files of other formats") {
    raylane_texture* texture = nullptr;
    const std::uint8_t codes[3] = {};
    CHECK(raylane_texture_from_codes(0, 1, codes, &texture) == RAYLANE_INVALID_VALUE);
    CHECK(raylane_texture_from_codes(1, 1, nullptr, &texture) == RAYLANE_INVALID_VALUE);
    CHECK(raylane_read_texture("no-such-file.png", &texture) == RAYLANE_BAD_INPUT);
    CHECK(texture == nullptr);
    CHECK(raylane_read_texture(RAYLANE_SOURCE_DIR "/scenes/birthday.json", &texture) ==
          RAYLANE_BAD_INPUT);
    CHECK(std::string(raylane_error_text()).find("must be PNG, got another format") !=
          std::string::npos);
    raylane_texture_release(nullptr);
}

TEST_CASE("C has the defaults of C++") {
    const raylane_material material = raylane_default_material();
    CHECK(material.diffuse == Material{}.diffuse);
    CHECK(material.pattern.axes == Pattern{}.axes);
    CHECK(material.pattern.to.y == Pattern{}.to.y);
    CHECK(material.pattern.formula[2] == nullptr);
    CHECK(raylane_default_camera().field_of_view == Camera{}.field_of_view);
    CHECK(raylane_default_fog().end == Fog{}.end);
    CHECK(raylane_default_light().direction.y == Light{}.direction.y);
    CHECK(raylane_default_light().edge_v.z == Light{}.edge_v.z);
    CHECK(raylane_default_light().reach == Light{}.reach);
    CHECK(raylane_default_camera().focus_distance == Camera{}.focus_distance);
    CHECK(raylane_default_settings().light_samples == Settings{}.light_samples);
    CHECK(raylane_default_settings().max_depth == Settings{}.max_depth);
    CHECK(raylane_default_settings().max_transparent == Settings{}.max_transparent);
    CHECK(raylane_default_settings().transparent_shadows == 1);
    CHECK(raylane_default_settings().outline.creases == Settings{}.outline.creases);
    CHECK(raylane_default_material().opacity == Material{}.opacity);
}

TEST_CASE("an error in C has a code and a line of text") {
    const auto says = [](raylane_status status, raylane_status expected, const char* text) {
        CHECK(status == expected);
        CHECK(std::string(raylane_error_text()) == text);
    };
    const Builder builder = builder_in_c();
    std::uint32_t material = 0;
    const raylane_material plain = raylane_default_material();
    CHECK(raylane_add_material(builder.get(), &plain, &material) == RAYLANE_OK);
    const raylane_sphere balls[] = {{{0, 0, 0}, 1}, {{0, 0, 0}, -1}};
    says(raylane_add_spheres(builder.get(), balls, 2, material, nullptr), RAYLANE_INVALID_VALUE,
         "1/radius: must be positive, got -1");
    says(raylane_add_spheres(nullptr, balls, 1, material, nullptr), RAYLANE_INVALID_VALUE,
         "builder: must not be NULL");
    says(raylane_add_spheres(builder.get(), nullptr, 1, material, nullptr), RAYLANE_INVALID_VALUE,
         "shapes: must not be NULL");
    CHECK(raylane_add_spheres(builder.get(), nullptr, 0, material, nullptr) == RAYLANE_OK);
    const raylane_triangle halves[] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}},
                                       {{0, 0, 0}, {1, 1, 0}, {0, 1e31F, 0}}};
    says(raylane_add_polygon(builder.get(), halves, 2, material, nullptr), RAYLANE_INVALID_VALUE,
         "1/c/1: must be a number from -1e30 to 1e30, got 1e+31");

    raylane_scene* none = nullptr;
    CHECK(raylane_load("no/such.json", &none) == RAYLANE_BAD_INPUT);
    CHECK(none == nullptr);
    const char text[] = "{\"objects\": 3}";
    CHECK(raylane_parse(text, std::strlen(text), "mine.json", &none) == RAYLANE_BAD_INPUT);
    CHECK(std::string(raylane_error_text()).starts_with("mine.json"));
    CHECK(raylane_save(balls_in_c().get(), "no/such.json") == RAYLANE_SYSTEM_REFUSED);
    says(raylane_save(balls_in_c().get(), "such.txt"), RAYLANE_BAD_INPUT,
         "such.txt: must end in .json, .nff, .pov or .rl");
    says(raylane_save(nullptr, "such.json"), RAYLANE_INVALID_VALUE, "scene: must not be NULL");
    says(raylane_save(balls_in_c().get(), nullptr), RAYLANE_INVALID_VALUE,
         "path: must not be NULL");

    const SceneHandle scene = balls_in_c();
    raylane_tracer* tracer = nullptr;
    CHECK(raylane_tracer_create(scene.get(), -1, RAYLANE_EXACT, &tracer) == RAYLANE_INVALID_VALUE);
    CHECK(raylane_tracer_create(scene.get(), 1, 77, &tracer) == RAYLANE_INVALID_VALUE);
    CHECK(raylane_tracer_create(scene.get(), 1, -1, &tracer) == RAYLANE_INVALID_VALUE);
    CHECK(tracer == nullptr);
    const TracerHandle asked = tracer_of(scene);
    raylane_rays rays{};
    const raylane_hits hits{};
    CHECK(raylane_intersect(asked.get(), &rays, &hits) == RAYLANE_OK);
    rays.count = 1;
    says(raylane_intersect(asked.get(), &rays, &hits), RAYLANE_INVALID_VALUE,
         "origin_x: must not be NULL");
    says(raylane_intersect(asked.get(), &rays, nullptr), RAYLANE_INVALID_VALUE,
         "origin_x: must not be NULL");
    says(raylane_intersect(asked.get(), nullptr, &hits), RAYLANE_INVALID_VALUE,
         "rays: must not be NULL");

    std::vector<float> rgb(std::size_t{32} * 24 * 3);
    const auto cancel = [](const raylane_progress* progress, void* user) {
        CHECK(progress->pixels == std::int64_t{progress->tile_width} * progress->tile_height);
        CHECK(progress->total_pixels == 32 * 24);
        ++*static_cast<int*>(user);
        return 0;
    };
    int calls = 0;
    CHECK(raylane_render(scene.get(), nullptr, 1, RAYLANE_EXACT, cancel, &calls, rgb.data()) ==
          RAYLANE_CANCELLED);
    CHECK(calls == 1);

    // Invalid sizes are refused before a pixel is read or memory is allocated.
    for (const auto& [columns, rows, refusal] :
         {std::tuple(0, 9, "width: must be from 1 to 65535, got 0"),
          std::tuple(2147483647, 2147483647, "width: must be from 1 to 65535, got 2147483647"),
          std::tuple(70000, 70000, "width: must be from 1 to 65535, got 70000"),
          std::tuple(9, 65536, "height: must be from 1 to 65535, got 65536"),
          std::tuple(-1, 9, "width: must be from 1 to 65535, got -1")})
        says(raylane_write_image("none.png", columns, rows, rgb.data(), RAYLANE_SRGB),
             RAYLANE_INVALID_VALUE, refusal);
    says(raylane_write_image("none.png", 9, 9, nullptr, RAYLANE_SRGB), RAYLANE_INVALID_VALUE,
         "rgb: must not be NULL");
    raylane_tracer_release(nullptr);
    raylane_scene_release(nullptr);
    raylane_builder_release(nullptr);
}

TEST_CASE("spheres move in C as in C++") {
    const SceneHandle scene = balls_in_c();
    const raylane_vec3 positions[] = {{0, 0, 1}, {3, 0, 0}};
    const double doubles[] = {0, 0, 1, 3, 0, 0};
    Rays rays;
    for (const float x : {0.5F, 2.5F, -0.5F})
        rays.add({x, 0.25F, 9}, {0, 0, -1});
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    for (const raylane_vec3& at : positions)
        builder.add(Sphere{{at.x, at.y, at.z}, 1}, material);
    const Hits truth = intersect(Tracer(builder.build()), rays);
    const auto check = [&](const auto& move) {
        raylane_scene* moved = nullptr;
        REQUIRE(move(&moved) == RAYLANE_OK);
        const SceneHandle handle(moved);
        const TracerHandle asked = tracer_of(handle);
        Hits hits(rays.size());
        const raylane_rays to_c = {rays.size(),    rays.x.data(),  rays.y.data(),  rays.z.data(),
                                   rays.dx.data(), rays.dy.data(), rays.dz.data(), nullptr,
                                   nullptr,        nullptr,        nullptr,        nullptr,
                                   nullptr};
        const raylane_hits from_c = {hits.t.data(),
                                     hits.nx.data(),
                                     hits.ny.data(),
                                     hits.nz.data(),
                                     hits.shape.data(),
                                     hits.entering.data(),
                                     nullptr,
                                     nullptr,
                                     nullptr,
                                     nullptr,
                                     nullptr};
        CHECK(raylane_intersect(asked.get(), &to_c, &from_c) == RAYLANE_OK);
        CHECK(hits == truth);
    };
    check([&](raylane_scene** moved) {
        return raylane_with_positions(scene.get(), positions, 2, moved);
    });
    check([&](raylane_scene** moved) {
        return raylane_with_positions_doubles(scene.get(), doubles, 2, moved);
    });
    raylane_scene* none = nullptr;
    CHECK(raylane_with_positions(scene.get(), positions, 1, &none) == RAYLANE_INVALID_VALUE);
    CHECK(raylane_error_text() ==
          std::string("positions: must have one element for each of 2 spheres, got 1"));
    CHECK(raylane_with_positions(scene.get(), nullptr, 2, &none) == RAYLANE_INVALID_VALUE);
    CHECK(raylane_with_positions(nullptr, positions, 2, &none) == RAYLANE_INVALID_VALUE);
    CHECK(none == nullptr);
}
