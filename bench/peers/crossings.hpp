#pragma once

#include "bench/peers/measure.hpp"
#include "bench/peers/workload.hpp"

#include <memory>
#include <vector>

/// All crossings of rays, in order.
namespace raylane::bench {

/// Shapes by ray, from first[i] up to first[i + 1], in order.
struct ShapeRows {
    std::vector<std::uint64_t> first;
    std::vector<core::ShapeId> shape;
};

/// A ray tracer that finds all crossings.
class Gatherer {
  public:
    virtual ~Gatherer() = default;
    virtual void run() = 0; ///< this call is timed
    virtual const ShapeRows& rows() const = 0;
};

/// Makes Embree's gatherer, as in Embree's tutorial: a filter that stores each hit and rejects it,
/// and a sort by t. Null if Embree lacks any of the scene's shapes, or was missing in this build.
std::unique_ptr<Gatherer> embree_gatherer(const core::Scene& scene, simd::Isa isa,
                                          const RaySet& rays);

} // namespace raylane::bench
