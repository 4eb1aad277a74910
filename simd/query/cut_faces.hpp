#pragma once

#include "core/reference/solid_surfaces.hpp"
#include "simd/cuts.hpp"

#include <array>

namespace raylane::simd {

/// Says quickly where a face that cuts a union of many is a surface of its solid: where it is alone
/// and inside of a sphere of the union, most likely of one that it has been inside of just before.
/// To be used by one thread.
class CutFaces {
  public:
    explicit CutFaces(const core::Scene& scene) : scene_(scene) {}

    /// Whether a crossing with a part that cuts is one of the solid's surface. `error` is what its
    /// point may be off by.
    core::Value is_surface(const CutUnion& cut, core::ShapeId shape, const core::Vec3d& direction,
                           const core::Vec3d& point, double error);
    /// A part of the union that was found around a point.
    void remember(const CutUnion& cut, core::Solids::Index part);

  private:
    struct Sphere {
        const CutUnion* cut = nullptr;
        core::SphereOf<double> shape{};
    };

    const core::Scene& scene_;
    std::array<Sphere, 8> spheres_; // the one that was needed last is the first
};

} // namespace raylane::simd
