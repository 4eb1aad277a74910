#include "values.hpp"

#include <initializer_list>
#include <limits>
#include <mutex>
#include <pybind11/stl.h>
#include <string_view>
#include <utility>

namespace raylane::python {

namespace {

/// A SceneBuilder with a mutex, for use by several Python threads.
struct SharedBuilder {
    SceneBuilder builder;
    std::mutex mutex;

    /// Calls call(builder) under the mutex and without Python's lock.
    template <class Call>
    auto change(const Call& call) {
        const py::gil_scoped_release free;
        const std::lock_guard lock(mutex);
        return call(builder);
    }
};

/// An argument of a function that adds shapes. `axes`: number of axes that a single shape's value
/// has.
struct Rowed {
    const py::object& values;
    py::ssize_t axes;
    const char* name;
};
/// Returns the number of shapes: the rows of the first argument with more axes than a single
/// shape's value, or 1 if no argument has more.
std::size_t count_of(std::initializer_list<Rowed> all) {
    for (const Rowed& each : all)
        if (const py::array array = any_array(each.values, each.name); array.ndim() > each.axes)
            return static_cast<std::size_t>(array.shape(0));
    return 1;
}

/// Ids of added shapes: the first one, and one past the last.
using Ids = std::pair<ShapeId, std::size_t>;
py::tuple told(const Ids& ids) {
    return py::make_tuple(ids.first, ids.second);
}

/// Adds the shapes make(0), ..., make(count - 1) and returns their Ids as a tuple. In an
/// InvalidValue the field begins with the number of the shape.
template <class Make>
py::tuple add_all(SharedBuilder& shared, std::size_t count, const py::object& material,
                  const Make& make) {
    constexpr auto most = std::numeric_limits<MaterialIndex>::max();
    const Values<MaterialIndex> materials(whole_numbers(material, "material", most), count,
                                          "material");
    return told(shared.change([&](SceneBuilder& builder) {
        const auto first = static_cast<ShapeId>(builder.shape_count());
        for (std::size_t i = 0; i < count; ++i) {
            try {
                builder.add(make(i), materials[i]);
            } catch (const InvalidValue& error) {
                throw InvalidValue(std::to_string(i) + (error.field.empty() ? "" : "/") +
                                       error.field,
                                   error.expectation);
            }
        }
        return Ids(first, builder.shape_count());
    }));
}

MaterialIndex added(SceneBuilder& builder, const Material& material) {
    try {
        return builder.add_material(material);
    } catch (const InvalidValue& error) {
        constexpr std::string_view only =
            "pattern/colors/0"; // a single colour instead of a pattern
        if (material.pattern.kind != PatternKind::solid || !error.field.starts_with(only)) throw;
        throw InvalidValue("color" + error.field.substr(only.size()), error.expectation);
    }
}

/// Calls `call` with the type float if all arrays are of float32, otherwise with double.
template <class Call, class... Arrays>
py::tuple by_type(const Call& call, const Arrays&... arrays) {
    return (is_float(arrays) && ...) ? call(std::type_identity<float>())
                                     : call(std::type_identity<double>());
}

py::tuple add_spheres(SharedBuilder& builder, const py::object& centers, const py::object& radii,
                      const py::object& material) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const std::size_t count = count_of({{centers, 1, "centers"}, {radii, 0, "radii"}});
            const Rows<T> center(centers, {3}, "centers", count);
            const Values<T> radius(radii, count, "radii");
            const std::array columns = {center.column(0), center.column(1), center.column(2)};
            return add_all(builder, count, material, [&](std::size_t i) {
                return SphereOf<T>{{columns[0][i], columns[1][i], columns[2][i]}, radius[i]};
            });
        },
        centers, radii);
}
py::tuple add_ellipsoids(SharedBuilder& builder, const py::object& centers, const py::object& axes,
                         const py::object& material) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const std::size_t count = count_of({{centers, 1, "centers"}, {axes, 2, "axes"}});
            const Rows<T> center(centers, {3}, "centers", count);
            const Rows<T> axis(axes, {3, 3}, "axes", count);
            return add_all(builder, count, material, [&](std::size_t i) {
                return EllipsoidOf<T>{center.vector(i), axis.vector(i, 0), axis.vector(i, 3),
                                      axis.vector(i, 6)};
            });
        },
        centers, axes);
}
py::tuple add_planes(SharedBuilder& builder, const py::object& points, const py::object& normals,
                     const py::object& material) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const std::size_t count = count_of({{points, 1, "points"}, {normals, 1, "normals"}});
            const Rows<T> point(points, {3}, "points", count);
            const Rows<T> normal(normals, {3}, "normals", count);
            return add_all(builder, count, material, [&](std::size_t i) {
                return PlaneOf<T>{point.vector(i), normal.vector(i)};
            });
        },
        points, normals);
}
py::tuple add_discs(SharedBuilder& builder, const py::object& centers, const py::object& normals,
                    const py::object& radii, const py::object& material) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const std::size_t count =
                count_of({{centers, 1, "centers"}, {normals, 1, "normals"}, {radii, 0, "radii"}});
            const Rows<T> center(centers, {3}, "centers", count);
            const Rows<T> normal(normals, {3}, "normals", count);
            const Values<T> radius(radii, count, "radii");
            return add_all(builder, count, material, [&](std::size_t i) {
                return DiscOf<T>{center.vector(i), normal.vector(i), radius[i]};
            });
        },
        centers, normals, radii);
}
py::tuple add_triangles(SharedBuilder& builder, const py::object& corners,
                        const py::object& normals, const py::object& material, bool polygon) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const std::size_t count = count_of({{corners, 2, "corners"}});
            const Rows<T> corner(corners, {3, 3}, "corners", count);
            const auto flat = [&](std::size_t i) {
                return TriangleOf<T>{corner.vector(i, 0), corner.vector(i, 3), corner.vector(i, 6)};
            };
            const auto add = [&](const auto& make) {
                if (!polygon) return add_all(builder, count, material, make);
                const MaterialIndex of = one_material(material);
                return told(builder.change([&](SceneBuilder& to) {
                    std::vector<decltype(make(0))> all;
                    for (std::size_t i = 0; i < count; ++i)
                        all.push_back(make(i));
                    const ShapeId first = to.add_polygon(all, of);
                    return Ids(first, to.shape_count());
                }));
            };
            if (normals.is_none()) return add(flat);
            const Rows<T> normal(normals, {3, 3}, "normals", count);
            return add([&](std::size_t i) {
                const TriangleOf<T> of = flat(i);
                return SmoothTriangleOf<T>{of.a,
                                           of.b,
                                           of.c,
                                           normal.vector(i, 0),
                                           normal.vector(i, 3),
                                           normal.vector(i, 6)};
            });
        },
        corners, normals);
}
py::tuple add_boxes(SharedBuilder& builder, const py::object& corners, const py::object& edges,
                    const py::object& material) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const std::size_t count = count_of({{corners, 1, "corners"}, {edges, 2, "edges"}});
            const Rows<T> corner(corners, {3}, "corners", count);
            const Rows<T> edge(edges, {3, 3}, "edges", count);
            return add_all(builder, count, material, [&](std::size_t i) {
                return BoxOf<T>{corner.vector(i), edge.vector(i, 0), edge.vector(i, 3),
                                edge.vector(i, 6)};
            });
        },
        corners, edges);
}
py::tuple add_cylinders(SharedBuilder& builder, const py::object& bases, const py::object& axes,
                        const py::object& radii, const py::object& material,
                        const py::object& with_caps) {
    const bool caps = bool_from(with_caps, "caps");
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const std::size_t count =
                count_of({{bases, 1, "bases"}, {axes, 1, "axes"}, {radii, 0, "radii"}});
            const Rows<T> base(bases, {3}, "bases", count);
            const Rows<T> axis(axes, {3}, "axes", count);
            const Values<T> radius(radii, count, "radii");
            const auto add = [&]<class Shape>(std::type_identity<Shape>) {
                return add_all(builder, count, material, [&](std::size_t i) {
                    return Shape{base.vector(i), axis.vector(i), radius[i]};
                });
            };
            return caps ? add(std::type_identity<CappedCylinderOf<T>>())
                        : add(std::type_identity<OpenCylinderOf<T>>());
        },
        bases, axes, radii);
}
py::tuple add_cones(SharedBuilder& builder, const py::object& bases, const py::object& axes,
                    const py::object& base_radii, const py::object& top_radii,
                    const py::object& material, const py::object& with_caps) {
    const bool caps = bool_from(with_caps, "caps");
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const std::size_t count = count_of({{bases, 1, "bases"},
                                                {axes, 1, "axes"},
                                                {base_radii, 0, "base_radii"},
                                                {top_radii, 0, "top_radii"}});
            const Rows<T> base(bases, {3}, "bases", count);
            const Rows<T> axis(axes, {3}, "axes", count);
            const Values<T> lower(base_radii, count, "base_radii");
            const Values<T> upper(top_radii, count, "top_radii");
            const auto add = [&]<class Shape>(std::type_identity<Shape>) {
                return add_all(builder, count, material, [&](std::size_t i) {
                    return Shape{base.vector(i), axis.vector(i), lower[i], upper[i]};
                });
            };
            return caps ? add(std::type_identity<CappedConeOf<T>>())
                        : add(std::type_identity<OpenConeOf<T>>());
        },
        bases, axes, base_radii, top_radii);
}
py::tuple add_quadrics(SharedBuilder& builder, const py::object& centers,
                       const py::object& coefficients, const py::object& lower,
                       const py::object& upper, const py::object& material) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const std::size_t count = count_of({{centers, 1, "centers"},
                                                {coefficients, 1, "coefficients"},
                                                {lower, 1, "lower"},
                                                {upper, 1, "upper"}});
            const Rows<T> center(centers, {3}, "centers", count);
            const Rows<T> q(coefficients, {10}, "coefficients", count);
            const Rows<T> least(lower, {3}, "lower", count);
            const Rows<T> most(upper, {3}, "upper", count);
            return add_all(builder, count, material, [&](std::size_t i) {
                const auto at = [&](std::size_t k) { return q.column(k)[i]; };
                return QuadricOf<T>{center.vector(i),
                                    at(0),
                                    at(1),
                                    at(2),
                                    at(3),
                                    at(4),
                                    at(5),
                                    at(6),
                                    at(7),
                                    at(8),
                                    at(9),
                                    least.vector(i),
                                    most.vector(i)};
            });
        },
        centers, coefficients, lower, upper);
}

/// The values that a builder sets rather than adds: camera, background, fog, settings, wavelengths.
class Surroundings {
  public:
    Surroundings(const py::object& camera, const py::object& background, const py::object& fog,
                 const py::object& settings, const py::object& wavelengths)
        : camera_(camera.is_none() ? Camera() : camera_from(camera)),
          background_(color_from(background, "background")), fog_(fog_from(fog)),
          settings_(settings_from(settings)), wavelengths_(wavelengths_from(wavelengths)) {}

    Scene built(SceneBuilder& builder) const {
        builder.camera = camera_;
        builder.background = background_;
        builder.fog = fog_;
        builder.settings = settings_;
        builder.wavelengths = wavelengths_;
        return builder.build();
    }

  private:
    Camera camera_;
    Color background_;
    Fog fog_;
    Settings settings_;
    std::vector<double> wavelengths_;
};

} // namespace

void bind_builder(py::module_& module) {
    py::class_<SharedBuilder>(module, "Builder")
        .def(py::init())
        .def("add_material",
             [](SharedBuilder& builder, const py::object& material) {
                 const Material value = material_from(material);
                 return builder.change([&](SceneBuilder& to) { return added(to, value); });
             })
        .def("add_light",
             [](SharedBuilder& builder, const py::object& light) {
                 const Light value = light_from(light);
                 builder.change([&](SceneBuilder& to) { to.add_light(value); });
             })
        .def("add_solid",
             [](SharedBuilder& builder, const Solid& solid, const py::object& material) {
                 const MaterialIndex of = one_material(material);
                 return told(builder.change([&](SceneBuilder& to) {
                     const ShapeId first = to.add(solid, of);
                     return Ids(first, to.shape_count());
                 }));
             })
        .def("add_spheres", &add_spheres)
        .def("add_ellipsoids", &add_ellipsoids)
        .def("add_planes", &add_planes)
        .def("add_discs", &add_discs)
        .def("add_triangles", &add_triangles)
        .def("add_boxes", &add_boxes)
        .def("add_cylinders", &add_cylinders)
        .def("add_cones", &add_cones)
        .def("add_quadrics", &add_quadrics)
        .def("shape_count",
             [](SharedBuilder& builder) {
                 return builder.change([](const SceneBuilder& of) { return of.shape_count(); });
             })
        .def("build",
             [](SharedBuilder& builder, const py::object& camera, const py::object& background,
                const py::object& fog, const py::object& settings, const py::object& wavelengths,
                const py::object& merge_duplicates) {
                 const Surroundings around(camera, background, fog, settings, wavelengths);
                 const bool merge = bool_from(merge_duplicates, "merge_duplicates");
                 return builder.change([&](SceneBuilder& whole) {
                     whole.merge_duplicates = merge;
                     return around.built(whole);
                 });
             });
    // Throws the errors of build() for these values, before build() empties the builder.
    module.def("check",
               [](const py::object& camera, const py::object& background, const py::object& fog,
                  const py::object& settings, const py::object& wavelengths) {
                   const Surroundings around(camera, background, fog, settings, wavelengths);
                   const py::gil_scoped_release free;
                   SceneBuilder empty;
                   static_cast<void>(around.built(empty));
               });
}

} // namespace raylane::python
