#include "core/reference/search.hpp"
#include "raylane/raylane.hpp"
#include "scenes/library/internals.hpp"
#include "tests/catch.hpp"
#include "tests/ray_sets.hpp"

#include <bit>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

using namespace raylane;
using ray_sets::Random;
using ray_sets::Set;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// Rays with arrays of their own.
struct Rays {
    std::vector<float> x, y, z, dx, dy, dz, t_min, t_max;

    void add(const Vec3& origin, const Vec3& direction) {
        x.push_back(origin.x);
        y.push_back(origin.y);
        z.push_back(origin.z);
        dx.push_back(direction.x);
        dy.push_back(direction.y);
        dz.push_back(direction.z);
    }
    std::size_t size() const { return x.size(); }
    RaySpan span() const { return {x, y, z, dx, dy, dz, t_min, t_max}; }
    RaySpan part(std::size_t first, std::size_t count) const {
        const auto of = [&](const std::vector<float>& values) {
            return values.empty() ? std::span<const float>()
                                  : std::span(values).subspan(first, count);
        };
        return {of(x), of(y), of(z), of(dx), of(dy), of(dz), of(t_min), of(t_max)};
    }
    core::Ray<double> ray(std::size_t i) const {
        return {core::convert<double>(core::Vec3f(x[i], y[i], z[i])),
                core::convert<double>(core::Vec3f(dx[i], dy[i], dz[i]))};
    }
};

struct Hits {
    explicit Hits(std::size_t count)
        : t(count, -1.0F), nx(count, 9.0F), ny(count, 9.0F), nz(count, 9.0F), shape(count, 12345) {}

    std::vector<float> t, nx, ny, nz;
    std::vector<ShapeId> shape;

    HitSpan span() { return {t, nx, ny, nz, shape}; }
    bool operator==(const Hits&) const = default;
    bool is_none(std::size_t i) const {
        return t[i] == infinity && nx[i] == 0.0F && ny[i] == 0.0F && nz[i] == 0.0F &&
               shape[i] == no_shape;
    }
};

Hits intersect(const Tracer& tracer, const Rays& rays) {
    Hits hits(rays.size());
    tracer.intersect(rays.span(), hits.span());
    return hits;
}

std::vector<std::uint8_t> occluded(const Tracer& tracer, const Rays& rays) {
    std::vector<std::uint8_t> result(rays.size(), 77);
    tracer.occluded(rays.span(), result);
    return result;
}

struct Heap {
    Scene scene;
    Rays rays;
};

template <class Shape, class CoreShape>
void add_kind(SceneBuilder& builder, MaterialIndex material, int count, bool lattice,
              Random& random, Rays& rays) {
    for (int i = 0; i < count; ++i) {
        const auto shape = ray_sets::Target<CoreShape>::make(random, lattice);
        builder.add(std::bit_cast<Shape>(shape), material);
        for (const Set set : ray_sets::all_sets) {
            if ((set == Set::lattice) != lattice) continue;
            const core::Ray<float> ray = ray_sets::make_ray(shape, set, random);
            rays.add({ray.origin.x, ray.origin.y, ray.origin.z},
                     {ray.direction.x, ray.direction.y, ray.direction.z});
        }
    }
}

/// All kinds in one heap, with rays that are hard for some of them.
Heap heap(bool lattice, int of_each_kind, std::uint64_t seed) {
    Random random(seed);
    SceneBuilder builder;
    Rays rays;
    const MaterialIndex material = builder.add_material({});
    const auto add = [&]<class Shape, class CoreShape>(int count) {
        add_kind<Shape, CoreShape>(builder, material, count, lattice, random, rays);
    };
    add.operator()<Sphere, core::Sphere>(of_each_kind);
    add.operator()<Plane, core::Plane>(2);
    add.operator()<Disc, core::Disc>(of_each_kind);
    add.operator()<Triangle, core::Triangle>(of_each_kind);
    add.operator()<SmoothTriangle, core::SmoothTriangle>(of_each_kind);
    add.operator()<Box, core::Box>(of_each_kind);
    add.operator()<OpenCylinder, core::OpenCylinder>(of_each_kind);
    add.operator()<CappedCylinder, core::CappedCylinder>(of_each_kind);
    add.operator()<OpenCone, core::OpenCone>(of_each_kind);
    add.operator()<CappedCone, core::CappedCone>(of_each_kind);
    add.operator()<Quadric, core::Quadric>(of_each_kind);
    return {builder.build(), rays};
}

Heap heap() {
#ifdef RAYLANE_FEW_RAYS
    return heap(false, 6, 1);
#else
    return heap(false, 40, 1);
#endif
}

/// A unit ball around the origin.
Scene ball(const Material& material = {}) {
    SceneBuilder builder;
    builder.add(Sphere{{0, 0, 0}, 1}, builder.add_material(material));
    return builder.build();
}

/// A ray down the z axis to the unit ball: t = 4 and 6.
Rays to_ball() {
    Rays rays;
    rays.add({0, 0, 5}, {0, 0, -1});
    return rays;
}

} // namespace

TEST_CASE("the nearest crossings are those that trying every shape finds") {
    for (const bool lattice : {false, true}) {
        const Heap all = heap(lattice, 20, 7);
        const Hits hits = intersect(Tracer(all.scene), all.rays);
        core::Searcher<double> searcher(library::Internals::of(all.scene),
                                        core::Search::every_shape);
        std::size_t wrong = 0, found = 0;
        for (std::size_t i = 0; i < all.rays.size(); ++i) {
            const core::Ray<double> ray = all.rays.ray(i);
            const auto hit =
                searcher.nearest(ray, {}, [](const core::Hit<double>&) { return true; }).hit;
            if (!hit.any()) {
                wrong += hits.is_none(i) ? 0 : 1;
                continue;
            }
            ++found;
            const core::Vec3f normal = core::convert<float>(
                searcher.outward_normal_at(hit, core::mul_add(hit.t, ray.direction, ray.origin)));
            const bool same = hits.shape[i] == hit.shape &&
                              hits.t[i] == static_cast<float>(hit.t) && hits.nx[i] == normal.x &&
                              hits.ny[i] == normal.y && hits.nz[i] == normal.z;
            wrong += same ? 0 : 1;
        }
        CHECK(wrong == 0);
        CHECK(found > all.rays.size() / 2);
    }
}

TEST_CASE("each t, given back as t_min, leads on to the next crossing") {
    const Heap all = heap();
    const Tracer tracer(all.scene);
    core::Searcher<double> searcher(library::Internals::of(all.scene), core::Search::every_shape);
    std::vector<std::set<float>> expected(all.rays.size()), found(all.rays.size());
    for (std::size_t i = 0; i < all.rays.size(); ++i)
        searcher.each(all.rays.ray(i), {}, std::numeric_limits<double>::infinity(),
                      [&](const core::Hit<double>& hit) {
                          expected[i].insert(static_cast<float>(hit.t));
                          return true;
                      });
    Rays rays = all.rays;
    rays.t_min.assign(rays.size(), 0.0F);
    for (bool any = true; any;) {
        any = false;
        const Hits hits = intersect(tracer, rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (hits.shape[i] != no_shape) {
                any = true;
                CHECK(hits.t[i] > rays.t_min[i]);
                found[i].insert(hits.t[i]);
            }
            rays.t_min[i] = hits.t[i];
        }
    }
    CHECK(found == expected);
}

TEST_CASE("t_max belongs to the ray, t_min does not") {
    const Heap all = heap();
    const Tracer tracer(all.scene);
    const Hits hits = intersect(tracer, all.rays);
    Rays rays = all.rays;
    rays.t_max = hits.t;
    CHECK(intersect(tracer, rays) == hits);
    for (std::size_t i = 0; i < rays.size(); ++i)
        rays.t_max[i] = std::nextafter(hits.t[i], 0.0F);
    const Hits before = intersect(tracer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i)
        CHECK(before.is_none(i));

    rays = to_ball();
    rays.t_min = {4.0F};
    CHECK(intersect(Tracer(ball()), rays).t[0] == 6.0F);
    rays.t_max = {6.0F};
    CHECK(intersect(Tracer(ball()), rays).t[0] == 6.0F);
    rays.t_min = {6.0F};
    CHECK(intersect(Tracer(ball()), rays).is_none(0));
    rays.t_min = {-1.0F};
    CHECK(intersect(Tracer(ball()), rays).t[0] == 4.0F);
    for (const float t_max : {0.0F, -1.0F, -infinity}) {
        rays.t_max = {t_max};
        CHECK(intersect(Tracer(ball()), rays).is_none(0));
    }
}

TEST_CASE("a ray is occluded where intersect finds a shape") {
    const Heap all = heap();
    const Tracer tracer(all.scene);
    Rays rays = all.rays;
    const auto check = [&] {
        const Hits hits = intersect(tracer, rays);
        const std::vector<std::uint8_t> blocked = occluded(tracer, rays);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            wrong += blocked[i] == (hits.shape[i] != no_shape ? 1 : 0) ? 0 : 1;
        CHECK(wrong == 0);
    };
    check();
    Random random(3);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays.t_min.push_back(static_cast<float>(random.uniform(-1.0, 5.0)));
        rays.t_max.push_back(static_cast<float>(random.uniform(0.0, 20.0)));
    }
    check();
    rays.t_min = intersect(tracer, all.rays).t;
    rays.t_max.clear();
    check();
}

TEST_CASE("answers depend on the ray alone, in spans of any length") {
    const Heap all = heap();
    const Tracer tracer(all.scene), one_thread(all.scene, {.threads = 1}),
        many_threads(all.scene, {.threads = 5});
    const Hits whole = intersect(tracer, all.rays);
    CHECK(intersect(one_thread, all.rays) == whole);
    CHECK(intersect(many_threads, all.rays) == whole);
    const std::vector<std::uint8_t> blocked = occluded(tracer, all.rays);
    CHECK(occluded(one_thread, all.rays) == blocked);
    CHECK(occluded(many_threads, all.rays) == blocked);
    for (const std::size_t length : {1, 17, 300, 1000}) {
        Hits parts(all.rays.size());
        std::vector<std::uint8_t> blocked_parts(all.rays.size());
        for (std::size_t first = 0; first < all.rays.size(); first += length) {
            const std::size_t count = std::min(length, all.rays.size() - first);
            const auto of = [&](auto& values) { return std::span(values).subspan(first, count); };
            tracer.intersect(all.rays.part(first, count), {of(parts.t), of(parts.nx), of(parts.ny),
                                                           of(parts.nz), of(parts.shape)});
            tracer.occluded(all.rays.part(first, count), of(blocked_parts));
        }
        CHECK(parts == whole);
        CHECK(blocked_parts == blocked);
    }
}

TEST_CASE("no rays get no answers") {
    const Tracer tracer(ball());
    tracer.intersect({}, {});
    tracer.occluded({}, {});
    CHECK(intersect(tracer, {}).t.empty());
}

TEST_CASE("what is not wanted may be left out") {
    const Heap all = heap();
    const Tracer tracer(all.scene);
    const Hits whole = intersect(tracer, all.rays);
    Hits hits(all.rays.size());
    tracer.intersect(all.rays.span(), {.t = hits.t});
    tracer.intersect(all.rays.span(), {.normal_x = hits.nx});
    tracer.intersect(all.rays.span(), {.normal_y = hits.ny});
    tracer.intersect(all.rays.span(), {.normal_z = hits.nz});
    tracer.intersect(all.rays.span(), {.shape = hits.shape});
    tracer.intersect(all.rays.span(), {});
    CHECK(hits == whole);
}

TEST_CASE("a span of another length is refused by its name") {
    const Tracer tracer(ball());
    const std::vector<float> two(2, 1.0F), three(3, 1.0F);
    std::vector<float> out(3);
    std::vector<ShapeId> ids(3);
    std::vector<std::uint8_t> flags(3);
    const auto refused = [](const auto& act) {
        try {
            act();
        } catch (const std::invalid_argument& error) {
            const auto& invalid = dynamic_cast<const InvalidValue&>(error);
            CHECK(std::string(error.what()) == invalid.field + ": " + invalid.expectation);
            return invalid.field;
        }
        return std::string("not refused");
    };
    const RaySpan good{two, two, two, two, two, two};
    using Input = std::span<const float> RaySpan::*;
    const std::pair<Input, const char*> inputs[] = {{&RaySpan::origin_y, "origin_y"},
                                                    {&RaySpan::origin_z, "origin_z"},
                                                    {&RaySpan::direction_x, "direction_x"},
                                                    {&RaySpan::direction_y, "direction_y"},
                                                    {&RaySpan::direction_z, "direction_z"},
                                                    {&RaySpan::t_min, "t_min"},
                                                    {&RaySpan::t_max, "t_max"}};
    for (const auto& [input, name] : inputs) {
        RaySpan rays = good;
        rays.*input = three;
        CHECK(refused([&] { tracer.intersect(rays, {}); }) == name);
        CHECK(refused([&] { tracer.occluded(rays, std::span(flags).first(2)); }) == name);
    }
    RaySpan without = good;
    without.direction_z = {};
    CHECK(refused([&] { tracer.intersect(without, {}); }) == "direction_z");
    CHECK(refused([&] { tracer.intersect({.t_max = two}, {}); }) == "t_max");

    CHECK(refused([&] { tracer.intersect(good, {.t = out}); }) == "t");
    CHECK(refused([&] { tracer.intersect(good, {.normal_x = out}); }) == "normal_x");
    CHECK(refused([&] { tracer.intersect(good, {.normal_y = out}); }) == "normal_y");
    CHECK(refused([&] { tracer.intersect(good, {.normal_z = out}); }) == "normal_z");
    CHECK(refused([&] { tracer.intersect(good, {.shape = ids}); }) == "shape");
    CHECK(refused([&] { tracer.occluded(good, flags); }) == "occluded");
    CHECK(refused([&] { tracer.occluded(good, {}); }) == "occluded");
    try {
        tracer.intersect(good, {.t = out});
    } catch (const InvalidValue& invalid) {
        CHECK(invalid.expectation == "must have one element for each of 2 rays, got 3");
    }
    CHECK(refused([] { Tracer(ball(), {.threads = 4097}); }) == "threads");
}

TEST_CASE("what is no ray hits nothing, and harms no other") {
    const Tracer tracer(ball());
    Rays rays;
    const float bad[] = {not_a_number, infinity, -infinity};
    const auto good = [&] { rays.add({0, 0, 5}, {0, 0, -1}); };
    for (const float value : bad) {
        rays.add({value, 0, 5}, {0, 0, -1});
        rays.add({0, value, 5}, {0, 0, -1});
        rays.add({0, 0, value}, {0, 0, -1});
        rays.add({0, 0, 5}, {value, 0, -1});
        rays.add({0, 0, 5}, {0, value, -1});
        rays.add({0, 0, 5}, {0, 0, value});
        good();
    }
    rays.add({0, 0, 5}, {0, 0, 0});
    rays.add({0, 0, 0}, {-0.0F, 0, -0.0F});
    good();
    const Hits hits = intersect(tracer, rays);
    const std::vector<std::uint8_t> blocked = occluded(tracer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool is_good = rays.z[i] == 5.0F && rays.x[i] == 0.0F && rays.y[i] == 0.0F &&
                             rays.dx[i] == 0.0F && rays.dy[i] == 0.0F && rays.dz[i] == -1.0F;
        CHECK(hits.is_none(i) == !is_good);
        CHECK(blocked[i] == (is_good ? 1 : 0));
    }

    for (const float value : {not_a_number, infinity}) {
        Rays limited = to_ball();
        limited.t_min = {value};
        CHECK(intersect(tracer, limited).is_none(0));
    }
    Rays limited = to_ball();
    limited.t_max = {not_a_number};
    CHECK(intersect(tracer, limited).is_none(0));
    CHECK(occluded(tracer, limited)[0] == 0);
}

TEST_CASE("directions may have any length") {
    const Heap all = heap();
    const Tracer tracer(all.scene);
    const Hits hits = intersect(tracer, all.rays);
    for (const int power : {-40, -1, 3, 50}) {
        Rays rays = all.rays;
        for (std::vector<float>* components : {&rays.dx, &rays.dy, &rays.dz})
            for (float& value : *components)
                value = std::ldexp(value, power);
        Hits scaled = intersect(tracer, rays);
        CHECK(scaled.shape == hits.shape);
        for (float& t : scaled.t)
            t = std::ldexp(t, power);
        CHECK(scaled == hits);
    }
}

TEST_CASE("a t that no float can hold is the smallest or the largest of them") {
    Rays rays;
    rays.add({0, 0, 5}, {0, 0, -std::numeric_limits<float>::denorm_min()});
    rays.add({0, 0, 1 + 0x1p-20F}, {0, 0, -std::numeric_limits<float>::max()});
    rays.add({0, 0, 1e-30F}, {0, 0, -std::numeric_limits<float>::max()});
    SceneBuilder builder;
    const MaterialIndex m = builder.add_material({});
    builder.add(Sphere{{0, 0, 0}, 1}, m);
    builder.add(Plane{{0, 0, 0}, {0, 0, 1}}, m);
    const Hits hits = intersect(Tracer(builder.build()), rays);
    CHECK(hits.t[0] == std::numeric_limits<float>::max());
    CHECK(hits.shape[0] == 0);
    CHECK(hits.t[1] == 2 * std::numeric_limits<float>::denorm_min());
    CHECK(hits.shape[1] == 0);
    CHECK(hits.t[2] == std::numeric_limits<float>::denorm_min());
    CHECK(hits.shape[2] == 1);
    rays.t_max.assign(3, std::numeric_limits<float>::max());
    CHECK(occluded(Tracer(ball()), rays) == std::vector<std::uint8_t>{1, 1, 1});
}

TEST_CASE("a hit has the outward normal, from either side") {
    Rays rays = to_ball();
    rays.add({0, 0, 0}, {0, 0, -2});
    const Hits hits = intersect(Tracer(ball()), rays);
    CHECK(hits.nz == std::vector<float>{1.0F, -1.0F});
    CHECK(hits.t[1] == 0.5F);
}

TEST_CASE("of surfaces that coincide the one that is entered comes first, then the lower id") {
    SceneBuilder builder;
    const MaterialIndex m = builder.add_material({});
    const auto block = [&](float z) {
        return builder.add(Box{{-1, -1, z}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}}, m);
    };
    const ShapeId above = block(0.0F), below = block(-1.0F);
    block(-1.0F);
    Rays rays;
    rays.add({0.25F, 0.25F, 0.5F}, {0, 0, -1});
    const Tracer tracer(builder.build());
    CHECK(intersect(tracer, rays).shape[0] == below);
    rays.z[0] = -0.5F;
    rays.dz[0] = 1;
    CHECK(intersect(tracer, rays).shape[0] == above);
    rays.t_min = {0.5F};
    CHECK(intersect(tracer, rays).t[0] == 1.5F);
}

TEST_CASE("sides that are not visible are not hit, and glass is") {
    const auto hits = [](const Material& material) {
        Rays rays = to_ball();
        rays.add({0, 0, 0}, {0, 0, 1});
        const Tracer tracer(ball(material));
        const std::vector<std::uint8_t> blocked = occluded(tracer, rays);
        CHECK(blocked == std::vector<std::uint8_t>{1, blocked[1]});
        CHECK((intersect(tracer, rays).t[1] == 1.0F) == (blocked[1] == 1));
        return intersect(tracer, rays).t[0];
    };
    CHECK(hits({}) == 4.0F);
    CHECK(hits({.transmission = 1.0F}) == 4.0F);
    CHECK(hits({.visible = Visible::outside}) == 4.0F);
    CHECK(hits({.visible = Visible::inside}) == 6.0F);
}

TEST_CASE("a scene without shapes is hit by nothing") {
    const Tracer tracer(SceneBuilder().build());
    CHECK(intersect(tracer, to_ball()).is_none(0));
    CHECK(occluded(tracer, to_ball())[0] == 0);
}

TEST_CASE("a tracer keeps its scene alive, and copies are the same") {
    const Tracer tracer = [] {
        const Tracer first(ball());
        return Tracer(first); // NOLINT: a copy
    }();
    CHECK(tracer.scene().shape_count() == 1);
    CHECK(intersect(tracer, to_ball()).t[0] == 4.0F);
}

TEST_CASE("any number of threads may ask one tracer") {
    const Heap all = heap();
    const Tracer tracer(all.scene);
    const Hits whole = intersect(tracer, all.rays);
    const std::vector<std::uint8_t> blocked = occluded(tracer, all.rays);
    std::vector<Hits> hits(6, Hits(all.rays.size()));
    std::vector<std::vector<std::uint8_t>> flags(hits.size(),
                                                 std::vector<std::uint8_t>(all.rays.size()));
    {
        std::vector<std::jthread> threads;
        for (std::size_t k = 0; k < hits.size(); ++k)
            threads.emplace_back([&, k] {
                tracer.intersect(all.rays.span(), hits[k].span());
                tracer.occluded(all.rays.span(), flags[k]);
            });
    }
    for (std::size_t k = 0; k < hits.size(); ++k) {
        CHECK(hits[k] == whole);
        CHECK(flags[k] == blocked);
    }
}
