#pragma once

#include "core/reference/tracer.hpp"
#include "simd/query/look_through.hpp"

#include <optional>

namespace raylane::simd {

/// Arrays for spawned rays.
void take_spawned(Arena& arena, SpawnedRays& rays, std::size_t capacity);

/// Finds what of a light reaches the surfaces of a wave.
class ShadowTracer {
  public:
    ShadowTracer(const SceneData& scene, const Tracing& tracing,
                 core::ReferenceTracer<double>& reference);

    void take_from(Arena& arena, std::size_t capacity, bool with_media);

    /// Rays to the light, to be filled, weighted by what arrives if nothing is in the way.
    SpawnedRays& rays() { return rays_; }

    /// Wave that they come from: position p of it is what lane order[p] has hit.
    struct Wave {
        const Paths& paths;
        const Hits& hits;
        const std::uint32_t* order;
        std::size_t count; ///< of positions
        bool coherent;     ///< it was hit by rays from the camera
    };

    /// Whose rays are traced from now on, to any number of lights.
    void look_at(const Wave& wave);
    /// Weakens the rays' weights by what is in the way, or blocks them.
    void trace(const LightView& light, EngineCounters& counters);
    /// The same of rays to all sides.
    void trace_softly(EngineCounters& counters);
    /// Has all of them arrive, whatever is in the way.
    void let_pass();

    bool arrives(std::size_t ray) const { return state_[ray] != blocked; }

  private:
    void trace(const Coherence& coherence, bool together, EngineCounters& counters);
    void start();
    void find_blocked(const Coherence* coherence, EngineCounters& counters);
    void walk(const Coherence& coherence, EngineCounters& counters);
    void start_walk(std::size_t ray);
    void follow(std::size_t lane);
    bool step(std::size_t lane, double& distance);
    void absorb(core::MaterialIndex medium, double distance, std::size_t lane);

    const SceneData& scene_;
    core::ReferenceTracer<double>& reference_;

    std::optional<Wave> wave_;
    // Shapes that rays from each position of the wave leave, and what is known of the rays.
    std::uint32_t* leave_first_ = nullptr;
    std::uint32_t* leave_last_ = nullptr;
    std::uint8_t* leave_state_ = nullptr;

    SpawnedRays rays_{};
    std::uint32_t* origin_first_ = nullptr;
    std::uint32_t* origin_last_ = nullptr;
    std::uint8_t* state_ = nullptr;

    // Rays that some surface may let through, or that may cross again what they start on: they walk
    // from surface to surface.
    LookThrough walker_;
    Paths walk_{}; // throughput: what is left of the weight; sample: the ray
    double* walk_distance_ = nullptr;
};

} // namespace raylane::simd
