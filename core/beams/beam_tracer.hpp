#pragma once

#include "core/beams/beam_search.hpp"
#include "core/scene/camera_rays.hpp"
#include "core/scene/region.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace raylane::core {

/// What a beam of all rays through a square of pixels says of it.
enum class Sight : std::uint8_t {
    even,   ///< nothing hides in it: each pixel's middle shows its mean
    uneven, ///< one surface, evenly lit; but what it mirrors or lets through may have edges
    soft,   ///< one surface; what it shows of lights with a size is to be sampled
    step,   ///< one surface; a shadow or a colour of its paint may begin or end on it
    edge,   ///< a surface may begin or end in it
};

/// A square of the picture, in pixels from its upper left corner.
struct Square {
    double x, y;
    double size; ///< a side
};

/// Finds squares in which nothing hides: a beam of all rays through them meets no edge, nor do
/// those to the lights and off mirrors. All of it is done in plain double, so that it depends on
/// scene and settings alone. To be used by one thread.
class BeamTracer {
  public:
    BeamTracer(const Scene& scene, const Settings& settings);

    /// `t_likely`: where the last of its rays may meet the first surface; infinite if any misses.
    /// What comes out does not depend on it.
    Sight sight_of(const Square& square, double t_likely);
    /// The same, but that what is mirrored and let through is not looked at: as if even.
    Sight surfaces_in(const Square& square, double t_likely);

    /// After sight_of() or surfaces_in() an edge: the shapes that may show; empty if they are too
    /// many to know.
    const std::vector<BeamCandidate>& shown() const { return shown_; }

    /// Looks at the 4^halvings parts of a square, and keeps the shapes that may show in at least so
    /// many of them; no_shape is asked for as whatever may show behind them. `shown` is what
    /// shown() was of the square; halvings >= 1.
    void keep_shown(const Square& square, const std::vector<BeamCandidate>& shown, int halvings,
                    int least_parts, std::vector<ShapeId>& asked);
    static constexpr int most_halvings = 4;

  private:
    /// A surface that all rays of a beam meet.
    struct Surface {
        const Material& material;
        Departure departure; ///< on the side that it is seen from
        bool has_shading_normals;
        Vec3<Affine> point, flat_normal, direction;
    };

    BeamHit first_in(const Beam& beam, double t_likely);
    Beam camera_beam(const Square& square) const;
    Surface surface_at(const Beam& beam, const BeamHit& hit) const;
    bool is_lit_softly(const Surface& surface) const;
    bool is_lit_evenly(const Surface& surface, double weight);
    bool is_light_known(const Surface& surface, const Light& light, double weight);
    void find_shown(const Square& square, const std::vector<BeamCandidate>& shown, int halvings,
                    const std::vector<ShapeId>& asked);
    static double most_reflected(const Surface& surface, const Vec3<Affine>& to_light);
    bool is_smooth(const Surface& surface, double weight, double size) const;
    double unknown_behind(const Surface& surface, double weight, double size, int depth);
    double unknown_along(const Beam& beam, const Departure& from, double weight, double size,
                         int depth);

    const Scene& scene_;
    Settings settings_;
    CameraRays<double> rays_;
    BeamSearch search_;
    double tolerance_;       // of a linear component
    double brightest_ = 0.0; // of the lights without a size, together
    bool has_soft_lights_ = false;
    std::vector<BeamCandidate> shown_, in_the_way_, mirrored_;
    std::vector<ShapeId> found_, parts_shown_;
    std::array<std::vector<BeamCandidate>, most_halvings> closer_; // by halvings that are left
};

} // namespace raylane::core
