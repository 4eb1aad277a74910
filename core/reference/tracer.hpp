#pragma once

#include "core/beams/region_samples.hpp"
#include "core/optics/media.hpp"
#include "core/optics/soft_light.hpp"
#include "core/reference/search.hpp"
#include "core/scene/camera_rays.hpp"
#include "core/scene/film.hpp"
#include "core/scene/region.hpp"

#include <atomic>
#include <optional>

namespace raylane::core {

/// The scalar reference tracer, written to be read. It defines the image of a scene. `Real` is
/// float or double. With Precision::exact, every decision of which surface a ray hits is that of
/// real arithmetic. The result for a pixel depends on scene and settings alone. For use by one
/// thread.
template <class Real>
class ReferenceTracer {
  public:
    /// `survey`: needed if the settings have a quality. `abandon`: once it is true, survey() and
    /// render() return early; may be null.
    ReferenceTracer(const Scene& scene, const Settings& settings, Search search = Search::hierarchy,
                    Precision precision = precision_of<Real>, Survey* survey = nullptr,
                    const std::atomic<bool>* abandon = nullptr);

    /// Samples a batch of the survey.
    void survey(Survey::Pass pass, std::size_t batch);

    /// Renders a region. If the settings have a quality, the tracer needs a finished survey, and
    /// the region must consist of whole squares (RegionSamples::square_size). An abandoned region
    /// keeps some or all of its old pixels.
    void render(const Region& region, Film& film);

    /// Returns the number of samples of a pixel of the last region; pixels are numbered row by row.
    int samples_of(std::size_t pixel) const {
        return to_quality_ ? to_quality_->taken(pixel) : settings_.grid * settings_.grid;
    }

    /// Returns the mean of a pixel's samples, added in their order, as many as `settings.grid`
    /// specifies. Linear RGB.
    Color pixel(int x, int y);

    /// Returns the linear RGB colour seen along a ray, whose direction must be a unit vector.
    Vec3<Real> trace(const Ray<Real>& ray);

    /// Returns the share of the background that the last ray, path or pixel left out
    /// (Settings::alpha).
    Real transmittance() const { return transmittance_; }

    /// Returns the sum of Sample::cost over all paths so far.
    double cost() const { return cost_; }

    /// Returns counters of the work of all calls so far.
    const Counters& counters() const { return searcher_.counters; }

    using Vector = Vec3<Real>;

    /// Sets the sample whose points on lights with a size are used from now on.
    void set_sample(const SampleName& sample) { sample_ = sample; }

    /// A ray being traced.
    struct Path {
        Ray<Real> ray;
        OriginSurfaces<Real> origins;
        Media media;             ///< media that it is inside of
        Vector throughput;       ///< share of its colour that reaches the pixel
        int depth;               ///< reflections and refractions so far
        int crossings = 0;       ///< surfaces at its start that it may still cross without depth
        int passed = 0;          ///< transparent surfaces that it has passed in a straight line
        Real travelled = 0;      ///< length of its straight line before the ray's start
        bool is_straight = true; ///< true if it has never been bent since the camera
    };

    /// Returns the linear RGB light that a path and all paths spawned by it bring to the pixel.
    Vector light_along(Path path);
    /// Returns the first hit of the last ray from the camera; an empty hit if it hits nothing.
    const Hit<Real>& first_hit() const { return first_hit_; }

    /// Returns the first surface along a ray, visible or not, with its contacts.
    Encounter<Real> nearest(const Ray<Real>& ray, const OriginSurfaces<Real>& origins) {
        return searcher_.nearest(ray, origins, [](const Hit<Real>&) { return true; });
    }

    /// Returns the share of a light that reaches the origin of a ray towards it. Opaque surfaces
    /// block it. Transmissive surfaces on the straight line let through the light that they
    /// transmit and do not absorb.
    Vector light_let_through(const Ray<Real>& ray, const OriginSurfaces<Real>& origins, Media media,
                             Real distance);

    /// Returns the media that a ray from the camera starts in; `may_be_in_a_body`: false if no body
    /// encloses the origin.
    Media media_around(const Vector& origin, bool may_be_in_a_body = true);
    /// Returns the media that paths are inside of.
    MediaStacks& media() { return media_; }

  private:
    /// The surface that a path has hit, seen from the side that the path came from.
    struct Surface {
        Hit<Real> hit;
        const OriginSurfaces<Real>& contacts;
        const Material& material;
        Vector point;
        Vector flat_normal; ///< unit, perpendicular to the surface
        Vector normal;      ///< unit, to shade with: differs for smooth triangles

        /// Returns the origin surfaces for a ray from here.
        OriginSurfaces<Real> origins(bool through, const Vector& direction) const {
            return contacts.turned(hit, through, direction);
        }
    };

    /// The indices of refraction before and behind a surface.
    struct Indices {
        Real before;
        Real behind;
    };

    Vector light_on(const Path& path);
    Vector color_at_infinity(const Path& path) const;
    Real transmittance_to_infinity(const Path& path) const;
    Surface surface_at(const Path& path, const Encounter<Real>& encounter) const;
    Vector shade(const Path& path, const Surface& surface, const Vector& throughput);
    Vector own_color(const Surface& surface) const;
    Vector lit(const Path& path, const Surface& surface);
    Vector lit_softly(const Path& path, const Surface& surface, const Vector& own);
    Real highlight(const Path& path, const Surface& surface, const Vector& to_light) const;
    void reflect(const Path& path, const Surface& surface, const Vector& throughput);
    void transmit(const Path& path, const Surface& surface, const Vector& throughput,
                  const Vector& direction);
    void pass(const Path& path, const Surface& surface, const Vector& throughput);
    Path through(const Path& path, const Surface& surface, const Vector& throughput,
                 const Vector& direction);
    bool find_crossings(const Ray<Real>& ray, const OriginSurfaces<Real>& origins, Real distance);

    Sample taken(const SampleName& name);
    bool is_abandoned() const { return abandon_ != nullptr && *abandon_; }
    bool is_worth(const Vector& throughput) const;
    bool is_visible(const Hit<Real>& hit) const;
    Indices indices_at(const Hit<Real>& hit, Media media, Media behind);

    Real let_through(const Hit<Real>& hit, const Ray<Real>& ray,
                     const OriginSurfaces<Real>& origins, Media media, Media media_behind);
    Media media_behind(const Path& path, const Surface& surface);
    Media media_behind(const Hit<Real>& hit, Media media, int count);
    MaterialIndex medium_before(const Hit<Real>& hit, Media media) const;
    Vector absorbed(MaterialIndex medium, Real distance) const;

    const Scene& scene_;
    Settings settings_;
    CameraRays<Real> camera_rays_;
    Searcher<Real> searcher_;
    bool is_exact_;
    MediaStacks media_;
    std::vector<Path> pending_;        // the next path last
    std::vector<Hit<Real>> crossings_; // of a shadow ray
    std::vector<SoftLight> soft_lights_;
    double cost_ = 0.0;
    double light_rays_ = 0.0; // for each surface
    SampleName sample_{};
    Vector start_{};                   // origin of the last camera ray
    std::optional<Media> start_media_; // media around start_

    Survey* survey_ = nullptr; // set if the image has a quality
    const std::atomic<bool>* abandon_;
    std::optional<RegionSamples> to_quality_;
    Hit<Real> first_hit_; // first hit of the last camera ray
    Real transmittance_ = 0;
};

extern template class ReferenceTracer<float>;
extern template class ReferenceTracer<double>;

} // namespace raylane::core
