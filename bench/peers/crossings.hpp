#pragma once

#include "bench/peers/measure.hpp"
#include "bench/peers/workload.hpp"

#include <memory>
#include <vector>

/// All crossings of rays, in order.
namespace raylane::bench {

/// By ray, from first[i] up to first[i + 1], in order.
struct ShapeRows {
    std::vector<std::uint64_t> first;
    std::vector<core::ShapeId> shape;
};

/// Somebody who finds them.
class Gatherer {
  public:
    virtual ~Gatherer() = default;
    virtual void run() = 0; ///< this is what is timed
    virtual const ShapeRows& rows() const = 0;
};

/// Embree, as its tutorial has it: a filter that notes each hit and rejects it, and a sort by t.
/// Null if it does not have the scene's shapes, or was not there when this was built.
std::unique_ptr<Gatherer> embree_gatherer(const core::Scene& scene, simd::Isa isa,
                                          const RaySet& rays);

} // namespace raylane::bench
