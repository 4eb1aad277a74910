#include "core/reference/closest.hpp"

#include "core/reference/closest_filter.hpp"
#include "core/reference/closest_on_quadric.hpp"
#include "core/reference/require_shapes.hpp"
#include "core/reference/rounding.hpp"
#include "core/shapes/closest_point.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

namespace raylane::core {

namespace {

using Extended = Bounded<DoubleDouble>;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Calls visit(shape) with a shape of the scene.
template <class Visit>
decltype(auto) with_shape(const Scene& scene, Kind kind, Place place, const Visit& visit) {
    return with_table(scene.shapes(), kind,
                      [&](const auto& table) { return visit(table.get(place)); });
}

/// Returns the closest point, or nothing if the numbers do not decide on which part of the shape it
/// is.
template <class Real>
std::optional<ClosestPoint<Real>> closest_in(const Scene& scene, Kind kind, Place place,
                                             const Vec3d& point) {
    return with_shape(scene, kind, place,
                      [&]<class Shape>(const Shape& shape) -> std::optional<ClosestPoint<Real>> {
                          if constexpr (has_closest_point<Shape>) {
                              ErrorPredicate<Real> predicate;
                              const ClosestPoint<Real> closest =
                                  closest_point(shape, convert<Real>(point), predicate);
                              if (predicate.doubt()) return {};
                              return closest;
                          } else {
                              return closest_on_quadric(shape, convert<Real>(point));
                          }
                      });
}

/// The closest point of a shape of flat and round parts, in exact numbers.
class ExactOnParts {
  public:
    explicit ExactOnParts(ClosestPoint<Exact> closest) : closest_(std::move(closest)) {}

    double nearest_distance() const { return nearest_double_root(closest_.squared); }
    Vec3d nearest_point() const {
        const Vec3<Exact>& point = closest_.point;
        return {nearest_double(point.x), nearest_double(point.y), nearest_double(point.z)};
    }
    Face face() const { return closest_.face; }

    friend int compare(const ExactOnParts& a, const ExactOnParts& b) {
        return compare(a.closest_.squared, b.closest_.squared);
    }
    const Exact& squared() const { return closest_.squared; }

  private:
    ClosestPoint<Exact> closest_;
};

/// The closest point of an ellipsoid or quadric.
class ExactOnQuadric {
  public:
    /// `distance`: null if the quadric has no point in its box.
    explicit ExactOnQuadric(std::unique_ptr<QuadricDistance> distance)
        : distance_(std::move(distance)) {}

    double nearest_distance() const {
        return distance_ != nullptr ? distance_->nearest_distance() : infinite;
    }
    Vec3d nearest_point() const { return distance_->nearest_point(); }
    static Face face() { return body; }

    friend int compare(const ExactOnQuadric& a, const ExactOnQuadric& b) {
        return compare(*a.distance_, *b.distance_);
    }
    friend int compare(const ExactOnQuadric& a, const ExactOnParts& b) {
        return a.distance_->compare_with(b.squared());
    }
    friend int compare(const ExactOnParts& a, const ExactOnQuadric& b) { return -compare(b, a); }

  private:
    std::unique_ptr<QuadricDistance> distance_;
};

/// The closest point of any shape. All have nearest_distance(), nearest_point() and face(), and
/// compare() returns the order of two distances: -1 if a is less.
using ExactClosest = std::variant<ExactOnParts, ExactOnQuadric>;

ExactClosest exactly_closest(const Scene& scene, Kind kind, Place place, const Vec3d& point) {
    return with_shape(scene, kind, place, [&]<class Shape>(const Shape& shape) -> ExactClosest {
        if constexpr (has_closest_point<Shape>) {
            ErrorPredicate<Exact> predicate;
            return ExactOnParts(closest_point(shape, convert<Exact>(point), predicate));
        } else {
            return ExactOnQuadric(exact_distance(shape, point));
        }
    });
}

double nearest_distance(ExactClosest& closest) {
    return std::visit([](auto& search) { return search.nearest_distance(); }, closest);
}

/// Returns bounds on the root of a number, which may be infinite.
template <class T>
DistanceBounds bounds_of(const Bounded<T>& squared) {
    const Bounded<double> distance = in_double(sqrt(squared));
    if (!(distance.error < infinite)) return {0.0, infinite};
    if (distance.error == 0.0) return {distance.value, distance.value};
    return {std::max(0.0, std::nextafter(distance.value - distance.error, -infinite)),
            std::nextafter(distance.value + distance.error, infinite)};
}

/// Returns bounds on the distance; from 0 to infinity if errors of the numbers leave it open.
template <class Real>
DistanceBounds bounds_in(const Scene& scene, Kind kind, Place place, const Vec3d& point) {
    const auto closest = closest_in<Real>(scene, kind, place, point);
    if (!closest) return {0.0, infinite};
    return bounds_of(closest->squared);
}

/// Returns a lower bound on the distance from a quadric: that of its surface without the box.
double least_distance(const Scene& scene, Place place, const Vec3d& point) {
    const QuadricOf<double> quadric = std::get<Table<Quadric>>(scene.shapes()).get(place);
    const auto closest = closest_on_whole_quadric<double>(quadric, convert<Bounded<double>>(point));
    return closest ? bounds_of(closest->squared).lower : 0.0;
}

/// Returns bounds of finite width, or bounds beyond the limit.
DistanceBounds bounds_of_distance(const Scene& scene, Kind kind, Place place, const Vec3d& point,
                                  double limit) {
    if (kind == Kind::quadric) { // exact numbers take long
        const double least = least_distance(scene, place, point);
        if (least > limit) return {least, infinite};
    }
    const DistanceBounds in_double = bounds_in<Bounded<double>>(scene, kind, place, point);
    if (in_double.upper < infinite) return in_double;
    const DistanceBounds in_extended = bounds_in<Extended>(scene, kind, place, point);
    if (in_extended.upper < infinite) return in_extended;
    ExactClosest exact = exactly_closest(scene, kind, place, point);
    const double nearest = nearest_distance(exact);
    if (nearest == 0.0 || nearest == infinite) return {nearest, nearest};
    return {std::nextafter(nearest, 0.0), std::nextafter(nearest, infinite)};
}

bool is_within(const Bounds& bounds, double size) {
    return static_cast<double>(largest_component(bounds.lower)) < size &&
           static_cast<double>(largest_component(bounds.upper)) < size;
}

/// Returns a number's double if all numbers within its error round to it.
std::optional<double> surely_nearest(const Extended& number) {
    if (number.error == 0.0 && number.value.low == 0.0) return number.value.high + 0.0; // no -0
    const DoubleDouble sum = double_double::two_sum(number.value.high, number.value.low);
    if (!rounds_surely(sum, number.error)) return {};
    return sum.high;
}

} // namespace

void require_closest_points(const Scene& scene) {
    require_shapes(scene, "closest points");
    if (scene.solids().any())
        throw InvalidValue("scene", "must have no constructed solids: closest points on them are "
                                    "not supported");
}

Closest ClosestSearcher::find(const Vec3d& point, double max_distance) {
    candidates_.clear();
    if (!(max_distance >= 0.0)) return {};
    limit_ = std::nextafter(max_distance, infinite); // its distance may be rounded down
    for_each_unbounded_table(scene_.shapes(), [&]<class Shape>(const Table<Shape>& table) {
        for (std::uint32_t block = 0; block < table.blocks().size(); ++block)
            look_in(kind_of<Shape>, block, point);
    });
    if (!scene_.hierarchy().nodes.empty()) walk(point);
    drop_farther();
    if (candidates_.empty()) return {};
    const Closest closest = answer(decide(point), point);
    return closest.distance <= max_distance ? closest : Closest{};
}

/// Adds the shapes of a block that may be the closest. Looks at those that may be closer than
/// others first.
void ClosestSearcher::look_in(Kind kind, std::uint32_t block, const Vec3d& point) {
    with_table(scene_.shapes(), kind, [&]<class Shape>(const Table<Shape>& table) {
        LaneBounds bounds;
        constexpr bool has_bounds = is_bounded<Shape>;
        if constexpr (has_bounds)
            if (largest_component(point) < filter_limit)
                table.visit_block(block, [&](const Block<Shape>& shapes) {
                    bound_distances(shapes, point, table.has_doubles(), bounds);
                });
        if (!has_bounds || !(largest_component(point) < filter_limit)) {
            std::fill_n(bounds.lower, block_size, 0.0);
            std::fill_n(bounds.upper, block_size, infinite);
        }
        look_at(kind, block, point, bounds);
    });
}

/// Adds the candidates of a block, given bounds on the distances of its shapes.
void ClosestSearcher::look_at(Kind kind, std::uint32_t block, const Vec3d& point,
                              const LaneBounds& bounds) {
    std::uint8_t lanes[block_size];
    int count = 0;
    with_table(scene_.shapes(), kind, [&](const auto& table) {
        for (std::uint8_t lane = 0; lane < block_size; ++lane) {
            if (bounds.lower[lane] > limit_) continue;
            if (table.id({block, lane}) == no_shape) break;
            limit_ = std::min(limit_, bounds.upper[lane]);
            lanes[count++] = lane;
        }
        std::sort(lanes, lanes + count, [&](std::uint8_t a, std::uint8_t b) {
            return bounds.lower[a] < bounds.lower[b];
        });
        for (int i = 0; i < count; ++i) {
            const Place place{block, lanes[i]};
            DistanceBounds of_shape{bounds.lower[lanes[i]], bounds.upper[lanes[i]]};
            if (of_shape.lower > limit_) return;
            if (kind != Kind::sphere || of_shape.upper == infinite)
                of_shape = bounds_of_distance(scene_, kind, place, point, limit_);
            if (of_shape.lower > limit_ || of_shape.lower == infinite) continue;
            candidates_.push_back({kind, place, table.id(place), of_shape});
            limit_ = std::min(limit_, of_shape.upper);
        }
    });
}

/// Visits the blocks through the hierarchy, nearest first.
void ClosestSearcher::walk(const Vec3d& point) {
    const double reach = largest_component(point);
    const bool in_float =
        reach < float_filter_limit && is_within(scene_.hierarchy().bounds, float_filter_limit);
    double squared[block_size] = {};
    float squared_in_float[block_size];
    Bounds around;
    if (in_float) include_point(around, point);
    const auto limit = [&] {
        return in_float ? float_squared_limit(limit_) : squared_limit(limit_);
    };
    pending_.assign(1, {0.0, Child::node(0)});
    while (!pending_.empty()) {
        const Pending next = pending_.back();
        pending_.pop_back();
        if (next.squared > limit()) continue;
        if (next.child.is_block()) {
            look_in(next.child.kind(), next.child.index(), point);
            continue;
        }
        const WideNode& node = scene_.hierarchy().nodes[next.child.index()];
        if (in_float) {
            squared_distances(node, around, squared_in_float);
            std::copy_n(squared_in_float, block_size, squared);
        } else if (reach < filter_limit) {
            squared_distances(node, point, squared);
        }
        const auto first = static_cast<std::ptrdiff_t>(pending_.size());
        const double most = limit();
        for (int i = 0; i < block_size && !node.children[i].empty(); ++i)
            if (squared[i] <= most) pending_.push_back({squared[i], node.children[i]});
        std::sort(pending_.begin() + first, pending_.end(),
                  [](const Pending& a, const Pending& b) { return a.squared > b.squared; });
    }
}

void ClosestSearcher::drop_farther() {
    std::erase_if(candidates_, [&](const Candidate& it) { return it.bounds.lower > limit_; });
}

/// Returns the closest of the candidates, the lowest shape of several.
const ClosestSearcher::Candidate& ClosestSearcher::decide(const Vec3d& point) {
    if (candidates_.size() > 1) {
        for (Candidate& it : candidates_) {
            const DistanceBounds bounds = bounds_in<Extended>(scene_, it.kind, it.place, point);
            it.bounds = {std::max(it.bounds.lower, bounds.lower),
                         std::min(it.bounds.upper, bounds.upper)};
            limit_ = std::min(limit_, it.bounds.upper);
        }
        drop_farther();
    }
    if (candidates_.size() == 1) return candidates_.front();
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Candidate& a, const Candidate& b) { return a.shape < b.shape; });
    const Candidate* best = nullptr;
    std::optional<ExactClosest> least;
    for (const Candidate& it : candidates_) {
        ExactClosest exact = exactly_closest(scene_, it.kind, it.place, point);
        const auto order = [](auto& a, auto& b) { return compare(a, b); };
        if (best != nullptr && std::visit(order, exact, *least) >= 0) continue;
        best = &it;
        least.emplace(std::move(exact));
    }
    return *best;
}

/// Rounds the numbers of the closest point.
Closest ClosestSearcher::answer(const Candidate& it, const Vec3d& point) const {
    const auto known = closest_in<Extended>(scene_, it.kind, it.place, point);
    std::optional<double> distance, coordinates[3];
    if (known) {
        distance = surely_nearest(sqrt(known->squared));
        for (int axis = 0; axis < 3; ++axis)
            coordinates[axis] = surely_nearest(known->point[axis]);
    }
    if (distance && coordinates[0] && coordinates[1] && coordinates[2])
        return {
            *distance, {*coordinates[0], *coordinates[1], *coordinates[2]}, it.shape, known->face};
    ExactClosest exact = exactly_closest(scene_, it.kind, it.place, point);
    return std::visit(
        [&](auto& search) -> Closest {
            return {distance ? *distance : search.nearest_distance(), search.nearest_point(),
                    it.shape, search.face()};
        },
        exact);
}

} // namespace raylane::core
