#include "tests/scenes/api/ray_arrays.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <vector>

using namespace raylane;
using namespace raylane::tests;

/// Tests of the headers' rules for rays that touch a surface, lie in it, start on it, or meet
/// several.

namespace {

struct Answer {
    ShapeId shape;
    float t;
    bool entering;
    Vec3 normal;
};

/// Returns the crossings of a ray. Each t is the t_min of the query for the next one.
template <class... Shapes>
std::vector<Answer> answers(const Vec3& origin, const Vec3& direction, const Shapes&... shapes) {
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    (builder.add(shapes, material), ...);
    const Tracer tracer(builder.build());
    std::vector<Answer> found;
    float t = 0.0F;
    while (found.size() < 10) {
        Rays rays;
        rays.add(origin, direction);
        rays.t_min = {t};
        const Hits hits = intersect(tracer, rays);
        CHECK(occluded(tracer, rays)[0] == (hits.shape[0] != no_shape));
        if (hits.shape[0] == no_shape) break;
        t = hits.t[0];
        found.push_back(
            {hits.shape[0], t, hits.entering[0] == 1, {hits.nx[0], hits.ny[0], hits.nz[0]}});
    }
    return found;
}

void check(const Answer& answer, ShapeId shape, float t, bool entering, const Vec3& normal) {
    CHECK(answer.shape == shape);
    CHECK(answer.t == t);
    CHECK(answer.entering == entering);
    CHECK((answer.normal.x == normal.x && answer.normal.y == normal.y &&
           answer.normal.z == normal.z));
}

template <class... Shapes>
void check_one(float t, bool entering, const Vec3& normal, const Vec3& origin,
               const Vec3& direction, const Shapes&... shapes) {
    const std::vector<Answer> found = answers(origin, direction, shapes...);
    REQUIRE(found.size() == 1);
    check(found[0], 0, t, entering, normal);
}

Quadric saddle() { // z = x y
    Quadric quadric;
    quadric.xy = -0.5F;
    quadric.z = 0.5F;
    quadric.lower = {-4, -4, -4};
    quadric.upper = {4, 4, 4};
    return quadric;
}

Quadric unit_quadric() {
    Quadric quadric;
    quadric.xx = quadric.yy = quadric.zz = 1;
    quadric.one = -1;
    quadric.lower = {-2, -2, -2};
    quadric.upper = {2, 2, 2};
    return quadric;
}

} // namespace

TEST_CASE("a line that touches a surface enters it there") {
    check_one(3, true, {0, 1, 0}, {-3, 1, 0}, {1, 0, 0}, Sphere{{0, 0, 0}, 1});
    check_one(3, true, {0, 1, 0}, {-3, 1, 0}, {1, 0, 0}, unit_quadric());
    check_one(3, true, {0, 1, 0}, {-3, 1, 0}, {1, 0, 0}, OpenCylinder{{0, 0, -1}, {0, 0, 2}, 1});
    check_one(3, true, {0, 1, 0}, {-3, 1, 0}, {1, 0, 0}, CappedCylinder{{0, 0, -1}, {0, 0, 2}, 1});
    // A line one float further out misses, and one float further in enters and leaves.
    const float more = std::nextafter(1.0F, 2.0F), less = std::nextafter(1.0F, 0.0F);
    CHECK(answers({-3, more, 0}, {1, 0, 0}, Sphere{{0, 0, 0}, 1}).empty());
    CHECK(answers({-3, less, 0}, {1, 0, 0}, Sphere{{0, 0, 0}, 1}).size() == 2);
}

TEST_CASE("a line in an open surface does not hit it and one in a solid's surface hits the solid") {
    const Vec3 from{-3, 0, 0}, along{1, 0, 0};
    CHECK(answers(from, along, Plane{{0, 0, 0}, {0, 1, 0}}).empty());
    CHECK(answers(from, along, Disc{{0, 0, 0}, {0, 1, 0}, 1}).empty());
    CHECK(answers(from, along, Triangle{{-1, 0, -1}, {1, 0, -1}, {0, 0, 2}}).empty());
    CHECK(answers({-3, 1, 0}, along, OpenCylinder{{-1, 0, 0}, {2, 0, 0}, 1}).empty());
    CHECK(answers({-3, 4, 0}, {1, -1, 0}, OpenCone{{0, 0, 0}, {2, 0, 0}, 1, 3}).size() == 1);
    CHECK(answers({-1, 0, 0}, {1, 1, 0}, OpenCone{{0, 0, 0}, {2, 0, 0}, 1, 3}).empty());
    CHECK(answers(from, along, saddle()).empty()); // z = x y holds the x axis
    // In a face of a box, and along the side of a cylinder.
    const std::vector<Answer> face =
        answers({-3, 1, 0}, along, Box{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}});
    REQUIRE(face.size() == 2);
    check(face[0], 0, 2, true, {-1, 0, 0});
    check(face[1], 0, 4, false, {1, 0, 0});
    const std::vector<Answer> side =
        answers({-3, 1, 0}, along, CappedCylinder{{-1, 0, 0}, {2, 0, 0}, 1});
    REQUIRE(side.size() == 2);
    check(side[0], 0, 2, true, {-1, 0, 0});
    check(side[1], 0, 4, false, {1, 0, 0});
}

TEST_CASE("crossings are tied exactly if real arithmetic gives the same t") {
    // The second plane is nearer. Both t are 1 in float and in double.
    const float tiny = 0x1p-100F;
    const Plane at{{0, 0, tiny}, {0, 0, 1}}, before{{0, 0, 2 * tiny}, {0, 0, 1}};
    CHECK(answers({0, 0, 1}, {0, 0, -1}, at, before)[0].shape == 1);
    // At the same t, entries come first, then lower ids.
    const Sphere left{{0, 0, 1}, 1}, entered{{0, 0, -1}, 1};
    const std::vector<Answer> contact = answers({0, 0, 1}, {0, 0, -1}, left, entered);
    REQUIRE(contact.size() == 2);
    check(contact[0], 1, 1, true, {0, 0, 1});
    check(contact[1], 1, 3, false, {0, 0, -1});
    const Plane same{{1, 2, 0}, {0, 0, 3}};
    CHECK(answers({0, 0, 1}, {0, 0, -1}, Plane{{0, 0, 0}, {0, 0, 1}}, same)[0].shape == 0);
}

TEST_CASE("a crossing at the origin does not count and the next one does") {
    check_one(2, false, {0, 0, -1}, {0, 0, 1}, {0, 0, -1}, Sphere{{0, 0, 0}, 1});
    CHECK(answers({0, 0, 1}, {0, 0, 1}, Sphere{{0, 0, 0}, 1}).empty());
    CHECK(answers({0, 0, 1}, {1, 0, 0}, Sphere{{0, 0, 0}, 1}).empty());
    CHECK(answers({0, 0, 0}, {1, 0, 1}, Disc{{0, 0, 0}, {0, 0, 1}, 1}).empty());
}

TEST_CASE("t is the float nearest to the exact t") {
    check_one(1.0F / 3.0F, true, {0, 0, -1}, {0, 0, -1}, {0, 0, 3}, Plane{{0, 0, 0}, {0, 0, -1}});
    const float root = static_cast<float>(2.0 - std::sqrt(0.5));
    check_one(2.0F, true, {0, 1, 0}, {-2, 1, 0}, {1, 0, 0}, Sphere{{0, 0, 0}, 1});
    const std::vector<Answer> chord = answers({-2, 0.5F, 0.5F}, {1, 0, 0}, Sphere{{0, 0, 0}, 1});
    REQUIRE(chord.size() == 2);
    CHECK(chord[0].t == root);
}

TEST_CASE("edges and rims and apexes have a defined normal") {
    // At an edge or a corner of a box, the normal is that of the first face, in the order of
    // edge_u, edge_v and edge_w.
    const Box box{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    CHECK(answers({3, 3, 0}, {-1, -1, 0}, box)[0].normal.x == 1);
    CHECK(answers({0, 3, 3}, {0, -1, -1}, box)[0].normal.y == 1);
    CHECK(answers({3, 3, 3}, {-1, -1, -1}, box)[0].normal.x == 1);
    CHECK(answers({-3, 3, 3}, {1, -1, -1}, box)[0].normal.x == -1);
    // At a rim, the normal is that of the side.
    const CappedCylinder can{{0, -1, 0}, {0, 2, 0}, 1};
    CHECK(answers({3, 3, 0}, {-1, -1, 0}, can)[0].normal.x == 1);
    const CappedCone bucket{{0, 1, 0}, {0, 1, 0}, 1, 1.5F};
    CHECK(answers({2.5F, 3, 0}, {-1, -1, 0}, bucket)[0].normal.y < 0);
    // At the apex of a cone, the normal points along the axis towards the apex. At that of a
    // quadric, it is z.
    const CappedCone cone{{0, -1, 0}, {0, 1, 0}, 1, 0};
    CHECK(answers({-3, 0, 0}, {1, 0, 0}, cone)[0].normal.y == 1);
    CHECK(answers({0, 3, 0}, {0, -1, 0}, cone)[0].normal.y == 1);
    Quadric light_cone; // x^2 + y^2 = z^2
    light_cone.xx = light_cone.yy = 1;
    light_cone.zz = -1;
    light_cone.lower = {-1, -1, -1};
    light_cone.upper = {1, 1, 1};
    CHECK(answers({-3, 0, 0}, {1, 0, 0}, light_cone)[0].normal.z == 1);
}

TEST_CASE("a ray may enter and leave with the same normal") {
    // The ray grazes the plane: the sine of its angle with the plane is 2^-60. Both normals are
    // those of the front.
    const Plane plane{{0, 0, 0}, {1, 0x1p60F, 0}};
    const std::vector<Answer> up = answers({-1, 0, 0}, {1, 0, 0}, plane);
    const std::vector<Answer> down = answers({1, 0, 0}, {-1, 0, 0}, plane);
    REQUIRE((up.size() == 1 && down.size() == 1));
    CHECK(!up[0].entering);
    CHECK(down[0].entering);
    CHECK((up[0].normal.x == down[0].normal.x && up[0].normal.y == 1 && down[0].normal.y == 1));
}
