#include "core/scene/generators.hpp"

#include "core/numbers/elementary.hpp"
#include "core/shapes/checks.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>

namespace raylane::core {

namespace {

using Vec3i = Vec3<int>;

using checks::require_count;

void require_positive(const char* field, float value) {
    if (value > 0.0F) return;
    char text[32];
    throw InvalidValue(field,
                       "must be positive, got " +
                           std::string(text, std::to_chars(text, text + sizeof text, value).ptr));
}

void require_limit(const char* field, double extent) {
    if (!(extent <= static_cast<double>(coordinate_limit)))
        throw InvalidValue(field, "must keep all shapes between -1e30 and 1e30");
}

/// Reserves exactly `count` more shapes, but only if they are many compared to the existing ones.
/// Otherwise a long series of small generators would copy all shapes each time.
void reserve(SceneBuilder& builder, std::size_t count) {
    if (count >= builder.shape_count() / 2) builder.reserve(count);
}

/// Returns the centres of nine spheres around one, as unit vectors in a frame whose z axis is the
/// tip. They are the upper nine of the twelve spheres that touch a sphere in cubic close packing.
/// Six lie in the sphere's own layer, 60 degrees apart around the waist. Three lie in the next
/// layer, in every other gap between those, at cos(polar angle) = sqrt(2/3). As in the databases,
/// the first azimuth is 45 degrees from the x axis.
std::array<Vec3d, 9> nine_directions() {
    static constexpr double degree = std::numbers::pi / 180.0;
    std::array<Vec3d, 9> directions;
    for (int i = 0; i < 3; ++i) {
        const double azimuth = (45.0 + 120.0 * i) * degree;
        directions[i] = {cos(azimuth) / std::sqrt(3.0), sin(azimuth) / std::sqrt(3.0),
                         std::sqrt(2.0 / 3.0)};
    }
    for (int i = 0; i < 6; ++i) {
        const double azimuth = (15.0 + 60.0 * i) * degree;
        directions[3 + i] = {cos(azimuth), sin(azimuth), 0.0};
    }
    return directions;
}

/// The columns of a rotation matrix.
struct Rotation {
    Vec3d x, y, z;

    Vec3d operator*(const Vec3d& v) const { return v.x * x + v.y * y + v.z * z; }
};

/// Returns the smallest rotation that takes the z axis to the unit vector `z`. For -z, every half
/// turn is the smallest, and this returns the one about the y axis.
Rotation rotation_along(const Vec3d& z) {
    const double sin_squared = z.x * z.x + z.y * z.y;
    // A direction straight down has rounding errors in x and y, which define no axis.
    if (z.z < 0.0 && sin_squared < 1e-20)
        return {{-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, -1.0}};
    // 1 + cos, without cancellation
    const double k = z.z >= 0.0 ? 1.0 + z.z : sin_squared / (1.0 - z.z);
    const double xy = -z.x * z.y / k;
    return {{1.0 - z.x * z.x / k, xy, -z.x}, {xy, 1.0 - z.y * z.y / k, -z.y}, z};
}

class FlakeBuilder {
  public:
    FlakeBuilder(SceneBuilder& builder, const Sphereflake& flake, MaterialIndex material)
        : builder_(builder), material_(material),
          world_(rotation_along(normalized(convert<double>(flake.up)))) {}

    /// Adds a sphere and those that it bears. `tip` is a unit vector in the flake's own frame,
    /// whose z axis is its "up".
    void grow(const Vec3d& center, double radius, const Vec3d& tip, int depth) {
        builder_.add(Sphere{convert<float>(center), static_cast<float>(radius)}, material_);
        if (depth == 0) return;
        const Rotation frame = rotation_along(tip);
        const double child_radius = radius / 3.0;
        for (const Vec3d& direction : directions_) {
            const Vec3d child_tip = frame * direction;
            grow(center + (radius + child_radius) * (world_ * child_tip), child_radius, child_tip,
                 depth - 1);
        }
    }

  private:
    SceneBuilder& builder_;
    MaterialIndex material_;
    Rotation world_;
    std::array<Vec3d, 9> directions_ = nine_directions();
};

} // namespace

std::size_t count_of(const Sphereflake& flake) {
    require_count("depth", flake.depth, 0, Sphereflake::max_depth);
    std::size_t count = 0;
    for (int level = 0; level <= flake.depth; ++level)
        count = 9 * count + 1;
    return count;
}

Vec3d corner_around(const Vec3d& center, int n, float spacing) {
    return center - Vec3d(0.5 * (n - 1.0) * static_cast<double>(spacing));
}

std::size_t count_of(const Lattice& lattice) {
    require_count("n", lattice.n, 1, Lattice::max_nodes);
    const auto n = static_cast<std::size_t>(lattice.n);
    return n * n * n + 3 * n * n * (n - 1);
}

void add(SceneBuilder& builder, const Sphereflake& flake, MaterialIndex material) {
    const std::size_t count = count_of(flake);
    if (flake.up == Vec3f(0.0F))
        throw InvalidValue("up", "must not be the zero vector, got [0, 0, 0]");
    require_positive("radius", flake.radius);
    auto least = static_cast<double>(flake.radius);
    for (int level = 0; level < flake.depth; ++level)
        least /= 3.0;
    if (static_cast<float>(least) == 0.0F)
        throw InvalidValue("radius", "must be so large that no sphere's radius is 0");
    // All spheres are within two radii around the centre.
    for (int axis = 0; axis < 3; ++axis)
        require_limit("center", std::abs(static_cast<double>(flake.center[axis])) +
                                    2.0 * static_cast<double>(flake.radius));
    reserve(builder, count);
    FlakeBuilder(builder, flake, material)
        .grow(convert<double>(flake.center), static_cast<double>(flake.radius), {0.0, 0.0, 1.0},
              flake.depth);
}

void add(SceneBuilder& builder, const Lattice& lattice, MaterialIndex material,
         MaterialIndex strut_material) {
    const int n = lattice.n;
    const std::size_t count = count_of(lattice);
    require_positive("spacing", lattice.spacing);
    require_positive("sphere_radius", lattice.sphere_radius);
    require_positive("strut_radius", lattice.strut_radius);
    const auto node = [&](int x, int y, int z) {
        return convert<float>(lattice.corner +
                              static_cast<double>(lattice.spacing) * Vec3d(x, y, z));
    };
    for (const Vec3f& corner : {node(0, 0, 0), node(n - 1, n - 1, n - 1)})
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(corner[axis]) <= coordinate_limit))
                throw InvalidValue("", "must have all nodes between -1e30 and 1e30");
    require_limit("sphere_radius", static_cast<double>(lattice.sphere_radius));
    require_limit("strut_radius", static_cast<double>(lattice.strut_radius));

    const auto for_each_node = [&](const Vec3i& end, const auto& visit) {
        for (int z = 0; z < end.z; ++z)
            for (int y = 0; y < end.y; ++y)
                for (int x = 0; x < end.x; ++x)
                    visit(node(x, y, z));
    };
    reserve(builder, count);
    for_each_node(Vec3i(n), [&](const Vec3f& center) {
        builder.add(Sphere{center, lattice.sphere_radius}, material);
    });
    for (int axis = 0; axis < 3; ++axis) {
        Vec3i end(n);
        end[axis] = n - 1;
        Vec3f strut(0.0F);
        strut[axis] = lattice.spacing;
        for_each_node(end, [&](const Vec3f& base) {
            builder.add(OpenCylinder{base, strut, lattice.strut_radius}, strut_material);
        });
    }
}

} // namespace raylane::core
