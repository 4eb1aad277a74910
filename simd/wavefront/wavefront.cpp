#include "simd/wavefront/wavefront.hpp"

#include "core/numbers/infinity.hpp"
#include "core/optics/fog.hpp"
#include "core/optics/optics.hpp"
#include "core/reference/enclosing.hpp"
#include "core/reference/surface_color.hpp"
#include "simd/query/as_core.hpp"
#include "simd/wavefront/camera_view.hpp"
#include "simd/wavefront/coherence.hpp"

#include <algorithm>
#include <numeric>

namespace raylane::simd {

Wavefront::Wavefront(const SceneData& scene, const core::Settings& settings, const Tracing& tracing,
                     core::Survey* survey, const std::atomic<bool>* abandon)
    : scene_(scene), settings_(settings), tracing_(tracing), abandon_(abandon),
      camera_rays_(scene.scene().camera(), settings), camera_(view_of(camera_rays_)),
      camera_coherence_(camera_rays_.has_lens() ? neighbours : coherence_of(camera_)),
      with_media_(scene.scene().transmissive().any),
      transparent_(std::any_of(scene.scene().materials().begin(), scene.scene().materials().end(),
                               [](const core::Material& m) { return m.is_transparent(); })),
      shade_(tracing.kernels
                 ->shade[with_media_ ? 1 : 0][scene.fog().kind != core::FogKind::none ? 1 : 0]),
      reference_(scene.scene(), settings, core::Search::hierarchy, tracing.precision),
      finder_(scene, tracing), shadows_(scene, tracing, reference_, settings.transparent_shadows),
      survey_(survey), light_rays_(core::light_rays_of(scene.scene(), settings)), sorted_(scene) {
    arena_ = arena_for([this](Arena& arena) { take_from(arena); });
    samples_.reserve(chunk_samples);
    names_.resize(chunk_samples);
    light_keys_.resize(scene.soft_lights().empty() ? 0 : wave_rays);
    first_points_.resize(light_keys_.size());
    pending_.reserve(64);
    if (transparent_) position_of_.resize(wave_rays);
    constexpr std::size_t max_pixels = static_cast<std::size_t>(max_region) * max_region;
    if (settings.quality == 0.0F) {
        common_samples_ = settings.grid * settings.grid;
        for (int number = 0; camera_rays_.regular() && number < common_samples_; ++number)
            cells_.push_back(camera_rays_.in_pixel(0, 0, number));
        sums_.reserve(max_pixels);
        transmittances_.reserve(settings.alpha ? max_pixels : 0);
        return;
    }
    to_quality_.emplace(scene.scene(), settings, *survey);
    first_shape_.resize(chunk_samples);
    cost_.resize(chunk_samples);
}

void Wavefront::take_from(Arena& arena) {
    // Each ray may spawn a reflected ray, a transmitted one, and one that goes straight on.
    const std::size_t max_spawned = wave_rays * (transparent_ ? 3 : 2);
    const auto take_paths = [&](Paths& paths, std::size_t capacity) {
        paths.take_from(arena, capacity, with_media_);
        if (transparent_)
            paths.take_passed_from(arena, capacity, scene_.fog().kind != core::FogKind::none);
    };
    take_paths(paths_, max_spawned);
    take_paths(next_, max_spawned);
    finder_.take_from(arena, wave_rays);
    way_ = arena.take<double>(wave_rays);
    const std::vector<core::Material>& materials = scene_.scene().materials();
    if (std::any_of(materials.begin(), materials.end(), [](const core::Material& material) {
            return material.pattern.needs_shape();
        })) {
        arena.take(on_shape_, wave_rays);
        arena.take(pattern_, wave_rays);
    }
    across_ = arena.take<double>(chunk_samples);
    upward_ = arena.take<double>(chunk_samples);
    if (camera_rays_.has_lens()) {
        lens_right_ = arena.take<double>(chunk_samples);
        lens_up_ = arena.take<double>(chunk_samples);
    }
    arena.take(radiance_, chunk_samples);
    if (settings_.alpha) transmittance_ = arena.take<double>(chunk_samples);
    sorted_.take_from(arena, wave_rays);
    for (auto* columns :
         {&surfaces_.point, &surfaces_.flat_normal, &surfaces_.normal, &surfaces_.direction,
          &surfaces_.throughput, &surfaces_.own, &surfaces_.radiance})
        arena.take(*columns, wave_rays);
    if (transparent_) arena.take(surfaces_.behind, wave_rays);
    if (with_media_) {
        media_.index_before = arena.take<double>(wave_rays);
        media_.index_behind = arena.take<double>(wave_rays);
        media_.inside = arena.take<double>(wave_rays);
        arena.take(media_.absorption, wave_rays);
        take_spawned(arena, transmitted_, wave_rays);
    }
    shadows_.take_from(arena, wave_rays, with_media_);
    if (!scene_.soft_lights().empty()) {
        light_u_ = arena.take<double>(wave_rays);
        light_v_ = arena.take<double>(wave_rays);
    }
    take_paths(deferred_, deferred_waves * max_spawned); // last: rarely touched
}

EngineCounters Wavefront::counters() const {
    EngineCounters counters = counters_;
    counters += reference_.counters();
    return counters;
}

core::CameraRays<double>::InPixel Wavefront::in_pixel(const Samples& pixel_samples,
                                                      int number) const {
    if (to_quality_) {
        const int common = number + common_samples_;
        if (number < 0) return cells_[static_cast<std::size_t>(common)];
        const core::SamplePoint place =
            core::place_in_pixel({pixel_samples.x, pixel_samples.y, number});
        return camera_rays_.filtered({static_cast<double>(place.x), static_cast<double>(place.y)});
    }
    return camera_rays_.regular() ? cells_[static_cast<std::size_t>(number)]
                                  : camera_rays_.in_pixel(pixel_samples.x, pixel_samples.y, number);
}

void Wavefront::start(std::size_t count) {
    std::size_t filled = 0;
    for (const Samples& pixel_samples : samples_)
        for (int number = pixel_samples.first; number < pixel_samples.first + pixel_samples.count;
             ++number) {
            const auto point = camera_rays_.point_at(pixel_samples.x, pixel_samples.y,
                                                     in_pixel(pixel_samples, number));
            across_[filled] = point.across;
            upward_[filled] = point.upward;
            names_[filled++] = {pixel_samples.x, pixel_samples.y, number, common_samples_};
        }
    if (camera_rays_.has_lens())
        for (std::size_t i = 0; i < count; ++i) {
            const auto point = camera_rays_.on_lens(names_[i].x, names_[i].y, names_[i].number);
            lens_right_[i] = point.right;
            lens_up_[i] = point.up;
        }
    for (double* channel : radiance_)
        std::fill_n(channel, count, 0.0);
    if (settings_.alpha) std::fill_n(transmittance_, count, 0.0);
    if (is_surveying_) std::fill_n(cost_.begin(), count, 0.0);
    paths_.count = count;
    tracing_.kernels->rays.camera_rays(camera_, count, across_, upward_, lens_right_, lens_up_,
                                       paths_.origin, paths_.direction);
    for (double* channel : paths_.throughput)
        std::fill_n(channel, count, 1.0);
    std::iota(paths_.sample, paths_.sample + count, 0U);
    paths_.start_nowhere(0, count);
    if (transparent_)
        for (std::size_t lane = 0; lane < count; ++lane)
            paths_.set_passed(lane, 0, 0.0);
    if (with_media_ && (camera_.orthographic || camera_rays_.has_lens()))
        start_in_media();
    else if (with_media_)
        std::fill_n(paths_.media, count, reference_.media_around(ray_of(paths_, 0).origin));
    counters_.primary += count;
}

/// Finds the media around neighbouring origins together: they are rarely inside of a body.
void Wavefront::start_in_media() {
    constexpr std::size_t together = 64;
    const core::Scene& scene = scene_.scene();
    for (std::size_t first = 0; first < paths_.count; first += together) {
        const std::size_t end = std::min(first + together, paths_.count);
        core::Bounds origins;
        for (std::size_t i = first; i < end; ++i)
            core::include_point(origins, ray_of(paths_, i).origin);
        const bool may_be = core::may_be_in_body(scene, origins);
        for (std::size_t i = first; i < end; ++i)
            paths_.set_media(i, reference_.media_around(ray_of(paths_, i).origin, may_be));
    }
}

void Wavefront::add(std::uint32_t sample, double r, double g, double b) {
    radiance_[0][sample] += r;
    radiance_[1][sample] += g;
    radiance_[2][sample] += b;
}

void Wavefront::trace() {
    int depth = 0;
    coherent_ = true;
    next_coherence_ = camera_coherence_;
    for (;;) {
        next_.count = 0;
        if (paths_.count != 0) trace_wave(depth, std::exchange(next_coherence_, neighbours));
        std::swap(paths_, next_);
        ++depth;
        if (paths_.count > wave_rays) split_next(depth);
        if (paths_.count == 0) {
            if (pending_.empty()) return;
            take_deferred(depth);
            coherent_ = false;
            next_coherence_ = neighbours;
        }
    }
}

void Wavefront::trace_wave(int depth, const Coherence& coherence) {
    finder_.nearest(paths_, &coherence, counters_);
    if (is_surveying_) count_costs();
    const bool is_first = to_quality_ && depth == 0;
    if (is_first) note_first_hits();
    for (const std::uint32_t lane : finder_.at_contacts()) { // where several surfaces meet
        follow(lane, depth);
        if (is_first) first_shape_[paths_.sample[lane]] = reference_.first_hit().shape;
    }
    sorted_.sort(finder_.hits().slot, paths_.count, finder_.at_contacts(), paths_.passed,
                 static_cast<std::uint32_t>(settings_.max_transparent));
    see_background(depth);
    shade(depth);
}

/// Adds each ray of the wave, and its rays to lights, to the cost of its sample. The reference
/// counts those that it follows.
void Wavefront::count_costs() {
    const auto cost_of = [&](std::size_t lane) {
        return finder_.hits().slot[lane] != no_slot ? 1.0 + light_rays_ : 1.0;
    };
    for (std::size_t lane = 0; lane < paths_.count; ++lane)
        cost_[paths_.sample[lane]] += cost_of(lane);
    for (const std::uint32_t lane : finder_.at_contacts())
        cost_[paths_.sample[lane]] -= cost_of(lane);
}

void Wavefront::note_first_hits() {
    for (std::size_t lane = 0; lane < paths_.count; ++lane) {
        const std::uint32_t slot = finder_.hits().slot[lane];
        first_shape_[paths_.sample[lane]] = slot != no_slot ? scene_.id_of(slot) : core::no_shape;
    }
}

/// Lets the reference tracer follow a lane to its end.
void Wavefront::follow(std::size_t lane, int depth) {
    ++counters_.followed;
    const core::Vec3d throughput(paths_.throughput[0][lane], paths_.throughput[1][lane],
                                 paths_.throughput[2][lane]);
    reference_.set_sample(names_[paths_.sample[lane]]);
    const double cost_before = reference_.cost();
    const core::Vec3d light = reference_.light_along(
        {ray_of(paths_, lane), origin_surfaces_of(scene_, paths_, lane), paths_.media_at(lane),
         throughput, depth_of(lane, depth),
         /*crossings=*/0, static_cast<int>(paths_.passed_at(lane)), paths_.travelled_at(lane),
         /*is_straight=*/depth_of(lane, depth) == 0});
    add(paths_.sample[lane], light.x, light.y, light.z);
    if (settings_.alpha) transmittance_[paths_.sample[lane]] += reference_.transmittance();
    if (is_surveying_) cost_[paths_.sample[lane]] += reference_.cost() - cost_before;
}

core::Vec3d Wavefront::background_along(std::size_t lane) {
    const core::Scene& scene = scene_.scene();
    const core::Vec3d color = core::convert<double>(scene.background());
    if (const core::Media media = paths_.media_at(lane); media != core::empty_space) {
        const core::MaterialIndex medium = reference_.media().top(media);
        return core::let_through_medium(scene.materials()[medium], core::infinity<double>) * color;
    }
    if (scene.fog().kind == core::FogKind::none) return color;
    const core::Ray<double> ray = ray_of(paths_, lane);
    const double fog = core::fog_fraction_at_infinity(scene.fog(), ray.origin, ray.direction);
    return (1.0 - fog) * color + fog * core::convert<double>(scene.fog().color);
}

/// Same as in core::ReferenceTracer.
double Wavefront::transmittance_to_infinity(std::size_t lane) {
    core::Vec3d share(paths_.throughput[0][lane], paths_.throughput[1][lane],
                      paths_.throughput[2][lane]);
    if (const core::Media media = paths_.media_at(lane); media != core::empty_space)
        share *= core::let_through_medium(scene_.scene().materials()[reference_.media().top(media)],
                                          core::infinity<double>);
    return core::mean_of_channels(share);
}

void Wavefront::see_background(int depth) {
    for (const std::uint32_t lane : sorted_.missed()) {
        if (settings_.alpha && depth_of(lane, depth) == 0) {
            transmittance_[paths_.sample[lane]] += transmittance_to_infinity(lane);
            continue;
        }
        const core::Vec3d color = background_along(lane);
        add(paths_.sample[lane], paths_.throughput[0][lane] * color.x,
            paths_.throughput[1][lane] * color.y, paths_.throughput[2][lane] * color.z);
    }
}

/// Fills in the media as core::ReferenceTracer does in `indices_at`.
void Wavefront::fill_media() {
    core::MediaStacks& stacks = reference_.media();
    for (const Run& run : sorted_.runs()) {
        const bool transmits = run.material->transmits;
        for (std::size_t i = run.begin; i < run.end; ++i) {
            const std::uint32_t lane = sorted_.order()[i];
            const SceneData::ShapeRecord shape = scene_.record_of(finder_.hits().slot[lane]);
            const bool entering = shape.is_entered(finder_.hits().hit[lane]);
            const core::Media media = paths_.media_at(lane);
            const SceneData::Medium& before = scene_.medium(
                stacks.before(media, shape.medium,
                              scene_.scene().materials()[shape.medium].transmits(), entering));
            media_.inside[i] = before.inside;
            media_.index_before[i] = before.index;
            for (int channel = 0; channel < 3; ++channel)
                media_.absorption[channel][i] = before.absorption[channel];
            media_.index_behind[i] = scene_.medium(shape.medium).index;
            if (entering || !transmits) continue;
            media_.index_behind[i] =
                scene_.medium(stacks.top(stacks.left(media, shape.medium))).index;
        }
    }
}

/// Computes coordinates on shapes, points in their space and colours of images, for patterns that
/// need them.
void Wavefront::fill_patterns(HitPaths& hit_paths) {
    std::copy_n(on_shape_, 2, hit_paths.on_shape);
    std::copy_n(pattern_, 3, hit_paths.pattern);
    const std::vector<core::Material>& materials = scene_.scene().materials();
    for (const Run& run : sorted_.runs()) {
        const auto material = static_cast<std::size_t>(run.material - scene_.materials().data());
        if (material >= materials.size() || !materials[material].pattern.needs_shape()) continue;
        const core::Pattern& pattern = materials[material].pattern;
        for (std::size_t i = run.begin; i < run.end; ++i) {
            const std::uint32_t lane = sorted_.order()[i];
            const std::uint32_t slot = finder_.hits().slot[lane];
            core::Vec3d point;
            for (int axis = 0; axis < 3; ++axis)
                point[axis] = core::mul_add(hit_paths.way[lane], hit_paths.direction[axis][lane],
                                            hit_paths.origin[axis][lane]); // as in the kernels
            const SceneData::ShapeRecord shape = scene_.record_of(slot);
            const core::SurfacePlace surface{
                shape.id, shape.kind, scene_.place_of(slot),
                static_cast<core::Face>(hit_paths.hit[lane] & hit_face), point};
            core::PatternPlace at{};
            if (pattern.is_on_surface())
                at.point = core::color_on(scene_.scene(), pattern, surface);
            else
                at = core::place_in_pattern(scene_.scene(), pattern, surface);
            for (int axis = 0; axis < 3; ++axis)
                pattern_[axis][lane] = at.point[axis];
            on_shape_[0][lane] = at.on_shape.u;
            on_shape_[1][lane] = at.on_shape.v;
        }
    }
}

void Wavefront::shade(int depth) {
    if (sorted_.runs().empty()) return;
    if (with_media_) fill_media();
    const Hits& hits = finder_.hits();
    HitPaths hit_paths{};
    for (int axis = 0; axis < 3; ++axis) {
        hit_paths.origin[axis] = paths_.origin[axis];
        hit_paths.direction[axis] = paths_.direction[axis];
        hit_paths.throughput[axis] = paths_.throughput[axis];
        hit_paths.normal[axis] = hits.normal[axis];
        hit_paths.shading_normal[axis] = hits.shading_normal[axis];
    }
    hit_paths.t = hits.t;
    hit_paths.travelled = paths_.travelled;
    hit_paths.way = hits.t;
    if (!finder_.points().empty()) {
        std::copy_n(hits.t, paths_.count, way_);
        for (const auto& [lane, point] : finder_.points()) {
            paths_.move_to(lane, point); // the previous origin is no longer needed
            way_[lane] = 0.0;
        }
        hit_paths.way = way_;
    }
    hit_paths.hit = hits.hit;
    if (pattern_[0] != nullptr) fill_patterns(hit_paths);
    for (const Run& run : sorted_.runs())
        shade_.surfaces(run, sorted_.order(), hit_paths, scene_.fog(),
                        with_media_ ? &media_ : nullptr, surfaces_);
    for (std::size_t i = 0; i < sorted_.hit_count(); ++i)
        add(paths_.sample[sorted_.order()[i]], surfaces_.radiance[0][i], surfaces_.radiance[1][i],
            surfaces_.radiance[2][i]);
    looked_ = false;
    add_lights();
    add_soft_lights(depth);
    if (depth < settings_.max_depth || transparent_) spawn(depth);
}

/// Sets the wave for shadow rays, before the first of them to any light.
void Wavefront::look_at_lights() {
    if (std::exchange(looked_, true)) return;
    shadows_.look_at({paths_, finder_.hits(), sorted_.order(), sorted_.hit_count(), coherent_});
}

void Wavefront::add_lights() {
    for (const LightView& light : scene_.lights()) {
        SpawnedRays& rays = shadows_.rays();
        rays.count = 0;
        for (const Run& run : sorted_.runs())
            if (run.material->diffuse > 0.0 || run.material->specular > 0.0)
                shade_.light(run, light, surfaces_, rays);
        if (rays.count == 0) continue;
        look_at_lights();
        shadows_.trace(light, counters_);
        add_what_arrives();
    }
}

/// Samples lights with a size, sample after sample of each light, as
/// core::ReferenceTracer::lit_softly.
void Wavefront::add_soft_lights(int depth) {
    const std::vector<core::SoftLight>& lights = scene_.soft_lights();
    const auto samples = static_cast<std::uint32_t>(settings_.light_rays());
    const bool is_hard = settings_.light_samples == core::Settings::hard_light;
    const std::size_t count = sorted_.hit_count();
    for (std::uint32_t number = 0; number < lights.size(); ++number) {
        const core::SoftLight& light = lights[number];
        for (std::size_t i = 0; i < count; ++i) {
            const core::SampleName& sample = names_[paths_.sample[sorted_.order()[i]]];
            const core::PointRange points = core::points_on_light(
                sample, samples, depth, number, static_cast<std::uint32_t>(lights.size()));
            light_keys_[i] = points.key;
            first_points_[i] = points.first;
        }
        for (std::uint32_t k = 0; k < samples; ++k) {
            if (is_hard) {
                const core::SamplePoint middle = core::middle_of(light);
                std::fill_n(light_u_, count, static_cast<double>(middle.x));
                std::fill_n(light_v_, count, static_cast<double>(middle.y));
            } else {
                shade_.light_points(count, light_keys_.data(), first_points_.data(), k, light_u_,
                                    light_v_);
            }
            SpawnedRays& rays = shadows_.rays();
            rays.count = 0;
            for (const Run& run : sorted_.runs())
                if (run.material->diffuse > 0.0 ||
                    (run.material->specular > 0.0 && light.kind != core::LightKind::sky))
                    shade_.soft_light(run, light, 1.0 / static_cast<double>(samples), light_u_,
                                      light_v_, surfaces_, rays);
            if (rays.count == 0) continue;
            look_at_lights();
            if (is_hard && light.kind == core::LightKind::sky)
                shadows_.let_pass();
            else
                shadows_.trace_softly(counters_);
            add_what_arrives();
        }
    }
}

void Wavefront::add_what_arrives() {
    const SpawnedRays& rays = shadows_.rays();
    for (std::size_t k = 0; k < rays.count; ++k)
        if (shadows_.arrives(k))
            add(paths_.sample[sorted_.order()[static_cast<std::size_t>(rays.parent[k])]],
                rays.weight[0][k], rays.weight[1][k], rays.weight[2][k]);
}

} // namespace raylane::simd
