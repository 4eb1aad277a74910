#include "raylane/raylane.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "simd/isa/isa.hpp"

#ifdef RAYLANE_EMBREE
#include "bench/embree_scene.hpp"
#endif

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <vector>

/// Measures situations in which the time for a ray might rise sharply: many shapes that almost meet
/// it, sizes and distances far from 1. Prints nanoseconds per ray through the library, on one
/// thread: the mean of one call for all rays, and the worst of one call per ray. Prints the same
/// for `robust`, which tests in float, for Embree, and for all crossings.
///
/// usage: raylane-worst-case [NAME...]   parts of names; default: all
namespace raylane::bench {
namespace {

class Random {
  public:
    float uniform(float low, float high) {
        return low + (high - low) * static_cast<float>(engine_() >> 40) * 0x1p-24F;
    }
    float any() { return uniform(-1.0F, 1.0F); }
    Vec3 cube(float size) { return {size * any(), size * any(), size * any()}; }

  private:
    std::mt19937_64 engine_{20261122};
};

Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec3 operator*(float s, const Vec3& a) {
    return {s * a.x, s * a.y, s * a.z};
}

struct Rays {
    std::vector<float> values[6];

    void add(const Vec3& origin, const Vec3& direction) {
        const float numbers[] = {origin.x,    origin.y,    origin.z,
                                 direction.x, direction.y, direction.z};
        for (int k = 0; k < 6; ++k)
            values[k].push_back(numbers[k]);
    }
    std::size_t size() const { return values[0].size(); }
    RaySpan span(std::size_t first, std::size_t count) const {
        const auto part = [&](int k) { return std::span(values[k]).subspan(first, count); };
        return {part(0), part(1), part(2), part(3), part(4), part(5)};
    }
};

struct Situation {
    Scene scene;
    Rays rays;
};

struct Hits {
    std::vector<float> t, x, y, z;
    std::vector<ShapeId> shape;

    explicit Hits(std::size_t n) : t(n), x(n), y(n), z(n), shape(n) {}
    HitSpan span(std::size_t first, std::size_t count) {
        const auto part = [&](auto& column) { return std::span(column).subspan(first, count); };
        return {part(t), part(x), part(y), part(z), part(shape)};
    }
};

using Clock = std::chrono::steady_clock;

double nanoseconds_of(const std::function<void()>& act) {
    const auto start = Clock::now();
    act();
    return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

struct Times {
    double mean = 0.0, worst = 0.0;
};

/// Measures `ask(first, count)`, which traces rays. The setup of a first call is not counted.
/// `worst` is the largest time of a single ray, each of which is the least of three.
Times times_of(std::size_t count, const std::function<void(std::size_t, std::size_t)>& ask) {
    Times times;
    ask(0, std::min<std::size_t>(count, 16));
    times.mean = nanoseconds_of([&] { ask(0, count); }) / static_cast<double>(count);
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 500); ++i) {
        double least = HUGE_VAL;
        for (int turn = 0; turn < 3; ++turn)
            least = std::min(least, nanoseconds_of([&] { ask(i, 1); }));
        times.worst = std::max(times.worst, least);
    }
    return times;
}

Times raylane_times(const Situation& situation, Precision precision) {
    const Tracer tracer(situation.scene, {.threads = 1, .precision = precision});
    Hits hits(situation.rays.size());
    return times_of(situation.rays.size(), [&](std::size_t first, std::size_t count) {
        tracer.intersect(situation.rays.span(first, count), hits.span(first, count));
    });
}

/// Times for all crossings, and the number of crossings per ray.
struct AllTimes : Times {
    double crossings = 0.0;
};
AllTimes crossing_times(const Situation& situation) {
    const Tracer tracer(situation.scene, {.threads = 1});
    CrossingRows rows;
    const std::size_t count = situation.rays.size();
    AllTimes times{times_of(count, [&](std::size_t first, std::size_t size) {
        tracer.crossings(situation.rays.span(first, size), rows);
    })};
    tracer.crossings(situation.rays.span(0, count), rows);
    times.crossings = static_cast<double>(rows.t.size()) / static_cast<double>(count);
    return times;
}

#ifdef RAYLANE_EMBREE
Times embree_times(const Situation& situation) {
    const core::Scene& scene = library::Internals::of(situation.scene);
    if (!EmbreeScene::can_hold(scene)) return {};
    const EmbreeDevice device = make_embree_device(simd::best_isa());
    EmbreeScene embree(device.get(), scene, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_MEDIUM);
    embree.commit();
    const NoDenormals no_denormals;
    EmbreeQuery query(false);
    return times_of(situation.rays.size(), [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            RTCRayHit ray{};
            float* const to[] = {&ray.ray.org_x, &ray.ray.org_y, &ray.ray.org_z,
                                 &ray.ray.dir_x, &ray.ray.dir_y, &ray.ray.dir_z};
            for (int k = 0; k < 6; ++k)
                *to[k] = situation.rays.values[k][i];
            ray.ray.tfar = HUGE_VALF;
            ray.ray.mask = ~0U;
            ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            query.nearest(embree.get(), ray);
        }
    });
}
#else
Times embree_times(const Situation&) {
    return {};
}
#endif

constexpr int ray_count = 4000;

/// Spheres in a cube of half side `size` around `middle`. Rays go through it in any direction, or
/// start on surfaces.
Situation heap(int count, float size, const Vec3& middle, float distance) {
    Random random;
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    const float radius = 0.5F * size / std::cbrt(static_cast<float>(count));
    std::vector<Vec3> centers;
    for (int i = 0; i < count; ++i) {
        centers.push_back(middle + random.cube(size));
        builder.add(Sphere{centers.back(), radius}, material);
    }
    Rays rays;
    for (int i = 0; i < ray_count; ++i) {
        const Vec3& target = centers[static_cast<std::size_t>(
            random.uniform(0.0F, static_cast<float>(count) - 0.5F))];
        const Vec3 way = random.cube(1.0F);
        // From a surface, or from `distance` sizes away.
        const float from = distance == 0.0F
                               ? radius / std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z)
                               : distance * size;
        const Vec3 origin = target + from * way;
        rays.add(origin, distance == 0.0F
                             ? random.cube(1.0F)
                             : (1.0F / from) * (target - origin + random.cube(radius)));
    }
    return {builder.build(), rays};
}

/// Triangles on the plane y = slope x, and rays parallel to it, `above` higher.
Situation floor_of(int side, float slope, float above, bool any_way) {
    Random random;
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    const auto at = [&](int i, int j) {
        const float x = 2.0F * static_cast<float>(i) / static_cast<float>(side) - 1.0F;
        return Vec3{x, slope * x, 2.0F * static_cast<float>(j) / static_cast<float>(side) - 1.0F};
    };
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            builder.add(Triangle{at(i, j), at(i, j + 1), at(i + 1, j)}, material);
            builder.add(Triangle{at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)}, material);
        }
    Rays rays;
    for (int i = 0; i < ray_count; ++i) {
        const float x = random.any(), z = random.any();
        const float dx = any_way ? random.any() : 1.0F, dz = any_way ? random.any() : 0.0F;
        rays.add({x - 2.0F * dx, slope * (x - 2.0F * dx) + above, z - 2.0F * dz},
                 {dx, slope * dx, dz});
    }
    return {builder.build(), rays};
}

/// Open cylinders end to end, and rays along their surface, `outside` it.
Situation pipes(int count, int rows, float outside, bool tilted) {
    Random random;
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < count / rows; ++i)
            builder.add(OpenCylinder{{0.25F * static_cast<float>(row), 0, static_cast<float>(i)},
                                     {0, 0, 1},
                                     0.125F},
                        material);
    Rays rays;
    for (int i = 0; i < ray_count / 4; ++i) {
        const auto row = std::floor(random.uniform(0.0F, static_cast<float>(rows) - 0.01F));
        rays.add({0.25F * row + (i % 2 == 0 ? 0.125F + outside : 0.0F),
                  i % 2 == 0 ? 0.0F : 0.125F + outside, -1.0F},
                 {0, tilted ? 1e-7F * random.any() : 0.0F, 1});
    }
    return {builder.build(), rays};
}

/// Concentric spheres: all the same, or with radii an ulp apart.
Situation shells(int count, bool identical) {
    Random random;
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    float radius = 1.0F;
    for (int i = 0; i < count; ++i) {
        builder.add(Sphere{{0, 0, 0}, radius}, material);
        if (!identical) radius = std::nextafter(radius, 2.0F);
    }
    Rays rays;
    for (int i = 0; i < ray_count / 4; ++i) {
        const Vec3 origin = random.cube(3.0F);
        rays.add(origin, random.cube(0.8F) - origin);
    }
    return {builder.build(), rays};
}

/// Spheres in a row that touch a line, and rays along it.
Situation row_of_spheres(int count, float above) {
    Random random;
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    for (int i = 0; i < count; ++i)
        builder.add(Sphere{{static_cast<float>(i), 0, 0}, 0.5F}, material);
    Rays rays;
    for (int i = 0; i < ray_count / 4; ++i)
        rays.add({-1.0F - random.uniform(0.0F, 1.0F), 0.5F + above, 0}, {1, 0, 0});
    return {builder.build(), rays};
}

/// Shapes whose fronts lie in one plane, on top of each other.
Situation stack(int count) {
    Random random;
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    for (int i = 0; i < count; ++i) {
        const float a = 1.0F + random.uniform(0.0F, 1.0F), b = 1.0F + random.uniform(0.0F, 1.0F);
        builder.add(Box{{-a, -b, -1}, {2 * a, 0, 0}, {0, 2 * b, 0}, {0, 0, 1}}, material);
    }
    Rays rays;
    for (int i = 0; i < ray_count / 4; ++i)
        rays.add({random.any(), random.any(), 3}, {0.3F * random.any(), 0.3F * random.any(), -1});
    return {builder.build(), rays};
}

/// Triangles around one corner, and rays at it.
Situation fan(int count) {
    Random random;
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    const auto at = [&](int i) {
        const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(count);
        return Vec3{std::cos(angle), std::sin(angle), 0.25F};
    };
    for (int i = 0; i < count; ++i)
        builder.add(Triangle{{0, 0, 0}, at(i), at((i + 1) % count)}, material);
    Rays rays;
    for (int i = 0; i < ray_count / 4; ++i) {
        const Vec3 way{std::round(4 * random.any()), std::round(4 * random.any()), -4};
        rays.add((i % 2 == 0 ? -1.0F : -1.25F) * way, way);
    }
    return {builder.build(), rays};
}

/// Boxes stacked face on face. Rays go along faces, along edges, and in any direction.
Situation crates(int side) {
    Random random;
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    for (int i = 0; i < side * side * side; ++i) {
        const Vec3 corner{static_cast<float>(i % side), static_cast<float>(i / side % side),
                          static_cast<float>(i / side / side)};
        builder.add(Box{corner, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, material);
    }
    Rays rays;
    const auto grid_number = [&] {
        return std::floor(random.uniform(0.0F, static_cast<float>(side)));
    };
    for (int i = 0; i < ray_count; ++i)
        switch (i % 3) {
        case 0:
            rays.add({grid_number(), grid_number(), -1}, {0, 0, 1});
            break;
        case 1:
            rays.add({grid_number(), grid_number() + 0.5F, grid_number() - 0.5F}, {0, 1, 1});
            break;
        default:
            rays.add({grid_number(), grid_number(), grid_number()}, random.cube(1.0F));
        }
    return {builder.build(), rays};
}

/// Shapes and rays of sizes far apart.
Situation sizes(float large, float small) {
    Random random;
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    for (int i = 0; i < 20; ++i) {
        const float size = i % 2 == 0 ? large : small;
        builder.add(Sphere{random.cube(size), 0.4F * size}, material);
        builder.add(CappedCone{random.cube(size), random.cube(size), 0.3F * size, 0}, material);
        builder.add(Box{random.cube(size), {size, 0, 0}, {0, size, 0}, {0, 0, size}}, material);
    }
    Rays rays;
    for (int i = 0; i < ray_count / 4; ++i) {
        const Vec3 origin = random.cube(i % 2 == 0 ? large : small);
        const Vec3 target = random.cube(i % 4 < 2 ? large : small);
        rays.add(origin, (i % 8 < 4 ? 1.0F : 1.0F / large) * (target - origin));
    }
    return {builder.build(), rays};
}

using Make = std::function<Situation()>;

std::vector<std::pair<std::string, Make>> all_situations() {
    std::vector<std::pair<std::string, Make>> subjects;
    const auto add = [&](const std::string& name, const Make& make) {
        subjects.emplace_back(name, make);
    };
    for (const float size : {1e-6F, 1e-3F, 1.0F, 1e3F, 1e6F})
        for (const float distance : {0.0F, 3.0F, 1e3F, 1e6F}) {
            char name[100];
            std::snprintf(name, sizeof name, "heap/size:%g/away:%g", static_cast<double>(size),
                          static_cast<double>(distance));
            add(name, [=] { return heap(10'000, size, {}, distance); });
        }
    for (const float offset : {1e1F, 1e3F, 1e5F, 1e6F}) {
        const std::string name = "heap/offset:" + std::to_string(static_cast<int>(offset));
        add(name, [=] {
            return heap(10'000, 1.0F, {offset, -0.7F * offset, 0.3F * offset}, 3.0F);
        });
    }
    for (const float distance : {0.0F, 3.0F})
        add(distance == 0.0F ? "molecule/from_surfaces" : "molecule/any",
            [=] { return heap(200'000, 1e-6F, {}, distance); });
    for (const int side : {32, 128, 512}) {
        const std::string triangles = std::to_string(2 * side * side);
        add("floor/" + triangles + "/above", [=] { return floor_of(side, 0.0F, 1e-7F, false); });
        add("floor/" + triangles + "/above_any_way",
            [=] { return floor_of(side, 0.0F, 1e-7F, true); });
        add("floor/" + triangles + "/within", [=] { return floor_of(side, 0.0F, 0.0F, true); });
        add("slope/" + triangles + "/above", [=] { return floor_of(side, 0.3F, 1e-7F, true); });
        add("slope/" + triangles + "/within", [=] { return floor_of(side, 0.3F, 0.0F, true); });
    }
    for (const int count : {4096, 262'144}) {
        const std::string cylinders = std::to_string(count);
        for (const int rows : {1, 64})
            for (const float outside : {0.0F, 1e-7F})
                add("pipes/" + cylinders + "/rows:" + std::to_string(rows) +
                        (outside == 0.0F ? "/along" : "/above"),
                    [=] { return pipes(count, rows, outside, false); });
        add("pipes/" + cylinders + "/rows:64/tilted", [=] { return pipes(count, 64, 0.0F, true); });
    }
    add("shells/65536/identical", [] { return shells(65'536, true); });
    add("shells/1000/ulps_apart", [] { return shells(1000, false); });
    add("row/10000/touching", [] { return row_of_spheres(10'000, 0.0F); });
    add("row/10000/above", [] { return row_of_spheres(10'000, 1e-7F); });
    for (const int count : {10, 100, 1000})
        add("stack/" + std::to_string(count), [=] { return stack(count); });
    for (const int count : {100, 1000})
        add("fan/" + std::to_string(count), [=] { return fan(count); });
    add("crates/8000", [] { return crates(20); });
    add("sizes/1e30/1e-30", [] { return sizes(1e30F, 1e-30F); });
    add("sizes/1e9/1e-9", [] { return sizes(1e9F, 1e-9F); });
    return subjects;
}

} // namespace
} // namespace raylane::bench

int main(int argc, char** argv) {
    using namespace raylane;
    using namespace raylane::bench;
    std::printf("%-36s %9s %9s %9s %9s %9s %9s %9s %9s %9s\n", "ns a ray", "exact", "worst",
                "robust", "worst", "embree", "worst", "all", "worst", "crossings");
    for (const auto& [name, make] : all_situations()) {
        bool wanted = argc == 1;
        for (int i = 1; i < argc; ++i)
            wanted = wanted || name.find(argv[i]) != std::string::npos;
        if (!wanted) continue;
        const Situation situation = make();
        const Times exact = raylane_times(situation, Precision::exact),
                    robust = raylane_times(situation, Precision::robust),
                    embree = embree_times(situation);
        const AllTimes total_times = crossing_times(situation);
        std::printf("%-36s %9.0f %9.0f %9.0f %9.0f %9.0f %9.0f %9.0f %9.0f %9.1f\n", name.c_str(),
                    exact.mean, exact.worst, robust.mean, robust.worst, embree.mean, embree.worst,
                    total_times.mean, total_times.worst, total_times.crossings);
        std::fflush(stdout);
    }
}
