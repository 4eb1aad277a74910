#include "core/scene/pattern.hpp"
#include "tests/support/catch.hpp"

#include <cmath>

using namespace raylane::core;

namespace {

Pattern two_colors(PatternKind kind) {
    Pattern pattern;
    pattern.kind = kind;
    pattern.colors = {Color(0.0F), Color(1.0F)};
    return pattern;
}

double at(const Pattern& pattern, const Vec3d& point) {
    return color_at(pattern, point).x;
}

} // namespace

TEST_CASE("a checker changes from cell to cell along its axes") {
    Pattern floor = two_colors(PatternKind::checker); // x and z
    floor.size = 2.0F;
    CHECK(at(floor, {1, 0, 1}) == 0.0);
    CHECK(at(floor, {3, 0, 1}) == 1.0);
    CHECK(at(floor, {3, 0, 3}) == 0.0);
    CHECK(at(floor, {-1, 0, 1}) == 1.0);
    CHECK(at(floor, {-1, 0, -1}) == 0.0);
    CHECK(at(floor, {1, 3, 1}) == 0.0); // y does not count
    CHECK(at(floor, {2, 0, 1}) == 1.0);
    CHECK(at(floor, {1e300, 0, 1}) == 0.0);
    floor.axes = 7;
    CHECK(at(floor, {1, 3, 1}) == 1.0);
}

TEST_CASE("a point that rounding moves across an edge belongs to the cell that begins there") {
    Pattern checker = two_colors(PatternKind::checker);
    checker.axes = 7;
    checker.size = 0.1F;
    Pattern stripes = two_colors(PatternKind::stripes);
    stripes.size = 0.1F;
    const auto size = static_cast<double>(checker.size);
    for (const double edge : {0.0, 1.0, -1.0, 7.0, -1000.0, 1e6}) {
        CAPTURE(edge);
        const double color = std::fmod(std::abs(edge), 2.0);
        for (const double off : {0.0, 0x1p-52, -0x1p-52, 0x1p-30, -0x1p-30, 0.25}) {
            CAPTURE(off);
            CHECK(at(stripes, {(edge + off) * size, 5, 5}) == color);
            CHECK(at(checker, {0, (edge + off) * size, 0x1p-52}) == color);
        }
        CHECK(at(stripes, {(edge - 0x1p-26) * size, 5, 5}) == 1.0 - color);
        CHECK(at(checker, {0, (edge - 0x1p-26) * size, 0}) == 1.0 - color);
    }
    CHECK(color_at(stripes, Vec3f(0.1F * (3 - 0x1p-22F), 0, 0)).x == 1.0F);
    CHECK(color_at(stripes, Vec3f(0.1F * (3 - 0x1p-12F), 0, 0)).x == 0.0F);
}

TEST_CASE("a checker's cells hold their upper edges along chosen axes") {
    Pattern checker = two_colors(PatternKind::checker);
    checker.axes = 1 | 4 | 32;
    checker.size = 2.0F;
    for (const double edge : {0.0, 1.0, -1.0, 7.0, -1000.0, 1e6}) {
        CAPTURE(edge);
        const double below = std::fmod(std::abs(edge - 1.0), 2.0);
        for (const double off : {0.0, 0x1p-30, -0x1p-30, -0.25}) {
            CAPTURE(off);
            CHECK(at(checker, {0, 0, (edge + off) * 2.0}) == below);
        }
        CHECK(at(checker, {0, 0, (edge + 0x1p-26) * 2.0}) == 1.0 - below);
        CHECK(at(checker, {edge * 2.0, 0, 1}) == 1.0 - below);
    }
}

TEST_CASE("stripes run across their direction") {
    Pattern stripes = two_colors(PatternKind::stripes);
    stripes.size = 0.5F;
    stripes.direction = {0, 0, 3};
    CHECK(at(stripes, {9, 9, 0.25}) == 0.0);
    CHECK(at(stripes, {9, 9, 0.75}) == 1.0);
    CHECK(at(stripes, {9, 9, -0.25}) == 1.0);
}

TEST_CASE("a gradient is constant beyond its ends") {
    Pattern gradient = two_colors(PatternKind::gradient);
    gradient.from = {0, 1, 0};
    gradient.to = {0, 5, 0};
    CHECK(at(gradient, {7, 0, 7}) == 0.0);
    CHECK(at(gradient, {7, 1, 7}) == 0.0);
    CHECK(at(gradient, {7, 2, 7}) == 0.25);
    CHECK(at(gradient, {7, 5, 7}) == 1.0);
    CHECK(at(gradient, {7, 6, 7}) == 1.0);
}
