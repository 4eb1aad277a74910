#pragma once

#include "simd/isa/isa.hpp"
#include "simd/query/scene_data.hpp"
#include "simd/wavefront/render.hpp"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Measurements of raylane-peers: raylane and other ray tracers in turn, medians of several runs.
namespace raylane::bench {

/// A run to be timed: returns the seconds that it takes with this number of threads.
struct TimedRun {
    std::string name;
    std::function<double(int threads)> seconds;
};

double seconds_of(const std::function<void()>& run);

/// One contender's part of a row.
struct Result {
    std::string name;
    double median, least, most;       ///< in the row's unit
    std::optional<std::size_t> wrong; ///< number of wrong answers
    std::optional<double> alone;      ///< median with one thread; set if there are several threads

    /// Converts seconds for `count` items to a speed.
    void in_millions_per_second(std::size_t count);
};

/// One measurement of all contenders, raylane's engine first. Names of raylane's contenders begin
/// with "raylane" or "library".
struct Row {
    std::string what;
    std::size_t count = 0; ///< of rays, shapes or pixels
    bool is_speed = true;  ///< millions per second; otherwise seconds
    std::vector<Result> by;

    /// Returns the result for users of raylane: the library's, or the first if the row lacks one.
    const Result& users() const;
    /// Returns how many times better users() is than the best contender that is not raylane's;
    /// empty if all are raylane's.
    std::optional<double> ratio() const;
    nlohmann::ordered_json json() const;
    void print() const;
};

/// Returns Embree's version; null if it was missing in this build.
const char* embree_version();

struct Measuring {
    simd::Isa isa;
    int threads;
    int repetitions;
    int side; ///< of images, in pixels
    int call; ///< rays in each call of the library
};

/// Times all runs, alternating. The first round warms up. With several threads, a run with one
/// thread alternates, too.
std::vector<Result> alternate(const std::vector<TimedRun>& runs, const Measuring& how);

/// Measures the `wanted` ray sets, of ray_set_names. Reports each row when it is done.
void measure_rays(const simd::SceneData& scene, const std::vector<std::string>& wanted,
                  const Measuring& how, const std::function<void(const Row&)>& report);

/// Measures all crossings of `random` rays, in order, on one thread.
Row measure_crossings(const simd::SceneData& scene, const Measuring& how);

/// Measures the time to build a hierarchy on one thread, until the first ray can be traced.
Row measure_building(const core::Scene& scene, const Measuring& how);
/// Returns Embree's build, unless Embree is missing or lacks any of the scene's shapes.
std::optional<TimedRun> embree_building(const core::Scene& scene, simd::Isa isa);

/// Measures a whole image: by raylane, and by its wavefront with another traversal.
Row measure_image(const simd::SceneData& scene, const Measuring& how);

struct Drawing {
    std::string name;
    std::function<simd::Rendering(const core::Settings&, const simd::RenderOptions&)> draw;
};
/// Returns raylane's renderings with Precision::robust and Embree's traversal; empty if Embree is
/// missing or lacks any of the scene's shapes. Embree does not know the shape on which a ray
/// starts: rays start a little ahead, or a filter rejects that shape. Only one of these may run at
/// a time.
std::vector<Drawing> embree_drawings(const simd::SceneData& scene, simd::Isa isa);

} // namespace raylane::bench
