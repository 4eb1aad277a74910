#include "core/scene/best_view.hpp"
#include "core/scene/scene.hpp"
#include "tests/support/catch.hpp"

#include <random>

using namespace raylane::core;

TEST_CASE("the best view has the largest extent across and the least in depth") {
    std::mt19937 random(3);
    std::normal_distribution<double> number;
    for (int round = 0; round < 20; ++round) {
        // Axes of a box at random, by Gram and Schmidt.
        const auto vector = [&] { return Vec3d(number(random), number(random), number(random)); };
        const Vec3d a = normalized(vector());
        Vec3d b = vector();
        b = normalized(b - dot(a, b) * a);
        const Vec3d c = cross(a, b);
        SceneBuilder builder;
        const MaterialIndex material = builder.add_material({});
        for (int x = -1; x <= 1; x += 2)
            for (int y = -1; y <= 1; y += 2)
                for (int z = -1; z <= 1; z += 2) {
                    const Vec3d at = Vec3d(4, -7, 2) + 5.0 * x * a + 3.0 * y * b + 1.0 * z * c;
                    builder.add(SphereOf<double>{at, 0.5}, material);
                }
        builder.wants_light = false;
        const NamedView view = best_view(std::move(builder).build());
        const Vec3d along = normalized(convert<double>(view.direction));
        const Vec3d up = normalized(convert<double>(view.up));
        CHECK(std::abs(dot(along, c)) > 1.0 - 1e-6);
        CHECK(std::abs(dot(up, b)) > 1.0 - 1e-6);
        const Vec3d right = cross(along, up);
        for (const Vec3d& axis : {right, up})
            CHECK(std::max({axis.x, axis.y, axis.z}) >= std::max({-axis.x, -axis.y, -axis.z}));
    }
}

TEST_CASE("the best view of nothing is that from the front") {
    SceneBuilder builder;
    builder.wants_light = false;
    CHECK(best_view(std::move(builder).build()).name == "front");
}

TEST_CASE("the best view over a floor stands on it, away from walls") {
    for (const bool is_disc : {false, true})
        for (const double side : {1.0, -1.0}) {
            SceneBuilder builder;
            const MaterialIndex material = builder.add_material({});
            const Vec3d up = normalized(Vec3d(0.1, side, 0.2));
            if (is_disc)
                builder.add(DiscOf<double>{Vec3d(0.1, 0.2, 0.3), up, 20.0}, material);
            else
                builder.add(PlaneOf<double>{Vec3d(0.1, 0.2, 0.3), up}, material);
            // Flat on the floor, so that the least extent is upward.
            const Vec3d right = normalized(cross(up, Vec3d(0, 0, 1))), back = cross(right, up);
            for (int x = -2; x <= 2; ++x)
                for (int z = -1; z <= 1; ++z)
                    builder.add(SphereOf<double>{Vec3d(0.1, 0.2, 0.3) + 1.0 * x * right +
                                                     1.0 * z * back + 0.5 * up,
                                                 0.5},
                                material);
            const double wall = is_disc ? -1.0 : 1.0;
            builder.add(PlaneOf<double>{-5.0 * wall * back, -1.0 * back}, material);
            builder.wants_light = false;
            const NamedView view = best_view(std::move(builder).build());
            const Vec3d along = normalized(convert<double>(view.direction));
            CHECK(length(convert<double>(view.up) - up) < 1e-6);
            CHECK(std::abs(dot(along, up) + 0.3420201433256687) < 1e-6);
            CHECK(std::abs(dot(along, right)) < 1e-6);
            CHECK(dot(along, back) * wall < 0.0);
        }
}
