#pragma once

#include "core/beams/beam.hpp"
#include "core/scene/scene.hpp"

#include <vector>

/// Searches the shapes that a beam meets. Works like a ray's search, with answers that hold for all
/// rays of the beam or for no ray.
namespace raylane::core {

/// A shape that a beam may meet.
struct BeamCandidate {
    Bounds bounds; ///< infinite if the shape is unbounded
    Place place;
    Kind kind;
    ShapeId id = no_shape;
    float near; ///< lower bound on t
};

class BeamSearch {
  public:
    explicit BeamSearch(const Scene& scene);

    /// Maximum number of candidates. A beam that may meet more is in doubt as a whole.
    static constexpr std::size_t max_candidates = 4096;

    /// Fills in all shapes whose bounds a beam may meet. Returns false if they are too many.
    bool collect(const Beam& beam, std::vector<BeamCandidate>& candidates);

    /// Reduces the candidates of a beam to those of a part of it.
    static void narrow(const Beam& part, std::vector<BeamCandidate>& candidates);

    /// Keeps the candidates that some ray of the beam may meet first.
    void keep_first(const Beam& beam, std::vector<BeamCandidate>& candidates);

  private:
    struct Met {
        enum What : std::uint8_t { missed, whole, partly } what;
        Crossing<Affine> crossing{}; ///< if partly: not behind any ray's first crossing
    };

    template <class Visit>
    bool for_each_block(const Hierarchy& hierarchy, const BeamSlabs& slabs, const Visit& visit);
    template <class Visit>
    bool for_each_copied_block(const BeamSlabs& slabs, const Visit& visit);

    Met meet(const BeamCandidate& candidate, const Beam& beam, const BeamCone& cone) const;

    /// Returns the bounds of a block's shapes. Valid until the next call.
    const BlockBounds& bounds_of(const Child& block);
    void add(const Child& block, int lane, const BlockBounds& block_bounds, float near,
             std::vector<BeamCandidate>& candidates) const;

    const Scene& scene_;
    /// Cache of the bounds of recently used blocks; each block has one possible entry. In a scene
    /// of millions of shapes, the bounds of all blocks would take as much memory as the shapes.
    struct Held {
        std::uint32_t index = 0;
        Kind kind{};
        bool any = false;
        BlockBounds bounds;
    };
    std::vector<Held> held_; // the size is a power of two
    std::vector<BeamCandidate> unbounded_;
    std::vector<Child> pending_;
    std::vector<Affine> met_; // t of candidates
};

} // namespace raylane::core
