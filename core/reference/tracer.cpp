#include "core/reference/tracer.hpp"

#include "core/numbers/elementary.hpp"
#include "core/numbers/infinity.hpp"
#include "core/numbers/primitives.hpp"
#include "core/optics/fog.hpp"
#include "core/optics/optics.hpp"
#include "core/reference/enclosing.hpp"
#include "core/reference/surface_color.hpp"
#include "core/scene/pattern.hpp"
#include "core/scene/pattern_place.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <type_traits>

namespace raylane::core {

namespace {

template <class Real>
Real largest(const Vec3<Real>& v) {
    return std::max({v.x, v.y, v.z});
}

} // namespace

template <class Real>
ReferenceTracer<Real>::ReferenceTracer(const Scene& scene, const Settings& settings, Search search,
                                       Precision precision, Survey* survey,
                                       const std::atomic<bool>* abandon)
    : scene_(scene), settings_(settings), camera_rays_(scene.camera(), settings),
      searcher_(scene, search, precision), is_exact_(precision == Precision::exact),
      survey_(survey), abandon_(abandon) {
    crossings_.reserve(64);
    pending_.reserve(64);
    for (const Light& light : scene.lights())
        if (is_soft(light.kind)) soft_lights_.push_back(prepared(light));
    light_rays_ = light_rays_of(scene, settings);
    if (survey != nullptr) to_quality_.emplace(scene, settings, *survey);
}

template <class Real>
Sample ReferenceTracer<Real>::taken(const SampleName& name) {
    sample_ = name;
    const SamplePoint place = place_in_pixel(name);
    const double cost_before = cost_;
    const Vector color =
        trace(camera_rays_.ray(name, camera_rays_.filtered({Real(place.x), Real(place.y)})));
    return {convert<double>(color), first_hit_.shape, static_cast<double>(transmittance_),
            cost_ - cost_before};
}

template <class Real>
void ReferenceTracer<Real>::survey(Survey::Pass pass, std::size_t batch) {
    if (batch >= survey_->batches(pass)) return;
    Survey::Samples samples(*survey_, pass, batch);
    do {
        for (std::size_t pixel = 0; pixel < samples.pixels(); ++pixel)
            for (int wanted = samples.wanted(pixel); wanted > 0 && !is_abandoned(); --wanted)
                samples.add(pixel, taken({samples.x(pixel), samples.y(pixel), samples.next(pixel),
                                          samples.common()}));
    } while (!is_abandoned() && samples.end_round());
}

template <class Real>
void ReferenceTracer<Real>::render(const Region& region, Film& film) {
    if (settings_.quality == 0.0F) {
        for (int y = region.y0; y < region.y1; ++y)
            for (int x = region.x0; x < region.x1; ++x) {
                const Color color = pixel(x, y);
                if (is_abandoned()) return;
                film.at(x, y) = color;
                if (film.has_alpha())
                    film.alpha_at(x, y) = static_cast<float>(Real(1) - transmittance_);
            }
        return;
    }
    RegionSamples& samples = *to_quality_;
    const auto for_each_pixel = [&](const auto& visit) {
        std::size_t number = 0;
        for (int y = region.y0; y < region.y1; ++y)
            for (int x = region.x0; x < region.x1; ++x)
                visit(x, y, number++);
    };
    samples.begin(region);
    do {
        for_each_pixel([&](int x, int y, std::size_t pixel) {
            for (int wanted = samples.wanted(pixel); wanted > 0 && !is_abandoned(); --wanted)
                samples.add(pixel, taken({x, y, samples.next(pixel), samples.common()}));
        });
    } while (!is_abandoned() && samples.end_round());
    if (is_abandoned()) return;
    for_each_pixel([&](int x, int y, std::size_t pixel) {
        film.at(x, y) = samples.mean(pixel);
        if (film.has_alpha()) film.alpha_at(x, y) = samples.alpha(pixel);
    });
}

template <class Real>
Color ReferenceTracer<Real>::pixel(int x, int y) {
    const int samples = settings_.grid * settings_.grid;
    Vector sum(0);
    Real transmittance = 0;
    for (int sample = 0; sample < samples && !is_abandoned(); ++sample) {
        sample_ = {x, y, sample, samples};
        sum += trace(camera_rays_.ray(x, y, sample));
        transmittance += transmittance_;
    }
    transmittance_ = transmittance / Real(samples);
    return convert<float>(Vector(sum / Real(samples)));
}

template <class Real>
Vec3<Real> ReferenceTracer<Real>::trace(const Ray<Real>& ray) {
    ++searcher_.counters.primary;
    return light_along({ray, OriginSurfaces<Real>{}, media_around(ray.origin), Vector(1), 0});
}

/// Perspective rays share their origin, so the media of the last origin are reused.
template <class Real>
Media ReferenceTracer<Real>::media_around(const Vector& origin, bool may_be_in_a_body) {
    if (!start_media_ || origin != start_) {
        start_ = origin;
        start_media_ = enclosing_media(scene_, searcher_, media_, origin, may_be_in_a_body);
    }
    return *start_media_;
}

/// Keeps spawned paths in `pending_`, not on the call stack. The path spawned last is traced first.
template <class Real>
Vec3<Real> ReferenceTracer<Real>::light_along(Path path) {
    Vector light(0);
    transmittance_ = 0;
    first_hit_ = {};
    const std::size_t others = pending_.size();
    pending_.push_back(std::move(path));
    while (pending_.size() > others) {
        const Path next = std::move(pending_.back());
        pending_.pop_back();
        light += light_on(next);
    }
    return light;
}

/// Returns the light of the nearest visible surface, and of the media in between.
template <class Real>
Vec3<Real> ReferenceTracer<Real>::light_on(const Path& path) {
    Encounter<Real> encounter = searcher_.nearest(
        path.ray, path.origins, [&](const Hit<Real>& candidate) { return is_visible(candidate); });
    const Hit<Real>& hit = encounter.hit;
    cost_ += hit.any() ? 1.0 + light_rays_ : 1.0;
    if (path.depth == 0 && path.passed == 0 && path.crossings == 0) first_hit_ = hit;
    if (!hit.any()) {
        if (!settings_.alpha || !path.is_straight) return path.throughput * color_at_infinity(path);
        transmittance_ = transmittance_to_infinity(path);
        return Vector(0);
    }

    if constexpr (std::is_same_v<Real, double>)
        if (is_exact_ && path.origins.size() != 0 && is_rounded_away(path.ray.origin, hit.t))
            encounter.contacts = encounter.contacts.joined(path.origins);
    const Surface surface = surface_at(path, encounter);
    const MaterialIndex medium = medium_before(hit, path.media);
    Vector before = path.throughput;
    if (medium != no_medium) before = absorbed(medium, hit.t) * before;
    if (surface.material.is_transparent()) {
        // Each surface on a straight line has the fog that it would have as the only one.
        const Real opacity =
            path.passed < settings_.max_transparent ? Real(surface.material.opacity) : Real(0);
        pass(path, surface, (Real(1) - opacity) * before);
        if (opacity == Real(0)) return Vector(0);
        before = opacity * before;
    }
    if (medium != no_medium) return shade(path, surface, before);
    const Real fog = fog_fraction(scene_.fog(), path.travelled + hit.t, surface.point.z);
    const Vector of_fog = fog * convert<Real>(scene_.fog().color) * before;
    return of_fog + shade(path, surface, (Real(1) - fog) * before);
}

template <class Real>
Vec3<Real> ReferenceTracer<Real>::color_at_infinity(const Path& path) const {
    const Vector background = convert<Real>(scene_.background());
    if (path.media != empty_space)
        return absorbed(media_.top(path.media), infinity<Real>) * background;
    const Real fog = fog_fraction_at_infinity(scene_.fog(), path.ray.origin, path.ray.direction);
    return mul_add(fog, convert<Real>(scene_.fog().color), Vector((Real(1) - fog) * background));
}

/// Ignores fog. Over an infinite segment, the fraction of fog is 0 or 1 unless the fog is linear_z
/// and the ray runs across z; full fog counts as background.
template <class Real>
Real ReferenceTracer<Real>::transmittance_to_infinity(const Path& path) const {
    return mean_of_channels(
        Vector(absorbed(media_.top(path.media), infinity<Real>) * path.throughput));
}

template <class Real>
typename ReferenceTracer<Real>::Surface
ReferenceTracer<Real>::surface_at(const Path& path, const Encounter<Real>& encounter) const {
    const Hit<Real>& hit = encounter.hit;
    auto [point, flat] = searcher_.surface_at(path.ray, path.origins, hit);
    Vector normal =
        with_table(scene_.shapes(), hit.kind, [&, &at = point, &there = flat](const auto& table) {
            return shading_normal_at(table.get(hit.place), at, there);
        });
    if (dot(normal, flat) < Real(0)) normal = -normal;
    if (!hit.entering) {
        flat = -flat;
        normal = -normal;
    }
    // An apex has no normal, and its substitute may face the wrong side. Elsewhere, only rounding
    // at grazing angles can cause that.
    if (dot(flat, path.ray.direction) > Real(0x1p-20)) normal = flat = -path.ray.direction;
    return {hit, encounter.contacts, scene_.material_of(hit.shape), point, flat, normal};
}

/// Applies the formula at `Material`; `throughput` is the share of the result that reaches the
/// pixel.
template <class Real>
Vec3<Real> ReferenceTracer<Real>::shade(const Path& path, const Surface& surface,
                                        const Vector& throughput) {
    const Material& material = surface.material;
    const Vector light = throughput * lit(path, surface);
    if (!material.reflects() && !material.transmits()) return light;

    const auto [before, behind] = indices_at(surface.hit, path.media, media_behind(path, surface));
    Refraction<Real> refraction = refract(path.ray.direction, surface.normal, before, behind);
    // A shading normal may bend the ray to the wrong side of the surface.
    if (!refraction.total && dot(refraction.transmitted, surface.flat_normal) >= Real(0))
        refraction = refract(path.ray.direction, surface.flat_normal, before, behind);

    const Real reflected_share = material.transmits() || material.reflection != Reflection::constant
                                     ? reflectance(material, refraction, before, behind)
                                     : Real(material.reflectivity);
    const Real transmitted_share = (Real(1) - reflected_share) * Real(material.transmission);
    if (transmitted_share > Real(0))
        transmit(path, surface, transmitted_share * throughput, refraction.transmitted);
    reflect(path, surface, reflected_share * throughput);
    return light;
}

template <class Real>
Vec3<Real> ReferenceTracer<Real>::own_color(const Surface& surface) const {
    const Pattern& pattern = surface.material.pattern;
    if (!pattern.needs_shape()) return color_at(pattern, surface.point);
    const Hit<Real>& hit = surface.hit;
    const SurfacePlace place{hit.shape, hit.kind, hit.place, hit.face,
                             convert<double>(surface.point)};
    if (pattern.is_on_surface()) return convert<Real>(color_on(scene_, pattern, place));
    const PatternPlace at = place_in_pattern(scene_, pattern, place);
    return color_at(pattern, convert<Real>(at.point), at.on_shape);
}

/// Returns the ambient light, and that of each light on this side of the surface.
template <class Real>
Vec3<Real> ReferenceTracer<Real>::lit(const Path& path, const Surface& surface) {
    const Material& material = surface.material;
    const Vector own = own_color(surface);
    Vector color = Real(material.ambient) * own;
    if (material.diffuse == 0.0F && material.specular == 0.0F) return color;

    for (const Light& light : scene_.lights()) {
        if (is_soft(light.kind)) continue;
        Vector to_light = -convert<Real>(light.direction);
        if (light.kind == LightKind::point)
            to_light = convert<Real>(light.position) - surface.point;
        Real distance = length(to_light);
        if (!(distance > Real(0))) continue; // a light does not light its own position
        to_light /= distance;
        if (light.kind == LightKind::directional) distance = infinity<Real>;
        if (dot(surface.flat_normal, to_light) <= Real(0)) continue;

        const Real cos_light = std::max(dot(surface.normal, to_light), Real(0));
        const Vector share =
            Real(material.diffuse) * cos_light * own + Vector(highlight(path, surface, to_light));
        if (share == Vector(0)) continue;
        ++searcher_.counters.shadow;
        color +=
            light_let_through({surface.point, to_light},
                              surface.origins(/*through=*/false, to_light), path.media, distance) *
            convert<Real>(light.color) * share;
    }
    return soft_lights_.empty() ? color : color + lit_softly(path, surface, own);
}

/// Returns the highlight of light from a direction.
template <class Real>
Real ReferenceTracer<Real>::highlight(const Path& path, const Surface& surface,
                                      const Vector& to_light) const {
    const Material& material = surface.material;
    if (material.specular == 0.0F) return Real(0);
    const auto power_of = [&](Real cosine) {
        return Real(material.specular) *
               core::pow(std::max(cosine, Real(0)), Real(material.exponent));
    };
    if (material.highlight == Highlight::phong)
        return power_of(dot(reflected(path.ray.direction, surface.normal), to_light));
    const Vector halfway = to_light - path.ray.direction;
    if (!(squared_length(halfway) > Real(0))) return Real(0);
    return power_of(dot(surface.normal, normalized(halfway)));
}

/// Returns the mean of the samples of each light with a size. The sky makes no highlights.
template <class Real>
Vec3<Real> ReferenceTracer<Real>::lit_softly(const Path& path, const Surface& surface,
                                             const Vector& own) {
    const Directed<double> point{static_cast<double>(surface.point.x),
                                 static_cast<double>(surface.point.y),
                                 static_cast<double>(surface.point.z)};
    const Directed<double> normal{static_cast<double>(surface.normal.x),
                                  static_cast<double>(surface.normal.y),
                                  static_cast<double>(surface.normal.z)};
    const auto lights = static_cast<std::uint32_t>(soft_lights_.size());
    const auto count = static_cast<std::uint32_t>(settings_.light_rays());
    const bool is_hard = settings_.light_samples == Settings::hard_light;
    Vector color(0);
    for (std::uint32_t number = 0; number < lights; ++number) {
        const SoftLight& light = soft_lights_[number];
        const bool is_sky = light.kind == LightKind::sky;
        const SoftLightSampler<double> sampler(light);
        const PointRange points =
            points_on_light(sample_, count, path.depth + path.passed, number, lights);
        for (std::uint32_t k = 0; k < count; ++k) {
            const SamplePoint at =
                is_hard ? middle_of(light) : shuffled_point(points.key, points.first + k);
            const LightSample<double> sample =
                sampler.sample(point, normal, static_cast<double>(at.x), static_cast<double>(at.y));
            const Vector to_light(Real(sample.direction.x), Real(sample.direction.y),
                                  Real(sample.direction.z));
            if (dot(surface.flat_normal, to_light) <= Real(0)) continue;
            const Real cos_light = std::max(dot(surface.normal, to_light), Real(0));
            Vector share = Real(surface.material.diffuse) * (is_sky ? Real(1) : cos_light) * own;
            if (!is_sky) share += Vector(highlight(path, surface, to_light));
            for (int channel = 0; channel < 3; ++channel) {
                const double zenith = light.color[channel], ground = light.ground[channel];
                const double radiance =
                    is_sky ? ground + sample.height * (zenith - ground) : zenith;
                share[channel] *= Real(radiance * (sample.share / static_cast<double>(count)));
            }
            if (share == Vector(0)) continue;
            if (is_hard && is_sky) {
                color += share;
                continue;
            }
            ++searcher_.counters.shadow;
            color += light_let_through({surface.point, to_light},
                                       surface.origins(/*through=*/false, to_light), path.media,
                                       Real(sample.distance)) *
                     share;
        }
    }
    return color;
}

template <class Real>
void ReferenceTracer<Real>::reflect(const Path& path, const Surface& surface,
                                    const Vector& throughput) {
    if (path.depth >= settings_.max_depth || !is_worth(throughput)) return;

    Vector direction = reflected(path.ray.direction, surface.normal);
    if (dot(direction, surface.flat_normal) <= Real(0))
        direction = reflected(path.ray.direction, surface.flat_normal);

    ++searcher_.counters.reflected;
    pending_.push_back({{surface.point, normalized(direction)},
                        surface.origins(/*through=*/false, direction),
                        path.media,
                        throughput,
                        path.depth + 1,
                        /*crossings=*/0,
                        path.passed,
                        /*travelled=*/0,
                        /*is_straight=*/false});
}

template <class Real>
void ReferenceTracer<Real>::transmit(const Path& path, const Surface& surface,
                                     const Vector& throughput, const Vector& direction) {
    // Further surfaces at the same point do not count as depth, but `crossings` limits their
    // number: a path must not run in circles there.
    const bool is_free = surface.hit.at_start && path.crossings > 0;
    if ((path.depth >= settings_.max_depth && !is_free) || !is_worth(throughput)) return;

    ++searcher_.counters.refracted;
    Path next = through(path, surface, throughput, normalized(direction));
    next.depth += is_free ? 0 : 1;
    next.is_straight = false;
    pending_.push_back(std::move(next));
}

/// Continues a path straight behind a transparent surface.
template <class Real>
void ReferenceTracer<Real>::pass(const Path& path, const Surface& surface,
                                 const Vector& throughput) {
    if (!is_worth(throughput)) return;

    ++searcher_.counters.passed;
    Path next = through(path, surface, throughput, path.ray.direction);
    ++next.passed;
    next.travelled = path.travelled + surface.hit.t;
    pending_.push_back(std::move(next));
}

/// Returns a path that continues through a surface in a direction of length 1, at the same depth.
template <class Real>
typename ReferenceTracer<Real>::Path
ReferenceTracer<Real>::through(const Path& path, const Surface& surface, const Vector& throughput,
                               const Vector& direction) {
    return {{surface.point, direction},
            surface.origins(/*through=*/true, direction),
            media_behind(path, surface),
            throughput,
            path.depth,
            surface.hit.at_start ? path.crossings - 1 : static_cast<int>(surface.contacts.size()),
            path.passed,
            /*travelled=*/0,
            path.is_straight};
}

template <class Real>
Vec3<Real> ReferenceTracer<Real>::light_let_through(const Ray<Real>& ray,
                                                    const OriginSurfaces<Real>& origins,
                                                    Media media, Real distance) {
    if (!find_crossings(ray, origins, distance)) return Vector(0);
    if (!settings_.transparent_shadows) return Vector(1);

    Vector share(1);
    Real reached = 0;
    for (auto hit = crossings_.begin(); hit != crossings_.end(); ++hit) {
        share *= absorbed(medium_before(*hit, media), hit->t - reached);
        reached = hit->t;
        // Coincident surfaces of one material are one surface, whatever else coincides with them.
        const auto others = std::find_if(hit + 1, crossings_.end(), [&](const Hit<Real>& other) {
            return !other.joins || other.enters() != hit->enters();
        });
        auto end = hit + 1;
        for (auto other = end; other != others; ++other)
            if (scene_.material_index_of(other->shape) == scene_.material_index_of(hit->shape)) {
                std::rotate(end, other, other + 1);
                ++end;
            }
        const Media behind = media_behind(*hit, media, static_cast<int>(end - hit));
        share *= let_through(*hit, ray, origins, media, behind);
        media = behind;
        hit = end - 1;
    }
    return share * absorbed(media_.top(media), distance - reached);
}

/// Finds the surfaces on a shadow ray that let light pass, in order. Returns false if a surface is
/// opaque.
template <class Real>
bool ReferenceTracer<Real>::find_crossings(const Ray<Real>& ray,
                                           const OriginSurfaces<Real>& origins, Real distance) {
    bool is_unblocked = true;
    crossings_.clear();
    searcher_.each(ray, origins, distance, [&](const Hit<Real>& hit) {
        if (!is_visible(hit)) return true;
        is_unblocked = scene_.material_of(hit.shape).lets_light_pass();
        if (is_unblocked) crossings_.push_back(hit);
        return is_unblocked;
    });
    if (!is_unblocked) return false;

    searcher_.sort(ray, origins, crossings_);
    return true;
}

/// Returns the share of light that one surface lets through.
template <class Real>
Real ReferenceTracer<Real>::let_through(const Hit<Real>& hit, const Ray<Real>& ray,
                                        const OriginSurfaces<Real>& origins, Media media,
                                        Media media_behind) {
    const Vector normal = searcher_.surface_at(ray, origins, hit).normal;
    const Real cos = std::abs(dot(ray.direction, normal));
    const auto [before, behind] = indices_at(hit, media, media_behind);
    return let_straight_through(scene_.material_of(hit.shape), std::min(cos, Real(1)), before,
                                behind);
}

template <class Real>
bool ReferenceTracer<Real>::is_worth(const Vector& throughput) const {
    const Real most = largest(throughput);
    return most > Real(0) && most >= Real(settings_.min_weight);
}

template <class Real>
bool ReferenceTracer<Real>::is_visible(const Hit<Real>& hit) const {
    return scene_.material_of(hit.shape).is_seen(hit.enters());
}

/// Returns both indices. Behind a surface that transmits nothing is the surface's own index, from
/// whichever side it is seen.
template <class Real>
typename ReferenceTracer<Real>::Indices
ReferenceTracer<Real>::indices_at(const Hit<Real>& hit, Media media, Media media_behind) {
    const auto before = static_cast<Real>(index_of(scene_.materials(), medium_before(hit, media)));
    const Material& material = scene_.material_of(hit.shape);
    if (hit.enters() || !material.transmits())
        return {before, Real(scene_.materials()[scene_.medium_index_of(hit.shape)].index)};
    const MaterialIndex behind = media_.top(media_behind);
    return {before, static_cast<Real>(index_of(scene_.materials(), behind))};
}

/// Returns the media behind `count` surfaces of the hit's material.
template <class Real>
Media ReferenceTracer<Real>::media_behind(const Hit<Real>& hit, Media media, int count) {
    const MaterialIndex medium = scene_.medium_index_of(hit.shape);
    if (!scene_.bounds_medium(scene_.material_index_of(hit.shape), medium)) return media;
    for (; count > 0; --count)
        media = media_.crossed(media, medium, hit.enters());
    return media;
}

template <class Real>
Media ReferenceTracer<Real>::media_behind(const Path& path, const Surface& surface) {
    return media_behind(surface.hit, path.media, surface.contacts.count_as_one(surface.hit));
}

template <class Real>
MaterialIndex ReferenceTracer<Real>::medium_before(const Hit<Real>& hit, Media media) const {
    const MaterialIndex medium = scene_.medium_index_of(hit.shape);
    return media_.before(media, medium, scene_.materials()[medium].transmits(), hit.enters());
}

template <class Real>
Vec3<Real> ReferenceTracer<Real>::absorbed(MaterialIndex medium, Real distance) const {
    if (medium == no_medium) return Vector(1);
    return let_through_medium(scene_.materials()[medium], distance);
}

template class ReferenceTracer<float>;
template class ReferenceTracer<double>;

} // namespace raylane::core
