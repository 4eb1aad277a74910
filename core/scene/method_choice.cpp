#include "core/scene/method_choice.hpp"

#include "core/numbers/infinity.hpp"
#include "core/scene/camera_rays.hpp"
#include "core/scene/features.hpp"
#include "core/shapes/displacement.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::core {

namespace {

constexpr double good_enough = 0.1; ///< pixels
/// All pairs of shapes are compared.
constexpr std::size_t most_shapes = 1000;

/// Distances to a box's nearest and farthest points.
struct Distances {
    double nearest, farthest;
};

Distances distances(const Vec3d& from, const Bounds& bounds) {
    double near_squared = 0.0, far_squared = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double below = static_cast<double>(bounds.lower[axis]) - from[axis];
        const double above = from[axis] - static_cast<double>(bounds.upper[axis]);
        const double outside = std::max({below, above, 0.0});
        const double across = std::max(std::abs(below), std::abs(above));
        near_squared += outside * outside;
        far_squared += across * across;
    }
    return {std::sqrt(near_squared), std::sqrt(far_squared)};
}

/// Between the nearest points of two boxes.
double gap(const Bounds& a, const Bounds& b) {
    double squared = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double outside = std::max(
            {static_cast<double>(a.lower[axis]) - static_cast<double>(b.upper[axis]),
             static_cast<double>(b.lower[axis]) - static_cast<double>(a.upper[axis]), 0.0});
        squared += outside * outside;
    }
    return std::sqrt(squared);
}

/// The least length that a pixel covers at a distance.
class PixelSize {
  public:
    PixelSize(const Camera& camera, const Settings& settings)
        : orthographic_(camera.projection == Projection::orthographic) {
        const CameraRays<double> rays(camera, settings);
        const double half_pixel = length(rays.up());
        size_ = 2.0 * half_pixel;
        if (orthographic_) return;
        // Towards the picture's corner a pixel is seen under a smaller angle, by the cosine
        // squared.
        const double half = half_pixel * settings.height, across = half_pixel * settings.width;
        size_ /= 1.0 + half * half + across * across;
    }

    double at(double distance) const { return orthographic_ ? size_ : size_ * distance; }

  private:
    bool orthographic_;
    double size_;
};

/// Displacement of surfaces and shadows by a method of floats, in a scene without reflections.
class FloatMethod {
  public:
    FloatMethod(const Scene& scene, const Settings& settings, bool shadows, Precision precision)
        : scene_(scene), pixel_(scene.camera(), settings), shadows_(shadows), precision_(precision),
          eye_(convert<double>(scene.camera().from)) {
        for_each_bounded([&](const auto&, const Bounds& bounds) { all_.include(bounds); });
        nearest_ = distances(eye_, all_).nearest;
        largest_ = distances(Vec3d(0.0), all_).farthest;
        extent_ = length(convert<double>(all_.upper) - convert<double>(all_.lower));
        for_each_bounded([&](const auto& shape, const Bounds& bounds) { add(shape, bounds); });
    }

    double pixels() const { return pixels_; }

    /// True if two surfaces may be closer than the sum of their displacements.
    bool confuses_surfaces() const {
        for (std::size_t i = 0; i < drawn_.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (!(gap(drawn_[i].bounds, drawn_[j].bounds) > drawn_[i].off + drawn_[j].off))
                    return true;
        return false;
    }

  private:
    struct Drawn {
        Bounds bounds;
        double off;
    };

    template <class Visit>
    void for_each_bounded(const Visit& visit) const {
        for_each_bounded_table(scene_.shapes(), [&]<class Shape>(const Table<Shape>& table) {
            for_each_shape(table,
                           [&](const auto& shape, ShapeId) { visit(shape, bounds_of(shape)); });
        });
    }

    /// Rays' directions are rounded to float, and so are starts that are not the camera.
    double off_from(const auto& shape, double reach, double start) const {
        return displacement(shape, precision_, reach) + 0x1p-22 * (reach + start);
    }

    void add(const auto& shape, const Bounds& bounds) {
        const Distances seen = distances(eye_, bounds);
        // Orthographic rays start in the camera's plane, beside it.
        const double start =
            scene_.camera().projection == Projection::orthographic ? extent_ + length(eye_) : 0.0;
        double off = off_from(shape, seen.farthest + start, start);
        pixels_ = std::max(pixels_, off / pixel_.at(seen.nearest));
        if (shadows_) off = std::max(off, add_shadows(shape, bounds));
        drawn_.push_back({bounds, off});
    }

    /// Shadows fall anywhere in the scene, and are larger than what casts them. Where they fall at
    /// a slant they are displaced by more, but there the light that they take is as much weaker.
    /// Returns what the shape is off by, seen from where they fall.
    double add_shadows(const auto& shape, const Bounds& bounds) {
        const double off = off_from(shape, extent_, largest_);
        for (const Light& light : scene_.lights()) {
            double larger = 1.0;
            if (light.kind == LightKind::point) {
                const Vec3d position = convert<double>(light.position);
                larger = distances(position, all_).farthest / distances(position, bounds).nearest;
            }
            pixels_ = std::max(pixels_, larger * off / pixel_.at(nearest_));
        }
        return off;
    }

    const Scene& scene_;
    PixelSize pixel_;
    bool shadows_;
    Precision precision_;
    Vec3d eye_;
    Bounds all_;
    double nearest_ = 0.0; ///< from the eye
    double extent_ = 0.0;  ///< between any two points of the scene, at most
    double largest_ = 0.0; ///< from the origin
    double pixels_ = 0.0;
    std::vector<Drawn> drawn_;
};

void consider_floats(MethodEstimate& method, const Scene& scene, const Settings& settings,
                     const Features& features) {
    if (features.solids) {
        method.objection = "where solids that are made of others have their surface is not bounded";
    } else if (features.planes) {
        method.objection = "planes have no end, nor has its error there";
    } else if (features.reflection || features.refraction) {
        method.objection = "reflections and refractions magnify its errors";
    } else if (features.patterns) {
        method.objection = "patterns are read where it takes the surface to be";
    } else if (features.soft_light) {
        method.objection = "its error in the shadows of lights with a size is not bounded";
    } else if (features.lens) {
        method.objection = "a lens' rays start beside each other";
    } else if (scene.shape_count() > most_shapes) {
        method.objection = "too many shapes to compare each with each";
    } else {
        const FloatMethod drawn(scene, settings, features.shading, method.precision);
        method.pixels = drawn.pixels();
        if (!(method.pixels < good_enough))
            method.objection = "it may displace what is seen by a tenth of a pixel or more";
        else if (drawn.confuses_surfaces())
            method.objection = "shapes touch or nearly do, and it may take one for another";
    }
}

double mean_cost(const Scene& scene, Precision precision) {
    double sum = 0.0;
    for_each_table(scene.shapes(), [&]<class Shape>(const Table<Shape>& table) {
        sum += static_cast<double>(table.size()) *
               Shape::traits.costs.value[static_cast<std::size_t>(precision)];
    });
    return scene.shape_count() == 0 ? 1.0 : sum / static_cast<double>(scene.shape_count());
}

} // namespace

MethodChoice choose_method(const Scene& scene, const Settings& settings) {
    const Features features = features_of(scene, settings);
    MethodChoice choice{Precision::exact, {}};
    for (const Precision precision : all_precisions) {
        MethodEstimate method{precision, mean_cost(scene, precision), infinity<double>, {}};
        if (is_single(precision)) {
            consider_floats(method, scene, settings, features);
        } else if (precision == Precision::exact) {
            method.pixels = 0.0;
        } else {
            method.objection = "nothing certifies it";
        }
        choice.considered.insert(
            std::upper_bound(
                choice.considered.begin(), choice.considered.end(), method,
                [](const MethodEstimate& a, const MethodEstimate& b) { return a.cost < b.cost; }),
            std::move(method));
    }
    for (const MethodEstimate& method : choice.considered)
        if (method.objection.empty()) {
            choice.precision = method.precision;
            break;
        }
    return choice;
}

} // namespace raylane::core
