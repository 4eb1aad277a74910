#include "scenes/api/cpp/internals.hpp"
#include "tests/scenes/api/ray_arrays.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// Tests of copies that are kept against scenes of the same shapes.
using namespace raylane;
using namespace raylane::tests;

namespace {

using Point = Vec3Of<double>;

/// Contents of a scene with copies.
struct Contents {
    std::vector<Material> materials;
    std::vector<Sphere> balls; ///< before and between copies
    bool has_floor = false;
    std::vector<Group> groups;
    std::vector<std::vector<Placement>> placements; ///< by group
    Settings settings;
    Camera camera;
    std::optional<AutoCamera> auto_camera;

    Scene built(bool as_copies) const {
        SceneBuilder builder;
        builder.settings = settings;
        builder.camera = camera;
        builder.auto_camera = auto_camera;
        builder.add_light({.position = {40, 60, 50}});
        for (const Material& material : materials)
            builder.add_material(material);
        const std::size_t before = balls.size() / 2;
        for (std::size_t i = 0; i < before; ++i)
            builder.add(balls[i], 0);
        if (has_floor) builder.add(Plane{{0, 0, -30}, {0, 0, 1}}, 0);
        builder.keep_from = as_copies ? 0 : std::numeric_limits<std::size_t>::max();
        builder.add(groups[0], placements[0], 0);
        for (std::size_t i = before; i < balls.size(); ++i)
            builder.add(balls[i], 1);
        if (groups.size() > 1) builder.add(groups[1], placements[1], 0);
        return builder.build();
    }
};

Point point_in(Random& random, double size) {
    const core::Vec3d p = random.cube(size);
    return {p.x, p.y, p.z};
}

/// Returns a group of spheres and cylinders. Some numbers are floats, and some are small integers.
Group any_group(Random& random, int members) {
    Group group;
    for (int i = 0; i < members; ++i) {
        const auto material = static_cast<MaterialIndex>(random.integer(0, 1));
        switch (random.integer(0, 4)) {
        case 0:
            group.add(CappedCylinderOf<double>{point_in(random, 3), point_in(random, 2),
                                               random.uniform(0.05, 0.3)},
                      material);
            break;
        case 1:
            group.add(OpenCylinderOf<double>{point_in(random, 3), point_in(random, 2),
                                             random.uniform(0.05, 0.3)},
                      material);
            break;
        case 2:
            group.add(Sphere{{static_cast<float>(random.integer(-3, 3)),
                              static_cast<float>(random.integer(-3, 3)), 0},
                             0.5F},
                      material);
            break;
        default:
            group.add(SphereOf<double>{point_in(random, 3), random.uniform(0.1, 1)}, material);
        }
    }
    return group;
}

Placement any_placement(Random& random, double size) {
    Placement placement;
    placement.translate = point_in(random, size);
    if (random.integer(0, 2) == 0) {
        const auto random_integer = [&] { return static_cast<double>(random.integer(-20, 20)); };
        placement.translate = {random_integer(), random_integer(), random_integer()};
    }
    if (random.integer(0, 2) != 0) placement.rotate = point_in(random, 360);
    if (random.integer(0, 2) == 0) placement.rotate = {0, 90.0 * random.integer(0, 3), 0};
    if (random.integer(0, 1) == 0) placement.scale = random.log_uniform(0.3, 3);
    return placement;
}

Contents any_contents(Random& random, int members, int copies, int balls) {
    Contents contents;
    contents.materials = {{.ambient = 0.3F}, {}};
    const double size = 4.0 * std::cbrt(copies);
    for (int i = 0; i < balls; ++i) {
        const core::Vec3f center = ray_sets::rounded(random.cube(size));
        contents.balls.push_back({{center.x, center.y, center.z}, 1});
    }
    contents.has_floor = random.integer(0, 1) == 0;
    for (int group = 0; group < 2; ++group) {
        contents.groups.push_back(any_group(random, members));
        auto& placements = contents.placements.emplace_back();
        for (int i = 0; i < copies; ++i)
            placements.push_back(any_placement(random, size));
    }
    return contents;
}

/// Adds rays that are hard for some shapes of a scene.
template <class CoreShape, template <class> class ShapeOf>
void add_hard_rays(const Scene& scene, int count, Random& random, Rays& rays) {
    const auto shapes = scene.shapes<ShapeOf>();
    if (shapes.shape.empty()) return;
    for (int i = 0; i < count; ++i) {
        const auto& shape = shapes.shape[static_cast<std::size_t>(
            random.integer(0, static_cast<int>(shapes.shape.size()) - 1))];
        const auto exact = std::bit_cast<core::InDouble<CoreShape>>(shape);
        const core::Ray<float> ray =
            ray_sets::make_ray(core::to_floats(exact), ray_sets::any_set(random), random);
        rays.add({ray.origin.x, ray.origin.y, ray.origin.z},
                 {ray.direction.x, ray.direction.y, ray.direction.z});
    }
}

Rays hard_rays(const Scene& scene, int count, Random& random) {
    Rays rays;
    add_hard_rays<core::Sphere, SphereOf>(scene, count, random, rays);
    add_hard_rays<core::CappedCylinder, CappedCylinderOf>(scene, count / 2, random, rays);
    add_hard_rays<core::OpenCylinder, OpenCylinderOf>(scene, count / 2, random, rays);
    return rays;
}

/// All answers about rays.
struct Answers {
    Hits hits;
    std::vector<std::uint8_t> face, occluded;
    std::vector<double> t;
    DoubleNormals normals;

    template <class Real>
    Answers(const Tracer& tracer, const BasicRaySpan<Real>& rays, std::size_t count)
        : hits(count), face(count), occluded(count), t(count), normals(count) {
        HitSpan span = hits.span();
        span.face = face;
        span.t_double = t;
        normals.add_to(span);
        tracer.intersect(rays, span);
        tracer.occluded(rays, occluded);
    }
};

template <class Real>
void expect_same(const Tracer& kept, const Tracer& shapes, const BasicRaySpan<Real>& rays) {
    const std::size_t count = rays.origin_x.size();
    const Answers found(kept, rays, count), expected(shapes, rays, count);
    for (std::size_t i = 0; i < count; ++i) {
        INFO("ray " << i << ": shape " << found.hits.shape[i] << " at " << found.t[i]
                    << ", expected " << expected.hits.shape[i] << " at " << expected.t[i]);
        REQUIRE(found.hits.is_same(i, expected.hits));
        REQUIRE(found.t[i] == expected.t[i]);
        REQUIRE(found.face[i] == expected.face[i]);
        REQUIRE(found.occluded[i] == expected.occluded[i]);
        for (int axis = 0; axis < 3; ++axis)
            REQUIRE(found.normals[i][axis] == expected.normals[i][axis]);
    }
}

/// Owns the arrays of rays in double.
struct DoubleRays {
    std::vector<double> columns[6];

    explicit DoubleRays(const Rays& rays, std::size_t most = 1'000'000) {
        for (std::size_t i = 0; i < std::min(rays.size(), most); ++i) {
            const core::Ray<double> ray = rays.ray(i);
            for (int axis = 0; axis < 3; ++axis) {
                columns[axis].push_back(ray.origin[axis] * (1.0 + 0x1p-40));
                columns[3 + axis].push_back(ray.direction[axis]);
            }
        }
    }
    /// Moves the origins back along their rays.
    void start_before(double distance) {
        for (int axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < columns[axis].size(); ++i)
                columns[axis][i] -= distance * columns[3 + axis][i];
    }
    DoubleRaySpan span() const {
        return {columns[0], columns[1], columns[2], columns[3], columns[4], columns[5]};
    }
};

/// Sends rays onward from the hits of others.
void expect_same_onward(const Tracer& kept, const Tracer& shapes, const DoubleRays& rays,
                        Random& random) {
    const std::size_t count = rays.columns[0].size();
    Hits hits(count);
    std::vector<std::uint8_t> face(count);
    std::vector<double> t(count);
    HitSpan span = hits.span();
    span.face = face;
    span.t_double = t;
    shapes.intersect(rays.span(), span);
    std::vector<double> directions[3];
    for (std::size_t i = 0; i < count; ++i) {
        const core::Vec3d d = random.direction();
        for (int axis = 0; axis < 3; ++axis)
            directions[axis].push_back(d[axis]);
    }
    const OnwardRays<double> onward_rays =
        onward(rays.span(), span, directions[0], directions[1], directions[2]);
    expect_same(kept, shapes, onward_rays.span());
}

/// Gives each ray limits.
void limit(Rays& rays, Random& random) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays.t_min.push_back(static_cast<float>(random.uniform(0, 2)));
        rays.t_max.push_back(static_cast<float>(random.log_uniform(0.1, 100)));
    }
}

void expect_same_answers(const Contents& contents, int count, Random& random) {
    const Scene kept = contents.built(true), shapes = contents.built(false);
    REQUIRE(library::Internals::of(kept).copies() != nullptr);
    REQUIRE(library::Internals::of(shapes).copies() == nullptr);
    REQUIRE(kept.shape_count() == shapes.shape_count());
    for (ShapeId id = 0; id < kept.shape_count(); ++id)
        REQUIRE(kept.material_of(id) == shapes.material_of(id));
    const auto spheres = kept.shapes<SphereOf>(), expected = shapes.shapes<SphereOf>();
    REQUIRE(spheres.id == expected.id);
    REQUIRE(spheres.material == expected.material);
    REQUIRE(kept.bounds().lower == shapes.bounds().lower);
    REQUIRE(kept.bounds().upper == shapes.bounds().upper);
    const Tracer of_kept(kept), of_shapes(shapes);
    Rays rays = hard_rays(shapes, count, random);
    expect_same(of_kept, of_shapes, rays.span());
    expect_same(of_kept, of_shapes, rays.part(0, 3));
    const DoubleRays doubles(rays);
    expect_same(of_kept, of_shapes, doubles.span());
    expect_same_onward(of_kept, of_shapes, doubles, random);
    DoubleRays far(rays, 50);
    for (const double distance : {1e10, 1e16}) {
        far.start_before(distance);
        expect_same(of_kept, of_shapes, far.span());
    }
    DoubleRays farthest(rays, 2); // they search all shapes
    farthest.start_before(1e200);
    expect_same(of_kept, of_shapes, farthest.span());
    limit(rays, random);
    expect_same(of_kept, of_shapes, rays.span());
}

} // namespace

TEST_CASE("rays at kept copies have the answers of rays at shapes") {
    Random random(tests::seed(17));
    const int rounds = tests::rounds(4, 1, 30);
    for (int round = 0; round < rounds; ++round) {
        INFO(round);
        expect_same_answers(any_contents(random, 40, 30, 5), 2000, random);
        expect_same_answers(any_contents(random, 5, 60, 100), 2000, random);
        expect_same_answers(any_contents(random, 1, 200, 0), 1000, random);
        expect_same_answers(any_contents(random, 400, 3, 30), 1000, random);
    }
}

TEST_CASE("bounds of scenes with kept copies have the bits of those with shapes") {
    Random random(41);
    for (int round = 0; round < 400; ++round) {
        Contents contents;
        contents.materials = {{}, {}};
        // A sphere in doubles has other bounds than one in floats, and so has each sphere beside.
        const double radius = round % 2 == 0 ? 1.0 : 1.0 + 0x1p-40;
        Group group;
        if (round % 4 < 2)
            group.add(SphereOf<double>{{0, 0, 0}, radius}, 0);
        else
            group.add(CappedCylinderOf<double>{{0, 0, 0}, {0, 0, radius}, radius}, 0);
        contents.groups = {group};
        contents.placements = {{Placement{}, Placement{.translate = {0.5, 0.5, 0.5}}}};
        for (int ball = 0; ball < 3; ++ball) {
            const core::Vec3f center = ray_sets::rounded(random.cube(9));
            contents.balls.push_back({{center.x, center.y, center.z}, 1});
        }
        const Bounds kept = contents.built(true).bounds(), shapes = contents.built(false).bounds();
        CAPTURE(round);
        REQUIRE(kept.lower == shapes.lower);
        REQUIRE(kept.upper == shapes.upper);
    }
}

TEST_CASE("of copies in one place, rays hit the first") {
    Random random(29);
    Contents contents = any_contents(random, 30, 20, 10);
    for (auto& placements : contents.placements)
        placements.insert(placements.end(), placements.begin(), placements.begin() + 10);
    const Scene shapes = contents.built(false);
    const Rays rays = hard_rays(shapes, 2000, random);
    expect_same(Tracer(contents.built(true)), Tracer(shapes), rays.span());
}

TEST_CASE("images of kept copies have the bits of those of shapes") {
    Random random(5);
    Contents contents = any_contents(random, 30, 40, 3);
    contents.has_floor = true;
    contents.materials[0].reflectivity = 0.3F;
    contents.materials[1].opacity = 0.5F;
    contents.camera.from = {0, -40, 10};
    contents.camera.at = {0, 0, 0};
    contents.camera.up = {0, 0, 1};
    contents.settings.width = 60;
    contents.settings.height = 40;
    contents.settings.grid = 2;
    const auto expect_same_images = [&] {
        RenderOptions options;
        options.aovs = true;
        const Image kept = render(contents.built(true), options);
        const Image shapes = render(contents.built(false), options);
        CHECK((kept.rgb == shapes.rgb));
        CHECK((kept.aovs.shape_id == shapes.aovs.shape_id));
        CHECK((kept.aovs.depth == shapes.aovs.depth));
        CHECK((kept.aovs.samples == shapes.aovs.samples));
    };
    expect_same_images();
    contents.auto_camera = AutoCamera{};
    contents.settings.quality = 35.0F; // beams search for thin shapes
    expect_same_images();
}

TEST_CASE("a kept copy takes at most 100 bytes") {
    Random random(7);
    Contents contents = any_contents(random, 100, 1, 0);
    contents.groups.resize(1);
    contents.placements = {{}};
    const auto bytes_of = [&](std::size_t copies) {
        while (contents.placements[0].size() < copies)
            contents.placements[0].push_back(any_placement(random, 1000));
        return static_cast<double>(library::Internals::of(contents.built(true)).bytes());
    };
    const double few = bytes_of(1000), many = bytes_of(11000);
    CHECK((many - few) / 10000 <= 100.0);
}

TEST_CASE("solids turn copies into shapes with the same ids") {
    Random random(3);
    const Contents contents = any_contents(random, 3, 10, 0);
    const auto built = [&](bool as_copies) {
        SceneBuilder builder;
        builder.add_material({});
        builder.add_material({});
        builder.keep_from = as_copies ? 0 : std::numeric_limits<std::size_t>::max();
        builder.add(contents.groups[0], contents.placements[0], 0);
        CHECK(builder.add(Sphere{{0, 0, 0}, 1}, 1) == 30);
        CHECK(builder.add(contents.groups[1], contents.placements[1], 0) == 31);
        CHECK(builder.add(raylane::Solid(Sphere{{50, 0, 0}, 1}) -
                              raylane::Solid(Sphere{{51, 0, 0}, 1}),
                          0) == 61);
        return builder.build();
    };
    const Scene given_up = built(true), shapes = built(false);
    CHECK(library::Internals::of(given_up).copies() == nullptr);
    for (ShapeId id = 0; id < shapes.shape_count(); ++id)
        REQUIRE(given_up.material_of(id) == shapes.material_of(id));
    const auto spheres = given_up.shapes<SphereOf>(), expected = shapes.shapes<SphereOf>();
    CHECK(spheres.id == expected.id);
    for (std::size_t i = 0; i < spheres.id.size(); ++i)
        REQUIRE(spheres.shape[i].center.x == expected.shape[i].center.x);
}

TEST_CASE("all crossings with kept copies are those with shapes") {
    Random random(23);
    for (int round = 0; round < tests::rounds(3, 1, 20); ++round) {
        Contents contents = any_contents(random, 20, 30, 40);
        const Scene shapes = contents.built(false);
        const Tracer of_kept(contents.built(true)), of_shapes(shapes);
        const Rays rays = hard_rays(shapes, 500, random);
        CrossingRows found, expected;
        of_kept.crossings(rays.span(), found, {.normals = true});
        of_shapes.crossings(rays.span(), expected, {.normals = true});
        CHECK((found.first == expected.first));
        REQUIRE(found.t.size() == expected.t.size());
        for (std::size_t i = 0; i < found.t.size(); ++i) {
            INFO(i << ": shape " << found.shape_id[i] << ", expected " << expected.shape_id[i]);
            REQUIRE(found.t[i] == expected.t[i]);
            REQUIRE(found.shape_id[i] == expected.shape_id[i]);
        }
        CHECK((found.shape_id == expected.shape_id));
        CHECK((found.entering == expected.entering));
        CHECK((found.normal_x == expected.normal_x));
        std::vector<std::uint64_t> counts(rays.size()), expected_counts(rays.size());
        of_kept.count_crossings(rays.span(), counts);
        of_shapes.count_crossings(rays.span(), expected_counts);
        CHECK((counts == expected_counts));
        SolidLengthRows lengths, expected_lengths;
        of_kept.solid_lengths(rays.span(), lengths);
        of_shapes.solid_lengths(rays.span(), expected_lengths);
        CHECK((lengths.first == expected_lengths.first));
        CHECK((lengths.length == expected_lengths.length));
    }
}

TEST_CASE("scenes with kept copies refuse other queries") {
    Random random(3);
    const Contents contents = any_contents(random, 3, 10, 0);
    const Scene scene = contents.built(true);
    const Tracer tracer(scene);
    const std::vector<float> zero = {0.0F};
    CHECK(message_of([&] {
              SolidRows rows;
              tracer.contains(PointSpan{zero, zero, zero}, rows);
          }).find("copies") != std::string::npos);
    CHECK(message_of([&] {
              tracer.closest(PointSpan{zero, zero, zero}, ClosestSpan{});
          }).find("copies") != std::string::npos);
    CHECK(message_of([&] {
              static_cast<void>(scene.with_positions(std::vector<Vec3>{}));
          }).find("copies") != std::string::npos);
}
