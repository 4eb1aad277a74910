#include "core/scene/built_shapes.hpp"
#include "core/scene/scene.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "tests/scenes/api/ray_arrays.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

/// Tests of Scene::with_positions against scenes that are built of the same shapes.
using namespace raylane;
using namespace raylane::tests;

namespace {

using Point = Vec3Of<double>;
using Points = std::vector<Point>;

std::vector<Vec3> in_floats(const Points& points) {
    std::vector<Vec3> floats;
    for (const Point& p : points)
        floats.push_back(
            {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    return floats;
}

/// The contents of a scene, from which it can be built with other centres.
struct Contents {
    struct Ball {
        double radius;
        MaterialIndex material;
    };
    std::vector<Material> materials;
    std::vector<Ball> balls;
    /// Adds other shapes; the i-th is called before the i-th ball is added.
    std::vector<std::function<void(SceneBuilder&)>> others;
    bool in_double = false; ///< centres and radii are not floats

    Scene built(const Points& centers) const {
        SceneBuilder builder;
        for (const Material& material : materials)
            builder.add_material(material);
        for (std::size_t i = 0; i < std::max(balls.size(), others.size()); ++i) {
            if (i < others.size()) others[i](builder);
            if (i >= balls.size()) continue;
            if (in_double)
                builder.add(SphereOf<double>{centers[i], balls[i].radius}, balls[i].material);
            else
                builder.add(Sphere{in_floats({centers[i]})[0], static_cast<float>(balls[i].radius)},
                            balls[i].material);
        }
        return builder.build();
    }
    Scene moved(const Scene& scene, const Points& centers) const {
        return in_double ? scene.with_positions(centers) : scene.with_positions(in_floats(centers));
    }
};

Point point_in(Random& random, double size) {
    const core::Vec3d p = random.cube(size);
    return {p.x, p.y, p.z};
}

Points points_in(Random& random, std::size_t count, double size) {
    Points points(count);
    for (Point& point : points)
        point = point_in(random, size);
    return points;
}

void add_other_shapes(Contents& contents, Random& random, int count) {
    for (int i = 0; i < count; ++i) {
        const auto material = static_cast<MaterialIndex>(
            random.integer(0, static_cast<int>(contents.materials.size()) - 1));
        core::for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
            if (core::kind_of<Shape> == core::Kind::sphere || random.integer(0, 3) != 0) return;
            const auto shape = ray_sets::Target<Shape>::make(random, false);
            contents.others.emplace_back(
                [=](SceneBuilder& builder) { add(builder, shape, material); });
        });
    }
}

/// Adds solids with spheres among their parts, and a union that is large enough for a tree.
void add_solids(Contents& contents, Random& random) {
    const auto ball = [&](double size) {
        const core::Vec3d at = random.cube(size);
        return SphereOf<double>{{at.x, at.y, at.z}, random.uniform(0.5, 3.0)};
    };
    std::vector<raylane::Solid> many;
    for (int i = 0; i < 20; ++i)
        many.emplace_back(ball(6.0));
    const raylane::Solid hollow =
        difference_of(ball(4.0), {ball(4.0), Box{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}}});
    for (const raylane::Solid& solid : {union_of(many), hollow})
        contents.others.emplace_back([=](SceneBuilder& builder) { builder.add(solid, 0); });
}

Contents contents_of(Random& random, int count, bool in_double, bool with_others,
                     bool with_solids) {
    Contents contents;
    contents.in_double = in_double;
    const int materials = random.integer(1, 3);
    for (int i = 0; i < materials; ++i)
        contents.materials.push_back({.specular = static_cast<float>(i)});
    const int radii = random.integer(1, 3);
    for (int i = 0; i < count; ++i)
        contents.balls.push_back(
            {radii == 3 ? random.log_uniform(0.01, 1.0) : 0.25 * random.integer(1, radii),
             static_cast<MaterialIndex>(random.integer(0, materials - 1))});
    if (with_others) add_other_shapes(contents, random, random.integer(1, 10));
    if (with_solids) add_solids(contents, random);
    return contents;
}

/// Returns new centres, by one of several sorts of motion.
Points drifted(const Points& centers, Random& random) {
    const double step = random.log_uniform(1e-3, 3.0);
    Points moved = centers;
    const auto nudge = [&](Point& p, double size) {
        const Point d = point_in(random, size);
        p = {p.x + d.x, p.y + d.y, p.z + d.z};
    };
    const auto any = [&] {
        return random.integer(0, std::max(static_cast<int>(moved.size()) - 1, 0));
    };
    switch (random.integer(0, 11)) {
    case 0: // all in one place
        std::fill(moved.begin(), moved.end(), point_in(random, 10.0));
        break;
    case 1: // in few places, so that some become equal
        for (Point& p : moved)
            p = {1.0 * random.integer(-2, 2), 1.0 * random.integer(-2, 2), 0.5};
        break;
    case 2: // one becomes equal to another, or is so no more
        if (!moved.empty()) moved[any()] = moved[any()];
        break;
    case 3: { // far away
        const Point d = point_in(random, random.log_uniform(1e2, 9e29));
        for (Point& p : moved)
            p = {p.x + d.x, p.y + d.y, p.z + d.z};
        break;
    }
    case 4: // shuffled
        for (std::size_t i = moved.size(); i > 1; --i)
            std::swap(moved[i - 1], moved[random.integer(0, static_cast<int>(i) - 1)]);
        break;
    case 5: // some fly away
        for (Point& p : moved)
            if (random.integer(0, 9) == 0) nudge(p, 300.0);
        break;
    case 6:
        return points_in(random, moved.size(), 10.0);
    case 7: // a part of them moves
        for (Point& p : moved)
            if (p.x > 0.0) nudge(p, 5.0);
        break;
    case 8:
        for (Point& p : moved)
            p = {0.5 * p.x, 0.5 * p.y, 0.5 * p.z};
        break;
    default:
        for (Point& p : moved)
            nudge(p, step);
    }
    return moved;
}

/// Returns rays that are aimed at some of the spheres, past their limbs or through the middle.
Rays rays_at(const Contents& contents, const Points& centers, Random& random, int count) {
    Rays rays;
    for (int i = 0; i < count; ++i) {
        core::Vec3d aim = random.cube(10.0);
        if (!centers.empty()) {
            const auto at =
                static_cast<std::size_t>(random.integer(0, static_cast<int>(centers.size()) - 1));
            const double radius = contents.balls[at].radius;
            aim = core::Vec3d(centers[at].x, centers[at].y, centers[at].z) +
                  radius * random.uniform(0.0, 1.1) * random.direction();
        }
        const core::Vec3d along = random.direction();
        const core::Vec3f from = ray_sets::rounded(random.integer(0, 1) == 0
                                                       ? aim + random.log_uniform(0.1, 30.0) * along
                                                       : random.cube(15.0));
        const core::Vec3f to = ray_sets::rounded(aim - core::convert<double>(from));
        rays.add({from.x, from.y, from.z}, {to.x, to.y, to.z});
        rays.t_max.push_back(random.integer(0, 3) == 0 ? 1.0F : infinity);
    }
    return rays;
}

/// All answers to the same rays, and the solids around their origins.
struct Answers {
    Hits hits;
    std::vector<std::uint8_t> blocked;
    CrossingRows rows;
    SolidRows solids;
    LengthRows lengths;

    Answers(const Scene& scene, const Rays& rays) : hits(rays.size()) {
        const Tracer tracer(scene, {.threads = 1});
        tracer.intersect(rays.span(), hits.span());
        blocked = occluded(tracer, rays);
        tracer.crossings(rays.span(), rows, {.normals = true});
        tracer.contains({rays.x, rays.y, rays.z}, solids);
        tracer.path_lengths(rays.span(), lengths);
    }
};

void check_same(const Scene& moved, const Scene& fresh, const Rays& rays) {
    const Answers answers(moved, rays), truth(fresh, rays);
    CHECK(answers.hits == truth.hits);
    CHECK(answers.blocked == truth.blocked);
    CHECK(answers.rows.first == truth.rows.first);
    CHECK(answers.rows.t == truth.rows.t);
    CHECK(answers.rows.shape_id == truth.rows.shape_id);
    CHECK(answers.rows.entering == truth.rows.entering);
    CHECK(answers.rows.face == truth.rows.face);
    CHECK(answers.rows.tied == truth.rows.tied);
    CHECK(answers.rows.touching == truth.rows.touching);
    CHECK(answers.rows.normal_x == truth.rows.normal_x);
    CHECK(answers.rows.normal_z == truth.rows.normal_z);
    CHECK(answers.solids.first == truth.solids.first);
    CHECK(answers.solids.shape_id == truth.solids.shape_id);
    CHECK(answers.solids.on_surface == truth.solids.on_surface);
    CHECK(answers.lengths.first == truth.lengths.first);
    CHECK(answers.lengths.length == truth.lengths.length);
    CHECK(moved.shape_count() == fresh.shape_count());
    CHECK(moved.bounds().lower == fresh.bounds().lower);
    CHECK(moved.bounds().upper == fresh.bounds().upper);
}

/// Checks that the hierarchy is a tree that has each shape within its bounds.
void check_tree(const Scene& scene) {
    const core::Scene& inner = library::Internals::of(scene);
    if (inner.solids().any()) return; // the checks are those of files, which have none
    core::Workers alone;
    CHECK_NOTHROW(core::check({inner.shapes(),
                               inner.material_indices(),
                               {inner.polygons().begin(), inner.polygons().end()},
                               inner.merged(),
                               inner.hierarchy(),
                               {},
                               0},
                              inner.materials().size(), alone));
}

void check_chain(const Contents& contents, Random& random, int steps, int ray_count) {
    Points centers = points_in(random, contents.balls.size(), 10.0);
    if (random.integer(0, 3) == 0) centers = drifted(centers, random);
    Scene moved = contents.built(centers);
    for (int step = 0; step < steps; ++step) {
        CAPTURE(step);
        centers = drifted(centers, random);
        for (Point& p : centers)
            for (double* const x : {&p.x, &p.y, &p.z})
                *x = std::clamp(*x, -1e30, 1e30);
        moved = contents.moved(moved, centers);
        check_tree(moved);
        check_same(moved, contents.built(centers), rays_at(contents, centers, random, ray_count));
    }
}

} // namespace

TEST_CASE("moved scenes answer like new scenes of the same shapes, to the bit") {
    Random random(tests::seed(11));
    for (int round = 0; round < rounds(40, 6, 600); ++round) {
        CAPTURE(round);
        constexpr int counts[] = {0, 1, 2, 17, 30, 200, 1500};
        const int count = counts[random.integer(0, 6)];
        const bool in_double = random.integer(0, 2) == 0;
        const Contents contents = contents_of(random, count, in_double, random.integer(0, 1) == 0,
                                              random.integer(0, 2) == 0);
        check_chain(contents, random, 6, 200);
    }
}

TEST_CASE("a scene that has moved a hundred times answers like a new one") {
    Random random(tests::seed(12));
    for (const bool in_double : {false, true}) {
        const Contents contents = contents_of(random, 600, in_double, true, true);
        check_chain(contents, random, 100, 50);
    }
}

TEST_CASE("packed spheres stay packed when they move") {
    Random random(7);
    Points before = points_in(random, 400, 10.0), after = points_in(random, 400, 10.0);
    for (Points* const points : {&before, &after})
        for (Point& p : *points)
            p = {p.x + 40.0, p.y + 40.0, p.z + 40.0}; // coordinates of one sign can be packed
    Contents contents = contents_of(random, 400, false, false, false);
    core::SceneBuilder builder;
    builder.wants_light = false;
    builder.pack_from = 0;
    for (std::size_t i = 0; i < contents.materials.size(); ++i)
        builder.add_material({});
    for (std::size_t i = 0; i < before.size(); ++i) {
        contents.balls[i].radius = i % 2 == 0 ? 0.25 : 0.5;
        const Vec3 at = in_floats(before)[i];
        builder.add(core::Sphere{{at.x, at.y, at.z}, i % 2 == 0 ? 0.25F : 0.5F},
                    contents.balls[i].material);
    }
    const auto scene = library::Internals::scene(
        std::make_shared<const core::Scene>(std::move(builder).build()), nullptr);
    const Scene moved = contents.moved(scene, after);
    const core::Tables& tables = library::Internals::of(moved).shapes();
    CHECK(std::get<core::Table<core::Sphere>>(tables).is_packed());
    check_tree(moved);
    check_same(moved, contents.built(after), rays_at(contents, after, random, 500));
}

TEST_CASE("equal spheres of a saved scene part") {
    Random random(8);
    const TemporaryDirectory directory;
    const Points after = points_in(random, 50, 10.0);
    const Contents contents = contents_of(random, 50, false, false, false);
    save(contents.built(Points(50)), directory.path() / "a.rl");
    const Scene moved = contents.moved(load(directory.path() / "a.rl"), after);
    check_same(moved, contents.built(after), rays_at(contents, after, random, 500));
}

TEST_CASE("the camera stays when spheres move, and lights and fog that follow it adapt") {
    const auto atoms = [](const std::string& z) {
        return parse("2\n\nHe 0 0 0\nHe 9 0 " + z + "\n", "a.xyz");
    };
    const Scene before = atoms("0"), after = atoms("20");
    const std::vector<Vec3> positions = {{0, 0, 0}, {9, 0, 20}};
    const Scene moved = before.with_positions(positions);
    CHECK(moved.camera().from == before.camera().from);
    CHECK(moved.camera().from != after.camera().from);
    const Scene expected = after.seen_by(before.camera());
    REQUIRE(moved.lights().size() == expected.lights().size());
    for (std::size_t i = 0; i < expected.lights().size(); ++i)
        CHECK(moved.lights()[i].position == expected.lights()[i].position);
    CHECK(moved.fog().end == expected.fog().end);
}

TEST_CASE("an error about moved spheres names the sphere") {
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    builder.add_light({.position = {4, 0, 0}});
    for (const float x : {0.0F, 9.0F})
        builder.add(Sphere{{x, 0, 0}, 1}, material);
    const Scene scene = builder.build();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto message = [&](const Points& positions, bool in_double = false) {
        return message_of<InvalidValue>([&] {
            static_cast<void>(in_double ? scene.with_positions(positions)
                                        : scene.with_positions(in_floats(positions)));
        });
    };
    CHECK(message({{0, 0, 0}, {1, 0, 0}}) == "no error");
    CHECK(message({{0, 0, 0}}) == "positions: must have one element for each of 2 spheres, got 1");
    CHECK(message({{0, 0, 0}, {1, 0, 1e31}}) ==
          "positions/1/2: must be a number from -1e30 to 1e30, got 1e+31");
    CHECK(message({{0, 0, 0}, {1, nan, 0}}, true) ==
          "positions/1/1: must be a number from -1e30 to 1e30, got nan");
    CHECK(message({{1.1e-39, 0, 0}, {1, 0, 0}}, true) ==
          "positions/0/0: must be 0 or at least 1.2e-38 in size, got 1.1e-39");
    CHECK(message({{0, 0, 0}, {5, 0, 0}}) ==
          "lights/0/position: must not be on a surface, got a point of shape 1");
}
