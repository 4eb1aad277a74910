#include "core/scene/generators.hpp"
#include "tests/scenes/shared_scene.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

using namespace raylane;
using core::Vec3d;
using core::Vec3f;

namespace {

core::SceneBuilder builder_with_light() {
    core::SceneBuilder builder;
    builder.add_material({});
    builder.add_light({.position = Vec3f(1000.0F, 1001.0F, 1002.0F)});
    return builder;
}

template <class Shape>
std::vector<Shape> shapes_in(const core::Scene& scene) {
    std::vector<Shape> shapes(scene.shape_count());
    std::vector<bool> present(scene.shape_count());
    for (const auto& block : std::get<core::Table<Shape>>(scene.shapes()).blocks())
        for (int lane = 0; lane < core::block_size; ++lane)
            if (block.ids[lane] != core::no_shape) {
                shapes[block.ids[lane]] = block.get(lane);
                present[block.ids[lane]] = true;
            }
    std::vector<Shape> only;
    for (std::size_t id = 0; id < shapes.size(); ++id)
        if (present[id]) only.push_back(shapes[id]);
    return only;
}

std::vector<core::Sphere> spheres_of(const core::Sphereflake& flake) {
    core::SceneBuilder builder = builder_with_light();
    core::add(builder, flake, 0);
    return shapes_in<core::Sphere>(std::move(builder).build());
}

double distance(const Vec3f& a, const Vec3f& b) {
    return core::length(core::convert<double>(a) - core::convert<double>(b));
}

template <class Generator>
std::string refusal_of(const Generator& generator) {
    core::SceneBuilder builder = builder_with_light();
    try {
        if constexpr (std::is_same_v<Generator, core::Lattice>)
            core::add(builder, generator, 0, 0);
        else
            core::add(builder, generator, 0);
    } catch (const core::InvalidValue& invalid) {
        return invalid.what();
    }
    return "";
}

} // namespace

TEST_CASE("a sphereflake is the balls of the Standard Procedural Databases") {
    const auto path = tests::shared_scene("balls.nff");
    if (!path) return;
    std::vector<std::array<double, 4>> expected;
    std::ifstream file(*path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string entity;
        std::array<double, 4> s{};
        if (words >> entity && entity == "s" && words >> s[0] >> s[1] >> s[2] >> s[3])
            expected.push_back(s);
    }
    const auto spheres = spheres_of({.center = Vec3f(0.0F), .radius = 0.5F, .depth = 4});
    REQUIRE(expected.size() == 7381);
    REQUIRE(spheres.size() == expected.size());

    // Matches each sphere with the expected one near it. No two are as close as 1e-5.
    std::sort(expected.begin(), expected.end());
    std::vector<bool> taken(expected.size());
    for (const core::Sphere& sphere : spheres) {
        const std::array<double, 4> values = {
            static_cast<double>(sphere.center.x), static_cast<double>(sphere.center.y),
            static_cast<double>(sphere.center.z), static_cast<double>(sphere.radius)};
        const auto near = [&](const std::array<double, 4>& other) {
            for (int i = 0; i < 4; ++i)
                if (std::abs(values[i] - other[i]) > 1e-5) return false;
            return true;
        };
        auto candidate = std::lower_bound(expected.begin(), expected.end(),
                                          std::array<double, 4>{values[0] - 1e-5});
        while (candidate != expected.end() && (*candidate)[0] <= values[0] + 1e-5 &&
               !near(*candidate))
            ++candidate;
        REQUIRE(candidate != expected.end());
        REQUIRE(near(*candidate));
        REQUIRE_FALSE(taken[static_cast<std::size_t>(candidate - expected.begin())]);
        taken[static_cast<std::size_t>(candidate - expected.begin())] = true;
    }
}

TEST_CASE("the spheres of a sphereflake touch their parent for any direction up") {
    const Vec3f up = GENERATE(Vec3f(0, 0, 1), Vec3f(0, 0, -3), Vec3f(0, 2, 0), Vec3f(1, -2, -0.5F),
                              Vec3f(1e-20F, 0, -1));
    const auto spheres =
        spheres_of({.center = Vec3f(1, 2, 3), .radius = 3.0F, .depth = 1, .up = up});
    REQUIRE(spheres.size() == 10);
    CHECK(spheres[0].center == Vec3f(1, 2, 3));
    CHECK(spheres[0].radius == 3.0F);
    const Vec3d tip = core::normalized(core::convert<double>(up));
    for (int i = 1; i < 10; ++i) {
        CHECK(spheres[i].radius == 1.0F);
        CHECK(distance(spheres[i].center, spheres[0].center) == Approx(4.0).epsilon(1e-6));
        const double height =
            core::dot(core::convert<double>(spheres[i].center) - Vec3d(1, 2, 3), tip);
        CHECK(height == Approx(i <= 3 ? 4.0 * std::sqrt(2.0 / 3.0) : 0.0).margin(1e-6));
        for (int j = 1; j < i; ++j)
            CHECK(distance(spheres[i].center, spheres[j].center) > 3.9999);
    }
}

TEST_CASE("a sphereflake of depth 0 is one sphere") {
    CHECK(spheres_of({.center = Vec3f(0.0F), .radius = 1.0F, .depth = 0}).size() == 1);
}

TEST_CASE("a lattice has spheres at its nodes and struts between neighbours") {
    core::SceneBuilder builder = builder_with_light();
    const core::MaterialIndex struts = builder.add_material({});
    core::add(builder,
              core::Lattice{.corner = Vec3d(-1, 0, 2),
                            .n = 3,
                            .spacing = 0.5F,
                            .sphere_radius = 0.125F,
                            .strut_radius = 0.0625F},
              0, struts);
    const core::Scene scene = std::move(builder).build();
    const auto spheres = shapes_in<core::Sphere>(scene);
    const auto cylinders = shapes_in<core::OpenCylinder>(scene);
    REQUIRE(spheres.size() == 27);
    REQUIRE(cylinders.size() == 54);
    CHECK(scene.shape_count() == 81);
    CHECK(scene.material_index_of(26) == 0);
    CHECK(scene.material_index_of(27) == struts);

    std::set<std::array<float, 3>> nodes;
    for (const core::Sphere& sphere : spheres) {
        CHECK(sphere.radius == 0.125F);
        nodes.insert({sphere.center.x, sphere.center.y, sphere.center.z});
    }
    CHECK(nodes.size() == 27);
    CHECK(nodes.contains({-1, 0, 2}));
    CHECK(nodes.contains({0, 1, 3}));
    std::set<std::array<float, 6>> joined;
    for (const core::OpenCylinder& strut : cylinders) {
        CHECK(strut.radius == 0.0625F);
        CHECK(core::length(strut.axis) == 0.5F);
        const Vec3f end = strut.base + strut.axis;
        CHECK(nodes.contains({strut.base.x, strut.base.y, strut.base.z}));
        CHECK(nodes.contains({end.x, end.y, end.z}));
        joined.insert({strut.base.x, strut.base.y, strut.base.z, end.x, end.y, end.z});
    }
    CHECK(joined.size() == 54);
}

TEST_CASE("a lattice of one node has no struts") {
    core::SceneBuilder builder = builder_with_light();
    core::add(
        builder,
        core::Lattice{
            .corner = Vec3d(0.0), .n = 1, .spacing = 1, .sphere_radius = 1, .strut_radius = 1},
        0, 0);
    CHECK(builder.shape_count() == 1);
}

TEST_CASE("generators refuse parameters out of range") {
    const Vec3f origin(0.0F);
    CHECK(refusal_of(core::Sphereflake{origin, 1, -1}) == "depth: must be from 0 to 8, got -1");
    CHECK(refusal_of(core::Sphereflake{origin, 1, 9}) == "depth: must be from 0 to 8, got 9");
    CHECK(refusal_of(core::Sphereflake{origin, -2, 1}) == "radius: must be positive, got -2");
    CHECK(refusal_of(core::Sphereflake{origin, 1, 1, origin}) ==
          "up: must not be the zero vector, got [0, 0, 0]");
    CHECK(refusal_of(core::Lattice{Vec3d(0.0), 0, 1, 1, 1}) == "n: must be from 1 to 256, got 0");
    CHECK(refusal_of(core::Lattice{Vec3d(0.0), 257, 1, 1, 1}) ==
          "n: must be from 1 to 256, got 257");
    CHECK(refusal_of(core::Lattice{Vec3d(0.0), 2, 0, 1, 1}) == "spacing: must be positive, got 0");
    CHECK(refusal_of(core::Lattice{Vec3d(0.0), 2, 1, -0.5F, 1}) ==
          "sphere_radius: must be positive, got -0.5");
    CHECK(refusal_of(core::Lattice{Vec3d(0.0), 2, 1, 1, 0}) ==
          "strut_radius: must be positive, got 0");
    CHECK(refusal_of(core::Lattice{Vec3d(0.0), 3, 9e29F, 1, 1}) ==
          "must have all nodes between -1e30 and 1e30");
}
