#include "core/solids/transform.hpp"

#include "core/numbers/elementary.hpp"
#include "core/numbers/infinity.hpp"
#include "core/numbers/primitives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::core {

namespace {

using Exactly = Vec3<Dyadic>;

/// Returns the nearest double, ties to even; below `min_double`, the nearest float.
double rounded(const Dyadic& value) {
    double nearest = value.approximately().to_double();
    if (value.sign() == 0) return 0.0;
    for (;;) {
        const Dyadic off = value - Dyadic(nearest);
        if (off.sign() == 0) break;
        const double next =
            std::nextafter(nearest, off.sign() > 0 ? infinity<double> : -infinity<double>);
        if (!std::isfinite(next)) break;
        const Dyadic beyond = off + off - (Dyadic(next) - Dyadic(nearest));
        const int farther = off.sign() > 0 ? beyond.sign() : -beyond.sign();
        const bool is_even = (__builtin_bit_cast(std::uint64_t, nearest) & 1) == 0;
        if (farther < 0 || (farther == 0 && is_even)) break;
        nearest = next;
    }
    if (std::abs(nearest) < min_double) return static_cast<double>(static_cast<float>(nearest));
    return nearest;
}

Vec3d rounded(const Exactly& v) {
    return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

Exactly exactly(const Vec3d& v) {
    return convert<Dyadic>(v);
}

} // namespace

/// p . M p + 2 linear . p + one = 0, relative to a centre.
struct Transform::Form {
    Exactly rows[3];
    Exactly linear;
    Dyadic one;

    Exactly times(const Exactly& v) const {
        return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
    }

    /// Returns the quadric about a centre, scaled by a power of two so that no coefficient is
    /// large.
    QuadricOf<double> at(const Vec3d& center) const {
        std::int64_t most = std::numeric_limits<std::int64_t>::min();
        const auto see = [&](const Dyadic& a) {
            if (a.sign() != 0) most = std::max(most, a.approximately().exponent);
        };
        for (const Exactly& row : rows)
            for (int axis = 0; axis < 3; ++axis)
                see(row[axis]);
        for (int axis = 0; axis < 3; ++axis)
            see(linear[axis]);
        const auto scaled = [&](const Dyadic& a) {
            Dyadic result = a;
            for (std::int64_t left = most; left != 0;) {
                const auto step = std::clamp<std::int64_t>(left, -1000, 1000);
                result = result * Dyadic(std::ldexp(1.0, -static_cast<int>(step)));
                left -= step;
            }
            return rounded(result);
        };
        QuadricOf<double> q{};
        q.center = center;
        q.xx = scaled(rows[0].x);
        q.yy = scaled(rows[1].y);
        q.zz = scaled(rows[2].z);
        q.xy = scaled(rows[0].y);
        q.xz = scaled(rows[0].z);
        q.yz = scaled(rows[1].z);
        q.x = scaled(linear.x);
        q.y = scaled(linear.y);
        q.z = scaled(linear.z);
        q.one = scaled(one);
        q.lower = Vec3d(-1.0);
        q.upper = Vec3d(1.0);
        return q;
    }

    /// Returns the form of the body of a frustum about an axis from 0: |across|^2 = width^2, times
    /// |axis|^4.
    static Form around(const Vec3d& axis, double base_radius, double top_radius) {
        const Exactly a = exactly(axis);
        const Dyadic length = squared_length(a), slope = Dyadic(top_radius) - Dyadic(base_radius);
        const Dyadic along = length + slope * slope;
        Form form;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                form.rows[i][j] = (i == j ? length * length : Dyadic()) - along * (a[i] * a[j]);
        form.linear = (-(Dyadic(base_radius) * slope * length)) * a;
        form.one = -(Dyadic(base_radius) * Dyadic(base_radius) * length * length);
        return form;
    }
};

Turn turn_by_degrees(double degrees) {
    const double turn = std::remainder(degrees, 360.0);
    if (std::remainder(turn, 90.0) == 0.0)
        return {turn == 90.0    ? 1.0
                : turn == -90.0 ? -1.0
                                : 0.0,
                turn == 0.0               ? 1.0
                : std::abs(turn) == 180.0 ? -1.0
                                          : 0.0};
    constexpr double radians = 3.14159265358979323846 / 180.0;
    const auto [sine, cosine] = Elementary<double>::sin_cos(turn * radians);
    return {sine, cosine};
}

Transform::Transform() : even_(Dyadic(1.0)) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            rows_[i][j] = i == j ? 1.0 : 0.0;
}

Transform Transform::translation(const Vec3d& by) {
    Transform result;
    result.translation_ = exactly(by);
    return result;
}

Transform Transform::rotation(const Vec3d& degrees) {
    Transform result;
    for (int axis = 0; axis < 3; ++axis) {
        const auto [sine, cosine] = turn_by_degrees(degrees[axis]);
        Transform about;
        const int j = (axis + 1) % 3, k = (axis + 2) % 3;
        about.rows_[j][j] = about.rows_[k][k] = cosine;
        about.rows_[j][k] = -sine;
        about.rows_[k][j] = sine;
        result = about.after(result);
    }
    return result;
}

Transform Transform::turn(const Vec3d& x, const Vec3d& y, const Vec3d& z) {
    Transform result;
    for (int axis = 0; axis < 3; ++axis)
        result.rows_[axis] = {x[axis], y[axis], z[axis]};
    return result;
}

Transform Transform::scaling(const Vec3d& by) {
    Transform result;
    for (int axis = 0; axis < 3; ++axis) {
        if (by[axis] == 0.0)
            throw InvalidValue("scale/" + std::to_string(axis), "must not be 0, got 0");
        result.rows_[axis][axis] = by[axis];
    }
    const Vec3d size(std::abs(by.x), std::abs(by.y), std::abs(by.z));
    result.even_.reset();
    if (size.x == size.y && size.y == size.z) result.even_ = Dyadic(size.x);
    return result;
}

Transform Transform::matrix(const double (&rows)[3][4]) {
    Transform result;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            result.rows_[i][j] = rows[i][j];
        result.translation_[i] = rows[i][3];
    }
    if (result.determinant().sign() == 0)
        throw InvalidValue("transform", "must not be singular, got one of determinant 0");
    // A matrix scales all lengths equally if its columns are perpendicular and of equal length.
    // With rounded numbers, this counts only if each row has a single number that is not 0.
    result.even_.reset();
    double size = 0.0;
    bool even = true;
    for (int i = 0; i < 3; ++i) {
        int count = 0;
        for (int j = 0; j < 3; ++j) {
            if (rows[i][j] == 0.0) continue;
            ++count;
            if (size == 0.0) size = std::abs(rows[i][j]);
            even = even && std::abs(rows[i][j]) == size;
        }
        even = even && count == 1;
    }
    if (even) result.even_ = Dyadic(size);
    return result;
}

Transform Transform::after(const Transform& first) const {
    Transform result;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            result.rows_[i][j] =
                dot(rows_[i], Row(first.rows_[0][j], first.rows_[1][j], first.rows_[2][j]));
    result.translation_ = times(first.translation_) + translation_;
    result.even_.reset();
    if (even_ && first.even_) result.even_ = *even_ * *first.even_;
    return result;
}

std::array<Vec3d, 3> Transform::columns() const {
    std::array<Vec3d, 3> columns{};
    for (int i = 0; i < 3; ++i)
        columns[static_cast<std::size_t>(i)] = rounded(Row(rows_[0][i], rows_[1][i], rows_[2][i]));
    return columns;
}

Vec3d Transform::origin() const {
    return rounded(translation_);
}

Dyadic Transform::determinant() const {
    return dot(rows_[0], cross(rows_[1], rows_[2]));
}

Transform::Row Transform::times(const Row& v) const {
    return {dot(rows_[0], v), dot(rows_[1], v), dot(rows_[2], v)};
}

Transform::Row Transform::point(const Vec3d& p) const {
    return times(exactly(p)) + translation_;
}

Transform::Row Transform::cofactors_times(const Row& v) const {
    return {dot(cross(rows_[1], rows_[2]), v), dot(cross(rows_[2], rows_[0]), v),
            dot(cross(rows_[0], rows_[1]), v)};
}

Transform::Row Transform::adjugate_times(const Row& v) const {
    return v.x * cross(rows_[1], rows_[2]) + v.y * cross(rows_[2], rows_[0]) +
           v.z * cross(rows_[0], rows_[1]);
}

Transform::Row Transform::normal(const Row& n) const {
    const Row turned = cofactors_times(n);
    return determinant().sign() < 0 ? -turned : turned;
}

Solid Transform::operator()(const Solid& solid) const {
    if (solid.made == Made::of_shape) {
        Solid result = std::visit([&](const auto& shape) { return moved(shape); }, solid.shape);
        result.material = solid.material;
        result.cuts_nothing = solid.cuts_nothing;
        if (solid.space != nullptr) set_space(result, solid.space);
        return result;
    }
    Solid result{solid.made};
    result.material = solid.material;
    result.endless_as_part = solid.endless_as_part;
    result.parts.reserve(solid.parts.size());
    for (const Solid& part : solid.parts)
        result.parts.push_back((*this)(part));
    return result;
}

Solid Transform::moved(const SphereOf<double>& s) const {
    if (even_)
        return of_shape(
            SphereOf<double>{rounded(point(s.center)), rounded(Dyadic(s.radius) * *even_)});
    return moved(EllipsoidOf<double>{
        s.center, {s.radius, 0.0, 0.0}, {0.0, s.radius, 0.0}, {0.0, 0.0, s.radius}});
}

Solid Transform::moved(const PlaneOf<double>& s) const {
    return of_shape(PlaneOf<double>{rounded(point(s.point)), rounded(normal(exactly(s.normal)))});
}

Solid Transform::moved(const DiscOf<double>& s) const {
    if (!even_)
        throw InvalidValue("scale", "must be one number for all axes if the object has a disc");
    return of_shape(DiscOf<double>{rounded(point(s.center)), rounded(normal(exactly(s.normal))),
                                   rounded(Dyadic(s.radius) * *even_)});
}

/// Keeps the front.
Solid Transform::moved(const TriangleOf<double>& s) const {
    TriangleOf<double> result{rounded(point(s.a)), rounded(point(s.b)), rounded(point(s.c))};
    if (determinant().sign() < 0) std::swap(result.b, result.c);
    return of_shape(result);
}

Solid Transform::moved(const SmoothTriangleOf<double>& s) const {
    const auto turned = [&](const Vec3d& n) { return rounded(normal(exactly(n))); };
    SmoothTriangleOf<double> result{rounded(point(s.a)), rounded(point(s.b)), rounded(point(s.c)),
                                    turned(s.normal_a),  turned(s.normal_b),  turned(s.normal_c)};
    if (determinant().sign() < 0) {
        std::swap(result.b, result.c);
        std::swap(result.normal_b, result.normal_c);
    }
    return of_shape(result);
}

Solid Transform::moved(const BoxOf<double>& s) const {
    return of_shape(BoxOf<double>{rounded(point(s.corner)), rounded(times(exactly(s.edge_u))),
                                  rounded(times(exactly(s.edge_v))),
                                  rounded(times(exactly(s.edge_w)))});
}

Solid Transform::moved(const EllipsoidOf<double>& s) const {
    return of_shape(EllipsoidOf<double>{rounded(point(s.center)), rounded(times(exactly(s.axis_u))),
                                        rounded(times(exactly(s.axis_v))),
                                        rounded(times(exactly(s.axis_w)))});
}

/// Let p = M q for q relative to the centre: F(q) det^2 = F(adj(M) p / det) det^2.
QuadricOf<double> Transform::moved(const Form& form, const Vec3d& center) const {
    const Dyadic det = determinant();
    Form result;
    for (int j = 0; j < 3; ++j) {
        Row unit;
        unit[j] = 1.0;
        const Row column = cofactors_times(form.times(adjugate_times(unit)));
        for (int i = 0; i < 3; ++i)
            result.rows[i][j] = column[i];
    }
    result.linear = det * cofactors_times(form.linear);
    result.one = det * det * form.one;
    return result.at(rounded(point(center)));
}

Solid Transform::moved(const QuadricOf<double>& s) const {
    const Form form{
        {{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}}, {s.x, s.y, s.z}, s.one};
    return of_shape(moved(form, s.center));
}

/// Returns a quadric between two planes.
Solid Transform::between_ends(const Form& form, const Vec3d& base, const Vec3d& axis, double radius,
                              Ends ends) const {
    const Row along = normal(exactly(axis));
    Solid result{ends == Ends::capped ? Made::by_intersection : Made::by_clip};
    result.parts.push_back(of_shape(moved(form, base)));
    result.parts.push_back(of_shape(PlaneOf<double>{rounded(point(base)), rounded(Row(-along))}));
    result.parts.push_back(of_shape(PlaneOf<double>{
        rounded(Row(times(exactly(base) + exactly(axis)) + translation_)), rounded(along)}));
    // A box around the solid, which cuts nothing, gives its position.
    const Vec3d least = std::abs(axis.x) < std::abs(axis.y) && std::abs(axis.x) < std::abs(axis.z)
                            ? Vec3d(1.0, 0.0, 0.0)
                        : std::abs(axis.y) < std::abs(axis.z) ? Vec3d(0.0, 1.0, 0.0)
                                                              : Vec3d(0.0, 0.0, 1.0);
    const Vec3d across = 3.0 * radius * normalized(cross(axis, least));
    const Vec3d upward = 3.0 * radius * normalized(cross(axis, across));
    const BoxOf<double> around{base - 0.5 * across - 0.5 * upward - 0.25 * axis, across, upward,
                               1.5 * axis};
    if (ends == Ends::capped) {
        Solid clipped{Made::by_clip};
        clipped.parts.push_back(std::move(result));
        result = std::move(clipped);
    }
    result.parts.push_back(moved(around));
    result.parts.back().cuts_nothing = true;
    result.endless_as_part = ends == Ends::open;
    return result;
}

template <Ends ends>
Solid Transform::moved(const CylinderOf<double, ends>& s) const {
    if (even_)
        return of_shape(CylinderOf<double, ends>{rounded(point(s.base)),
                                                 rounded(times(exactly(s.axis))),
                                                 rounded(Dyadic(s.radius) * *even_)});
    return between_ends(Form::around(s.axis, s.radius, s.radius), s.base, s.axis, s.radius, ends);
}

template <Ends ends>
Solid Transform::moved(const ConeOf<double, ends>& s) const {
    if (even_)
        return of_shape(ConeOf<double, ends>{
            rounded(point(s.base)), rounded(times(exactly(s.axis))),
            rounded(Dyadic(s.base_radius) * *even_), rounded(Dyadic(s.top_radius) * *even_)});
    return between_ends(Form::around(s.axis, s.base_radius, s.top_radius), s.base, s.axis,
                        std::max(s.base_radius, s.top_radius), ends);
}

QuadricOf<double> half_space_of(const CylinderOf<double, Ends::open>& cylinder) {
    return Transform::Form::around(cylinder.axis, cylinder.radius, cylinder.radius)
        .at(cylinder.base);
}

QuadricOf<double> half_space_of(const ConeOf<double, Ends::open>& cone) {
    return Transform::Form::around(cone.axis, cone.base_radius, cone.top_radius).at(cone.base);
}

} // namespace raylane::core
