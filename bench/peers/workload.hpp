#pragma once

#include "core/scene/scene.hpp"
#include "core/shapes/ray.hpp"
#include "simd/isa/isa.hpp"
#include "simd/query/paths.hpp"

#include <optional>
#include <string>
#include <vector>

/// Scenes and rays on which raylane and other ray tracers are measured.
namespace raylane::bench {

/// Makes a scene. `spheres/N`: N spheres of radius 0.3 / cbrt(N), uniformly in the unit cube.
/// `sticks/N`: about N shapes of a ball-and-stick lattice in it, a quarter balls, the rest
/// cylinders and cones. Otherwise `name` is the path of a scene file.
/// The hierarchy is that for `isa`.
core::Scene make_workload(const std::string& name, simd::Isa isa);

/// Rays, structure of arrays, and the query to make with them. Rays that start on no shape have
/// directions of float precision, normalised in double, so that contenders in float trace the same
/// rays.
struct RaySet {
    std::string name;
    bool occlusion = false; ///< true: any hit before t_limit is sought; false: the first hit
    std::optional<simd::Coherence> coherence; ///< of all rays
    std::size_t count = 0;

    /// Returns paths from `begin` on: `most`, or all that are left.
    simd::Paths paths(std::size_t begin, std::size_t most) const;
    /// Number of rays in a wave: as many as a tile has at a time.
    static constexpr std::size_t wave = 1024;
    const float* t_limit(std::size_t begin) const { return t_limit_.data() + begin; }

    core::Ray<double> ray(std::size_t i) const;
    core::Ray<float> ray_in_float(std::size_t i) const;
    /// Returns the least t for contenders that do not know departures: a ray that starts this far
    /// ahead does not hit the shape that it leaves.
    float t_lowest(std::size_t i) const { return t_lowest_[i]; }
    /// Returns true if any ray leaves a shape.
    bool leaves_any() const;

    void reserve(std::size_t rays);
    /// Adds a ray that starts on no shape.
    void add(const core::Ray<double>& ray, float t_limit);
    /// Adds a ray that starts on the shape in `slot`, where another ray has hit it at distance t.
    /// `hit`: the bits of that hit, as in simd::Found::hit.
    void add_from(const core::Ray<double>& ray, float t_limit, const simd::SceneData& scene,
                  std::uint32_t slot, std::uint32_t hit, double t);
    /// Completes the set: makes whole packets readable.
    void finish();

  private:
    void append(const core::Ray<double>& ray, const core::Ray<float>& in_float, float t_limit);

    std::vector<double> origin_[3], direction_[3];
    std::vector<core::Ray<float>> in_float_;
    std::vector<float> t_limit_, t_lowest_;
    std::vector<std::uint32_t> origin_first_, origin_last_, origin_slot_, departure_;
};

inline constexpr const char* ray_set_names[] = {"camera",    "scanlines", "mirror", "diffuse",
                                                "diffuse-2", "shadow",    "sky",    "ambient",
                                                "random",    "occlusion"};

/// Makes the ray sets:
/// - `camera`: rays of an image of side x side pixels, tile by tile;
/// - `scanlines`: the same, line by line;
/// - `mirror`: reflections at the camera rays' hits;
/// - `diffuse`: from these hits, each in a random direction above the surface, by the cosine;
/// - `diffuse-2`: the same from the hits of `diffuse`;
/// - `shadow`: from the camera rays' hits to a point light, with unit directions in float;
/// - `sky`: whether the rays of `diffuse` hit anything;
/// - `ambient`: the same up to a distance of 1/20 of the scene's longest side;
/// - `random`: `side`^2 / 4 rays from a random point of the scene's bounds through another one;
/// - `occlusion`: whether anything is between those two points.
std::vector<RaySet> make_ray_sets(const core::Scene& scene, const simd::SceneData& data, int side);

} // namespace raylane::bench
