#include "core/optics/spectrum.hpp"
#include "core/reference/containing.hpp"
#include "core/reference/search.hpp"
#include "core/scene/glass.hpp"
#include "core/solids/lens.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <map>
#include <string>

using namespace raylane::core;

namespace {

Scene scene_of(const Lens& lens) {
    SceneBuilder builder;
    builder.wants_light = false;
    builder.add_solid(solid_of(lens), builder.add_material({}));
    return std::move(builder).build();
}

/// Returns all crossings of a line with the scene, in ascending order.
std::vector<Hit<double>> hits_of(const Scene& scene, const Ray<double>& ray) {
    Searcher<double> searcher(scene, Search::hierarchy);
    std::vector<Hit<double>> hits;
    searcher.each(ray, {}, 1e30, [&](const Hit<double>& hit) {
        hits.push_back(hit);
        return true;
    });
    searcher.sort(ray, {}, hits);
    return hits;
}

/// Returns their t.
std::vector<double> crossings(const Scene& scene, const Vec3d& origin, const Vec3d& direction) {
    std::vector<double> t;
    for (const Hit<double>& hit : hits_of(scene, {origin, direction}))
        t.push_back(hit.t);
    return t;
}

std::string complaint(const Lens& lens) {
    try {
        static_cast<void>(solid_of(lens));
        return "";
    } catch (const InvalidValue& invalid) {
        return invalid.what();
    }
}

} // namespace

TEST_CASE("glasses have the index of refraction of their catalogues") {
    const std::map<std::string, double> expected = {
        {"N-BK7", 1.51680}, {"N-K5", 1.52249},         {"N-BAK4", 1.56883},
        {"F2", 1.62004},    {"N-F2", 1.62005},         {"SF5", 1.67270},
        {"N-SF5", 1.67271}, {"N-SF10", 1.72828},       {"N-SF11", 1.78472},
        {"SF11", 1.78472},  {"fused silica", 1.45846}, {"calcium fluoride", 1.43385},
        {"diamond", 2.4175}};
    CHECK(glass_catalogue().size() == expected.size());
    for (const NamedGlass& named : glass_catalogue()) {
        INFO(named.name);
        const double n = index_at(named.glass, line_d);
        CHECK(n == Approx(expected.at(std::string(named.name)))
                       .margin(named.name == "diamond" ? 1e-3 : 1.5e-5));
        CHECK(index_at(named.glass, 486.13) > n);
        CHECK(n > index_at(named.glass, 656.27));
    }
    // Abbe numbers of crown and flint.
    const auto abbe = [](const Sellmeier& glass) {
        return (index_at(glass, line_d) - 1) /
               (index_at(glass, 486.1327) - index_at(glass, 656.2725));
    };
    CHECK(abbe(glass_catalogue()[0].glass) == Approx(64.17).margin(0.02));
    CHECK(abbe(glass_catalogue()[5].glass) == Approx(32.21).margin(0.02));
}

TEST_CASE("the shares of wavelengths add up to white and go from blue to red") {
    const std::vector<double> wavelengths = {420, 460, 500, 540, 580, 620, 660};
    const std::vector<Color> shares = shares_of(wavelengths);
    Color sum(0.0F);
    for (const Color& share : shares)
        sum += share;
    for (int channel = 0; channel < 3; ++channel)
        CHECK(sum[channel] == Approx(1.0F).epsilon(1e-6));
    CHECK(shares[1].z > shares[1].x);
    CHECK(shares[3].y > shares[3].z);
    CHECK(shares[5].x > shares[5].y);
    CHECK(shares_of(std::vector<double>{600})[0] == Color(1.0F));
}

TEST_CASE("a lens lies between its surfaces and within its cylinder") {
    // Biconvex, plano-convex on either side, meniscus, biconcave, and two with conics.
    const Lens lenses[] = {{{0, 0, 0}, {0, 0, 1}, {6, -6}, {0, 0}, 1.8, 3},
                           {{0, 0, 0}, {0, 0, 2}, {5, 0}, {0, 0}, 1, 2},
                           {{0, 0, 0}, {0, 0, 1}, {0, -5}, {0, 0}, 1, 2},
                           {{0, 0, 0}, {0, 0, 1}, {4, 7}, {0, 0}, 0.8, 1.5},
                           {{0, 0, 0}, {0, 0, 1}, {-6, 6}, {0, 0}, 0.5, 2},
                           {{0, 0, 0}, {0, 0, 1}, {5, -5}, {-1, -1}, 1.8, 2},
                           {{0, 0, 0}, {0, 0, 1}, {3, -4}, {-2.5, 0.5}, 2, 1.5}};
    for (const Lens& lens : lenses) {
        const Scene scene = scene_of(lens);
        for (const double height : {0.0, 0.3, 0.9}) {
            const double y = height * lens.radius;
            const std::vector<double> t = crossings(scene, {0, y, -20}, {0, 0, 1});
            REQUIRE(t.size() == 2);
            for (int side = 0; side < 2; ++side) {
                const double z =
                    t[static_cast<std::size_t>(side)] - 20 - (side == 0 ? 0 : lens.thickness);
                const double R = lens.radii[static_cast<std::size_t>(side)],
                             k = lens.conics[static_cast<std::size_t>(side)];
                if (R == 0)
                    CHECK(z == 0.0);
                else
                    CHECK(y * y + (1 + k) * z * z - 2 * R * z == Approx(0.0).margin(1e-12));
                CHECK(std::abs(z) < lens.radius);
            }
        }
        CHECK(crossings(scene, {0, 1.001 * lens.radius, -20}, {0, 0, 1}).empty());
        CHECK(crossings(scene, {0, -20, 0.5 * lens.thickness}, {0, 1, 0}).size() == 2);
    }
}

TEST_CASE("a thick lens does not show the far side of its surfaces") {
    // Convex, concave and hyperboloidal surfaces, each on either side; ellipsoids; spheres; a ball.
    const Lens lenses[] = {{{0, 0, 0}, {0, 0, 1}, {1, 0}, {0, 0}, 5, 0.5},
                           {{0, 0, 0}, {0, 0, 1}, {0, -1}, {0, 0}, 5, 0.5},
                           {{0, 0, 0}, {0, 0, 1}, {-1, 0}, {0, 0}, 5, 0.5},
                           {{0, 0, 0}, {0, 0, 1}, {0, 1}, {0, 0}, 5, 0.5},
                           {{0, 0, 0}, {0, 0, 1}, {-1, 0}, {-2, 0}, 5, 0.5},
                           {{0, 0, 0}, {0, 0, 1}, {0, 1}, {0, -2}, 5, 0.5},
                           {{0, 0, 0}, {0, 0, 1}, {0.5, -1}, {-0.5, 0.5}, 5, 0.5},
                           {{0, 0, 0}, {0, 0, 1}, {1, -1}, {0, 0}, 5, 0.5},
                           {{0, 0, 0}, {0, 0, 1}, {1, -1}, {0, 0}, 2, 1}};
    for (const Lens& lens : lenses) {
        CAPTURE(lens.radii[0], lens.radii[1], lens.conics[0], lens.conics[1]);
        const Scene scene = scene_of(lens);
        const double y = 0.6 * lens.radius;
        const std::vector<double> t = crossings(scene, {0, y, -20}, {0, 0, 1});
        REQUIRE(t.size() == 2);
        for (std::size_t side = 0; side < 2; ++side) {
            const double R = lens.radii[side], k = lens.conics[side];
            const double z = side == 0 ? 0 : lens.thickness;
            const double sag =
                R == 0 ? 0 : y * y / R / (1 + std::sqrt(1 - (1 + k) * y * y / R / R));
            CHECK(t[side] - 20 == Approx(z + sag));
        }
        CHECK(crossings(scene, {0, -20, 0.5 * lens.thickness}, {0, 1, 0}).size() == 2);
    }
}

TEST_CASE("a lens may stand anywhere and cemented lenses share one surface") {
    const Vec3d axis(1, 2, -2), vertex(3, -1, 0.5);
    const Scene scene = scene_of({vertex, axis, {6, -6}, {0, 0}, 1.5, 2});
    const std::vector<double> t = crossings(scene, vertex - axis, axis);
    REQUIRE(t.size() == 2);
    CHECK(t[0] == Approx(1.0));
    CHECK(t[1] == Approx(1.5));

    SceneBuilder builder;
    builder.wants_light = false;
    builder.add_solid(solid_of({{0, 0, 0}, {0, 0, 1}, {4.1, -3}, {0, 0}, 1.5, 2}),
                      builder.add_material({}));
    builder.add_solid(solid_of({{0, 0, 1.5}, {0, 0, 1}, {-3, -9}, {0, 0}, 0.6, 2}),
                      builder.add_material({}));
    const Scene doublet = std::move(builder).build();
    for (int i = 0; i < 50; ++i) {
        const auto hits = hits_of(doublet, {{0.03 * i, 0.01 * i, -9}, {0.01, -0.02, 1}});
        REQUIRE(hits.size() == 4);
        CHECK(hits[2].joins);
        CHECK(hits[1].enters()); // enters the flint before it leaves the crown
        CHECK_FALSE(hits[2].enters());
        CHECK(hits[1].shape > hits[2].shape);
    }
}

TEST_CASE("invalid lenses are refused") {
    CHECK(complaint({{0, 0, 0}, {0, 0, 1}, {6, -6}, {0, 0}, 1.6, 3})
              .starts_with("thickness: must keep the surfaces apart"));
    CHECK(complaint({{0, 0, 0}, {0, 0, 1}, {2, -6}, {0, 0}, 9, 3}) ==
          "radii/0: must make a surface that reaches the radius of the lens, got 2");
    CHECK(complaint({{0, 0, 0}, {0, 0, 0}, {6, -6}, {0, 0}, 2, 3}).starts_with("axis"));
    CHECK(complaint({{0, 0, 0}, {0, 0, 1}, {6, -6}, {0, 0}, 0, 3}).starts_with("thickness"));
    CHECK(complaint({{0, 0, 0}, {0, 0, 1}, {6, -6}, {0, 0}, 2, 0}).starts_with("radius"));
}
