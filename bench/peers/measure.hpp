#pragma once

#include "simd/isa.hpp"
#include "simd/render.hpp"
#include "simd/scene_data.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Measurements of raylane-peers: raylane and others in turn, medians of several runs.
namespace raylane::bench {

/// Something to be timed: it says how many seconds it took, by so many threads.
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
    std::optional<double> alone;      ///< the median by one thread, where there are several

    /// Seconds for so many become a speed.
    void in_millions_per_second(std::size_t count);
};

/// One measurement of all contenders, raylane's engine first. What is raylane's is called so, or
/// "library".
struct Row {
    std::string what;
    std::size_t count = 0; ///< of rays, shapes or pixels
    bool is_speed = true;  ///< millions per second, else seconds
    std::vector<Result> by;

    /// What users of raylane have: the library, where there is a row of it, or else the first.
    const Result& users() const;
    /// Ratio by which that outdoes the best of the others; none if raylane is alone.
    std::optional<double> ratio() const;
    nlohmann::ordered_json json() const;
    void print() const;
};

/// Version of Embree; null if it was not there when this was built.
const char* embree_version();

struct Measuring {
    simd::Isa isa;
    int threads;
    int repetitions;
    int side; ///< of pictures, in pixels
};

/// Times all, alternating; the first round warms up. Of several threads, one alone takes its turn,
/// too.
std::vector<Result> alternate(const std::vector<TimedRun>& runs, const Measuring& how);

/// Rays of the sorts that are `wanted`, of ray_set_names. Each row is handed over when it is done.
void measure_rays(const simd::SceneData& scene, const std::vector<std::string>& wanted,
                  const Measuring& how, const std::function<void(const Row&)>& report);

/// All crossings of `incoherent` rays, in order, by one thread.
Row measure_crossings(const simd::SceneData& scene, const Measuring& how);

/// Time to build a hierarchy, by one thread, until the first ray can be traced.
Row measure_building(const core::Scene& scene, const Measuring& how);
/// Embree's part of it, if it is there and has the scene's shapes.
std::optional<TimedRun> embree_building(const core::Scene& scene, simd::Isa isa);

/// A whole picture: by raylane, and by its wavefront with another's traversal inside.
Row measure_picture(const simd::SceneData& scene, const Measuring& how);

struct Drawing {
    std::string name;
    std::function<simd::Rendering(const core::Settings&, const simd::RenderOptions&)> draw;
};
/// raylane's, by Precision::robust, with Embree inside, if it is there and has the scene's shapes.
/// It does not know what a ray starts on: rays start a little ahead, or a filter rejects that
/// shape. Only one of these at a time may be drawn.
std::vector<Drawing> embree_drawings(const simd::SceneData& scene, simd::Isa isa);

} // namespace raylane::bench
