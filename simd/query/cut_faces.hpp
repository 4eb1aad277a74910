#pragma once

#include "core/reference/solid_surfaces.hpp"
#include "simd/query/clip_planes.hpp"

#include <array>

namespace raylane::simd {

/// Decides quickly where a face that cuts a union of many parts is a surface of its solid. It is
/// one where no other face is and a sphere of the union contains the point. That is most likely a
/// sphere that contained another point just before. To be used by one thread.
class CutFaces {
  public:
    explicit CutFaces(const core::Scene& scene) : scene_(scene) {}

    /// Decides whether a crossing with a part that cuts is on the solid's surface. `error` bounds
    /// the error of its point.
    core::Value is_surface(const CutUnion& cut, core::ShapeId shape, const core::Vec3d& direction,
                           const core::Vec3d& point, double error);
    /// Stores a part of the union that was found around a point, if it is a sphere.
    void remember(const CutUnion& cut, core::Solids::Index part);

  private:
    struct Sphere {
        const CutUnion* cut = nullptr;
        core::SphereOf<double> shape{};
    };

    const core::Scene& scene_;
    std::array<Sphere, 8> spheres_; // most recently used first
};

} // namespace raylane::simd
