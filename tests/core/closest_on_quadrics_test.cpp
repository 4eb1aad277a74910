#include "core/reference/closest.hpp"
#include "core/shapes/shapes.hpp"
#include "tests/oracle/closest.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"
#include "tests/support/rounds.hpp"

#include <optional>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using oracle::Number;
using oracle::Place;
using ray_sets::Random;
using ray_sets::Target;

/// Closest points of quadrics in their boxes: they are on the surface, no point of the surface that
/// a search finds is closer, and their distance is rounded from one of 100 digits.
namespace {

using QuadricD = QuadricOf<double>;

Closest closest_of(const QuadricD& quadric, const Vec3d& point) {
    SceneBuilder builder;
    builder.wants_light = false;
    builder.add(quadric, builder.add_material({}));
    const Scene scene = std::move(builder).build();
    return ClosestSearcher(scene).find(point, infinity<double>);
}

bool is_in(const QuadricD& q, const Vec3d& p) {
    bool is_it = true;
    for (int axis = 0; axis < 3; ++axis)
        is_it = is_it && p[axis] - q.center[axis] >= q.lower[axis] &&
                p[axis] - q.center[axis] <= q.upper[axis];
    return is_it;
}

/// Returns the least distance of a point from points of the surface that are on lines through the
/// box, at first random ones, then ones near the closest so far.
double sampled_distance(const QuadricD& q, const Vec3d& p, Random& r) {
    double best = infinity<double>, reach = 1.0;
    Vec3d around = q.center + 0.5 * (q.lower + q.upper);
    const double size = length(q.upper - q.lower);
    for (int i = 0; i < 2000; ++i) {
        const bool anywhere = !std::isfinite(best) || i < 300;
        Vec3d origin = q.center;
        for (int axis = 0; axis < 3; ++axis)
            origin[axis] += r.uniform(q.lower[axis], q.upper[axis]);
        if (!anywhere) origin = around + r.direction() * (size * reach);
        // Lines along faces and edges of the box find the points there.
        Vec3d direction = r.direction();
        for (int axis = 0; axis < 3; ++axis)
            if (r.integer(0, 2) == 0) {
                origin[axis] =
                    q.center[axis] + (r.integer(0, 1) == 0 ? q.lower[axis] : q.upper[axis]);
                direction[axis] = 0.0;
            }
        const ExactQuadratic f =
            form_along(q, ExactRay{convert<Dyadic>(origin), convert<Dyadic>(direction)}, body);
        const double A = f.A.approximately().to_double(), B = f.B.approximately().to_double(),
                     C = f.C.approximately().to_double();
        // Doubles give a double root to 8 digits only.
        if (A != 0.0 && !(B * B - A * C > 1e-6 * (B * B + std::abs(A * C)))) continue;
        const double root = std::sqrt(B * B - A * C);
        bool is_better = false;
        for (const double t : {(-B - root) / A, (-B + root) / A, -C / (2.0 * B)}) {
            const Vec3d at = origin + t * direction;
            if (!std::isfinite(t) || !is_in(q, at)) continue;
            if (t == -C / (2.0 * B) && A != 0.0) continue;
            if (!(length(at - p) < best)) continue;
            best = length(at - p);
            around = at;
            is_better = true;
        }
        if (!anywhere) reach *= is_better ? 1.2 : 0.99;
    }
    return best;
}

/// Solves a linear system by elimination. Returns nothing if it is nearly singular.
std::optional<std::vector<Number>> solved(std::vector<std::vector<Number>> rows) {
    const std::size_t n = rows.size();
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t pivot = i;
        for (std::size_t k = i; k < n; ++k)
            if (abs(rows[k][i]) > abs(rows[pivot][i])) pivot = k;
        if (abs(rows[pivot][i]) < Number("1e-9")) return {};
        std::swap(rows[i], rows[pivot]);
        for (std::size_t k = 0; k < n; ++k) {
            if (k == i) continue;
            const Number factor = rows[k][i] / rows[i][i];
            for (std::size_t j = i; j <= n; ++j)
                rows[k][j] -= factor * rows[i][j];
        }
    }
    std::vector<Number> result;
    for (std::size_t i = 0; i < n; ++i)
        result.push_back(rows[i][n] / rows[i][i]);
    return result;
}

/// The distance of the stationary point near an answer to 100 digits, by Newton's method for the
/// coordinates that are not at an end of the box, and the multiplier. Returns nothing if it does
/// not converge.
std::optional<Number> polished_distance(const QuadricD& q, const Vec3d& p, const Vec3d& answer) {
    const Number a[3][3] = {{Number(q.xx), Number(q.xy), Number(q.xz)},
                            {Number(q.xy), Number(q.yy), Number(q.yz)},
                            {Number(q.xz), Number(q.yz), Number(q.zz)}};
    const Number linear[3] = {Number(q.x), Number(q.y), Number(q.z)};
    Number x[3], f[3];
    std::vector<std::size_t> free;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        x[i] = Number(answer[axis]) - Number(q.center[axis]);
        f[i] = Number(p[axis]) - Number(q.center[axis]);
        bool is_free = true;
        for (const double limit : {q.lower[axis], q.upper[axis]})
            if (abs(x[i] - Number(limit)) <=
                1e-14 * (abs(Number(answer[axis])) + abs(Number(limit)))) {
                x[i] = Number(limit);
                is_free = false;
            }
        if (is_free) free.push_back(i);
    }
    const auto distance = [&] { return oracle::size_of({x[0] - f[0], x[1] - f[1], x[2] - f[2]}); };
    if (free.empty()) return distance();
    Number l = 0, last = 1;
    bool is_first = true;
    for (int step = 0; step < 40; ++step) {
        Number gradient[3], value = Number(q.one);
        for (std::size_t i = 0; i < 3; ++i) {
            gradient[i] = linear[i];
            for (std::size_t j = 0; j < 3; ++j)
                gradient[i] += a[i][j] * x[j];
            value += x[i] * (gradient[i] + linear[i]);
        }
        if (is_first) {
            Number up = 0, down = 0;
            for (const std::size_t i : free) {
                up += (x[i] - f[i]) * gradient[i];
                down += gradient[i] * gradient[i];
            }
            if (down == 0) return {};
            l = -up / down;
            is_first = false;
        }
        const std::size_t n = free.size();
        std::vector<std::vector<Number>> rows(n + 1, std::vector<Number>(n + 2, Number(0)));
        for (std::size_t r = 0; r < n; ++r) {
            const std::size_t i = free[r];
            for (std::size_t c = 0; c < n; ++c)
                rows[r][c] = l * a[i][free[c]] + (r == c ? 1 : 0);
            rows[r][n] = gradient[i];
            rows[r][n + 1] = -(x[i] - f[i] + l * gradient[i]);
            rows[n][r] = 2 * gradient[i];
        }
        rows[n][n + 1] = -value;
        const auto change = solved(rows);
        if (!change) return {};
        Number most = 0;
        for (std::size_t r = 0; r < n; ++r) {
            x[free[r]] += (*change)[r];
            most = std::max(most, Number(abs((*change)[r])));
        }
        l += (*change)[n];
        last = most;
        if (last < Number("1e-92")) break;
    }
    if (last > Number("1e-90")) return {};
    return distance();
}

struct Tally {
    int total = 0, polished = 0;
};

void check(const QuadricD& q, const Vec3d& p, Random& r, Tally& tally) {
    const Closest got = closest_of(q, p);
    const double sampled = sampled_distance(q, p, r);
    CAPTURE(q.center.x, q.center.y, q.center.z, q.xx, q.yy, q.zz, q.xy, q.xz, q.yz, q.x, q.y, q.z,
            q.one);
    CAPTURE(q.lower.x, q.lower.y, q.lower.z, q.upper.x, q.upper.y, q.upper.z, p.x, p.y, p.z);
    CAPTURE(got.distance, sampled, got.point.x, got.point.y, got.point.z);
    if (got.shape == no_shape) {
        CHECK(!std::isfinite(sampled));
        return;
    }
    const double scale = length(p - q.center) + length(q.upper - q.lower) + length(q.center);
    CHECK(got.distance <= sampled + 1e-12 * scale);
    CHECK(std::abs(length(got.point - p) - got.distance) <= 1e-14 * scale);
    for (int axis = 0; axis < 3; ++axis) {
        const double x = got.point[axis] - q.center[axis];
        CHECK(x >= q.lower[axis] - 1e-15 * scale);
        CHECK(x <= q.upper[axis] + 1e-15 * scale);
    }
    const Vec3d off = got.point - q.center;
    CHECK(std::abs(quadric_value(q, off)) <=
          1e-14 * scale *
              (length(quadric_half_gradient(q, off)) + scale * quadric_scale<double>(q)));
    ++tally.total;
    const auto polished = polished_distance(q, p, got.point);
    if (!polished || abs(*polished - Number(got.distance)) > 1e-12 * scale) return;
    ++tally.polished;
    CHECK(abs(Number(got.distance) - *polished) <=
          Number(0.5000001) *
                  (Number(std::nextafter(got.distance, infinity<double>)) - Number(got.distance)) +
              Number("1e-85"));
}

} // namespace

TEST_CASE("no point of a quadric in its box is closer than the answer") {
    Random r(tests::seed(11));
    Tally tally;
    for (int i = 0; i < tests::rounds(60, 5, 1000); ++i)
        for (const bool lattice : {false, true}) {
            const QuadricD q = to_doubles(Target<Quadric>::make(r, lattice));
            for (int k = 0; k < 3; ++k) {
                Vec3d p = lattice ? Vec3d(0.5) * convert<double>(r.small_integers(12))
                                  : q.center + r.cube(r.log_uniform(0.1, 100.0));
                if (r.integer(0, 4) == 0) p = Target<Quadric>::surface(to_floats(q), r).point;
                check(q, p, r, tally);
            }
        }
    CHECK(tally.polished > tally.total / 2);
}

TEST_CASE("closest points of quadrics at their axes, apexes and rims are those of geometry") {
    struct Case {
        QuadricD quadric;
        Vec3d point;
        double distance, z;
    };
    const Vec3d origin(0.0), lower(-2.0), upper(2.0), above(-2.0, -2.0, 0.0);
    const QuadricD paraboloid{origin, 1, 1, 0, 0, 0, 0, 0, 0, -0.5, 0, lower, upper};
    const QuadricD hyperboloid{origin, 1, 1, -1, 0, 0, 0, 0, 0, 0, -1, lower, upper};
    const QuadricD cone{origin, 1, 1, -1, 0, 0, 0, 0, 0, 0, 0, above, upper};
    const QuadricD cylinder{origin, 1, 1, 0, 0, 0, 0, 0, 0, 0, -1, lower, upper};
    const QuadricD line{origin, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, lower, upper};
    const QuadricD two_planes{origin, 1, 0, 0, 0, 0, 0, 0, 0, 0, -1, lower, upper};
    const QuadricD double_plane{origin, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, lower, upper};
    for (const Case& it : {
             Case{paraboloid, {0, 0, 1.5}, std::sqrt(1.25), 1},
             {paraboloid, {0, 0, -1.5}, 1.5, 0},
             {hyperboloid, {0, 0, 0}, 1, 0},
             {cone, {0, 0, 1}, std::sqrt(0.5), 0.5},
             {cone, {0, 0, -1}, 1, 0},
             {cone, {1, 0, -0.5}, std::sqrt(1.125), 0.25},
             {cylinder, {0, 0, 0.5}, 1, 0.5},
             {cylinder, {0, 0, 5}, std::sqrt(10.0), 2},
             {cylinder, {3, 0, 4}, std::sqrt(8.0), 2},
             {line, {1, 0.25, 0.5}, std::sqrt(1.0625), 0.5},
             {two_planes, {0, 0.25, 0.5}, 1, 0.5},
             {double_plane, {1, 0.25, 0.5}, 1, 0.5},
         }) {
        const Closest got = closest_of(it.quadric, it.point);
        CAPTURE(it.point.x, it.point.y, it.point.z, it.distance);
        CHECK(got.distance == it.distance);
        CHECK(got.point.z == it.z);
        CHECK(length(got.point - it.point) == Approx(it.distance).epsilon(1e-14));
    }
    const QuadricD empty{origin, 1, 1, 1, 0, 0, 0, 0, 0, 0, 1, lower, upper};
    CHECK(closest_of(empty, Vec3d(0.0)).shape == no_shape);
}
