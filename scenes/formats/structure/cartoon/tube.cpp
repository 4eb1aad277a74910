#include "scenes/formats/structure/cartoon/shapes.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::scenes {

namespace {

using core::Vec3d;
using core::Vec3f;

/// Adds pieces of a tube, from point to point, with a sphere at each end.
class Pieces {
  public:
    Pieces(double radius, const AddShape& add) : radius_(static_cast<float>(radius)), add_(add) {}

    void add(const Vec3d& from, const Vec3d& to, AtomIndex atom) {
        const auto start = core::convert<float>(from);
        const Vec3f axis = core::convert<float>(to) - start;
        if (!(core::squared_length(core::convert<double>(axis)) > 0.0)) return;
        add_ball(from, atom);
        add_(core::CappedCylinder{start, axis, radius_}, atom);
        add_ball(to, atom);
    }

  private:
    void add_ball(const Vec3d& at, AtomIndex atom) {
        const auto center = core::convert<float>(at);
        if (has_ball_ && center == last_) return;
        add_(core::Sphere{center, radius_}, atom);
        last_ = center;
        has_ball_ = true;
    }

    float radius_;
    const AddShape& add_;
    Vec3f last_{0.0F};
    bool has_ball_ = false;
};

/// Returns the number of pieces for half of the path between two points, by its turn.
int pieces_between(const Curve& curve, double from, double to) {
    constexpr double largest_cosine_of_turn = 0.9962; // 5 degrees
    constexpr int most = 16;
    for (int pieces = 1; pieces < most; ++pieces) {
        bool is_even = true;
        for (int k = 0; k < pieces && is_even; ++k) {
            const double step = (to - from) / pieces;
            const Vec3d a = curve(from + k * step).along, b = curve(from + (k + 1) * step).along;
            is_even = core::dot(a, b) >= largest_cosine_of_turn;
        }
        if (is_even) return pieces;
    }
    return most;
}

} // namespace

void add_tube(const Path& path, double radius, const IsDrawn& is_drawn, const AddShape& add) {
    const Curve curve(path);
    Pieces pieces(radius, add);
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (!is_drawn(path[i].atom)) continue;
        const auto s = static_cast<double>(i);
        for (const auto& [from, to] : {std::pair(s - 0.5, s), {s, s + 0.5}}) {
            if (from < 0.0 || to > curve.end()) continue;
            const int count = pieces_between(curve, from, to);
            Vec3d start = curve.point(from);
            for (int k = 1; k <= count; ++k) {
                const Vec3d end = curve.point(from + k * (to - from) / count);
                pieces.add(start, end, path[i].atom);
                start = end;
            }
        }
    }
}

void add_trace(const Path& path, double radius, const IsDrawn& is_drawn, const AddShape& add) {
    Pieces pieces(radius, add);
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (!is_drawn(path[i].atom)) continue;
        const Vec3d& at = path[i].at;
        if (i > 0) pieces.add(0.5 * (path[i - 1].at + at), at, path[i].atom);
        if (i + 1 < path.size()) pieces.add(at, 0.5 * (at + path[i + 1].at), path[i].atom);
    }
}

} // namespace raylane::scenes
