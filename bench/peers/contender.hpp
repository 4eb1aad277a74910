#pragma once

#include "bench/peers/workload.hpp"
#include "simd/isa.hpp"

#include <memory>

namespace raylane::bench {

/// Contender that answers rays.
class Contender {
  public:
    virtual ~Contender() = default;

    /// Makes ready for a set, which must stay there until the next one.
    virtual void prepare(const RaySet& rays) = 0;
    /// Answers rays begin to end; begin is a multiple of RaySet::wave. This is what is timed. Of
    /// several threads each has its own number, from 0 on, and its own rays.
    virtual void run(std::size_t begin, std::size_t end, int thread) = 0;
    /// Answers by ray, after all have been answered: the id of the shape hit or no_shape; or, of
    /// occlusion, 1 or 0.
    virtual std::vector<std::uint32_t> answers() = 0;

    const std::string& name() const { return name_; }

  protected:
    explicit Contender(std::string name) : name_(std::move(name)) {}

  private:
    std::string name_;
};

using Contenders = std::vector<std::unique_ptr<Contender>>;

/// raylane itself, by its own arrays.
std::unique_ptr<Contender> make_own(const simd::SceneData& scene, simd::Isa isa, int threads);

/// raylane's library, as its users have it: rays name what they leave, or start ahead of it.
std::unique_ptr<Contender> make_library(const simd::SceneData& scene, simd::Isa isa, bool names);

/// Embree: its calls for one ray, for 16, and for 16 that are said to be coherent. None if it does
/// not have the scene's shapes, or was not there when this was built.
Contenders make_embree(const core::Scene& scene, simd::Isa isa);

} // namespace raylane::bench
