#include "scenes/formats/triangulate.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace raylane;
using scenes::ExactSum;
using scenes::PlanePoint;
using scenes::Triangulator;
using Polygon = std::vector<core::Vec3f>;

namespace {

PlanePoint flat(const core::Vec3f& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y)};
}

void add_product(ExactSum& sum, const core::Vec3f& a, const core::Vec3f& b, double sign) {
    sum.add(sign * static_cast<double>(a.x) * static_cast<double>(b.y));
    sum.add(-sign * static_cast<double>(a.y) * static_cast<double>(b.x));
}

int winding_number(const Polygon& polygon, const PlanePoint& p) {
    int winding = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const PlanePoint a = flat(polygon[i]);
        const PlanePoint b = flat(polygon[(i + 1) % polygon.size()]);
        if (a.y <= p.y && b.y > p.y && scenes::orientation(a, b, p) > 0) ++winding;
        if (a.y > p.y && b.y <= p.y && scenes::orientation(a, b, p) < 0) --winding;
    }
    return winding;
}

/// Returns how many triangles contain p inside of their edges, or -1 if p is on an edge.
int coverage(const Polygon& polygon, std::span<const Triangulator::Corners> triangles,
             const PlanePoint& p) {
    int count = 0;
    for (const auto& [a, b, c] : triangles) {
        const int ab = scenes::orientation(flat(polygon[a]), flat(polygon[b]), p);
        const int bc = scenes::orientation(flat(polygon[b]), flat(polygon[c]), p);
        const int ca = scenes::orientation(flat(polygon[c]), flat(polygon[a]), p);
        if (std::min({ab, bc, ca}) > 0) ++count;
        if (std::min({ab, bc, ca}) == 0) return -1;
    }
    return count;
}

/// Returns true if the triangles face as the polygon does, have exactly its area, and cover random
/// points once if they are inside and not at all if they are outside.
bool tiles(const Polygon& polygon, std::span<const Triangulator::Corners> triangles,
           std::size_t points) {
    ExactSum area;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        add_product(area, polygon[i], polygon[(i + 1) % polygon.size()], 1.0);
    for (const auto& [a, b, c] : triangles) {
        if (scenes::orientation(flat(polygon[a]), flat(polygon[b]), flat(polygon[c])) <= 0)
            return false;
        add_product(area, polygon[a], polygon[b], -1.0);
        add_product(area, polygon[b], polygon[c], -1.0);
        add_product(area, polygon[c], polygon[a], -1.0);
    }
    if (area.sign() != 0) return false;

    scenes::Rectangle bounds;
    for (const core::Vec3f& v : polygon)
        bounds.include(flat(v));
    std::mt19937 random(1);
    std::uniform_real_distribution<double> x(bounds.lower.x, bounds.upper.x);
    std::uniform_real_distribution<double> y(bounds.lower.y, bounds.upper.y);
    for (std::size_t i = 0; i < points; ++i) {
        // Rounds to floats, for which the orientation is exact.
        const PlanePoint p{static_cast<double>(static_cast<float>(x(random))),
                           static_cast<double>(static_cast<float>(y(random)))};
        const int count = coverage(polygon, triangles, p);
        if (count >= 0 && count != winding_number(polygon, p)) return false;
    }
    return true;
}

bool triangulates(const Polygon& polygon, std::size_t points = 200) {
    Triangulator triangulator;
    return tiles(polygon, triangulator.triangulate(polygon), points);
}

core::Vec3f on_circle(double turns, double radius) {
    const double angle = 2.0 * std::numbers::pi * turns;
    return {static_cast<float>(radius * std::cos(angle)),
            static_cast<float>(radius * std::sin(angle)), 0.0F};
}

Polygon star(int tips, double inner) {
    Polygon polygon;
    for (int i = 0; i < 2 * tips; ++i)
        polygon.push_back(on_circle(i / (2.0 * tips), i % 2 == 0 ? 1.0 : inner));
    return polygon;
}

/// Returns a band that turns `turns` times.
Polygon spiral(int points, double turns) {
    Polygon polygon;
    for (int i = 0; i < points; ++i)
        polygon.push_back(on_circle(turns * i / points, 1.0 + turns * i / points));
    for (int i = points - 1; i >= 0; --i)
        polygon.push_back(on_circle(turns * i / points, 0.6 + turns * i / points));
    return polygon;
}

Polygon comb(int teeth) {
    Polygon polygon = {{static_cast<float>(2 * teeth), -1.0F, 0.0F}};
    for (int i = 2 * teeth - 1; i >= 0; --i)
        polygon.push_back({static_cast<float>(i), i % 2 == 0 ? 0.0F : 5.0F, 0.0F});
    polygon.push_back({-1.0F, -1.0F, 0.0F});
    return polygon;
}

/// Returns a strip with two rows of corners, each row in one line.
Polygon strip(int length) {
    Polygon polygon;
    for (int i = 0; i < length; ++i)
        polygon.push_back({static_cast<float>(i), 0.0F, 0.0F});
    for (int i = length - 1; i >= 0; --i)
        polygon.push_back({static_cast<float>(i), 1.0F, 0.0F});
    return polygon;
}

/// Returns a polygon with all corners but three reflex.
Polygon below_a_bowl(int corners) {
    Polygon polygon = {{0.0F, -5.0F, 0.0F}};
    for (int i = corners; i >= 0; --i) {
        const float x = 2.0F * static_cast<float>(i) / static_cast<float>(corners) - 1.0F;
        polygon.push_back({x, x * x, 0.0F});
    }
    return polygon;
}

struct GridPoint {
    int x, y;
    bool operator==(const GridPoint&) const = default;
};

int turn(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

using GridTriangle = std::array<GridPoint, 3>;

/// Returns true if the triangles have no inner point in common: an edge of one separates them.
bool apart(const GridTriangle& s, const GridTriangle& t) {
    const auto separates = [](const GridTriangle& by, const GridTriangle& other) {
        for (int i = 0; i < 3; ++i)
            if (std::all_of(other.begin(), other.end(), [&](const GridPoint& p) {
                    return turn(by[i], by[(i + 1) % 3], p) <= 0;
                }))
                return true;
        return false;
    };
    return separates(s, t) || separates(t, s);
}

/// Returns the outline of triangles that are glued to each other edge by edge, like leaves of a
/// tree, without overlapping. It does not cross itself. On so small a grid, it touches itself
/// everywhere, encloses holes, and runs along itself.
Polygon glued_triangles(std::mt19937& random, int triangles, int grid) {
    std::uniform_int_distribution<int> coordinate(0, grid - 1);
    const auto any_point = [&] { return GridPoint{coordinate(random), coordinate(random)}; };
    std::vector<GridTriangle> placed;
    std::vector<GridPoint> outline;
    while (outline.empty()) {
        const GridTriangle t = {any_point(), any_point(), any_point()};
        if (turn(t[0], t[1], t[2]) <= 0) continue;
        placed.push_back(t);
        outline.assign(t.begin(), t.end());
    }
    for (int attempt = 0; attempt < 20 * triangles && placed.size() < std::size_t(triangles);
         ++attempt) {
        const std::size_t edge = random() % outline.size();
        const GridTriangle t = {outline[(edge + 1) % outline.size()], outline[edge], any_point()};
        if (turn(t[0], t[1], t[2]) <= 0) continue;
        if (!std::all_of(placed.begin(), placed.end(),
                         [&](const GridTriangle& other) { return apart(t, other); }))
            continue;
        placed.push_back(t);
        outline.insert(outline.begin() + static_cast<std::ptrdiff_t>(edge) + 1, t[2]);
    }
    Polygon polygon;
    for (const GridPoint& p : outline)
        polygon.push_back({static_cast<float>(p.x), static_cast<float>(p.y), 0.0F});
    return polygon;
}

} // namespace

TEST_CASE("convex and concave and winding polygons are tiled") {
    CHECK(triangulates({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    CHECK(triangulates({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    CHECK(triangulates({{0, 0, 0}, {2, 0, 0}, {0.5F, 0.5F, 0}, {0, 2, 0}}));
    CHECK(triangulates(star(5, 0.4)));
    CHECK(triangulates(star(500, 0.01)));
    CHECK(triangulates(spiral(400, 5)));
    CHECK(triangulates(comb(100)));
    // Far from the origin, where a rounded side test would guess.
    Polygon far = star(60, 0.7);
    for (core::Vec3f& v : far)
        v += core::Vec3f(30000.0F, -70000.0F, 0.0F);
    CHECK(triangulates(far));
}

TEST_CASE("every vertex on a straight edge becomes a corner") {
    const Polygon square = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 3, 0},
                            {2, 3, 0}, {1, 3, 0}, {0, 3, 0}, {0, 2, 0}, {0, 1, 0}};
    Triangulator triangulator;
    const auto triangles = triangulator.triangulate(square);
    CHECK(triangles.size() == square.size() - 2);
    CHECK(tiles(square, triangles, 200));
}

TEST_CASE("repeated vertices and spikes do not belong to the area") {
    CHECK(triangulates({{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 2, 0}, {2, 2, 0}}));
    CHECK(triangulates({{0, 0, 0}, {2, 0, 0}, {5, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}));
    CHECK(triangulates({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {1, 1, 0}, {3, 3, 0}, {0, 3, 0}}));
}

TEST_CASE("polygons with bridged holes are tiled") {
    // A square with a square hole, and one with two holes on one bridge.
    CHECK(triangulates({{0, 0, 0},
                        {4, 0, 0},
                        {4, 4, 0},
                        {0, 4, 0},
                        {0, 0, 0},
                        {1, 1, 0},
                        {1, 3, 0},
                        {3, 3, 0},
                        {3, 1, 0},
                        {1, 1, 0}}));
    CHECK(triangulates({{0, 0, 0},
                        {9, 0, 0},
                        {9, 4, 0},
                        {0, 4, 0},
                        {0, 0, 0},
                        {1, 1, 0},
                        {1, 3, 0},
                        {3, 3, 0},
                        {3, 1, 0},
                        {5, 1, 0},
                        {5, 3, 0},
                        {7, 3, 0},
                        {7, 1, 0},
                        {5, 1, 0},
                        {3, 1, 0},
                        {1, 1, 0}}));
    // A ring of many corners.
    Polygon ring = star(100, 0.8);
    const std::size_t outer = ring.size();
    ring.push_back(ring.front());
    for (std::size_t i = 0; i <= outer; ++i)
        ring.push_back(ring[(2 * outer - i) % outer] * 0.5F);
    CHECK(triangulates(ring, 2000));
}

TEST_CASE("polygons that touch themselves are tiled") {
    std::mt19937 random(7);
    int failed = 0;
    for (int i = 0; i < 5000; ++i)
        if (!triangulates(glued_triangles(random, 1 + i % 60, 3 + i % 9), 20)) ++failed;
    CHECK(failed == 0);
}

TEST_CASE("triangles face as the polygon does in any plane") {
    const Polygon concave = {{0, 0, 0}, {2, 0, 0}, {0.5F, 0.5F, 0}, {0, 2, 0}};
    const auto faces = [](const Polygon& polygon, const core::Vec3f& normal) {
        Triangulator triangulator;
        const auto triangles = triangulator.triangulate(polygon);
        return triangles.size() == 2 &&
               std::all_of(triangles.begin(), triangles.end(), [&](const auto& t) {
                   const core::Vec3f a = polygon[t[0]];
                   return core::dot(core::cross(polygon[t[1]] - a, polygon[t[2]] - a), normal) > 0;
               });
    };
    for (int axis = 0; axis < 3; ++axis) {
        Polygon turned;
        for (const core::Vec3f& v : concave) {
            core::Vec3f w;
            w[axis] = 0.25F * v.x; // a slope
            w[(axis + 1) % 3] = v.x;
            w[(axis + 2) % 3] = v.y;
            turned.push_back(w);
        }
        core::Vec3f normal(0.0F);
        normal[axis] = 1.0F;
        CHECK(faces(turned, normal));
        std::reverse(turned.begin(), turned.end());
        CHECK(faces(turned, -normal));
        // For any first vertex, the reflex one included.
        std::rotate(turned.begin(), turned.begin() + 1, turned.end());
        CHECK(faces(turned, -normal));
    }
}

TEST_CASE("a polygon without an area has no triangles") {
    Triangulator triangulator;
    CHECK(triangulator.triangulate(Polygon{}).empty());
    CHECK(triangulator.triangulate(Polygon{{0, 0, 0}, {1, 0, 0}}).empty());
    CHECK(triangulator.triangulate(Polygon{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}).empty());
    CHECK(triangulator.triangulate(Polygon{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {3, 6, 9}}).empty());
    CHECK(triangulator.triangulate(Polygon{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}}).empty());
    // A sliver one ulp high has an area.
    CHECK(triangulator.triangulate(Polygon{{1, 1, 0}, {2, 1, 0}, {3, 1.0000001F, 0}}).size() == 1);
}

TEST_CASE("a polygon that crosses itself always gets the same triangles") {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> coordinate(0.0F, 1.0F);
    Polygon polygon;
    for (int i = 0; i < 1000; ++i)
        polygon.push_back({coordinate(random), coordinate(random), 0.0F});
    Triangulator triangulator;
    const auto first = triangulator.triangulate(polygon);
    const std::vector<Triangulator::Corners> triangles(first.begin(), first.end());
    CHECK(triangles.size() <= 998);
    triangulator.triangulate(star(7, 0.5));
    const auto second = triangulator.triangulate(polygon);
    CHECK(std::equal(triangles.begin(), triangles.end(), second.begin(), second.end()));
    Triangulator other;
    const auto third = other.triangulate(polygon);
    CHECK(std::equal(triangles.begin(), triangles.end(), third.begin(), third.end()));
}

TEST_CASE("large polygons do not take minutes") {
    CHECK(triangulates(star(50000, 0.5), 5));
    CHECK(triangulates(spiral(50000, 20), 5));
    CHECK(triangulates(comb(10000), 5));
    // Time quadratic in their corners would be minutes.
    CHECK(triangulates(strip(100'000), 5));
    CHECK(triangulates(below_a_bowl(200'000), 5));
}
