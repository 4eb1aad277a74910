#pragma once

#include "core/beams/region_samples.hpp"
#include "core/optics/media.hpp"
#include "core/optics/soft_light.hpp"
#include "core/reference/search.hpp"
#include "core/scene/camera_rays.hpp"
#include "core/scene/film.hpp"
#include "core/scene/region.hpp"

#include <optional>

namespace raylane::core {

/// The scalar reference: what a picture of a scene is, written to be read. `Real` is float or
/// double. With Precision::exact every decision of which surface a ray hits is the one that real
/// arithmetic takes. To be used by one thread; what it makes of a pixel depends on scene and
/// settings alone.
template <class Real>
class ReferenceTracer {
  public:
    ReferenceTracer(const Scene& scene, const Settings& settings, Search search = Search::hierarchy,
                    Precision precision = precision_of<Real>, Survey* survey = nullptr);

    /// Samples a batch of its survey.
    void survey(Survey::Pass pass, std::size_t batch);

    /// With a quality, there is a survey, which is finished, and the region consists of whole
    /// squares (RegionSamples::square_size).
    void render(const Region& region, Film& film);

    /// Samples that a pixel of the last region had; pixels are numbered row by row.
    int samples_of(std::size_t pixel) const {
        return to_quality_ ? to_quality_->taken(pixel) : settings_.grid * settings_.grid;
    }

    /// The mean of a pixel's samples, added in their order, as many as `settings.grid` says. Linear
    /// RGB.
    Color pixel(int x, int y);

    /// The linear RGB colour seen along a ray; its direction is a unit vector.
    Vec3<Real> trace(const Ray<Real>& ray);

    /// Of the last ray, path or pixel: the share of the background that has been left out
    /// (Settings::alpha).
    Real transmittance() const { return transmittance_; }

    /// Counts of the work of all calls so far.
    const Counters& counters() const { return searcher_.counters; }

    using Vector = Vec3<Real>;

    /// Whose samples of lights with a size are taken from now on.
    void set_sample(const SampleName& sample) { sample_ = sample; }

    /// A ray underway.
    struct Path {
        Ray<Real> ray;
        OriginSurfaces<Real> origins;
        Media media;             ///< media that it is inside of
        Vector throughput;       ///< share of its colour that reaches the pixel
        int depth;               ///< reflections and refractions so far
        int crossings = 0;       ///< of surfaces where it starts that it may cross for nothing
        int passed = 0;          ///< see-through surfaces that it has gone straight through
        Real travelled = 0;      ///< on the straight line that its ray is on, before its start
        bool is_straight = true; ///< as it left the camera
    };

    /// Light that a path, with all that follows from it, brings to the pixel: linear RGB.
    Vector light_along(Path path);
    /// Of the last ray from the camera; none where it hits nothing.
    const Hit<Real>& first_hit() const { return first_hit_; }

    /// The first surface along a ray, whether it can be seen or not, and what it touches there.
    Encounter<Real> nearest(const Ray<Real>& ray, const OriginSurfaces<Real>& origins) {
        return searcher_.nearest(ray, origins, [](const Hit<Real>&) { return true; });
    }

    /// Share of a light that reaches the origin of a ray towards it: nothing through an opaque
    /// surface; through transmissive ones, on a straight line, what they transmit and do not
    /// absorb.
    Vector light_let_through(const Ray<Real>& ray, const OriginSurfaces<Real>& origins, Media media,
                             Real distance);

    /// Media that a ray from the camera starts in; `may_be_in_a_body`: false if that is
    /// known to be in none.
    Media media_around(const Vector& origin, bool may_be_in_a_body = true);
    /// Those that paths are inside of.
    MediaStacks& media() { return media_; }

  private:
    /// The surface that a path has hit, seen from the side that it came from.
    struct Surface {
        Hit<Real> hit;
        const OriginSurfaces<Real>& contacts;
        const Material& material;
        Vector point;
        Vector flat_normal; ///< unit, perpendicular to the surface
        Vector normal;      ///< unit, to shade with: differs for smooth triangles

        /// Origin surfaces for a ray from here.
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
    bool is_worth(const Vector& throughput) const;
    bool is_visible(const Hit<Real>& hit) const;
    Indices indices_at(const Hit<Real>& hit, Media media, Media behind);

    Real let_through(const Hit<Real>& hit, const Ray<Real>& ray,
                     const OriginSurfaces<Real>& origins, Media media, Media media_behind);
    Media media_behind(const Path& path, const Surface& surface);
    Media media_behind(const Hit<Real>& hit, Media media, int count = 1);
    MaterialIndex medium_before(const Hit<Real>& hit, Media media) const;
    Vector absorbed(MaterialIndex medium, Real distance) const;

    const Scene& scene_;
    Settings settings_;
    CameraRays<Real> camera_rays_;
    Searcher<Real> searcher_;
    MediaStacks media_;
    std::vector<Path> pending_;        // the next one last
    std::vector<Hit<Real>> crossings_; // of a shadow ray
    std::vector<SoftLight> soft_lights_;
    SampleName sample_{};
    Vector start_{};                   // of the last ray from the camera
    std::optional<Media> start_media_; // around it

    Survey* survey_ = nullptr; // if the picture has a quality
    std::optional<RegionSamples> to_quality_;
    Hit<Real> first_hit_; // of the last ray from the camera
    Real transmittance_ = 0;
};

extern template class ReferenceTracer<float>;
extern template class ReferenceTracer<double>;

} // namespace raylane::core
