#include "core/shapes/displacement.hpp"

#include "core/numbers/infinity.hpp"
#include "core/shapes/quadric.hpp"
#include "core/shapes/rounded_to_floats.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::core {

namespace {

/// Error bound of eight roundings to float, relative to their largest operand.
constexpr double roundings = 8 * 0x1p-24;

/// A cell of a quadric's box, or of one of its faces, which is flat and sees the gradient within
/// itself alone.
struct Cell {
    Vec3d middle, half;

    Vec3d seen(Vec3d gradient) const {
        for (int axis = 0; axis < 3; ++axis)
            if (half[axis] == 0.0) gradient[axis] = 0.0;
        return gradient;
    }
};

/// The least |half gradient| in a cell where |Q| <= error, or less; infinity<double> if that is
/// nowhere. By cutting the cell until its middle stands for all of it; 0 if that does not help.
double least_gradient(const InDouble<Quadric>& quadric, double norm, double error, const Cell& cell,
                      int depth) {
    const double radius = length(cell.half);
    const double gradient = length(cell.seen(quadric_half_gradient(quadric, cell.middle)));
    if (std::abs(quadric_value(quadric, cell.middle)) >
        radius * (2.0 * gradient + norm * radius) + error)
        return infinity<double>;
    if (norm * radius <= 0.5 * gradient) return gradient - norm * radius;
    if (depth == 0) return 0.0;
    double least = infinity<double>;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d towards((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                            (corner & 4) != 0 ? 0.5 : -0.5);
        const Cell part{Vec3d(cell.middle + towards * cell.half), 0.5 * cell.half};
        least = std::min(least, least_gradient(quadric, norm, error, part, depth - 1));
        if (least == 0.0) break;
    }
    return least;
}

/// Least half gradient in the box, and within its faces, where the surface is cut off.
double least_gradient(const InDouble<Quadric>& quadric, double norm, double error) {
    constexpr int depth = 6;
    const Vec3d lower = quadric.lower, upper = quadric.upper;
    const Cell box{0.5 * (lower + upper), 0.5 * (upper - lower)};
    double least = least_gradient(quadric, norm, error, box, depth);
    for (int axis = 0; axis < 3; ++axis)
        for (const Vec3d& corner : {lower, upper}) {
            Cell face = box;
            face.middle[axis] = corner[axis];
            face.half[axis] = 0.0;
            least = std::min(least, least_gradient(quadric, norm, error, face, depth));
        }
    return least;
}

/// Rows of the matrix: the diagonal, and what the rest of each adds up to.
struct Rows {
    Vec3d diagonal, rest;

    explicit Rows(const InDouble<Quadric>& q) : diagonal(q.xx, q.yy, q.zz) {
        const double xy = std::abs(q.xy), xz = std::abs(q.xz), yz = std::abs(q.yz);
        rest = {xy + xz, xy + yz, xz + yz};
    }

    /// Norm of the matrix, or more.
    double norm() const {
        double norm = 0.0;
        for (int row = 0; row < 3; ++row)
            norm = std::max(norm, std::abs(diagonal[row]) + rest[row]);
        return norm;
    }

    /// Or less, sign apart; 0 if the matrix may be indefinite. By Gershgorin's circles.
    double least_eigenvalue() const {
        const Vec3d above = diagonal - rest, below = -diagonal - rest;
        return std::max(
            {std::min({above.x, above.y, above.z}), std::min({below.x, below.y, below.z}), 0.0});
    }
};

bool has_float_form(const InDouble<Quadric>& q) {
    const double form[] = {q.xx, q.yy, q.zz, q.xy, q.xz, q.yz, q.x, q.y, q.z, q.one};
    return std::ranges::all_of(form, checks::is_float<double>);
}

} // namespace

/// Displacement, with D the largest distance from a start to the centre's far side. Robust: the
/// foot of the perpendicular is off by roundings of D, and with it the radius. Fast: the
/// discriminant B^2 - A C is off by roundings of D^2, that is the square of the radius is.
double displacement(const InDouble<Sphere>& sphere, Precision precision, double reach) {
    const double r = sphere.radius, D = reach + r;
    const double off =
        precision == Precision::robust ? 2.0 * roundings * D : 3.0 * roundings * D * (1.0 + D / r);
    return off < 0.25 * r ? off + change_in_floats(sphere) : infinity<double>;
}

/// The numerator of t is off by roundings of |centre - origin|, the denominator by roundings of the
/// direction. So the point is off its plane by roundings of D, along the ray; and what that moves
/// it by inside the plane is foreshortened as the disc is.
double displacement(const InDouble<Disc>& disc, Precision, double reach) {
    const double r = disc.radius;
    const double off = 2.0 * roundings * (reach + r);
    return off < 0.25 * r ? off + change_in_floats(disc) : infinity<double>;
}

/// Let m be the matrix's norm, l the linear part's, s the largest coefficient, T(x) = m x^2 + 2 l x
/// + |one| what Q is made of at a distance x from the centre, R the box's reach, G = m R + l >=
/// half a gradient inside of it, and D the largest distance of a start. Let g be the least half
/// gradient on the surface there, and within the box's faces, as the edges move at which the
/// surface is cut off. An error of Q by e moves them by e / 2 g and a little more.
///
/// Robust: C is off by roundings of T(D), and t = C / q by what that moves the surface, and by its
/// own roundings, along the ray. The other root is half a chord h from the vertex, with |A| h <= G,
/// and |A| >= s / 16 or the vertex is not used: h <= 16 G / s. There Q is off by roundings of T(R)
/// and of 2 G h + m h^2, which is an error of h, along the ray, of 16 G / s (1 + 3 * 8) at most.
/// A crossing that moves along the ray moves by half of that across, as the surface is slanted.
///
/// Fast: the discriminant is off by roundings of B^2 and A C, and Q by that divided by A.
double displacement(const InDouble<Quadric>& quadric, Precision precision, double reach) {
    const Vec3d lower = quadric.lower, upper = quadric.upper;
    double R_squared = 0.0, aside_squared = 0.0; // the centre may be outside of the box
    for (int axis = 0; axis < 3; ++axis) {
        const double far = std::max(std::abs(lower[axis]), std::abs(upper[axis]));
        const double aside = std::max({lower[axis], -upper[axis], 0.0});
        R_squared += far * far;
        aside_squared += aside * aside;
    }
    const Rows matrix(quadric);
    const double m = matrix.norm();
    const double l = length(Vec3d(quadric.x, quadric.y, quadric.z));
    const double R = std::sqrt(R_squared), G = m * R + l;
    const double D = reach + std::sqrt(aside_squared);
    const auto T = [&](double x) { return x * (m * x + 2.0 * l) + std::abs(quadric.one); };

    double error = 0.0, along = D; // roundings of these: of Q, and along the ray
    if (precision == Precision::robust) {
        const auto s = quadric_scale<double>(quadric);
        error = T(D) + 2.0 * T(R);
        along += 16.0 * G / s * (1.0 + 3.0 * 8.0);
    } else {
        const double B = m * D + l;
        error = (1.25 * B * B + 2.0 * m * T(D)) / matrix.least_eigenvalue() + T(R);
    }
    error *= roundings;
    if (!(error < infinity<double>)) return infinity<double>;
    const double gradient = least_gradient(quadric, m, error);
    // Moved by x, Q changes by 2 g x - m x^2 or more.
    const double rest = gradient * gradient - m * error;
    if (!(rest > 0.0) || !has_float_form(quadric)) return infinity<double>;
    // As the box moves, so do the edges: along the surface, at a slant.
    const double moved = change_in_floats(quadric) * std::max(1.0, G / gradient);
    return error / (gradient + std::sqrt(rest)) + 0.5 * roundings * along + moved;
}

} // namespace raylane::core
