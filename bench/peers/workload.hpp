#pragma once

#include "core/scene/scene.hpp"
#include "core/shapes/ray.hpp"
#include "simd/query/paths.hpp"

#include <optional>
#include <string>
#include <vector>

/// Scenes and rays that raylane and others are measured on.
namespace raylane::bench {

/// `spheres/N`: N spheres of radius 0.3 / cbrt(N), uniformly in the unit cube. `sticks/N`: about N
/// shapes of a ball-and-stick lattice in it, a quarter balls, the rest cylinders and cones. Else
/// the path of a scene file.
core::Scene make_workload(const std::string& name);

/// Rays, structure of arrays, and what is asked of them. Those that start on nothing have
/// directions of float precision, brought to unit length in double, so that those who know only
/// floats are asked the same.
struct RaySet {
    std::string name;
    bool occlusion = false; ///< true: any hit before t_most is asked for; false: the first hit
    std::optional<simd::Coherence> coherence; ///< that all of them have
    std::size_t count = 0;

    /// Paths from `begin` on, so many or all that are left.
    simd::Paths paths(std::size_t begin, std::size_t most) const;
    /// Rays of a wave: as many as a tile has at a time.
    static constexpr std::size_t wave = 1024;
    const float* t_most(std::size_t begin) const { return t_most_.data() + begin; }

    core::Ray<double> ray(std::size_t i) const;
    core::Ray<float> ray_in_float(std::size_t i) const;
    /// Least t for those who know of no departures: how far ahead a ray has to start lest it hits
    /// what it leaves.
    float t_least(std::size_t i) const { return t_least_[i]; }
    /// True if any ray leaves something.
    bool leaves_any() const;

    void reserve(std::size_t rays);
    /// Adds a ray in the open.
    void add(const core::Ray<double>& ray, float t_most);
    /// Adds a ray from what another has hit after a length of t.
    void add_from(const core::Ray<double>& ray, float t_most, const simd::SceneData& scene,
                  std::uint32_t slot, std::uint32_t hit, double t);
    /// All rays are there: makes room to read whole packets.
    void finish();

  private:
    void append(const core::Ray<double>& ray, const core::Ray<float>& in_float, float t_most);

    std::vector<double> origin_[3], direction_[3];
    std::vector<core::Ray<float>> in_float_;
    std::vector<float> t_most_, t_least_;
    std::vector<std::uint32_t> origin_first_, origin_last_, origin_slot_, departure_;
};

inline constexpr const char* ray_set_names[] = {"camera", "scanlines",  "mirror",   "shadow",
                                                "sky",    "incoherent", "occlusion"};

/// `camera`: those of a picture of side x side pixels, tile by tile, and `scanlines`: line by line;
/// `mirror`: what the camera's hits
/// reflect, `shadow`: from these hits to a point light, and `sky`: from each one anywhere above the
/// surface, by the cosine; `incoherent`: `side`^2 / 4 rays between
/// any points of the scene's bounds, onwards; and `occlusion`: whether there is anything between
/// those points.
std::vector<RaySet> make_ray_sets(const core::Scene& scene, const simd::SceneData& data, int side);

} // namespace raylane::bench
