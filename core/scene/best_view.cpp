#include "core/scene/best_view.hpp"

#include "core/numbers/primitives.hpp"
#include "core/scene/scene.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace raylane::core {

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Calls `visit` with the centre of each bounded shape.
template <class Visit>
void for_each_center(const Scene& scene, const Visit& visit) {
    for_each_bounded_table(scene.shapes(), [&](const auto& table) {
        for_each_shape(table, [&](const auto& shape, ShapeId) {
            const Bounds bounds = bounds_of(shape);
            visit(0.5 * (convert<double>(bounds.lower) + convert<double>(bounds.upper)));
        });
    });
}

/// Turns `matrix`, which is symmetric, into a diagonal one by Jacobi's rotations, and the rows of
/// `axes` with it (Golub and Van Loan, Matrix Computations, 8.5). It uses +, -, *, / and sqrt,
/// which are the same on all machines.
void diagonalize(Matrix& matrix, std::array<Vec3d, 3>& axes) {
    constexpr int sweeps = 12; // convergence is quadratic: five suffice
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (std::size_t p = 0; p < 2; ++p)
            for (std::size_t q = p + 1; q < 3; ++q) {
                if (matrix[p][q] == 0.0) continue;
                const double slope = 0.5 * (matrix[q][q] - matrix[p][p]) / matrix[p][q];
                const double tangent = (slope >= 0.0 ? 1.0 : -1.0) /
                                       (std::abs(slope) + std::sqrt(1.0 + slope * slope));
                const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
                const double sine = tangent * cosine;
                for (std::size_t k = 0; k < 3; ++k) {
                    const double a = matrix[k][p], b = matrix[k][q];
                    matrix[k][p] = cosine * a - sine * b;
                    matrix[k][q] = sine * a + cosine * b;
                }
                for (std::size_t k = 0; k < 3; ++k) {
                    const double a = matrix[p][k], b = matrix[q][k];
                    matrix[p][k] = cosine * a - sine * b;
                    matrix[q][k] = sine * a + cosine * b;
                }
                const Vec3d a = axes[p], b = axes[q];
                axes[p] = cosine * a - sine * b;
                axes[q] = sine * a + cosine * b;
            }
}

/// Returns the direction or its opposite, such that its largest component is positive.
Vec3d positive(const Vec3d& direction) {
    int largest = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (std::abs(direction[axis]) > std::abs(direction[largest])) largest = axis;
    return direction[largest] < 0.0 ? -1.0 * direction : direction;
}

} // namespace

NamedView best_view(const Scene& scene) {
    return best_view([&](const auto& visit) { for_each_center(scene, visit); });
}

NamedView best_view(const VisitPoints& for_each_point) {
    Vec3d mean(0.0);
    double count = 0.0;
    for_each_point([&](const Vec3d& center) {
        mean = mean + center;
        count += 1.0;
    });
    if (count == 0.0) return named_views().front();
    mean = (1.0 / count) * mean;
    Matrix moments{};
    for_each_point([&](const Vec3d& center) {
        const Vec3d from = center - mean;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                moments[i][j] += from[static_cast<int>(i)] * from[static_cast<int>(j)] / count;
    });
    std::array<Vec3d, 3> axes = {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)};
    diagonalize(moments, axes);
    std::array<std::size_t, 3> order = {0, 1, 2}; // by descending extent
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return moments[a][a] > moments[b][b]; });
    const Vec3d right = positive(axes[order[0]]), up = positive(axes[order[1]]);
    return {best_view_name, convert<float>(cross(up, right)), convert<float>(up)};
}

} // namespace raylane::core
