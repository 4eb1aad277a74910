#pragma once

#include "core/beams/beam.hpp"
#include "core/scene/scene.hpp"

#include <vector>

/// What a beam meets: as a ray's search, with answers that hold for all of its rays or for none.
namespace raylane::core {

/// A shape that a beam may meet.
struct BeamCandidate {
    Bounds bounds; ///< infinite if it has none
    Place place;
    Kind kind;
    ShapeId id = no_shape;
    float near; ///< lower bound on t
};

class BeamSearch {
  public:
    explicit BeamSearch(const Scene& scene);

    /// Most candidates that are looked at; where a beam may meet more, all is in doubt.
    static constexpr std::size_t most_candidates = 4096;

    /// Fills in all shapes whose bounds a beam may meet; false if they are too many.
    bool collect(const Beam& beam, std::vector<BeamCandidate>& candidates);

    /// Of the candidates of a beam those of a part of it.
    static void narrow(const Beam& part, std::vector<BeamCandidate>& candidates);

    /// Keeps of the candidates those that a part of the beam may meet first.
    void keep_first(const Beam& beam, std::vector<BeamCandidate>& candidates);

  private:
    struct Met {
        enum What : std::uint8_t { missed, whole, partly } what;
        Crossing<Affine> crossing{}; ///< if partly: not behind any
    };

    Met meet(const BeamCandidate& candidate, const Beam& beam, const BeamCone& cone) const;

    /// Of a block's shapes; until the next call.
    const BlockBounds& bounds_of(const Child& block);
    void add(const Child& block, int lane, const BlockBounds& all, float near,
             std::vector<BeamCandidate>& candidates) const;

    const Scene& scene_;
    /// Bounds of the blocks that were looked at last, each in the one place where it may be: in a
    /// scene of millions all of them would take as much memory as the shapes do.
    struct Held {
        std::uint32_t index = 0;
        Kind kind{};
        bool any = false;
        BlockBounds bounds;
    };
    std::vector<Held> held_; // as many as a power of two
    std::vector<BeamCandidate> unbounded_;
    std::vector<Child> pending_;
    std::vector<Affine> met_; // t of candidates
};

} // namespace raylane::core
