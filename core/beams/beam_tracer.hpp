#pragma once

#include "core/beams/beam_search.hpp"
#include "core/scene/camera_rays.hpp"
#include "core/scene/region.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace raylane::core {

/// A square of the picture, in pixels from its upper left corner.
struct Square {
    double x, y;
    double size; ///< a side
};

/// Finds shapes that may show in squares of the picture, by beams of all rays through them. It is
/// done in plain double, so that it depends on scene and settings alone. To be used by one thread.
class BeamTracer {
  public:
    BeamTracer(const Scene& scene, const Settings& settings);

    /// True if shapes thinner than a pixel may show in a square, but not so many that its samples
    /// will see them anyway. No beam looks through a lens: it shows all that is thin as a blur.
    bool shows_thin(const Square& square);
    /// These shapes, and all that may show; until the next call.
    const std::vector<ShapeId>& thin() const { return thin_; }
    const std::vector<BeamCandidate>& shown() const { return shown_; }

    /// Looks at the 4^halvings parts of a square, and keeps the shapes that may show in at least so
    /// many of them. `shown` is shown() of the square; halvings >= 1.
    void keep_shown(const Square& square, const std::vector<BeamCandidate>& shown, int halvings,
                    int least_parts, std::vector<ShapeId>& asked);
    static constexpr int most_halvings = 4;

  private:
    static constexpr std::size_t most_thin = 64;

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
    std::array<std::vector<BeamCandidate>, most_halvings> closer_; // by halvings that are left
};

} // namespace raylane::core
