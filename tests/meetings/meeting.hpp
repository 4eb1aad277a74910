#pragma once

#include "tests/meetings/aim.hpp"
#include "tests/shapes/shapes.hpp"

#include <iterator>
#include <vector>

namespace raylane::meetings {

template <class Shape>
AnyShape touching(const Frame& frame, int r, Random& random) {
    return Touching<Shape>::make(frame, r, random);
}

using MakeTouching = AnyShape (*)(const Frame&, int, Random&);
#define RAYLANE_TOUCHING(Shape, name, text) touching<core::Shape>,
/// Indexed by kind.
inline constexpr MakeTouching make_touching[] = {RAYLANE_SHAPES(RAYLANE_TOUCHING)};
#undef RAYLANE_TOUCHING

/// Way in which two shapes meet.
enum class Way {
    opposite,   ///< from both sides of a plane
    nested,     ///< from the same side: one in the other, or flush
    coincident, ///< one shape twice or more often
    ulps_apart, ///< any of these, with one float of one shape off by 1 to 4 ulps
};
inline constexpr Way all_ways[] = {Way::opposite, Way::nested, Way::coincident, Way::ulps_apart};
inline constexpr const char* way_names[] = {"opposite", "nested", "coincident", "ulps apart"};

/// Shapes that meet at a point, and rays towards it.
struct Meeting {
    std::vector<AnyShape> shapes; ///< by id
    std::vector<core::Ray<float>> rays;
};

inline float ulps_off(float value, int ulps) {
    for (; ulps > 0; --ulps)
        value = std::nextafter(value, HUGE_VALF);
    for (; ulps < 0; ++ulps)
        value = std::nextafter(value, -HUGE_VALF);
    return value;
}

/// Returns the shape with one of its floats off by 1 to 4 ulps.
template <class Shape>
Shape beside(const Shape& shape, Random& random) {
    auto floats = core::numbers_of(shape);
    float& value =
        floats[static_cast<std::size_t>(random.integer(0, static_cast<int>(floats.size()) - 1))];
    if (value == 0.0F) return shape;
    value =
        ulps_off(value, random.integer(0, 1) == 0 ? random.integer(1, 4) : random.integer(-4, -1));
    return core::shape_of<Shape>(floats);
}
inline AnyShape beside(const AnyShape& any, Random& random) {
    return std::visit([&](const auto& shape) { return AnyShape(beside(shape, random)); }, any);
}

class MeetingMaker {
  public:
    MeetingMaker(int kind, int other_kind, Way way, Random& random)
        : MeetingMaker(kind, other_kind, way, random, Place::any(random)) {}

    MeetingMaker(int kind, int other_kind, Way way, Random& random, const Place& place)
        : random_(random), frame_(random), place_(place) {
        const int r = random.integer(1, 3);
        const bool turned = random.integer(0, 1) == 0;
        const AnyShape first = make_touching[kind](frame_, r, random);
        const Frame aside = random.integer(0, 1) == 0 ? frame_ : frame_.turned_aside();
        AnyShape second = first;
        if (way != Way::coincident) {
            const bool from_above =
                way == Way::opposite || (way == Way::ulps_apart && random.integer(0, 1) == 0);
            second = make_touching[other_kind](from_above ? aside.turned_over() : aside,
                                               turned ? r : random.integer(1, 4), random);
        }
        meeting_.shapes = {place_(first), place_(second)};
        if (way == Way::ulps_apart) {
            // A placed shape, or a copy of the first one in its stead, goes a few ulps beside its
            // place.
            AnyShape& moved = meeting_.shapes[random.integer(0, 1) == 0 ? 0 : 1];
            if (random.integer(0, 2) == 0) moved = meeting_.shapes[0];
            moved = beside(moved, random);
        }
        const int copies = way == Way::coincident ? random.integer(0, 5) : random.integer(0, 1);
        for (int i = 0; i < copies; ++i) {
            const AnyShape copy = meeting_.shapes[static_cast<std::size_t>(random.integer(0, 1))];
            meeting_.shapes.insert(meeting_.shapes.begin() + random.integer(0, 1), copy);
        }
    }

    Meeting make(int rays) {
        const Aim aim(frame_, place_, Vec3d(0.0));
        for (int i = 0; i < rays; ++i)
            meeting_.rays.push_back(aim.ray(random_));
        return meeting_;
    }

  private:
    Random& random_;
    Frame frame_;
    Place place_;
    Meeting meeting_;
};

} // namespace raylane::meetings
