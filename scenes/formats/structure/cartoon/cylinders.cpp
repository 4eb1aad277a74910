#include "scenes/formats/structure/cartoon/shapes.hpp"

#include <algorithm>

namespace raylane::scenes {

namespace {

using core::Vec3d;

constexpr float cylinder_radius = 2.0F;
constexpr std::size_t residues_per_turn = 4; // residues, 3.6 in alpha helices

/// A point of a helix's axis beside each of its residues.
struct Helix {
    std::size_t first, last;
    std::vector<Vec3d> axis;

    const Vec3d& at(std::size_t i) const { return axis[i - first]; }
};

double distance_from_line(const Vec3d& point, const Vec3d& a, const Vec3d& b) {
    const Vec3d way = b - a;
    const double square = core::squared_length(way);
    const Vec3d from = point - a;
    return core::length(square > 0.0 ? from - core::dot(from, way) / square * way : from);
}

/// Returns the point from `first` to `last` at which to split a line between these, or `first` if
/// all points are near it.
std::size_t bend_of(const std::vector<Vec3d>& points, std::size_t first, std::size_t last) {
    constexpr double furthest = 1.0;
    constexpr std::size_t least = 2 * residues_per_turn;
    std::size_t worst = first;
    double most = furthest;
    for (std::size_t i = first + residues_per_turn;
         i + residues_per_turn <= last && last - first >= least; ++i)
        if (const double far = distance_from_line(points[i], points[first], points[last]);
            far > most) {
            most = far;
            worst = i;
        }
    return worst;
}

/// Replaces points by a line between the first and the last one, or by several lines if one is too
/// far from a point (Ramer, Douglas and Peucker).
void straighten(std::vector<Vec3d>& points) {
    std::vector<std::size_t> ends{points.size() - 1}; // of the lines to come, the last first
    for (std::size_t first = 0; first + 1 < points.size();) {
        const std::size_t last = ends.back();
        if (const std::size_t bend = bend_of(points, first, last); bend != first) {
            ends.push_back(bend);
            continue;
        }
        const Vec3d from = points[first], way = points[last] - points[first];
        for (std::size_t i = first; i <= last; ++i)
            points[i] =
                from + static_cast<double>(i - first) / static_cast<double>(last - first) * way;
        first = last;
        ends.pop_back();
    }
}

/// Returns the axis beside each residue: means of four points, continued at the ends.
Helix helix_of(const Path& path, std::size_t first, std::size_t last) {
    std::vector<Vec3d> means; // beside first + 1.5, first + 2.5, ...
    for (std::size_t i = first; i + residues_per_turn - 1 <= last; ++i)
        means.push_back(0.25 * (path[i].at + path[i + 1].at + path[i + 2].at + path[i + 3].at));
    straighten(means);
    Helix helix{first, last, {}};
    const auto between = [&](double place) {
        if (means.size() == 1) {
            const Vec3d way = path[last].at - path[first].at;
            return means[0] + place / static_cast<double>(last - first) * way;
        }
        const double most = static_cast<double>(means.size()) - 2.0;
        const auto i = static_cast<std::size_t>(std::clamp(place, 0.0, most));
        return means[i] + (place - static_cast<double>(i)) * (means[i + 1] - means[i]);
    };
    for (std::size_t i = first; i <= last; ++i)
        helix.axis.push_back(between(static_cast<double>(i - first) - 1.5));
    return helix;
}

class HelixCylinders {
  public:
    HelixCylinders(const Path& path, const RibbonSizes& sizes, double max_error,
                   const IsDrawn& is_drawn, const AddShape& add)
        : path_(path), sizes_(sizes), max_error_(max_error), is_drawn_(is_drawn), add_(add) {}

    void add() {
        for (std::size_t i = 0; i < path_.size();) {
            std::size_t last = i;
            while (last + 1 < path_.size() && path_[last + 1].secondary == path_[i].secondary)
                ++last;
            if (path_[i].secondary == Secondary::helix && last - i + 1 >= residues_per_turn)
                add_helix(helix_of(path_, i, last));
            else
                rest_.insert(rest_.end(), path_.begin() + static_cast<std::ptrdiff_t>(i),
                             path_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
            i = last + 1;
        }
        add_rest();
    }

  private:
    /// The path before a helix ends inside of its cylinder, and the path behind begins there.
    void add_helix(const Helix& helix) {
        const auto end = [&](std::size_t i) {
            return PathPoint{helix.at(i), path_[i].across, path_[i].atom};
        };
        if (!rest_.empty()) rest_.push_back(end(helix.first));
        add_rest();
        if (helix.last + 1 < path_.size()) rest_.push_back(end(helix.last));
        for (std::size_t i = helix.first; i < helix.last; ++i) {
            const Vec3d middle = 0.5 * (helix.at(i) + helix.at(i + 1));
            add_piece(helix.at(i), middle, path_[i].atom);
            add_piece(middle, helix.at(i + 1), path_[i + 1].atom);
            if (i > helix.first && bends(helix, i) && is_drawn_(path_[i].atom))
                add_(core::Sphere{core::convert<float>(helix.at(i)), cylinder_radius},
                     path_[i].atom);
        }
    }

    static bool bends(const Helix& helix, std::size_t i) {
        return core::squared_length(helix.at(i + 1) - 2.0 * helix.at(i) + helix.at(i - 1)) > 1e-12;
    }

    void add_piece(const Vec3d& from, const Vec3d& to, AtomIndex atom) {
        const auto axis = core::convert<float>(to - from);
        if (is_drawn_(atom) && axis != core::Vec3f(0.0F))
            add_(core::CappedCylinder{core::convert<float>(from), axis, cylinder_radius}, atom);
    }

    void add_rest() {
        add_ribbon(rest_, sizes_, max_error_, is_drawn_, add_);
        rest_.clear();
    }

    const Path& path_;
    const RibbonSizes& sizes_;
    double max_error_;
    const IsDrawn& is_drawn_;
    const AddShape& add_;
    Path rest_; // residues behind the last helix
};

} // namespace

void add_with_cylinders(const Path& path, const RibbonSizes& sizes, double max_error,
                        const IsDrawn& is_drawn, const AddShape& add) {
    HelixCylinders(path, sizes, max_error, is_drawn, add).add();
}

} // namespace raylane::scenes
