#pragma once

#include "core/beams/region_samples.hpp"
#include "core/scene/camera_rays.hpp"
#include "core/scene/film.hpp"
#include "core/scene/region.hpp"
#include "simd/wavefront/hit_sorter.hpp"
#include "simd/wavefront/shadow_tracer.hpp"

#include <atomic>
#include <optional>
#include <vector>

namespace raylane::simd {

/// Renders regions of an image: camera rays in chunks, then wave after wave of secondary rays,
/// until no ray is left. To be used by one thread. Allocates all of its memory once, except for
/// exact numbers that a crossing may need.
///
/// An image does not depend on its division into regions: each sample's contributions are added in
/// an order that does not depend on other samples, and samples are added in their own order.
///
/// Drawing: bench/drawings/ray_life.svg
class Wavefront {
  public:
    /// `survey`: needed if the image has a quality; otherwise it may be null. `abandon`: once it is
    /// true, the current region is left unfinished.
    Wavefront(const SceneData& scene, const core::Settings& settings, const Tracing& tracing,
              core::Survey* survey = nullptr, const std::atomic<bool>* abandon = nullptr);

    /// Takes the samples of one batch of the survey.
    void survey(core::Survey::Pass pass, std::size_t batch);

    /// Renders a region. With a quality, the survey must be finished, and the region must consist
    /// of whole squares (core::RegionSamples::square_size).
    void render(const core::Region& region, core::Film& film);

    /// Returns the number of samples that a pixel of the last region had. Pixels are numbered row
    /// by row.
    int samples_of(std::size_t pixel) const {
        return to_quality_ ? to_quality_->taken(pixel) : settings_.grid * settings_.grid;
    }

    Wavefront(const Wavefront&) = delete; // parts refer to others
    Wavefront& operator=(const Wavefront&) = delete;

    EngineCounters counters() const;

    /// Largest side of a region in pixels.
    static constexpr int max_region = 64;

  private:
    /// Samples in a chunk, and rays in a wave: about 2 KiB each in all arrays. Half and twice as
    /// many take the same time.
    static constexpr std::size_t chunk_samples = 1024;
    static constexpr std::size_t wave_rays = chunk_samples;
    static constexpr std::size_t deferred_waves = 12;

    /// Consecutive samples of a pixel.
    struct Samples {
        int x, y;
        std::size_t pixel; ///< of the region, row by row
        int first, count;
    };
    struct Deferred {
        std::size_t begin;
        std::size_t count;
        int depth;
    };

    bool is_abandoned() const { return abandon_ != nullptr && *abandon_; }
    void take_from(Arena& arena);
    void render_grid(const core::Region& region, core::Film& film);
    void render_to_quality(const core::Region& region, core::Film& film);
    template <class Visit>
    void for_each_pixel(const core::Region& region, const Visit& visit);
    template <class Pixels>
    auto adder_to(Pixels& pixels);
    /// Sets SampleName::common of the samples that follow.
    void begin_samples(int common);
    template <class Add>
    void take(Samples samples, const Add& add);
    template <class Add>
    void flush(const Add& add);
    core::CameraRays<double>::InPixel in_pixel(const Samples& batch, int number) const;
    void start(std::size_t count);
    void count_costs();
    void note_first_hits();
    void start_in_media();
    void trace();
    void trace_wave(int depth, const Coherence& coherence);
    void follow(std::size_t lane, int depth);
    void see_background(int depth);
    void shade(int depth);
    void fill_media();
    void fill_patterns(HitPaths& hit_paths);
    void look_at_lights();
    void add_lights();
    void add_soft_lights(int depth);
    void add_what_arrives();
    void spawn(int depth);
    std::size_t add_to_next(const SpawnedRays& spawned, bool through, int depth);
    std::size_t pass_on();
    void start_next(std::size_t to, std::size_t lane, bool through);
    int depth_of(std::size_t lane, int wave) const {
        return wave - static_cast<int>(paths_.passed_at(lane));
    }
    void split_next(int depth);
    void take_deferred(int& depth);
    void add(std::uint32_t sample, double r, double g, double b);
    core::Vec3d background_along(std::size_t lane);
    double transmittance_to_infinity(std::size_t lane);

    const SceneData& scene_;
    core::Settings settings_;
    Tracing tracing_;
    const std::atomic<bool>* abandon_;
    core::CameraRays<double> camera_rays_;
    CameraView camera_{};
    Coherence camera_coherence_{};
    Coherence next_coherence_ = neighbours; ///< of the rays that a wave has spawned
    bool with_media_;
    bool transparent_; ///< some surfaces are transparent
    ShadeKernels shade_;
    core::ReferenceTracer<double> reference_;
    TransparencyWalk finder_;
    ShadowTracer shadows_;
    EngineCounters counters_;

    Arena arena_;
    Paths paths_{}, next_{}, deferred_{};
    std::vector<Deferred> pending_;

    std::vector<Samples> samples_;                         // of the chunk
    std::vector<core::CameraRays<double>::InPixel> cells_; // by sample, if regular or in a grid
    double* way_ = nullptr;                                // HitPaths::way, where it differs from t
    double* on_shape_[2] = {}; // HitPaths::on_shape and pattern, by lane, if a pattern needs shapes
    double* pattern_[3] = {};
    double* across_ = nullptr;
    double* upward_ = nullptr;
    double* lens_right_ = nullptr; // if there is a lens
    double* lens_up_ = nullptr;
    double* radiance_[3] = {};            // by sample
    double* transmittance_ = nullptr;     // by sample, if the image has an alpha
    std::vector<core::SampleName> names_; // by sample
    int common_samples_ = 0;              // SampleName::common
    std::size_t filled_ = 0;              // samples of the chunk
    std::vector<core::Vec3d> sums_;       // by pixel of the region
    std::vector<double> transmittances_;  // the same

    // Used if the image has a quality.
    core::Survey* survey_;
    std::optional<core::RegionSamples> to_quality_;
    bool is_surveying_ = false;
    double light_rays_;                      // for each surface
    std::vector<double> cost_;               // by sample: core::Sample::cost, in a survey
    std::vector<core::ShapeId> first_shape_; // by sample: the shape that the camera ray hits
    // A wave, sorted.
    HitSorter sorted_;
    bool coherent_ = false;                  // hit by rays on straight lines from the camera
    std::vector<std::uint32_t> position_of_; // by lane, if some surfaces are transparent
    bool looked_ = false;                    // look_at_lights() has been called for this wave
    Surfaces surfaces_{};
    double* light_u_ = nullptr; // by position, if there are lights with a size
    double* light_v_ = nullptr;
    std::vector<std::uint64_t> light_keys_;
    std::vector<std::uint32_t> first_points_;
    MediumColumns media_{};
    SpawnedRays transmitted_{};
};

} // namespace raylane::simd
