#include "core/shapes/invalid_value.hpp"
#include "scenes/formats/pov/expressions.hpp"
#include "scenes/formats/pov/finishes.hpp"

#include <cmath>

namespace raylane::scenes::pov {

namespace {

using core::Vec3d;

Motion linear(const core::Transform& exact, const Vec3d& x, const Vec3d& y, const Vec3d& z) {
    Motion motion{exact};
    motion.translation.reset();
    for (int axis = 0; axis < 3; ++axis) {
        motion.rows[axis][0] = x[axis];
        motion.rows[axis][1] = y[axis];
        motion.rows[axis][2] = z[axis];
    }
    return motion;
}

Motion translation(const Vec3d& by) {
    Motion motion{core::Transform::translation(by)};
    motion.translation = by;
    for (int axis = 0; axis < 3; ++axis)
        motion.rows[axis][3] = by[axis];
    return motion;
}

/// Returns the rotation of solids. Its matrix has the images of the axes.
Motion rotation(const Vec3d& degrees) {
    const core::Transform exact = core::Transform::rotation(degrees);
    Vec3d axes[3];
    for (int axis = 0; axis < 3; ++axis) {
        core::Solid plane_solid;
        core::PlaneOf<double> plane{Vec3d(0.0), Vec3d(0.0)};
        plane.normal[axis] = 1.0;
        plane_solid.shape = plane;
        axes[axis] = std::get<core::PlaneOf<double>>(exact(plane_solid).shape).normal;
    }
    return linear(exact, axes[0], axes[1], axes[2]);
}

Motion scaling(Vec3d by, Tokens& tokens, const Place& place) {
    for (int axis = 0; axis < 3; ++axis)
        if (by[axis] == 0.0) {
            tokens.remark(place, "a scale of 0 is replaced by 1");
            by[axis] = 1.0;
        }
    return linear(core::Transform::scaling(by), {by.x, 0.0, 0.0}, {0.0, by.y, 0.0},
                  {0.0, 0.0, by.z});
}

/// Reads "<...>" with twelve numbers: the images of the axes and of the origin.
Motion matrix(Tokens& tokens) {
    const Place place = tokens.peek().place;
    double rows[3][4];
    tokens.expect("<");
    for (int column = 0; column < 4; ++column)
        for (auto& row : rows) {
            row[column] = read_number(tokens);
            tokens.accept(",");
        }
    tokens.expect(">");
    try {
        Motion motion{core::Transform::matrix(rows)};
        motion.translation.reset();
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column)
                motion.rows[row][column] = rows[row][column];
        return motion;
    } catch (const core::InvalidValue& invalid) {
        fail(place, invalid.expectation);
    }
}

/// Returns the inverse of the map of the axes to x, y and z. If these are at right angles and of
/// equal length, so are the inverse's, exactly: spheres stay spheres.
Motion inverse_of_linear(const Vec3d& x, const Vec3d& y, const Vec3d& z, const Place& place) {
    constexpr double tolerance = 1e-12;
    const double square = core::dot(x, x);
    const auto is_small = [&](double a) { return std::abs(a) <= tolerance * square; };
    if (is_small(core::dot(x, y)) && is_small(core::dot(y, z)) && is_small(core::dot(z, x)) &&
        is_small(core::dot(y, y) - square) && is_small(core::dot(z, z) - square)) {
        const double size = std::abs(square - 1.0) <= tolerance ? 1.0 : std::sqrt(square);
        const Vec3d rows[3] = {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}};
        const Vec3d a = rows[0] / size, b = rows[1] / size, c = rows[2] / size;
        const core::Transform scaled = core::Transform::scaling(Vec3d(1.0 / size));
        return linear(scaled.after(core::Transform::turn(a, b, c)), a / size, b / size, c / size);
    }
    const Vec3d crossed[3] = {core::cross(y, z), core::cross(z, x), core::cross(x, y)};
    const double det = core::dot(x, crossed[0]);
    double rows[3][4] = {};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) {
            rows[row][column] = crossed[row][column] / det;
            if (!std::isfinite(rows[row][column]))
                fail(place, "must have an inverse of finite numbers");
        }
    const auto column = [&](int i) { return Vec3d(rows[0][i], rows[1][i], rows[2][i]); };
    return linear(core::Transform::matrix(rows), column(0), column(1), column(2));
}

Shared<Motion> inverse_of(const Motion& motion, const Place& place) {
    const auto column = [&](int i) {
        return Vec3d(motion.rows[0][i], motion.rows[1][i], motion.rows[2][i]);
    };
    auto back = std::make_shared<const Motion>(translation(Vec3d(0.0) - column(3)));
    if (motion.translation) return back;
    return both(back, std::make_shared<const Motion>(
                          inverse_of_linear(column(0), column(1), column(2), place)));
}

} // namespace

Vec3d Motion::direction(const Vec3d& v) const {
    Vec3d result;
    for (int axis = 0; axis < 3; ++axis)
        result[axis] = rows[axis][0] * v.x + rows[axis][1] * v.y + rows[axis][2] * v.z;
    return result;
}

Vec3d Motion::point(const Vec3d& p) const {
    return direction(p) + Vec3d(rows[0][3], rows[1][3], rows[2][3]);
}

Shared<Motion> both(const Shared<Motion>& first, const Shared<Motion>& second) {
    if (first == nullptr) return second;
    if (second == nullptr) return first;
    Motion motion{second->exact.after(first->exact)};
    motion.translation.reset();
    for (int axis = 0; axis < 4; ++axis) {
        const Vec3d column(first->rows[0][axis], first->rows[1][axis], first->rows[2][axis]);
        const Vec3d moved = axis < 3 ? second->direction(column) : second->point(column);
        for (int row = 0; row < 3; ++row)
            motion.rows[row][axis] = moved[row];
    }
    return std::make_shared<const Motion>(std::move(motion));
}

LightSource LightSource::moved(const Shared<Motion>& motion) const {
    LightSource light = *this;
    if (motion == nullptr) return light;
    light.position = motion->point(position);
    light.point_at = motion->point(point_at);
    return light;
}

Shared<Motion> read_motion(Tokens& tokens) {
    const Token word = tokens.peek();
    const auto made = [](Motion motion) {
        return std::make_shared<const Motion>(std::move(motion));
    };
    if (tokens.accept("translate")) return made(translation(read_vector(tokens)));
    if (tokens.accept("rotate")) return made(rotation(read_vector(tokens)));
    if (tokens.accept("scale")) return made(scaling(read_vector(tokens), tokens, word.place));
    if (tokens.accept("matrix")) return made(matrix(tokens));
    if (tokens.accept("transform")) return read_transform(tokens);
    return nullptr;
}

Shared<Motion> read_transform(Tokens& tokens) {
    const auto named = [&] {
        Shared<Motion> motion = tokens.accept_value<Motion>();
        const Token& word = tokens.peek();
        if (motion == nullptr) fail(word.place, "must be a transformation, got " + word.quoted());
        return motion;
    };
    const Place place = tokens.peek().place;
    if (!tokens.accept("{")) return named();
    Shared<Motion> joined;
    bool is_inverse = false; // of all of it, wherever the word is
    while (!tokens.accept("}")) {
        if (tokens.accept("inverse")) {
            is_inverse = true;
            continue;
        }
        const Shared<Motion> next = read_motion(tokens);
        joined = both(joined, next != nullptr ? next : named());
    }
    if (joined == nullptr) return std::make_shared<const Motion>();
    return is_inverse ? inverse_of(*joined, place) : joined;
}

} // namespace raylane::scenes::pov
