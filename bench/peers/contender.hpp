#pragma once

#include "bench/peers/workload.hpp"
#include "simd/isa/isa.hpp"

#include <memory>

namespace raylane::bench {

/// A ray tracer that is measured.
class Contender {
  public:
    virtual ~Contender() = default;

    /// Prepares for a set of rays. The rays must exist until the next set is prepared.
    virtual void prepare(const RaySet& rays) = 0;
    /// Answers the rays from `begin`, a multiple of RaySet::wave, to `end` - 1. The time of this
    /// call is measured. If several threads call it, each has different rays and a different
    /// `thread`, counted from 0.
    virtual void run(std::size_t begin, std::size_t end, int thread) = 0;
    /// Returns the answers by ray, after all rays have been answered: the id of the shape hit, or
    /// no_shape; for occlusion, 1 or 0.
    virtual std::vector<std::uint32_t> answers() = 0;

    const std::string& name() const { return name_; }

  protected:
    explicit Contender(std::string name) : name_(std::move(name)) {}

  private:
    std::string name_;
};

using Contenders = std::vector<std::unique_ptr<Contender>>;

/// Makes raylane's engine, with rays in its arrays.
std::unique_ptr<Contender> make_own(const simd::SceneData& scene, simd::Isa isa, int threads);

/// Makes raylane's library as users call it. If `names` is true, rays name the shapes that they
/// leave. Otherwise, their t_min lets them start ahead of these shapes. `call`: rays in each call.
std::unique_ptr<Contender> make_library(const simd::SceneData& scene, simd::Isa isa, bool names,
                                        int call);

/// Makes contenders of Embree: its calls for one ray and, if `call` is 16 or more, for 16 rays,
/// also with the coherent flag. Returns no contenders if Embree lacks any of the scene's shapes, or
/// was missing in this build.
Contenders make_embree(const core::Scene& scene, simd::Isa isa, int call);

} // namespace raylane::bench
