#include "tests/scenes/api/exam_in_double.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

/// Tests of rays that go on from hits: by limits, and from the shapes that they leave.
using namespace raylane;
using namespace raylane::tests;

namespace {

/// Returns the message of the InvalidRay that a query throws.
template <class Real>
std::string refusal(const Tracer& tracer, const BasicRaySpan<Real>& rays) {
    std::string text;
    const auto add = [&](const auto& query) {
        try {
            query();
            text += "none|";
        } catch (const InvalidRay& invalid) {
            text = invalid.what();
            CHECK(invalid.field == invalid.array + "/" + std::to_string(invalid.ray));
        }
    };
    Hits hits(rays.origin_x.size());
    std::vector<std::uint8_t> blocked(hits.t.size());
    CrossingRows rows;
    LengthRows lengths;
    SolidLengthRows solids;
    std::vector<std::uint64_t> counts(hits.t.size());
    add([&] { tracer.intersect(rays, hits.span()); });
    const std::string first = text;
    for (const auto& query :
         {std::function<void()>([&] { tracer.occluded(rays, blocked); }),
          std::function<void()>([&] { tracer.crossings(rays, rows); }),
          std::function<void()>([&] { tracer.crossings(rays, rows, {.most = 1}); }),
          std::function<void()>([&] { tracer.count_crossings(rays, counts); }),
          std::function<void()>([&] { tracer.path_lengths(rays, lengths); }),
          std::function<void()>([&] { tracer.solid_lengths(rays, solids); })}) {
        text.clear();
        add(query);
        CHECK(text == first);
    }
    return first;
}

/// Asks a ray from a point, which leaves a face of a shape, as the second of a few rays and of
/// more.
template <class Real>
std::string refusal(const Tracer& tracer, const Vec3Of<Real>& origin, const Vec3Of<Real>& direction,
                    ShapeId shape, std::uint8_t face, int inward) {
    std::string text;
    for (const std::size_t count : {2, 6}) {
        const auto column = [count]<class Value>(std::type_identity_t<Value> others, Value second) {
            std::vector<Value> values(count, others);
            values[1] = second;
            return values;
        };
        const std::vector<Real> x = column(9, origin.x), y = column(9, origin.y),
                                z = column(9, origin.z), dx = column(1, direction.x),
                                dy = column(0, direction.y), dz = column(0, direction.z);
        const std::vector<ShapeId> shapes = column(no_shape, shape);
        const std::vector<std::uint8_t> faces = column(200, face);
        const std::vector<std::uint8_t> sides = column(1, static_cast<std::uint8_t>(inward));
        BasicRaySpan<Real> rays{x, y, z, dx, dy, dz};
        rays.origin_shape = shapes;
        rays.origin_face = faces;
        if (inward >= 0) rays.origin_inward = sides;
        const std::string found = refusal(tracer, rays);
        // A ray that is refused because of a limit need not start on its shape.
        const std::vector<Real> limits = column(1, std::numeric_limits<Real>::quiet_NaN());
        for (const bool upper : {false, true}) {
            BasicRaySpan<Real> limited = rays;
            (upper ? limited.t_max : limited.t_min) = limits;
            CHECK(refusal(tracer, limited) == "none|");
        }
        CHECK((count == 2 || found == text));
        text = found;
    }
    return text;
}

Scene one_of_each() {
    SceneBuilder builder;
    const MaterialIndex m = builder.add_material({});
    builder.add(Sphere{{0, 0, 0}, 1}, m);
    builder.add(Box{{2, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, m);
    builder.add(CappedCylinder{{4, 0, 0}, {0, 0, 2}, 0.5F}, m);
    builder.add(CappedCone{{6, 0, 0}, {0, 0, 2}, 1, 0}, m);
    builder.add(Ellipsoid{{8, 0, 0}, {0.5F, 0, 0}, {0, 1, 0}, {0, 0, 2}}, m);
    builder.add(Disc{{10, 0, 0}, {0, 0, 1}, 1}, m);
    builder.add(Triangle{{12, 0, 0}, {13, 0, 0}, {12, 1, 0}}, m);
    builder.add(Plane{{0, 0, -5}, {0, 0, 1}}, m);
    builder.add(OpenCylinder{{14, 0, 0}, {0, 0, 2}, 0.5F}, m);
    builder.add(OpenCone{{16, 0, 0}, {0, 0, 2}, 1, 0.5F}, m);
    return builder.build();
}

template <class Real>
void check_departures() {
    const Tracer tracer(one_of_each(), {.threads = 1});
    struct Place {
        ShapeId shape;
        std::uint8_t face;
        Vec3Of<Real> at, out;
    };
    const Place places[] = {
        {0, 0, {0, 0, 1}, {0, 0, 1}},
        {1, 1, {3, Real(0.5), Real(0.5)}, {1, 0, 0}},
        {1, 4, {Real(2.5), Real(0.5), 0}, {0, 0, -1}},
        {2, 0, {Real(4.5), 0, 1}, {1, 0, 0}},
        {2, 1, {4, 0, 0}, {0, 0, -1}},
        {2, 2, {4, Real(0.25), 2}, {0, 0, 1}},
        {3, 0, {Real(6.5), 0, 1}, {2, 0, 1}},
        {3, 1, {6, 0, 0}, {0, 0, -1}},
        {4, 0, {Real(8.5), 0, 0}, {1, 0, 0}},
        {5, 0, {10, Real(0.5), 0}, {0, 0, 1}},
        {6, 0, {Real(12.25), Real(0.25), 0}, {0, 0, 1}},
        {7, 0, {3, 4, -5}, {0, 0, 1}},
        {8, 0, {Real(14.5), 0, 1}, {1, 0, 0}},
        {9, 0, {Real(16.75), 0, 1}, {4, 0, 1}},
    };
    const auto minus = [](const Vec3Of<Real>& v) { return Vec3Of<Real>{-v.x, -v.y, -v.z}; };
    for (const Place& p : places) {
        CAPTURE(p.shape, int(p.face));
        const std::string none = "none|";
        for (const int side : {-1, 0})
            CHECK(refusal(tracer, p.at, p.out, p.shape, p.face, side) == none);
        for (const int side : {-1, 1})
            CHECK(refusal(tracer, p.at, minus(p.out), p.shape, p.face, side) == none);
        CHECK(refusal(tracer, p.at, p.out, p.shape, p.face, 2) == none);
        CHECK(refusal(tracer, p.at, p.out, p.shape, p.face, 1) ==
              "origin_inward/1: must be 0 for a direction to the outside, got 1");
        CHECK(refusal(tracer, p.at, minus(p.out), p.shape, p.face, 0) ==
              "origin_inward/1: must be 1 for a direction to the inside, got 0");
        for (const int other : {3, 255})
            for (const Vec3Of<Real>& direction : {p.out, minus(p.out)})
                CHECK(refusal(tracer, p.at, direction, p.shape, p.face, other) ==
                      "origin_inward/1: must be 0, 1, or 2 if the direction decides, got " +
                          std::to_string(other));
        CHECK(refusal(tracer, p.at, p.out, p.shape, 77, 0)
                  .find("origin_face/1: must be less than the shape's number of faces, ") == 0);
        if (p.shape == 7) continue; // a plane takes any origin
        const Vec3Of<Real> away{p.at.x + Real(0.1) * p.out.x, p.at.y + Real(0.1) * p.out.y,
                                p.at.z + Real(0.1) * p.out.z};
        CHECK(refusal(tracer, away, p.out, p.shape, p.face, 0) ==
              "origin_shape/1: must be a shape that the origin is on, within rounding");
    }
}

} // namespace

TEST_CASE("a ray must start on the shape that it names, and go to the side that it names") {
    check_departures<float>();
    check_departures<double>();
}

TEST_CASE("onward rays leave the surfaces of hits") {
    const Heap setup = heap();
    const Tracer tracer(setup.scene);
    DoubleRays rays;
    std::vector<double> away[3];
    Random random(5);
    for (std::size_t i = 0; i < setup.rays.size(); ++i) {
        rays.add(setup.rays.ray(i), 0.0, endless);
        for (std::vector<double>& component : away)
            component.push_back(random.uniform(-1, 1));
    }
    FullHits found(tracer, rays);
    const OnwardRays<double> next = onward(rays.span(), found.span(), away[0], away[1], away[2]);
    Hits after(rays.size());
    QueryStatistics statistics;
    tracer.intersect(next.span(), after.span(), &statistics);
    std::size_t misses = 0, with_face = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        misses += found.shape[i] == no_shape ? 1 : 0;
        if (found.shape[i] == no_shape) continue;
        ++with_face;
        const double along = static_cast<double>(found.nx[i]) * away[0][i] +
                             static_cast<double>(found.ny[i]) * away[1][i] +
                             static_cast<double>(found.nz[i]) * away[2][i];
        if (std::abs(along) > 1e-6) CHECK(next.inward[i] == (along < 0 ? 1 : 0));
    }
    CHECK(statistics.refused == misses);
    CHECK(with_face > rays.size() / 4);
    HitSpan without_faces = found.span();
    without_faces.face = {};
    CHECK_THROWS_AS(onward(rays.span(), without_faces, away[0], away[1], away[2]), InvalidValue);
}

namespace {

/// Returns rays in float that meet a cone's surface next to its tip, or tiny balls far from 0.
/// There the normal at a rounded origin is any.
Rays to_tips(Random& random, bool to_ball) {
    const auto uniform = [&](double least, double most) {
        return static_cast<float>(random.uniform(least, most));
    };
    const auto off = [&] { return uniform(-1e-4, 1e-4); };
    Rays rays;
    for (int i = 0; i < 400; ++i) {
        const Vec3 to = to_ball ? Vec3{1000, 700, -300} : Vec3{3, 4, 9};
        const Vec3 from{uniform(-9, 9), uniform(-9, 9), uniform(10, 20)};
        rays.add(from, {to.x - from.x + off(), to.y - from.y + off(), to.z - from.z + off()});
    }
    return rays;
}

} // namespace

TEST_CASE("onward rays in tangents go to the side that exact arithmetic finds") {
    // The true normal of the hit is (1, 2, 3) / sqrt(14). Its floats are on one side or the other
    // of the tangents (2, -1, 0), (3, 0, -1) and (0, 3, -2).
    SceneBuilder builder;
    builder.add(Plane{{0, 0, 0}, {1, 2, 3}}, builder.add_material({}));
    builder.add(Sphere{{0, 0, 0}, 50}, 0);
    const Tracer tracer(builder.build());
    const Vec3Of<double> tangents[] = {{2, -1, 0}, {3, 0, -1}, {0, 3, -2}, {1, 1, -1}};
    DoubleRays rays;
    std::vector<double> away[3];
    for (const Vec3Of<double>& tangent : tangents)
        for (const double sign : {-1.0, 1.0})
            for (const double off : {-0x1p-40, 0.0, 0x1p-40}) {
                rays.add({{0, 0, 5}, {0, 0, -1}}, 0.0, endless);
                away[0].push_back(sign * tangent.x + off);
                away[1].push_back(sign * tangent.y);
                away[2].push_back(sign * tangent.z);
            }
    FullHits found(tracer, rays);
    const OnwardRays<double> next = onward(rays.span(), found.span(), away[0], away[1], away[2]);
    CHECK(next.inward == std::vector<std::uint8_t>(rays.size(), 2));
    // On the inside of the plane, its half-space is around the rays.
    const Tracer half = [] {
        SceneBuilder of_solids;
        const raylane::Solid below(Plane{{0, 0, 0}, {1, 2, 3}}), all(Sphere{{0, 0, 0}, 50});
        of_solids.add(intersection_of({below, all}), of_solids.add_material({}));
        return Tracer(of_solids.build());
    }();
    LengthRows lengths;
    half.path_lengths(next.span(), lengths);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        CAPTURE(i);
        CHECK((lengths.first[i + 1] != lengths.first[i]) == (i % 3 == 0));
    }
}

TEST_CASE("onward rays are not refused next to a tip or on a tiny shape") {
    Random random(6);
    SceneBuilder builder;
    const MaterialIndex m = builder.add_material({});
    builder.add(CappedCone{{3, 4, 9}, {-0.4F, 0.3F, -0.1F}, 0, 0.3F}, m);
    builder.add(Sphere{{1000, 700, -300}, 2e-4F}, m);
    const Tracer tracer(builder.build());
    for (const bool to_ball : {false, true}) {
        const Rays rays = to_tips(random, to_ball);
        FullHits found(tracer, rays);
        std::vector<float> away[3];
        for (std::vector<float>& component : away)
            for (std::size_t i = 0; i < rays.size(); ++i)
                component.push_back(static_cast<float>(random.uniform(-1, 1)));
        const OnwardRays<float> next = onward(rays.span(), found.span(), away[0], away[1], away[2]);
        Hits after(rays.size());
        QueryStatistics statistics;
        CHECK_NOTHROW(tracer.intersect(next.span(), after.span(), &statistics));
        CHECK(rays.size() - statistics.refused > 40);
    }
}

TEST_CASE("onward rays leave the tip of a flat cone to the outside") {
    // Rounding moves each origin beyond the apex, where the normal of the cone's form points to the
    // inside.
    struct Departure {
        CappedCone cone;
        Vec3 origin, direction;
    };
    const Departure departures[] = {
        {{{-0x1.63785ap+2F, 0x1.d69598p+2F, -0x1.9db796p+2F},
          {-0x1.5f3f6cp-3F, 0x1.a1795cp-11F, -0x1.4e720ap-1F},
          0x1.570e78p+1F,
          0},
         {-0x1.6e7256p+2F, 0x1.d6a2a4p+2F, -0x1.c785d8p+2F},
         {-0x1.e82c0cp+4F, -0x1.25ae12p+2F, -0x1.fb850cp+2F}},
        {{{0x1.b97336p+2F, 0x1.1e5ef8p+3F, 0x1.9fdc6ep+2F},
          {0x1.5d3d5ep-5F, -0x1.1495bep-11F, 0x1.303474p-5F},
          0x1.dc1054p-2F,
          0},
         {0x1.bc2db2p+2F, 0x1.1e5aa6p+3F, 0x1.a23cd6p+2F},
         {0x1.b0f832p-1F, 0x1.069544p-1F, 0x1.2ed3f8p-3F}},
        {{{-0x1.bf99b6p+0F, -0x1.1fac0ap+1F, 0x1.15604cp+3F},
          {0x1.65995cp-7F, 0x1.d22472p-7F, 0x1.9bfd5cp-7F},
          0x1.bc202cp-2F,
          0},
         {-0x1.bcce88p+0F, -0x1.1dd9e6p+1F, 0x1.15c74cp+3F},
         {0x1.62aa24p+9F, 0x1.28671ap+8F, 0}},
    };
    for (const Departure& departure : departures) {
        SceneBuilder builder;
        builder.add(departure.cone, builder.add_material({}));
        const Tracer tracer(builder.build());
        const Vec3& from = departure.origin;
        const Vec3& to = departure.direction;
        for (const int inward : {-1, 0, 2})
            CHECK(refusal(tracer, from, to, 0, 0, inward) == "none|");
    }
}

TEST_CASE("a ray from a cone's apex leaves the cone by its base if it goes inside") {
    SceneBuilder builder;
    builder.add(CappedCone{{1, 2, 1}, {0, 0, 2}, 1, 0}, builder.add_material({}));
    const Tracer tracer(builder.build());
    for (const bool inside : {true, false}) {
        Rays rays;
        rays.add({1, 2, 3}, {inside ? 0.25F : 1.25F, 0, -2});
        RaySpan from = rays.span();
        const std::vector<ShapeId> shape = {0};
        from.origin_shape = shape;
        Hits hits(1);
        tracer.intersect(from, hits.span());
        CHECK(hits.is_none(0) == !inside);
        if (inside) CHECK(hits.t[0] == 1.0F);
    }
}

TEST_CASE("limits of rays in double compare with t as it is answered, also if that is a float") {
    const Heap setup = heap();
    const Tracer tracer(setup.scene);
    DoubleRays rays;
    for (std::size_t i = 0; i < setup.rays.size(); ++i) {
        core::Ray<double> ray = setup.rays.ray(i);
        ray.origin.x += 1e-9; // t is no float
        rays.add(ray, 0.0, endless);
    }
    Hits first(rays.size());
    tracer.intersect(rays.span(), first.span());
    for (std::size_t i = 0; i < rays.size(); ++i)
        rays.t_max[i] = static_cast<double>(first.t[i]);
    CHECK(first.shape != std::vector<ShapeId>(rays.size(), no_shape));
    Hits again(rays.size());
    tracer.intersect(rays.span(), again.span());
    CHECK(again == first);
    rays.t_min = rays.t_max;
    rays.t_max.assign(rays.size(), endless);
    tracer.intersect(rays.span(), again.span());
    std::size_t behind = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (first.shape[i] == no_shape) continue;
        CHECK(again.t[i] > first.t[i]);
        ++behind;
    }
    CHECK(behind > rays.size() / 4);
}
