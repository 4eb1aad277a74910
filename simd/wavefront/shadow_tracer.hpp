#pragma once

#include "core/reference/tracer.hpp"
#include "simd/query/transparency_walk.hpp"

#include <optional>

namespace raylane::simd {

/// Takes arrays for spawned rays.
void take_spawned(Arena& arena, SpawnedRays& rays, std::size_t capacity);

/// Finds the light that reaches the surfaces of a wave.
class ShadowTracer {
  public:
    /// `dims`: surfaces and media that let light pass dim it.
    ShadowTracer(const SceneData& scene, const Tracing& tracing,
                 core::ReferenceTracer<double>& reference, bool dims);

    void take_from(Arena& arena, std::size_t capacity, bool with_media);

    /// Rays to the light, to be filled in. Their weight is the light that arrives if nothing is in
    /// the way.
    SpawnedRays& rays() { return rays_; }

    /// The wave from which the rays come. Position p is the surface that lane order[p] has hit.
    struct Wave {
        const Paths& paths;
        const Hits& hits;
        const std::uint32_t* order;
        std::size_t count; ///< of positions
        bool coherent;     ///< rays from the camera have hit it
    };

    /// Sets the wave for the following traces, to any number of lights.
    void look_at(const Wave& wave);
    /// Reduces the rays' weights by the surfaces in the way, or blocks the rays.
    void trace(const LightView& light, EngineCounters& counters);
    /// Same as trace(), for rays in all directions.
    void trace_softly(EngineCounters& counters);
    /// Lets all rays arrive, whatever is in the way.
    void let_pass();

    bool arrives(std::size_t ray) const { return state_[ray] != blocked; }

  private:
    void trace(const Coherence& coherence, EngineCounters& counters);
    void start();
    void find_blocked(const Coherence* coherence, EngineCounters& counters);
    void walk(const Coherence& coherence, EngineCounters& counters);
    void start_walk(std::size_t ray);
    void follow(std::size_t lane);
    bool step(std::size_t lane, double& distance);
    void absorb(core::MaterialIndex medium, double distance, std::size_t lane);

    const SceneData& scene_;
    core::ReferenceTracer<double>& reference_;
    bool dims_;

    std::optional<Wave> wave_;
    // The shapes that rays from each position leave, and the state that is known before a search.
    std::uint32_t* leave_first_ = nullptr;
    std::uint32_t* leave_last_ = nullptr;
    std::uint8_t* leave_state_ = nullptr;

    SpawnedRays rays_{};
    std::uint32_t* origin_first_ = nullptr;
    std::uint32_t* origin_last_ = nullptr;
    std::uint8_t* state_ = nullptr;

    // Rays that a surface may let through, or that may cross again the shape that they start on,
    // walk from surface to surface.
    TransparencyWalk walker_;
    Paths walk_{}; // throughput: the remaining weight; sample: the ray
    double* walk_distance_ = nullptr;
};

} // namespace raylane::simd
