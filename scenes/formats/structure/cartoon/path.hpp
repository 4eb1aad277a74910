#pragma once

#include "scenes/formats/structure/cartoon/backbone.hpp"
#include "scenes/formats/structure/cartoon/spline.hpp"

#include <vector>

namespace raylane::scenes {

/// A point of a chain's path, one for each residue.
struct PathPoint {
    core::Vec3d at;
    core::Vec3d across; ///< direction of a ribbon's width; of any length except 0
    AtomIndex atom;     ///< for which the piece of the path around the point stands
    Secondary secondary = Secondary::coil;
};

using Path = std::vector<PathPoint>;

/// Returns the path of a protein through its CA. Ribbons are wide along the mean of the C=O on both
/// sides of a CA. If one of these is missing, they are wide across the plane of three CA.
Path path_of_peptide(const Structure& structure, const Segment& segment,
                     const std::vector<Secondary>& secondary);

/// Returns the path of a nucleic acid through its P, with the last O3' as its end.
Path path_of_nucleic(const Structure& structure, const Segment& segment);

/// Moves the points of strands to the middle of the pleats, and evens out directions.
void smooth(Path& path);

/// A place on the path with axes of length 1 and their derivatives by the parameter.
struct Frame {
    core::Vec3d at, along, across, up;   ///< up = along x across
    core::Vec3d by_at, by_across, by_up; ///< derivatives
};

/// A curve through the points of a path with axes across it. The parameter of point i is i.
class Curve {
  public:
    explicit Curve(const Path& path);
    Frame operator()(double s) const;
    double end() const { return static_cast<double>(points_.size() - 1); }
    core::Vec3d point(double s) const { return points_(s).at; }

  private:
    Spline points_, directions_;
};

} // namespace raylane::scenes
