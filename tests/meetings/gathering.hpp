#pragma once

#include "tests/meetings/meeting.hpp"

/// Many shapes that meet: enough for a tree.
namespace raylane::meetings {

/// Collects shapes in a random frame and place, and rays towards the points where they meet.
class Gathering {
  public:
    explicit Gathering(Random& random)
        : random_(random), frame_(random), place_(Place::any(random)) {}

    const Frame& frame() const { return frame_; }
    const Place& place() const { return place_; }
    Random& random() const { return random_; }

    void add(const AnyShape& shape) { meeting_.shapes.push_back(place_(shape)); }
    /// Adds a point where shapes meet, and the axis that crosses all of them there.
    void meet_at(const Vec3d& point, int across = 2) {
        aims_.emplace_back(frame_.with_up(across), place_, turned(point, across));
    }
    void add(const Meeting& other) {
        meeting_.shapes.insert(meeting_.shapes.end(), other.shapes.begin(), other.shapes.end());
        meeting_.rays.insert(meeting_.rays.end(), other.rays.begin(), other.rays.end());
    }
    /// Adds a ray in the frame's coordinates.
    void add_ray(const Vec3d& origin, const Vec3d& direction) {
        meeting_.rays.push_back(
            {ray_sets::rounded(place_(frame_(origin))), ray_sets::rounded(frame_(direction))});
    }

    Meeting make(int rays) {
        for (int i = 0; i < rays && !aims_.empty(); ++i) {
            const int aim = random_.integer(0, static_cast<int>(aims_.size()) - 1);
            meeting_.rays.push_back(aims_[static_cast<std::size_t>(aim)].ray(random_));
        }
        return std::move(meeting_);
    }

  private:
    /// Returns a point in the coordinates of Frame::with_up().
    static Vec3d turned(const Vec3d& point, int up) {
        return {point[(up + 1) % 3], point[(up + 2) % 3], point[up]};
    }

    Random& random_;
    Frame frame_;
    Place place_;
    Meeting meeting_;
    std::vector<Aim> aims_;
};

/// Balls that touch each other and a plane below: `across` x `across` of them, in one or two
/// layers.
inline Meeting packing(int across, Random& random, int rays) {
    Gathering gathering(random);
    const Frame& frame = gathering.frame();
    if (random.integer(0, 1) == 0)
        gathering.add(core::Plane{frame.exact(0, 0, 0), frame.exact(0, 0, 1)});
    const int layers = random.integer(1, 2);
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j)
            for (int k = 0; k < layers; ++k) {
                const Vec3d center(2 * i, 2 * j, 2 * k + 1);
                gathering.add(
                    core::Sphere{frame.exact(center.x, center.y, center.z), radius_of(frame, 1)});
                for (int axis = 0; axis < 3; ++axis) {
                    Vec3d contact = center;
                    contact[axis] -= 1;
                    gathering.meet_at(contact, axis);
                }
            }
    if (random.integer(0, 1) == 0) // this plane has the highest id
        gathering.add(core::Plane{frame.exact(0, 0, 0), frame.exact(0, 0, 1)});
    return gathering.make(rays);
}

/// Boxes on a grid that meet face to face and partly overlap.
inline Meeting stack(int across, Random& random, int rays) {
    Gathering gathering(random);
    const Frame& frame = gathering.frame();
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j)
            for (int k = 0; k < across; ++k) {
                const auto edge = [&] { return random.integer(0, 3) == 0 ? 2 : 1; };
                gathering.add(core::Box{frame.exact(i, j, k), frame.exact(edge(), 0, 0),
                                        frame.exact(0, edge(), 0), frame.exact(0, 0, edge())});
                // A corner, or the middle of an edge or of a face.
                const auto half = [&] { return 0.5 * random.integer(0, 1); };
                gathering.meet_at({i + half(), j + half(), k}, random.integer(0, 2));
            }
    return gathering.make(rays);
}

/// Triangles that share edges and corners, flat or hilly, with rays that graze the flat parts.
inline Meeting terrain(int across, Random& random, int rays) {
    Gathering gathering(random);
    const Frame& frame = gathering.frame();
    const int steepness = random.integer(0, 2);
    std::vector<std::vector<int>> height(static_cast<std::size_t>(across + 1));
    for (auto& row : height)
        for (int j = 0; j <= across; ++j)
            row.push_back(random.integer(0, steepness));
    const auto corner = [&](int i, int j) {
        return frame.exact(i, j, height[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
    };
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j) {
            gathering.add(core::Triangle{corner(i, j), corner(i + 1, j), corner(i, j + 1)});
            gathering.add(core::Triangle{corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
            const double at = height[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
            gathering.meet_at({i, j, at});
        }
    for (int i = 0; i < rays / 4; ++i) {
        const double least = random.integer(0, 1) == 0 ? 0.0 : random.log_uniform(1e-12, 1e-6);
        gathering.add_ray({-1.0, random.integer(0, across), 1e-7},
                          {1.0, 0.25 * random.integer(-1, 1), -least});
    }
    return gathering.make(rays - rays / 4);
}

using MakeShell = AnyShape (*)(const Frame&, int);

/// Returns a maker of shapes, Touching<Shape>::shell(), for each kind that has one. The shapes
/// touch the origin of the frame from below.
inline std::vector<MakeShell> all_shells() {
    std::vector<MakeShell> shells;
    core::for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
        if constexpr (requires(const Frame& frame) { Touching<Shape>::shell(frame, 1); })
            shells.push_back([](const Frame& frame, int r) {
                return AnyShape(Touching<Shape>::shell(frame, r));
            });
    });
    return shells;
}

/// Shapes of one or several kinds that touch the origin of the frame from below. Most have their
/// centre at the same distance below it. Some shapes are equal, some are a few ulps apart, and some
/// are slightly larger. The larger ones touch the origin, too.
inline Meeting shells(int count, Random& random, int rays) {
    Gathering gathering(random);
    const Frame& frame = gathering.frame();
    const std::vector<MakeShell> makers = all_shells();
    const int kinds = static_cast<int>(makers.size());
    const int r = random.integer(1, 3), only = random.integer(0, 2 * kinds);
    for (int i = 0; i < count; ++i) {
        const int kind = only < kinds ? only : random.integer(0, kinds - 1);
        AnyShape shape = makers[static_cast<std::size_t>(kind)](frame, r);
        switch (random.integer(0, 3)) {
        case 0:
            break;
        case 1: // slightly larger, about the origin
            shape = tests::Placing(Vec3f(0.0F),
                                   1.0F + std::ldexp(1.0F, random.integer(-22, -4)))(shape);
            break;
        default:
            shape = beside(shape, random);
        }
        gathering.add(shape);
    }
    gathering.meet_at({0, 0, 0});
    gathering.meet_at({0, 0, -2 * r});
    return gathering.make(rays);
}

/// Many copies of one shape, some of them ulps apart.
inline Meeting copies(int count, Random& random, int rays) {
    Gathering gathering(random);
    const AnyShape shape = make_touching[random.integer(0, core::kind_count - 1)](
        gathering.frame(), random.integer(1, 3), random);
    const int apart = random.integer(0, 2); // none, half or all of them
    for (int i = 0; i < count; ++i)
        gathering.add(random.integer(1, 2) <= apart ? beside(shape, random) : shape);
    gathering.meet_at({0, 0, 0});
    return gathering.make(rays);
}

/// Cylinders or cones end to end. Rays along their common side meet all of them.
inline Meeting pipe(int count, Random& random, int rays) {
    Gathering gathering(random);
    const Frame& frame = gathering.frame();
    const int r = random.integer(1, 3), kind = random.integer(0, 3);
    const Vec3f axis = frame.exact(1, 0, 0);
    for (int i = 0; i < count; ++i) {
        const Vec3f base = frame.exact(i, 0, -r);
        const float radius = radius_of(frame, r);
        if (kind == 0) gathering.add(core::OpenCylinder{base, axis, radius});
        if (kind == 1) gathering.add(core::CappedCylinder{base, axis, radius});
        if (kind == 2)
            gathering.add(core::OpenCone{base, axis, radius, i % 2 == 0 ? 0.0F : radius});
        if (kind == 3) gathering.add(core::CappedCone{base, axis, radius, 0.5F * radius});
        gathering.meet_at({i, 0, 0});
        gathering.meet_at({i, 0, -r}, 0);
    }
    return gathering.make(rays);
}

/// Pairs of all kinds side by side, each with rays aimed at it.
inline Meeting crowd(int pairs, Random& random, int rays) {
    Gathering gathering(random);
    for (int i = 0; i < pairs; ++i) {
        const auto kind = [&] {
            // Few unbounded shapes, as one hides all shapes behind it.
            const int any = random.integer(0, core::kind_count - 1);
            return i > 0 && !tests::is_bounded_kind(static_cast<core::Kind>(any)) ? 0 : any;
        };
        const Place place =
            gathering.place().moved(core::convert<double>(random.small_integers(8)) * 8.0);
        gathering.add(MeetingMaker(kind(), kind(), all_ways[random.integer(0, 3)], random, place)
                          .make(rays / pairs));
    }
    return gathering.make(0);
}

struct Kind {
    const char* name;
    Meeting (*make)(int size, Random& random, int rays);
    int least, most; ///< sizes
};
/// The last kind is large, and is for few rounds.
inline constexpr Kind gatherings[] = {
    {"packing", packing, 4, 8},  {"stack", stack, 3, 5},
    {"terrain", terrain, 4, 10}, {"shells", shells, 20, 40},
    {"copies", copies, 20, 40},  {"pipe", pipe, 20, 60},
    {"crowd", crowd, 12, 30},    {"large packing", packing, 36, 36}};

} // namespace raylane::meetings
