#include "bench/peers/workload.hpp"

#include "core/numbers/primitives.hpp"
#include "core/numbers/sample_sequence.hpp"
#include "core/optics/soft_light.hpp"
#include "core/scene/camera_rays.hpp"
#include "scenes/formats/scene_file.hpp"
#include "simd/isa/isa.hpp"
#include "simd/query/query.hpp"
#include "simd/threads/threads.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace raylane::bench {

namespace {

using core::Ray;
using core::Vec3d;
using core::Vec3f;

constexpr float infinity = std::numeric_limits<float>::infinity();

void add_spheres(core::SceneBuilder& builder, int count) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    const float radius = 0.3F / std::cbrt(static_cast<float>(count));
    builder.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        Vec3f center;
        for (int axis = 0; axis < 3; ++axis)
            center[axis] = uniform(engine);
        builder.add(core::Sphere{center, radius}, 0);
    }
}

/// Adds a lattice: each node has a ball, and a stick in the direction of each axis. Sticks are
/// cylinders where the sum of the node's coordinates is even, otherwise cones.
void add_sticks(core::SceneBuilder& builder, int count) {
    const int n = std::max(1, static_cast<int>(std::lround(std::cbrt(count / 4.0))));
    const float spacing = 1.0F / static_cast<float>(n);
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const Vec3f node = spacing * Vec3f(core::convert<float>(core::Vec3<int>(x, y, z)));
                builder.add(core::Sphere{node, 0.2F * spacing}, 0);
                for (int axis = 0; axis < 3; ++axis) {
                    Vec3f stick(0.0F);
                    stick[axis] = spacing;
                    if ((x + y + z) % 2 == 0)
                        builder.add(core::CappedCylinder{node, stick, 0.08F * spacing}, 0);
                    else
                        builder.add(core::CappedCone{node, stick, 0.12F * spacing, 0.04F * spacing},
                                    0);
                }
            }
}

/// Visits the pixels in squares of 64 x 64, in Morton order within each, as a wavefront does in its
/// tiles.
template <class Visit>
void for_each_pixel(int side, const Visit& visit) {
    constexpr int tile = 64;
    for (int top = 0; top < side; top += tile)
        for (int left = 0; left < side; left += tile)
            for (int code = 0; code < tile * tile; ++code) {
                int x = left, y = top;
                for (int bit = 0; bit < 6; ++bit) {
                    x += (code >> 2 * bit & 1) << bit;
                    y += (code >> (2 * bit + 1) & 1) << bit;
                }
                if (x < side && y < side) visit(x, y);
            }
}

Vec3f light_of(const core::Scene& scene) {
    for (const core::Light& light : scene.lights())
        if (light.kind == core::LightKind::point) return light.position;
    return {2.0F, 3.0F, 1.5F};
}

Ray<float> in_float(const Ray<double>& ray) {
    return {core::convert<float>(ray.origin), core::convert<float>(ray.direction)};
}

simd::Coherence coherence_at(const Vec3f& apex, bool towards) {
    return {{apex.x, apex.y, apex.z}, towards, false, false, false};
}

/// Returns the direction of an image's first sample of a sky.
Vec3d to_sky(const Vec3d& normal, std::size_t pixel) {
    const core::SoftLight sky = core::prepared({core::LightKind::sky});
    const auto number = static_cast<std::uint32_t>(pixel);
    const core::SamplePoint point =
        core::sequence_point(core::sequence_key(number, 0, core::on_first_light), 0);
    const auto [x, y, z] = core::SoftLightSampler<double>(sky)
                               .sample({0.0, 0.0, 0.0}, {normal.x, normal.y, normal.z},
                                       static_cast<double>(point.x), static_cast<double>(point.y))
                               .direction;
    return {x, y, z};
}

/// A ray of a set, and where it hits.
struct RayHit {
    std::size_t number; ///< of the ray
    Ray<double> ray;
    Vec3d point, normal;
    double t, cos; ///< cos of the angle from the normal to the ray
    std::uint32_t slot, bits;

    /// Adds a ray that goes from here.
    void add_to(RaySet& set, const simd::SceneData& scene, const Vec3d& direction,
                float t_limit = infinity) const {
        set.add_from({point, direction}, t_limit, scene, slot, bits, t);
    }
    /// Returns a random direction above the surface, on the ray's side.
    Vec3d scattered() const { return to_sky(cos > 0.0 ? -normal : normal, number); }
};

/// Calls visit(hit) for the rays that hit anything.
template <class Visit>
void for_each_hit(const simd::SceneData& data, const RaySet& rays, const Visit& visit) {
    const simd::Tracing tracing{&simd::kernels_of(simd::best_isa())};
    simd::Query finder(data, tracing, simd::Asked::points);
    const simd::Arena arena =
        simd::arena_for([&](simd::Arena& a) { finder.take_from(a, RaySet::wave); });
    simd::EngineCounters counters;
    for (std::size_t begin = 0; begin < rays.count; begin += RaySet::wave) {
        const simd::Paths paths = rays.paths(begin, RaySet::wave);
        finder.nearest(paths, &*rays.coherence, counters);
        const simd::Hits& hits = finder.hits();
        for (std::size_t lane = 0; lane < paths.count; ++lane) {
            if (hits.slot[lane] == simd::no_slot) continue;
            const Ray<double> ray = rays.ray(begin + lane);
            const Vec3d normal(hits.normal[0][lane], hits.normal[1][lane], hits.normal[2][lane]);
            visit(RayHit{begin + lane, ray, core::mul_add(hits.t[lane], ray.direction, ray.origin),
                         normal, hits.t[lane], core::dot(normal, ray.direction), hits.slot[lane],
                         hits.hit[lane]});
        }
    }
}

} // namespace

core::Scene make_workload(const std::string& name, simd::Isa isa) {
    simd::ParallelWorkers workers(1, simd::node_width_of(isa));
    const std::size_t slash = name.find('/');
    const std::string kind = name.substr(0, slash);
    if (kind != "spheres" && kind != "sticks")
        return scenes::load_scene(name, {.workers = &workers});
    int count = 0;
    const char* const end = name.data() + name.size();
    if (slash == std::string::npos ||
        std::from_chars(name.data() + slash + 1, end, count).ptr != end || count < 1)
        throw std::invalid_argument("must be spheres/N or sticks/N, got " + name);
    core::SceneBuilder builder;
    builder.workers = &workers;
    builder.wants_light = false;
    builder.camera.from = {1.9F, 1.4F, 2.3F};
    builder.camera.at = Vec3f(0.5F);
    builder.camera.field_of_view = 30.0F;
    builder.add_material({});
    (kind == "spheres" ? add_spheres : add_sticks)(builder, count);
    return std::move(builder).build();
}

simd::Paths RaySet::paths(std::size_t begin, std::size_t most) const {
    // Paths have no read-only arrays.
    const auto from = [&]<class Value>(const std::vector<Value>& column) {
        return const_cast<Value*>(column.data()) + begin;
    };
    simd::Paths paths{};
    for (int axis = 0; axis < 3; ++axis) {
        paths.origin[axis] = from(origin_[axis]);
        paths.direction[axis] = from(direction_[axis]);
    }
    paths.origin_first = from(origin_first_);
    paths.origin_last = from(origin_last_);
    paths.origin_slot = from(origin_slot_);
    paths.origin_bits = from(departure_);
    paths.count = std::min(most, count - begin);
    return paths;
}

Ray<double> RaySet::ray(std::size_t i) const {
    return {{origin_[0][i], origin_[1][i], origin_[2][i]},
            {direction_[0][i], direction_[1][i], direction_[2][i]}};
}

core::Ray<float> RaySet::ray_in_float(std::size_t i) const {
    return in_float_[i];
}

bool RaySet::leaves_any() const {
    return std::any_of(origin_slot_.begin(), origin_slot_.end(),
                       [](std::uint32_t slot) { return slot != simd::no_slot; });
}

void RaySet::reserve(std::size_t rays) {
    const std::size_t padded = rays + 16;
    for (auto* columns : {&origin_, &direction_})
        for (auto& column : *columns)
            column.reserve(padded);
    in_float_.reserve(padded);
    t_limit_.reserve(padded);
    t_lowest_.reserve(padded);
    for (auto* column : {&origin_first_, &origin_last_, &origin_slot_, &departure_})
        column->reserve(padded);
}

void RaySet::add(const Ray<double>& ray, float t_limit) {
    const Ray<float> asked = in_float(ray);
    append({core::convert<double>(asked.origin),
            core::normalized(core::convert<double>(asked.direction))},
           asked, t_limit);
}

void RaySet::append(const Ray<double>& ray, const Ray<float>& in_float, float t_limit) {
    for (int axis = 0; axis < 3; ++axis) {
        origin_[axis].push_back(ray.origin[axis]);
        direction_[axis].push_back(ray.direction[axis]);
    }
    in_float_.push_back(in_float);
    t_limit_.push_back(t_limit);
    t_lowest_.push_back(0.0F);
    for (auto* column : {&origin_first_, &origin_last_, &origin_slot_})
        column->push_back(simd::no_slot);
    departure_.push_back(0);
    ++count;
}

/// Adds a ray from a hit. t_lowest is that of Embree's path tracer (tutorials/pathtracer): 32 times
/// the precision of the largest number from which the hit was computed.
void RaySet::add_from(const Ray<double>& ray, float t_limit, const simd::SceneData& scene,
                      std::uint32_t slot, std::uint32_t hit, double t) {
    append(ray, in_float(ray), t_limit);
    double largest = t;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, std::abs(ray.origin[axis]));
    t_lowest_.back() = 32.0F * std::numeric_limits<float>::epsilon() * static_cast<float>(largest);
    paths(count - 1, 1).start_on(0, slot, scene.record_of(slot), hit, /*through=*/false);
}

void RaySet::finish() {
    const std::size_t rays = count;
    for (int i = 0; i < 16; ++i)
        add({Vec3d(0.0), Vec3d(0.0, 0.0, 1.0)}, 0.0F);
    count = rays;
}

std::vector<RaySet> make_ray_sets(const core::Scene& scene, const simd::SceneData& data, int side) {
    const auto pixels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    std::vector<RaySet> sets(std::size(ray_set_names));
    RaySet &camera = sets[0], &scanlines = sets[1], &mirror = sets[2], &diffuse = sets[3],
           &diffuse_2 = sets[4], &shadow = sets[5], &sky = sets[6], &ambient = sets[7],
           &random = sets[8], &occlusion = sets[9];
    for (std::size_t i = 0; i < sets.size(); ++i)
        sets[i].name = ray_set_names[i];
    for (RaySet* set : {&shadow, &sky, &ambient, &occlusion})
        set->occlusion = true;
    camera.coherence = scanlines.coherence = coherence_at(scene.camera().from, false);
    for (RaySet* set : {&mirror, &diffuse, &diffuse_2, &sky, &ambient})
        set->coherence = simd::neighbours;
    shadow.coherence = coherence_at(light_of(scene), true);
    for (RaySet& set : sets)
        set.reserve(pixels);

    core::Settings settings;
    settings.width = settings.height = side;
    const core::CameraRays<double> rays(scene.camera(), settings);
    for_each_pixel(side, [&](int x, int y) { camera.add(rays.ray(x, y, 0), infinity); });
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            scanlines.add(rays.ray(x, y, 0), infinity);
    camera.finish();

    const core::Bounds& bounds = scene.hierarchy().bounds;
    const Vec3d lower = core::convert<double>(bounds.lower);
    const Vec3d size = core::convert<double>(bounds.upper) - lower;
    const auto near = static_cast<float>(0.05 * std::max({size.x, size.y, size.z}));
    const Vec3d light = core::convert<double>(light_of(scene));
    for_each_hit(data, camera, [&](const RayHit& hit) {
        hit.add_to(mirror, data,
                   core::normalized(Vec3d(hit.ray.direction - 2.0 * hit.cos * hit.normal)));
        hit.add_to(diffuse, data, hit.scattered());
        hit.add_to(sky, data, hit.scattered());
        hit.add_to(ambient, data, hit.scattered(), near);
        const Vec3d to_light = light - hit.point;
        if (core::dot(to_light, hit.normal) * hit.cos > 0.0) return; // in the shape's shadow
        const double distance = core::length(to_light);
        hit.add_to(shadow, data, to_light / distance, static_cast<float>(distance));
    });
    diffuse.finish();
    for_each_hit(data, diffuse,
                 [&](const RayHit& hit) { hit.add_to(diffuse_2, data, hit.scattered()); });

    std::mt19937_64 engine(2);
    const auto any_point = [&] {
        Vec3d point;
        for (int axis = 0; axis < 3; ++axis)
            point[axis] =
                lower[axis] + size[axis] * std::uniform_real_distribution<double>(0.0, 1.0)(engine);
        return point;
    };
    for (std::size_t i = 0; i < pixels / 4; ++i) {
        const Vec3d from = any_point(), to = any_point();
        const double distance = core::length(to - from);
        const Ray<double> ray{from, (to - from) / distance};
        random.add(ray, infinity);
        occlusion.add(ray, static_cast<float>(distance));
    }
    for (RaySet* set :
         {&scanlines, &mirror, &diffuse_2, &shadow, &sky, &ambient, &random, &occlusion})
        set->finish();
    return sets;
}

} // namespace raylane::bench
