#pragma once

#include "bench/peers/workload.hpp"
#include "simd/isa.hpp"

#include <memory>

namespace raylane::bench {

/// Who answers rays, on one thread.
class Contender {
  public:
    virtual ~Contender() = default;

    /// Makes ready for a set, which must stay there until the next one.
    virtual void prepare(const RaySet& rays) = 0;
    /// Answers all of them. This is what is timed.
    virtual void run() = 0;
    /// By ray: the id of the shape hit or no_shape; or, of occlusion, 1 or 0. After a run.
    virtual std::vector<std::uint32_t> answers() = 0;

    const std::string& name() const { return name_; }

  protected:
    explicit Contender(std::string name) : name_(std::move(name)) {}

  private:
    std::string name_;
};

/// raylane itself.
std::unique_ptr<Contender> make_own(const simd::SceneData& scene, simd::Isa isa);

/// Embree: its calls for one ray, for 16 and, of rays that have something in common, for 16 that
/// are said to be coherent. None if it does not have the scene's shapes, or was not there when this
/// was built.
std::vector<std::unique_ptr<Contender>> make_embree(const core::Scene& scene, simd::Isa isa);

/// Seconds that Embree takes to build its hierarchy of the scene's shapes; negative if it cannot.
double embree_build_seconds(const core::Scene& scene, simd::Isa isa);

} // namespace raylane::bench
