#pragma once

#include "core/beams/beam_search.hpp"
#include "core/scene/camera_rays.hpp"
#include "core/scene/region.hpp"

#include <array>
#include <vector>

namespace raylane::core {

/// A square of the image, in pixels from its upper left corner.
struct Square {
    double x, y;
    double size; ///< a side
};

/// Finds shapes that may show in squares of the image, by beams of all rays through them. Computes
/// in plain double, so that the result depends on scene and settings alone. For use by one thread.
class BeamTracer {
  public:
    BeamTracer(const Scene& scene, const Settings& settings);

    /// Returns true if shapes thinner than a pixel may show in a square, but not so many of them
    /// that its samples will see them anyway. Returns false for cameras with a lens, which blurs
    /// thin shapes.
    bool shows_thin(const Square& square);
    /// The thin shapes, and all shapes that may show. Valid until the next call of shows_thin.
    const std::vector<ShapeId>& thin() const { return thin_; }
    const std::vector<BeamCandidate>& shown() const { return shown_; }

    /// Tests the 4^halvings parts of a square, and keeps the shapes of `asked` that may show in at
    /// least `min_parts` of them. `shown` is shown() of the square; 1 <= halvings <=
    /// max_halvings.
    void keep_shown(const Square& square, const std::vector<BeamCandidate>& shown, int halvings,
                    int min_parts, std::vector<ShapeId>& asked);
    static constexpr int max_halvings = 4;

  private:
    static constexpr std::size_t max_thin = 64;

    bool is_thin(const BeamCandidate& candidate) const;
    Beam camera_beam(const Square& square) const;
    void find_shown(const Square& square, const std::vector<BeamCandidate>& shown, int halvings,
                    const std::vector<ShapeId>& asked);

    const Scene& scene_;
    Settings settings_;
    CameraRays<double> rays_;
    BeamSearch search_;
    std::vector<BeamCandidate> shown_;
    std::vector<ShapeId> thin_, found_, parts_shown_;
    std::array<std::vector<BeamCandidate>, max_halvings> closer_; // by remaining halvings
};

} // namespace raylane::core
