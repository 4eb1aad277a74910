#pragma once

#include "core/ray.hpp"
#include "tests/meetings/touching.hpp"

#include <iterator>
#include <utility>
#include <vector>

namespace raylane::meetings {

/// How two shapes meet.
enum class Way {
    opposite,   ///< from both sides of a plane
    nested,     ///< from the same side: one in the other, or flush
    coincident, ///< the same shape twice and more often
    ulps_apart, ///< any of these, but for one float of one shape, that is 1 to 4 ulps off
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

/// With one of its floats a little off.
template <class Shape>
Shape beside(const Shape& shape, Random& random) {
    auto floats = core::floats_of(shape);
    float& value =
        floats[static_cast<std::size_t>(random.integer(0, static_cast<int>(floats.size()) - 1))];
    if (value == 0.0F) return shape;
    value =
        ulps_off(value, random.integer(0, 1) == 0 ? random.integer(1, 4) : random.integer(-4, -1));
    return core::shape_of<Shape>(floats);
}

class MeetingMaker {
  public:
    MeetingMaker(int kind, int other_kind, Way way, Random& random)
        : random_(random), frame_(random) {
        // From a millionth to a million, and now and then where floats end.
        const int power = random.integer(0, 19) == 0  ? random.integer(-142, -125)
                          : random.integer(0, 2) == 0 ? 0
                                                      : random.integer(-20, 20);
        size_ = std::ldexp(1.0, power);
        switch (random.integer(0, 5)) {
        case 0: // anywhere near, as far as its bits go
            place_ = Vec3f(static_cast<float>(random.integer(-8, 8)),
                           static_cast<float>(random.integer(-8, 8)),
                           static_cast<float>(random.integer(-8, 8)));
            break;
        case 1: // far off: what is made is rounded
            place_ = ray_sets::rounded(random.direction() * random.log_uniform(1.0, 1e6));
            break;
        default:
            break;
        }
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
        add(first);
        add(second);
        if (way == Way::ulps_apart) {
            // Of what has been placed: a copy beside itself, or the other one beside where it was.
            AnyShape& moved = meeting_.shapes[random.integer(0, 1) == 0 ? 0 : 1];
            if (random.integer(0, 2) == 0) moved = meeting_.shapes[0];
            moved = std::visit([&](const auto& shape) { return AnyShape(beside(shape, random)); },
                               moved);
        }
        const int copies = way == Way::coincident ? random.integer(0, 5) : random.integer(0, 1);
        for (int i = 0; i < copies; ++i) {
            const AnyShape copy = meeting_.shapes[static_cast<std::size_t>(random.integer(0, 1))];
            meeting_.shapes.insert(meeting_.shapes.begin() + random.integer(0, 1), copy);
        }
    }

    Meeting make(int rays) {
        for (int i = 0; i < rays; ++i)
            meeting_.rays.push_back(ray());
        return meeting_;
    }

  private:
    void add(const AnyShape& shape) {
        meeting_.shapes.push_back(tests::Placing(place_, static_cast<float>(size_))(shape));
    }

    /// Through the meeting, or past it by 1e-12 to 1e-3 or a few whole numbers; in whole numbers,
    /// along the common tangent, all but along it, or any way; from near or far, either side.
    core::Ray<float> ray() {
        Random& r = random_;
        const auto whole = [&](int most) { return static_cast<double>(r.integer(-most, most)); };
        Vec3d way;
        switch (r.integer(0, 5)) {
        case 0:
            way = {whole(2), whole(2), 0.0};
            break;
        case 1:
            way = {whole(1), whole(1), r.log_uniform(1e-12, 1e-1)};
            break;
        case 2:
            way = {0.0, 0.0, 1.0};
            break;
        case 3:
            way = {r.log_uniform(1e-12, 1.0), r.log_uniform(1e-12, 1e-1), -1.0};
            break;
        case 4:
            way = r.direction();
            break;
        default:
            way = {whole(4), whole(4), whole(4)};
        }
        if (way == Vec3d(0.0)) way.x = 1.0;
        Vec3d past(0.0);
        switch (r.integer(0, 3)) {
        case 0:
            past = r.direction() * r.log_uniform(1e-12, 1e-3);
            break;
        case 1:
            past = {whole(3), whole(3), whole(1)};
            break;
        case 2:
            past[r.integer(0, 2)] = r.log_uniform(1e-12, 1e-3);
            break;
        default:
            break;
        }
        double before = whole(4);
        if (r.integer(0, 2) == 0) before = r.log_uniform(1e-3, 1e7);
        const Vec3d from = frame_(past - before * way);
        const Vec3f origin = ray_sets::rounded(size_ * (core::convert<double>(place_) + from));
        Vec3d direction = frame_(way);
        if (r.integer(0, 2) == 0) direction *= r.log_uniform(1e-3, 1e3);
        // Towards what is meant from where rounding has put the origin.
        if (r.integer(0, 2) == 0 && before != 0.0)
            direction = (size_ * (core::convert<double>(place_) + frame_(past)) -
                         core::convert<double>(origin)) /
                        size_;
        Vec3f rounded = ray_sets::rounded(direction);
        if (rounded == Vec3f(0.0F)) rounded.x = 1.0F;
        return {origin, rounded};
    }

    Random& random_;
    Frame frame_;
    Vec3f place_{0.0F};
    double size_;
    Meeting meeting_;
};

} // namespace raylane::meetings
