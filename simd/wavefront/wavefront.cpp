#include "simd/wavefront/wavefront.hpp"

#include "core/fog.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace raylane::simd {

namespace {

bool any_transmits(const core::Scene& scene) {
    return std::any_of(scene.materials().begin(), scene.materials().end(),
                       [](const core::Material& material) { return material.transmits(); });
}

void take(Arena& arena, SpawnedRays& rays, std::size_t capacity) {
    arena.take(rays.origin, capacity);
    arena.take(rays.direction, capacity);
    arena.take(rays.weight, capacity);
    rays.distance = arena.take<double>(capacity);
    rays.parent = arena.take<double>(capacity);
}

/// Every second bit of a Morton code.
constexpr int even_bits(unsigned code) {
    int result = 0;
    for (int bit = 0; bit < 8; ++bit)
        result |= static_cast<int>(code >> 2 * bit & 1U) << bit;
    return result;
}

/// The pixels of a region in the order of their Morton codes: neighbours in the picture are
/// neighbours in a packet.
constexpr auto pixel_order = [] {
    struct Pixel {
        std::uint8_t x, y;
    };
    constexpr unsigned codes = Wavefront::max_region * Wavefront::max_region;
    std::array<Pixel, codes> order{};
    for (unsigned code = 0; code < codes; ++code)
        order[code] = {static_cast<std::uint8_t>(even_bits(code)),
                       static_cast<std::uint8_t>(even_bits(code >> 1))};
    return order;
}();

CameraView view_of(const core::CameraRays<double>& rays) {
    CameraView view{};
    for (int axis = 0; axis < 3; ++axis) {
        view.from[axis] = rays.from()[axis];
        view.forward[axis] = rays.forward()[axis];
        view.right[axis] = rays.right()[axis];
        view.up[axis] = rays.up()[axis];
    }
    view.orthographic = rays.orthographic();
    return view;
}

Bundle bundle_of(const CameraView& camera) {
    Bundle bundle{};
    for (int axis = 0; axis < 3; ++axis)
        bundle.apex[axis] = static_cast<float>(camera.from[axis]);
    bundle.parallel = camera.orthographic;
    return bundle;
}

Bundle bundle_of(const LightView& light) {
    Bundle bundle{};
    for (int axis = 0; axis < 3; ++axis)
        bundle.apex[axis] = static_cast<float>(light.position[axis]);
    bundle.towards = light.is_point;
    bundle.parallel = !light.is_point;
    return bundle;
}

} // namespace

Wavefront::Wavefront(const SceneData& scene, const core::Settings& settings, const Kernels& kernels)
    : scene_(scene), settings_(settings), kernels_(kernels),
      camera_rays_(scene.scene().camera(), settings), camera_(view_of(camera_rays_)),
      camera_bundle_(bundle_of(camera_)), with_media_(any_transmits(scene.scene())),
      shade_(kernels.shade[with_media_ ? 1 : 0][scene.fog().kind != 0 ? 1 : 0]),
      reference_(scene.scene(), settings), finder_(scene, kernels, &reference_),
      walker_(scene, kernels, &reference_) {
    Arena measure;
    take_from(measure);
    arena_ = Arena(measure.used());
    take_from(arena_);
    samples_.reserve(chunk_samples);
    runs_.reserve(wave_rays);
    pending_.reserve(64);
    if (camera_rays_.regular())
        for (int number = 0; number < settings.grid * settings.grid; ++number)
            cells_.push_back(camera_rays_.in_pixel(0, 0, number));
    sums_.reserve(static_cast<std::size_t>(max_region) * max_region);
}

void Wavefront::take_from(Arena& arena) {
    paths_.take_from(arena, 2 * wave_rays, with_media_);
    next_.take_from(arena, 2 * wave_rays, with_media_);
    finder_.take_from(arena, wave_rays);
    across_ = arena.take<double>(chunk_samples);
    upward_ = arena.take<double>(chunk_samples);
    arena.take(radiance_, chunk_samples);
    keys_ = arena.take<std::uint32_t>(wave_rays);
    order_ = arena.take<std::uint32_t>(wave_rays);
    scratch_ = arena.take<std::uint32_t>(wave_rays);
    for (auto* columns :
         {&surfaces_.point, &surfaces_.flat_normal, &surfaces_.normal, &surfaces_.direction,
          &surfaces_.throughput, &surfaces_.own, &surfaces_.radiance})
        arena.take(*columns, wave_rays);
    if (with_media_) {
        media_.index_before = arena.take<double>(wave_rays);
        media_.index_behind = arena.take<double>(wave_rays);
        media_.inside = arena.take<double>(wave_rays);
        arena.take(media_.absorption, wave_rays);
        take(arena, transmitted_, wave_rays);
    }
    take(arena, shadows_, wave_rays);
    shadow_paths_.departed_first = arena.take<std::uint32_t>(wave_rays);
    shadow_paths_.departed_last = arena.take<std::uint32_t>(wave_rays);
    arena.take(shadow_rounded_.origin, wave_rays);
    arena.take(shadow_rounded_.direction, wave_rays);
    shadow_rounded_.slack = arena.take<float>(wave_rays);
    shadow_t_most_ = arena.take<float>(wave_rays);
    occlusions_.t_most = shadow_t_most_;
    occlusions_.state = arena.take<std::uint8_t>(wave_rays);
    shadow_pending_ = pending_for(scene_, arena);
    walker_.take_from(arena, wave_rays);
    walk_.take_from(arena, wave_rays, with_media_);
    walk_distance_ = arena.take<double>(wave_rays);
    deferred_.take_from(arena, deferred_rays, with_media_); // last: rarely touched
}

core::Counters Wavefront::counters() const {
    core::Counters all = counters_;
    all += reference_.counters();
    all.shadow -= counted_twice_;
    return all;
}

void Wavefront::render(const core::Region& region, core::Film& film) {
    const int width = region.x1 - region.x0, height = region.y1 - region.y0;
    const int samples = settings_.grid * settings_.grid;
    sums_.assign(static_cast<std::size_t>(width) * height, core::Vec3d(0.0));

    std::size_t filled = 0;
    const auto flush = [&] {
        start(filled);
        trace();
        std::size_t i = 0;
        for (const Samples& some : samples_) {
            core::Vec3d& total =
                sums_[static_cast<std::size_t>(some.y - region.y0) * width + some.x - region.x0];
            core::Vec3d sum = total;
            for (const std::size_t end = i + static_cast<std::size_t>(some.count); i < end; ++i)
                sum += core::Vec3d(radiance_[0][i], radiance_[1][i], radiance_[2][i]);
            total = sum;
        }
        samples_.clear();
        filled = 0;
    };
    for (const auto& pixel : pixel_order) {
        const int x = region.x0 + pixel.x, y = region.y0 + pixel.y;
        if (x >= region.x1 || y >= region.y1) continue;
        for (int first = 0; first < samples;) {
            const int count = std::min(samples - first, static_cast<int>(chunk_samples - filled));
            samples_.push_back({x, y, first, count});
            filled += static_cast<std::size_t>(count);
            first += count;
            if (filled == chunk_samples) flush();
        }
    }
    if (filled != 0) flush();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            film.at(region.x0 + x, region.y0 + y) = core::convert<float>(
                sums_[static_cast<std::size_t>(y) * width + x] / static_cast<double>(samples));
}

void Wavefront::start(std::size_t count) {
    std::size_t filled = 0;
    for (const Samples& some : samples_)
        for (int number = some.first; number < some.first + some.count; ++number) {
            const auto place = camera_rays_.place(
                some.x, some.y,
                camera_rays_.regular() ? cells_[static_cast<std::size_t>(number)]
                                       : camera_rays_.in_pixel(some.x, some.y, number));
            across_[filled] = place.across;
            upward_[filled++] = place.upward;
        }
    for (double* channel : radiance_)
        std::fill_n(channel, count, 0.0);
    paths_.count = count;
    kernels_.trace.camera_rays(camera_, count, across_, upward_, paths_.origin, paths_.direction);
    for (double* channel : paths_.throughput)
        std::fill_n(channel, count, 1.0);
    std::iota(paths_.sample, paths_.sample + count, 0U);
    for (std::uint32_t* column :
         {paths_.departed_first, paths_.departed_last, paths_.departed_slot})
        std::fill_n(column, count, no_slot);
    std::fill_n(paths_.departure, count, 0U);
    if (with_media_ && camera_.orthographic)
        for (std::size_t i = 0; i < count; ++i)
            paths_.set_media(i, reference_.media_around(ray_of(paths_, i).origin));
    else if (with_media_) {
        const core::Media& media = reference_.media_around(ray_of(paths_, 0).origin);
        for (int k = 0; k < core::Media::depth; ++k)
            std::fill_n(paths_.media[k], count, media.at(k));
    }
    counters_.primary += count;
}

void Wavefront::add(std::uint32_t sample, double r, double g, double b) {
    radiance_[0][sample] += r;
    radiance_[1][sample] += g;
    radiance_[2][sample] += b;
}

void Wavefront::trace() {
    int depth = 0;
    for (;;) {
        next_.count = 0;
        if (paths_.count != 0) trace_wave(depth);
        std::swap(paths_, next_);
        ++depth;
        if (paths_.count > wave_rays) split_next(depth);
        if (paths_.count == 0) {
            if (pending_.empty()) return;
            take_deferred(depth);
        }
    }
}

void Wavefront::trace_wave(int depth) {
    coherent_ = depth == 0;
    finder_.find(paths_, depth == 0 ? &camera_bundle_ : nullptr, counters_);
    follow_contacts(depth);
    sort_hits();
    see_background();
    shade(depth);
}

/// Where several surfaces meet, the reference goes on.
void Wavefront::follow_contacts(int depth) {
    for (const std::uint32_t lane : finder_.left_open()) {
        ++counters_.followed;
        const core::Vec3d throughput(paths_.throughput[0][lane], paths_.throughput[1][lane],
                                     paths_.throughput[2][lane]);
        const core::Vec3d color =
            reference_.color_along({ray_of(paths_, lane), departure_of(scene_, paths_, lane),
                                    paths_.media_at(lane), throughput, depth}) *
            throughput;
        add(paths_.sample[lane], color.x, color.y, color.z);
    }
}

/// Stably by material; what hit nothing comes last. Radix sort, a byte at a time.
void Wavefront::sort_hits() {
    const auto materials = static_cast<std::uint32_t>(scene_.materials().size());
    const Hits& hits = finder_.hits();
    for (std::size_t lane = 0; lane < paths_.count; ++lane)
        keys_[lane] =
            hits.slot[lane] == no_slot ? materials : scene_.occupant_of(hits.slot[lane]).material;
    const std::uint32_t taken = materials + 1;
    for (const std::uint32_t lane : finder_.left_open())
        keys_[lane] = taken;

    for (std::size_t i = 0; i < paths_.count; ++i)
        order_[i] = static_cast<std::uint32_t>(i);
    for (int shift = 0; shift < 32 && taken >> shift != 0; shift += 8) {
        std::array<std::uint32_t, 257> begin{};
        for (std::size_t i = 0; i < paths_.count; ++i)
            ++begin[(keys_[i] >> shift & 0xFF) + 1];
        for (int value = 1; value < 257; ++value)
            begin[value] += begin[value - 1];
        for (std::size_t i = 0; i < paths_.count; ++i)
            scratch_[begin[keys_[order_[i]] >> shift & 0xFF]++] = order_[i];
        std::swap(order_, scratch_);
    }

    runs_.clear();
    hit_count_ = 0;
    while (hit_count_ < paths_.count && keys_[order_[hit_count_]] < materials) {
        const std::uint32_t key = keys_[order_[hit_count_]];
        const std::size_t begin = hit_count_;
        while (hit_count_ < paths_.count && keys_[order_[hit_count_]] == key)
            ++hit_count_;
        runs_.push_back({&scene_.materials()[key], begin, hit_count_});
    }
}

core::Vec3d Wavefront::background_along(std::size_t lane) const {
    const core::Scene& scene = scene_.scene();
    core::Vec3d color = core::convert<double>(scene.background());
    if (with_media_ && paths_.media[0][lane] != core::Media::none) {
        const core::Vec3f& absorption = scene.materials()[paths_.media[0][lane]].absorption;
        for (int channel = 0; channel < 3; ++channel)
            if (absorption[channel] > 0.0F) color[channel] = 0.0;
        return color;
    }
    if (scene.fog().kind == core::FogKind::none) return color;
    const core::Ray<double> ray = ray_of(paths_, lane);
    const double fog = core::fog_fraction_at_infinity(scene.fog(), ray.origin, ray.direction);
    return (1.0 - fog) * color + fog * core::convert<double>(scene.fog().color);
}

void Wavefront::see_background() {
    const auto materials = static_cast<std::uint32_t>(scene_.materials().size());
    for (std::size_t i = hit_count_; i < paths_.count; ++i) {
        const std::uint32_t lane = order_[i];
        if (keys_[lane] != materials) break;
        const core::Vec3d color = background_along(lane);
        add(paths_.sample[lane], paths_.throughput[0][lane] * color.x,
            paths_.throughput[1][lane] * color.y, paths_.throughput[2][lane] * color.z);
    }
}

/// As core::ReferenceTracer has it at `indices_at`, `medium_before` and `media_behind`.
void Wavefront::fill_media() {
    const auto& materials = scene_.scene().materials();
    const auto index_of = [&](core::MaterialIndex medium) {
        return medium == core::Media::none ? 1.0 : static_cast<double>(materials[medium].index);
    };
    for (const Run& run : runs_)
        for (std::size_t i = run.begin; i < run.end; ++i) {
            const std::uint32_t lane = order_[i];
            const core::MaterialIndex material = keys_[lane];
            const bool entering = (finder_.hits().hit[lane] & hit_entering) != 0;
            const bool transmits = run.material->transmits;
            const core::MaterialIndex top = paths_.media[0][lane];
            const core::MaterialIndex before =
                top == core::Media::none && !entering && transmits ? material : top;
            media_.index_before[i] = index_of(before);
            if (entering || !transmits) {
                media_.index_behind[i] = run.material->index;
            } else {
                core::Media behind = paths_.media_at(lane);
                behind.leave(material);
                media_.index_behind[i] = index_of(behind.top());
            }
            media_.inside[i] = before == core::Media::none ? 0.0 : 1.0;
            for (int channel = 0; channel < 3; ++channel)
                media_.absorption[channel][i] =
                    before == core::Media::none
                        ? 0.0
                        : static_cast<double>(materials[before].absorption[channel]);
        }
}

void Wavefront::shade(int depth) {
    if (runs_.empty()) return;
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
    hit_paths.hit = hits.hit;
    for (const Run& run : runs_)
        shade_.surfaces(run, order_, hit_paths, scene_.fog(), with_media_ ? &media_ : nullptr,
                        surfaces_);
    for (std::size_t i = 0; i < hit_count_; ++i)
        add(paths_.sample[order_[i]], surfaces_.radiance[0][i], surfaces_.radiance[1][i],
            surfaces_.radiance[2][i]);
    add_lights();
    if (depth < settings_.max_depth) spawn();
}

void Wavefront::add_lights() {
    for (const LightView& light : scene_.lights()) {
        shadows_.count = 0;
        for (const Run& run : runs_)
            if (run.material->diffuse > 0.0 || run.material->specular > 0.0)
                shade_.light(run, light, surfaces_, shadows_);
        if (shadows_.count != 0) trace_shadows(light);
    }
}

void Wavefront::trace_shadows(const LightView& light) {
    const Hits& hits = finder_.hits();
    const std::size_t count = shadows_.count;
    counters_.shadow += count;
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t lane = order_[static_cast<std::size_t>(shadows_.parent[k])];
        const SceneData::Occupant shape = scene_.occupant_of(hits.slot[lane]);
        shadow_paths_.departed_first[k] = shape.coplanar.first;
        shadow_paths_.departed_last[k] = shape.coplanar.last;
        const bool inward = (hits.hit[lane] & hit_entering) == 0;
        const bool in_medium = with_media_ && paths_.media[0][lane] != core::Media::none;
        occlusions_.state[k] = in_medium || may_return(shape.kind, inward) ? doubtful : open;
        shadow_t_most_[k] = static_cast<float>(shadows_.distance[k]);
    }
    shadow_rounded_.departed_first = shadow_paths_.departed_first;
    shadow_rounded_.departed_last = shadow_paths_.departed_last;
    const TraceKernels& trace = kernels_.trace;
    trace.round_rays(count, shadows_.origin, shadows_.direction, shadow_rounded_);
    TraceCounters traced{};
    const Bundle bundle = bundle_of(light);
    if (coherent_ || !scene_.has_tree()) {
        trace.occluded_in_bundle(scene_.view(), scene_.listed_kinds(), bundle, count,
                                 shadow_rounded_, occlusions_, shadow_pending_, traced);
    } else {
        if (scene_.listed_kinds() != 0)
            trace.occluded_by_all(scene_.view(), scene_.listed_kinds(), count, shadow_rounded_,
                                  occlusions_, traced);
        trace.occluded_in_tree(scene_.view(), count, shadow_rounded_, occlusions_, shadow_pending_,
                               traced);
    }
    counters_.nodes += traced.nodes;
    counters_.shapes += traced.shapes;

    walk_.count = 0;
    for (std::size_t k = 0; k < count; ++k)
        if (occlusions_.state[k] == doubtful) start_walk(k);
    if (walk_.count != 0) walk_shadows(bundle);

    for (std::size_t k = 0; k < count; ++k)
        if (occlusions_.state[k] != blocked)
            add(paths_.sample[order_[static_cast<std::size_t>(shadows_.parent[k])]],
                shadows_.weight[0][k], shadows_.weight[1][k], shadows_.weight[2][k]);
}

void Wavefront::start_walk(std::size_t shadow) {
    ++counters_.walked;
    const std::uint32_t lane = order_[static_cast<std::size_t>(shadows_.parent[shadow])];
    const std::uint32_t hit = finder_.hits().hit[lane];
    const std::size_t to = walk_.count++;
    for (int axis = 0; axis < 3; ++axis) {
        walk_.origin[axis][to] = shadows_.origin[axis][shadow];
        walk_.direction[axis][to] = shadows_.direction[axis][shadow];
        walk_.throughput[axis][to] = shadows_.weight[axis][shadow];
    }
    walk_.sample[to] = static_cast<std::uint32_t>(shadow);
    walk_.departed_first[to] = shadow_paths_.departed_first[shadow];
    walk_.departed_last[to] = shadow_paths_.departed_last[shadow];
    walk_.departed_slot[to] = finder_.hits().slot[lane];
    walk_.departure[to] = (hit & hit_face) | ((hit & hit_entering) != 0 ? 0 : departure_inward);
    walk_.set_media(to, paths_.media_at(lane));
    walk_distance_[to] = shadows_.distance[shadow];
}

/// From surface to surface, until the light or something opaque. As
/// core::ReferenceTracer::light_let_through has it.
void Wavefront::walk_shadows(const Bundle& bundle) {
    while (walk_.count != 0) {
        walker_.find(walk_, &bundle, counters_);
        for (const std::uint32_t lane : walker_.left_open()) {
            ++counters_.followed;
            const core::Vec3d share =
                reference_.light_let_through(ray_of(walk_, lane), departure_of(scene_, walk_, lane),
                                             walk_.media_at(lane), walk_distance_[lane]);
            for (int channel = 0; channel < 3; ++channel)
                shadows_.weight[channel][walk_.sample[lane]] =
                    walk_.throughput[channel][lane] * share[channel];
            walk_distance_[lane] = -1.0; // done
        }
        std::size_t kept = 0;
        for (std::size_t lane = 0; lane < walk_.count; ++lane) {
            double distance = walk_distance_[lane];
            if (distance < 0.0 || !step(lane, distance)) continue;
            walk_.copy(walk_, lane, kept);
            walk_distance_[kept++] = distance;
        }
        walk_.count = kept;
    }
}

/// Takes a walk through the surface that it has found. False if it is over.
bool Wavefront::step(std::size_t lane, double& distance) {
    const Hits& found = walker_.hits();
    const std::uint32_t shadow = walk_.sample[lane], slot = found.slot[lane];
    const core::Media media = walk_.media_at(lane);
    const auto weaken = [&](const core::Vec3d& share) {
        for (int channel = 0; channel < 3; ++channel)
            walk_.throughput[channel][lane] *= share[channel];
    };
    if (slot == no_slot || !(found.t[lane] < distance)) {
        weaken(reference_.absorbed(media.top(), distance));
        for (int channel = 0; channel < 3; ++channel)
            shadows_.weight[channel][shadow] = walk_.throughput[channel][lane];
        return false;
    }
    core::Hit<double> hit;
    hit.shape = scene_.id_of(slot);
    hit.entering = (found.hit[lane] & hit_entering) != 0;
    if (!scene_.scene().material_of(hit.shape).transmits()) {
        occlusions_.state[shadow] = blocked;
        return false;
    }
    const double t = found.t[lane];
    const core::Ray<double> ray = ray_of(walk_, lane);
    const core::Vec3d normal(found.normal[0][lane], found.normal[1][lane], found.normal[2][lane]);
    weaken(reference_.absorbed(reference_.medium_before(hit, media), t) *
           reference_.let_through(hit, ray.direction, normal, media));
    for (int axis = 0; axis < 3; ++axis)
        walk_.origin[axis][lane] += t * ray.direction[axis];
    const core::IdRange range = scene_.occupant_of(slot).coplanar;
    walk_.departed_first[lane] = range.first;
    walk_.departed_last[lane] = range.last;
    walk_.departed_slot[lane] = slot;
    walk_.departure[lane] = (found.hit[lane] & hit_face) | (hit.entering ? departure_inward : 0);
    walk_.set_media(lane, reference_.media_behind(hit, media));
    distance -= t;
    return true;
}

void Wavefront::spawn() {
    SpawnedRays reflected{};
    for (int axis = 0; axis < 3; ++axis) {
        reflected.origin[axis] = next_.origin[axis];
        reflected.direction[axis] = next_.direction[axis];
        reflected.weight[axis] = next_.throughput[axis];
    }
    reflected.parent = shadows_.parent;
    transmitted_.count = 0;
    for (const Run& run : runs_)
        if (run.material->reflects || run.material->transmits)
            shade_.spawn(run, static_cast<double>(settings_.min_weight),
                         with_media_ ? &media_ : nullptr, surfaces_, reflected, transmitted_);
    counters_.reflected += reflected.count;
    counters_.refracted += transmitted_.count;
    add_to_next(reflected, /*through=*/false);
    if (transmitted_.count == 0) return;
    for (int axis = 0; axis < 3; ++axis) {
        std::copy_n(transmitted_.origin[axis], transmitted_.count,
                    next_.origin[axis] + next_.count);
        std::copy_n(transmitted_.direction[axis], transmitted_.count,
                    next_.direction[axis] + next_.count);
        std::copy_n(transmitted_.weight[axis], transmitted_.count,
                    next_.throughput[axis] + next_.count);
    }
    add_to_next(transmitted_, /*through=*/true);
}

/// The columns that the kernels do not write.
void Wavefront::add_to_next(const SpawnedRays& spawned, bool through) {
    const Hits& hits = finder_.hits();
    for (std::size_t k = 0; k < spawned.count; ++k) {
        const std::uint32_t lane = order_[static_cast<std::size_t>(spawned.parent[k])];
        const std::size_t to = next_.count++;
        const std::uint32_t slot = hits.slot[lane], hit = hits.hit[lane];
        const core::IdRange range = scene_.occupant_of(slot).coplanar;
        const bool entering = (hit & hit_entering) != 0;
        next_.sample[to] = paths_.sample[lane];
        next_.departed_first[to] = range.first;
        next_.departed_last[to] = range.last;
        next_.departed_slot[to] = slot;
        next_.departure[to] = (hit & hit_face) | (through == entering ? departure_inward : 0);
        if (!with_media_) continue;
        core::Media media = paths_.media_at(lane);
        if (through) {
            if (entering)
                media.enter(keys_[lane]);
            else
                media.leave(keys_[lane]);
        }
        next_.set_media(to, media);
    }
}

/// Leaves the first half of the samples, and the others for later, until they fit. What one sample
/// alone makes too many of, the reference follows.
void Wavefront::split_next(int depth) {
    while (paths_.count > wave_rays) {
        const auto [least, most] = std::minmax_element(paths_.sample, paths_.sample + paths_.count);
        const std::uint32_t first = *least, last = *most;
        if (first == last) {
            counters_.followed += paths_.count;
            for (std::size_t lane = 0; lane < paths_.count; ++lane) {
                const core::Vec3d throughput(paths_.throughput[0][lane], paths_.throughput[1][lane],
                                             paths_.throughput[2][lane]);
                const core::Vec3d color =
                    reference_.color_along({ray_of(paths_, lane),
                                            departure_of(scene_, paths_, lane),
                                            paths_.media_at(lane), throughput, depth}) *
                    throughput;
                add(first, color.x, color.y, color.z);
            }
            paths_.count = 0;
            return;
        }
        const std::uint32_t middle = first + (last - first) / 2;
        std::size_t kept = 0;
        const std::size_t begin = deferred_.count;
        for (std::size_t lane = 0; lane < paths_.count; ++lane)
            if (paths_.sample[lane] <= middle)
                paths_.copy(paths_, lane, kept++);
            else
                deferred_.copy(paths_, lane, deferred_.count++);
        pending_.push_back({begin, deferred_.count - begin, depth});
        counters_.deferred += deferred_.count - begin;
        paths_.count = kept;
    }
}

void Wavefront::take_deferred(int& depth) {
    const Deferred last = pending_.back();
    pending_.pop_back();
    for (std::size_t i = 0; i < last.count; ++i)
        paths_.copy(deferred_, last.begin + i, i);
    paths_.count = last.count;
    deferred_.count = last.begin;
    depth = last.depth;
    if (paths_.count > wave_rays) split_next(depth);
}

} // namespace raylane::simd
