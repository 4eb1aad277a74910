#include "core/numbers/elementary.hpp"
#include "core/shapes/checks.hpp"
#include "scenes/formats/structure/cartoon/shapes.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::scenes {

namespace {

using core::Vec3d;
using core::Vec3f;

/// A half-size of a ribbon's profile and its derivative along the path.
struct Size {
    double value, by_s = 0.0;
};

/// A point of a profile, along `across` and `up` of a frame.
struct ProfilePoint {
    Size x, y;
    double to_x, to_y; ///< direction of the profile, of length 1
};
using Profile = std::vector<ProfilePoint>;

struct Corner {
    Vec3f at, normal;
};
using Ring = std::vector<Corner>;

/// A range of the path with one secondary structure. Its ends are multiples of 0.5.
struct Section {
    Secondary kind;
    double begin, end;
};

/// Returns 0 at u = 0, 1 at u = 1, with a derivative of 0 at both.
Size eased(double u, double by_s) {
    return {u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) * by_s};
}

Corner corner_of(const Frame& frame, const ProfilePoint& point) {
    const auto& [x, by_x] = point.x;
    const auto& [y, by_y] = point.y;
    const Vec3d by_s =
        frame.by_at + by_x * frame.across + x * frame.by_across + by_y * frame.up + y * frame.by_up;
    const Vec3d along_profile = point.to_x * frame.across + point.to_y * frame.up;
    const Vec3d outward = core::cross(along_profile, frame.along);
    const Vec3d normal = core::cross(along_profile, by_s);
    const double size = core::length(normal);
    // The surface folds where the path turns more sharply than the profile is wide.
    const bool is_outward = core::dot(normal, outward) > 1e-3 * size;
    return {core::convert<float>(frame.at + x * frame.across + y * frame.up),
            core::convert<float>(is_outward ? 1.0 / size * normal : outward)};
}

class RibbonMesh {
  public:
    RibbonMesh(const Path& path, const RibbonSizes& sizes, double max_error,
               const IsDrawn& is_drawn, const AddShape& add)
        : path_(path), sizes_(sizes), curve_(path), is_drawn_(is_drawn), add_(add) {
        find_steps(max_error);
        find_sections();
    }

    void add() {
        for (const Section& section : sections_)
            if (section.kind == Secondary::strand) {
                add_strand(section);
            } else {
                const bool is_helix = section.kind == Secondary::helix;
                add_sweep(section.begin, section.end, [&](double s) {
                    return is_helix ? helix_profile(section, s)
                                    : round_profile({sizes_.coil}, {sizes_.coil});
                });
            }
        for (const auto& [s, kind] :
             {std::pair(0.0, sections_.front().kind), {curve_.end(), sections_.back().kind}})
            if (kind == Secondary::coil && is_drawn_at(s))
                add_(core::Sphere{core::convert<float>(curve_.point(s)),
                                  static_cast<float>(sizes_.coil)},
                     atom_at(s));
    }

  private:
    /// Sets the number of steps along the path, and around it. A chord of an arc of radius r and
    /// angle a is r * a^2 / 8 away from it.
    void find_steps(double max_error) {
        constexpr double sharpest = 2.0; // radius of the turns of coils and helices, in angstrom
        constexpr double half_turn = 0x1.921fb54442d18p+1;
        double length = 0.0;
        for (std::size_t i = 1; i < path_.size(); ++i)
            length += core::length(path_[i].at - path_[i - 1].at);
        const double spacing = length / static_cast<double>(path_.size() - 1);
        const double half_steps = 0.5 * spacing / std::sqrt(8.0 * max_error * sharpest);
        step_ = 0.5 / std::clamp(std::ceil(half_steps), 2.0, 20.0);
        // Ribbons are bent across their width, too, where they twist.
        columns_ = max_error < 0.01 ? 4 : max_error < 0.03 ? 2 : 1;
        const double arc = std::sqrt(8.0 * max_error / sizes_.coil);
        const auto arcs = static_cast<int>(std::clamp(std::ceil(half_turn / arc), 4.0, 24.0));
        for (int k = 0; k <= arcs; ++k) {
            const double angle = half_turn * (static_cast<double>(k) / arcs);
            // Exact at the ends, where the two halves of a round profile meet.
            const bool is_end = k == 0 || k == arcs;
            half_circle_.emplace_back(is_end ? 0.0 : core::sin(angle),
                                      is_end ? (k == 0 ? -1.0 : 1.0) : -core::cos(angle));
        }
    }

    std::size_t residue_at(double s) const {
        return std::min(static_cast<std::size_t>(std::floor(s + 0.5)), path_.size() - 1);
    }
    AtomIndex atom_at(double s) const { return path_[residue_at(s)].atom; }
    bool is_drawn_at(double s) const { return is_drawn_(atom_at(s)); }

    /// Splits the path half-way between residues. Helices of less than three residues, and strands
    /// of one, are coils.
    void find_sections() {
        for (std::size_t first = 0; first < path_.size();) {
            const Secondary secondary = path_[first].secondary;
            std::size_t last = first;
            while (last + 1 < path_.size() && path_[last + 1].secondary == secondary)
                ++last;
            const std::size_t least = secondary == Secondary::helix    ? 3
                                      : secondary == Secondary::strand ? 2
                                                                       : 1;
            const Secondary kind = last - first + 1 < least ? Secondary::coil : secondary;
            const double begin = first == 0 ? 0.0 : static_cast<double>(first) - 0.5;
            const double end = std::min(static_cast<double>(last) + 0.5, curve_.end());
            if (!sections_.empty() && sections_.back().kind == kind)
                sections_.back().end = end;
            else
                sections_.push_back({kind, begin, end});
            first = last + 1;
        }
    }

    /// Returns a rectangle with two half circles at its ends: half as wide as `wide`, and half as
    /// thick as `thick`.
    Profile round_profile(const Size& wide, const Size& thick) const {
        Profile profile;
        const Size straight{wide.value - thick.value, wide.by_s - thick.by_s};
        for (const double side : {1.0, -1.0}) {
            for (const auto& [cosine, sine] : half_circle_) {
                const double c = side * cosine, v = side * sine;
                profile.push_back({{side * straight.value + thick.value * c,
                                    side * straight.by_s + thick.by_s * c},
                                   {thick.value * v, thick.by_s * v},
                                   -v,
                                   c});
            }
            for (int k = 1; k < columns_; ++k) {
                const double x = side * (1.0 - 2.0 * k / columns_);
                profile.push_back({{x * straight.value, x * straight.by_s},
                                   {side * thick.value, side * thick.by_s},
                                   -side,
                                   0.0});
            }
        }
        return profile;
    }

    Profile square_profile(const Size& wide, const Size& thick) const {
        Profile profile;
        // A side's direction (to_x, to_y) is its outward direction turned by a quarter.
        for (const auto& [x, y] : {std::pair(1.0, 0.0), {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}})
            for (int k = 0, parts = y == 0.0 ? 1 : columns_; k <= parts; ++k) {
                const double end = 2.0 * k / parts - 1.0;
                const double u = x - end * y, v = y + end * x;
                profile.push_back(
                    {{u * wide.value, u * wide.by_s}, {v * thick.value, v * thick.by_s}, -y, x});
            }
        return profile;
    }

    /// Returns a helix's profile, which is that of a coil at ends that continue.
    Profile helix_profile(const Section& section, double s) const {
        constexpr double easing = 0.5; // residues
        Size part{1.0};
        if (section.begin > 0.0 && s < section.begin + easing)
            part = eased((s - section.begin) / easing, 1.0 / easing);
        else if (section.end < curve_.end() && s > section.end - easing)
            part = eased((section.end - s) / easing, -1.0 / easing);
        const auto between = [&](double coil, double helix) {
            return Size{coil + part.value * (helix - coil), part.by_s * (helix - coil)};
        };
        return round_profile(between(sizes_.coil, sizes_.helix_width),
                             between(sizes_.coil, sizes_.helix_thickness));
    }

    void add_strand(const Section& section) {
        constexpr double arrow = 1.5; // residues
        const double neck = std::max(section.begin, section.end - arrow);
        const Size thick{sizes_.strand_thickness};
        if (neck > section.begin)
            add_sweep(section.begin, neck,
                      [&](double) { return square_profile({sizes_.strand_width}, thick); });
        const double slope = (sizes_.coil - sizes_.arrow_width) / (section.end - neck);
        add_sweep(neck, section.end, [&](double s) {
            return square_profile({sizes_.arrow_width + slope * (s - neck), slope}, thick);
        });
    }

    /// Moves a profile along a part of the path. Closes it where it begins and ends, unless a
    /// coil or a helix continues as one of these.
    template <class ProfileAt>
    void add_sweep(double begin, double end, const ProfileAt& profile_at) {
        const auto steps = static_cast<int>(std::lround((end - begin) / step_));
        Ring before, next;
        RibbonPiece piece;
        Frame frame{};
        bool was_drawn = false;
        for (int step = 0; step <= steps; ++step) {
            const double s = begin + step * step_;
            const bool drawn = step < steps && is_drawn_at(s + 0.5 * step_);
            frame = curve_(s);
            next.clear();
            for (const ProfilePoint& point : profile_at(s))
                next.push_back(corner_of(frame, point));
            const bool has_end =
                drawn != was_drawn && !((step == 0 || step == steps) && is_seamless(s));
            if (was_drawn) {
                add_between(before, next, piece);
                if (has_end) add_end(next, frame, false, piece);
                add_(piece, atom_at(s - 0.5 * step_));
                piece.clear();
            } else if (has_end) {
                add_end(next, frame, true, piece);
            }
            was_drawn = drawn;
            std::swap(before, next);
        }
    }

    /// Returns true at the ends of coils that have a ball, and where coils and helices meet.
    bool is_seamless(double s) const {
        const auto is_round = [&](double at) {
            const auto in =
                std::partition_point(sections_.begin(), sections_.end(),
                                     [&](const Section& section) { return section.end <= at; });
            return in != sections_.end() && in->kind != Secondary::strand && is_drawn_at(at);
        };
        if (s == 0.0) return sections_.front().kind == Secondary::coil;
        if (s == curve_.end()) return sections_.back().kind == Secondary::coil;
        return is_round(s - 0.25) && is_round(s + 0.25);
    }

    static void add_triangle(const Corner& a, const Corner& b, const Corner& c,
                             RibbonPiece& piece) {
        if (core::checks::are_collinear(a.at, b.at, c.at)) return;
        piece.push_back({a.at, b.at, c.at, a.normal, b.normal, c.normal});
    }

    static void add_between(const Ring& before, const Ring& next, RibbonPiece& piece) {
        for (std::size_t k = 0; k < next.size(); ++k) {
            const std::size_t other = k + 1 == next.size() ? 0 : k + 1;
            const Corner &a = before[k], &b = before[other], &c = next[other], &d = next[k];
            if (a.at == b.at && c.at == d.at) continue; // an edge
            add_triangle(a, b, c, piece);
            add_triangle(a, c, d, piece);
        }
    }

    /// Closes a piece by a flat face, where it begins or ends.
    static void add_end(const Ring& ring, const Frame& frame, bool begins, RibbonPiece& piece) {
        const auto normal = core::convert<float>(begins ? -frame.along : frame.along);
        const Corner middle{core::convert<float>(frame.at), normal};
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const std::size_t other = k + 1 == ring.size() ? 0 : k + 1;
            add_triangle(middle, {ring[begins ? other : k].at, normal},
                         {ring[begins ? k : other].at, normal}, piece);
        }
    }

    const Path& path_;
    const RibbonSizes& sizes_;
    Curve curve_;
    const IsDrawn& is_drawn_;
    const AddShape& add_;
    std::vector<Section> sections_;
    double step_ = 0.5; // of the parameter; 0.5 is a multiple of it
    int columns_ = 1;   // across a ribbon
    std::vector<std::pair<double, double>> half_circle_; // from (0, -1) to (0, 1)
};

} // namespace

void add_ribbon(const Path& path, const RibbonSizes& sizes, double max_error,
                const IsDrawn& is_drawn, const AddShape& add) {
    if (path.size() > 1) RibbonMesh(path, sizes, max_error, is_drawn, add).add();
}

} // namespace raylane::scenes
