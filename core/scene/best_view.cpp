#include "core/scene/best_view.hpp"

#include "core/numbers/primitives.hpp"
#include "core/scene/scene.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace raylane::core {

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Calls `visit` with the centre and the id of each bounded shape.
template <class Visit>
void for_each_center(const Scene& scene, const Visit& visit) {
    for_each_bounded_table(scene.shapes(), [&](const auto& table) {
        for_each_shape(table, [&](const auto& shape, ShapeId id) {
            const Bounds bounds = bounds_of(shape);
            visit(0.5 * (convert<double>(bounds.lower) + convert<double>(bounds.upper)), id);
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

/// Returns the principal axes of points, unit vectors by descending extent, or nothing without
/// points.
std::optional<std::array<Vec3d, 3>> axes_of(const VisitPoints& for_each_point) {
    Vec3d mean(0.0);
    double count = 0.0;
    for_each_point([&](const Vec3d& center) {
        mean = mean + center;
        count += 1.0;
    });
    if (count == 0.0) return std::nullopt;
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
    std::array<std::size_t, 3> order = {0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return moments[a][a] > moments[b][b]; });
    return std::array{axes[order[0]], axes[order[1]], axes[order[2]]};
}

/// Returns the unit normals of floors, on the side of the shapes. Those of planes come first.
std::vector<Vec3d> floors_of(const Scene& scene) {
    std::vector<Vec3d> floors;
    const auto add = [&](const Vec3d& point, const Vec3d& normal, ShapeId own) {
        double least = 0.0, most = 0.0;
        for_each_center(scene, [&](const Vec3d& center, ShapeId id) {
            const double height = id == own ? 0.0 : dot(normal, center - point);
            least = std::min(least, height);
            most = std::max(most, height);
        });
        const double sign = least == 0.0 ? 1.0 : -1.0;
        if ((least == 0.0) != (most == 0.0)) floors.push_back(sign / length(normal) * normal);
    };
    constexpr std::size_t most_of_each = 16; // each is compared with all shapes
    const auto& planes = std::get<Table<Plane>>(scene.shapes());
    if (planes.size() <= most_of_each)
        for_each_shape(planes, [&](const auto& plane, ShapeId id) {
            if (!scene.solids().has(id))
                add(convert<double>(plane.point), convert<double>(plane.normal), id);
        });
    const auto& discs = std::get<Table<Disc>>(scene.shapes());
    if (discs.size() <= most_of_each)
        for_each_shape(discs, [&](const auto& disc, ShapeId id) {
            add(convert<double>(disc.center), convert<double>(disc.normal), id);
        });
    return floors;
}

/// Returns the best view over the most horizontal of some floors.
NamedView view_over(const std::vector<Vec3d>& floors, const Scene& scene) {
    const Vec3d upright = convert<double>(scene.camera().up);
    const auto slope = [&](const Vec3d& normal) { return std::abs(dot(normal, upright)); };
    const Vec3d up =
        *std::max_element(floors.begin(), floors.end(),
                          [&](const Vec3d& a, const Vec3d& b) { return slope(a) < slope(b); });
    const auto axes = axes_of([&](const auto& visit) {
        for_each_center(
            scene, [&](const Vec3d& center, ShapeId) { visit(center - dot(center, up) * up); });
    });
    // Without an extent, the axes may be those of space.
    constexpr double oblique = 0.8;
    const Vec3d across = *std::find_if(axes->begin(), axes->end(), [&](const Vec3d& axis) {
        return std::abs(dot(axis, up)) < oblique;
    });
    const Vec3d right = positive(normalized(across - dot(across, up) * up));
    const auto distance_to_walls = [&](const Vec3d& forward) {
        double least = 0.0; // of the camera, relative to that of the shapes
        for (const Vec3d& normal : floors)
            if (slope(normal) < slope(up)) least = std::min(least, -dot(forward, normal));
        return least;
    };
    Vec3d forward = cross(up, right);
    if (distance_to_walls(-1.0 * forward) > distance_to_walls(forward)) forward = -1.0 * forward;
    constexpr double cosine = 0.9396926207859084, sine = 0.3420201433256687; // of 20 degrees
    return {best_view_name, convert<float>(cosine * forward - sine * up), convert<float>(up)};
}

} // namespace

NamedView best_view(const Scene& scene) {
    const std::vector<Vec3d> floors = floors_of(scene);
    if (!floors.empty()) return view_over(floors, scene);
    return best_view([&](const auto& visit) {
        for_each_center(scene, [&](const Vec3d& center, ShapeId) { visit(center); });
    });
}

NamedView best_view(const VisitPoints& for_each_point) {
    const auto axes = axes_of(for_each_point);
    if (!axes) return named_views().front();
    const Vec3d right = positive((*axes)[0]), up = positive((*axes)[1]);
    return {best_view_name, convert<float>(cross(up, right)), convert<float>(up)};
}

} // namespace raylane::core
