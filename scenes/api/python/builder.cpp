#include "values.hpp"

#include <initializer_list>
#include <memory>
#include <mutex>
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace raylane::python {

namespace {

std::size_t count_in(const SceneBuilder& builder) {
    return builder.shape_count();
}
std::size_t count_in(const Group& group) {
    return group.size();
}

/// Numbers of added objects: the first one, and one past the last. Those of shapes in a scene are
/// ids.
using Range = std::pair<std::size_t, std::size_t>;

/// A SceneBuilder or a Group with a mutex, for use by several Python threads.
template <class To>
struct Shared {
    To to{};
    std::mutex mutex{};

    /// Calls call(to) under the mutex and without Python's lock.
    template <class Call>
    auto change(const Call& call) {
        const py::gil_scoped_release free;
        const std::lock_guard lock(mutex);
        return call(to);
    }
    /// Calls add(to) as change() does. Returns the numbers of the added objects.
    template <class Add>
    py::tuple numbers(const Add& add) {
        const Range range = change([&](To& all) {
            const std::size_t first = count_in(all);
            add(all);
            return Range(first, count_in(all));
        });
        return py::make_tuple(range.first, range.second);
    }
};
using SharedBuilder = Shared<SceneBuilder>;
using SharedGroup = Shared<Group>;

/// Returns the index of a material; None: no material.
MaterialIndex material_or_none(const py::object& material) {
    return material.is_none() ? no_material : one_material(material);
}

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

/// Adds the shapes make(0), ..., make(count - 1) and returns their range as a tuple. In an
/// InvalidValue the field begins with the number of the shape.
template <class To, class Make>
py::tuple add_all(Shared<To>& shared, std::size_t count, const py::object& material,
                  const Make& make) {
    const py::object given = material.is_none()
                                 ? py::int_(no_material)
                                 : whole_numbers(material, "material", no_material - 1);
    const Values<MaterialIndex> materials(given, count, "material");
    return shared.numbers([&](To& to) {
        for (std::size_t i = 0; i < count; ++i) {
            try {
                to.add(make(i), materials[i]);
            } catch (const InvalidValue& error) {
                throw InvalidValue(std::to_string(i) + (error.field.empty() ? "" : "/") +
                                       error.field,
                                   error.expectation);
            }
        }
    });
}

MaterialIndex added(SceneBuilder& builder, const Material& material, const std::string& name) {
    try {
        return builder.add_material(material, name);
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

template <class To>
py::tuple add_spheres(Shared<To>& builder, const py::object& centers, const py::object& radii,
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
template <class To>
py::tuple add_ellipsoids(Shared<To>& builder, const py::object& centers, const py::object& axes,
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
template <class To>
py::tuple add_planes(Shared<To>& builder, const py::object& points, const py::object& normals,
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
template <class To>
py::tuple add_discs(Shared<To>& builder, const py::object& centers, const py::object& normals,
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
template <class To>
py::tuple add_triangles(Shared<To>& builder, const py::object& corners, const py::object& normals,
                        const py::object& material, bool polygon) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const std::size_t count = count_of({{corners, 2, "corners"}});
            const Rows<T> corner(corners, {3, 3}, "corners", count);
            const auto flat = [&](std::size_t i) {
                return TriangleOf<T>{corner.vector(i, 0), corner.vector(i, 3), corner.vector(i, 6)};
            };
            const auto add = [&](const auto& make) {
                if constexpr (std::is_same_v<To, SceneBuilder>)
                    if (polygon) {
                        const MaterialIndex of = material_or_none(material);
                        return builder.numbers([&](SceneBuilder& to) {
                            std::vector<decltype(make(0))> all;
                            for (std::size_t i = 0; i < count; ++i)
                                all.push_back(make(i));
                            to.add_polygon(all, of);
                        });
                    }
                return add_all(builder, count, material, make);
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
template <class To>
py::tuple add_boxes(Shared<To>& builder, const py::object& corners, const py::object& edges,
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
template <class To>
py::tuple add_cylinders(Shared<To>& builder, const py::object& bases, const py::object& axes,
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
template <class To>
py::tuple add_cones(Shared<To>& builder, const py::object& bases, const py::object& axes,
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
template <class To>
py::tuple add_quadrics(Shared<To>& builder, const py::object& centers,
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
                return quadric_of(center.vector(i), q, i, least.vector(i), most.vector(i));
            });
        },
        centers, coefficients, lower, upper);
}

/// The values that a builder sets rather than adds: camera, background, fog, settings, wavelengths.
class Surroundings {
  public:
    Surroundings(const py::object& camera, const py::object& background, const py::object& fog,
                 const py::object& settings, const py::object& wavelengths)
        : auto_camera_(auto_camera_from(camera)),
          camera_(camera.is_none() || auto_camera_ ? Camera() : camera_from(camera)),
          background_(color_from(background, "background")), fog_(fog_from(fog)),
          settings_(settings_from(settings)), wavelengths_(wavelengths_from(wavelengths)) {}

    void check() const {
        SceneBuilder builder;
        builder.add(Sphere{{}, 1.0F}); // an automatic camera needs a shape
        static_cast<void>(built(builder));
    }
    Scene built(SceneBuilder& builder) const {
        builder.camera = camera_;
        builder.auto_camera = auto_camera_;
        builder.background = background_;
        builder.fog = fog_;
        builder.settings = settings_;
        builder.wavelengths = wavelengths_;
        return builder.build();
    }

  private:
    std::optional<AutoCamera> auto_camera_;
    Camera camera_;
    Color background_;
    Fog fog_;
    Settings settings_;
    std::vector<double> wavelengths_;
};

template <class To>
py::tuple add_solid(Shared<To>& shared, const Solid& solid, const py::object& material) {
    const MaterialIndex of = material_or_none(material);
    return shared.numbers([&](To& to) { to.add(solid, of); });
}

template <class To>
py::tuple add_group(Shared<To>& shared, SharedGroup& group, const py::object& material) {
    const MaterialIndex of = material_or_none(material);
    const Group members = group.change([](const Group& all) { return all; });
    return shared.numbers([&](To& to) { to.add(members, of); });
}

py::tuple add_copies(SharedBuilder& builder, SharedGroup& group, const py::object& translate,
                     const py::object& rotate, const py::object& scale, const py::object& material,
                     const py::object& keep_from) {
    const std::size_t count =
        count_of({{translate, 1, "translate"}, {rotate, 1, "rotate"}, {scale, 0, "scale"}});
    const Rows<double> by(translate, {3}, "translate", count), angles(rotate, {3}, "rotate", count);
    const Values<double> factors(scale, count, "scale");
    const auto vectors = [](const Rows<double>& rows) {
        return std::array{rows.column(0), rows.column(1), rows.column(2)};
    };
    const auto [x, y, z] = vectors(by);
    const auto [about_x, about_y, about_z] = vectors(angles);
    std::vector<Placement> placements(count);
    for (std::size_t i = 0; i < count; ++i)
        placements[i] = {{x[i], y[i], z[i]}, {about_x[i], about_y[i], about_z[i]}, factors[i]};
    const MaterialIndex of = material_or_none(material);
    const Group members = group.change([](const Group& all) { return all; });
    const std::size_t keep = count_from(keep_from, "keep_from");
    return builder.numbers([&](SceneBuilder& to) {
        to.keep_from = keep;
        to.add(members, placements, of);
    });
}

py::tuple add_sphereflake(SharedBuilder& builder, const py::object& center,
                          const py::object& radius, const py::object& depth, const py::object& up,
                          const py::object& material) {
    const Sphereflake flake{vector_from(center, "center"), number_from(radius, "radius"),
                            int_from(depth, "depth"), vector_from(up, "up")};
    const MaterialIndex of = material_or_none(material);
    return builder.numbers([&](SceneBuilder& to) { to.add(flake, of); });
}

py::tuple add_lattice(SharedBuilder& builder, const py::object& n, const py::object& spacing,
                      const py::object& sphere_radius, const py::object& strut_radius,
                      const py::object& corner, const py::object& center,
                      const py::object& material, const py::object& strut_material) {
    if (corner.is_none() == center.is_none())
        throw InvalidValue("corner", "must be given, or center, but not both");
    Lattice lattice{{},
                    int_from(n, "n"),
                    number_from(spacing, "spacing"),
                    number_from(sphere_radius, "sphere_radius"),
                    number_from(strut_radius, "strut_radius")};
    const char* const place = corner.is_none() ? "center" : "corner";
    const Rows<double> at(corner.is_none() ? center : corner, {3}, place, 1);
    lattice.corner = at.vector(0);
    if (corner.is_none()) lattice = centered_at(lattice, at.vector(0));
    const MaterialIndex of = material_or_none(material),
                        of_struts = material_or_none(strut_material);
    return builder.numbers([&](SceneBuilder& to) { to.add(lattice, of, of_struts); });
}

/// Binds the functions that add objects to a builder or to a group.
template <class To>
void bind_adding(py::class_<Shared<To>>& shared) {
    shared.def(py::init())
        .def("add_solid", &add_solid<To>)
        .def("add_group", &add_group<To>)
        .def("add_spheres", &add_spheres<To>)
        .def("add_ellipsoids", &add_ellipsoids<To>)
        .def("add_planes", &add_planes<To>)
        .def("add_discs", &add_discs<To>)
        .def("add_triangles", &add_triangles<To>)
        .def("add_boxes", &add_boxes<To>)
        .def("add_cylinders", &add_cylinders<To>)
        .def("add_cones", &add_cones<To>)
        .def("add_quadrics", &add_quadrics<To>)
        .def("count",
             [](Shared<To>& of) { return of.change([](const To& to) { return count_in(to); }); });
}

} // namespace

void bind_builder(py::module_& module) {
    py::class_<SharedGroup> group(module, "Group");
    py::class_<SharedBuilder> builder(module, "Builder");
    bind_adding(group);
    bind_adding(builder);
    group
        .def("of",
             [](SharedGroup& of, const py::object& material) {
                 const MaterialIndex index = one_material(material);
                 return of.change([&](const Group& all) {
                     return std::unique_ptr<SharedGroup>(new SharedGroup{all.of(index)});
                 });
             })
        .def("transformed",
             [](SharedGroup& of, const Transform& transform) {
                 return of.change([&](const Group& all) {
                     return std::unique_ptr<SharedGroup>(
                         new SharedGroup{all.transformed(transform)});
                 });
             })
        .def("solid", [](SharedGroup& of) {
            return of.change([](const Group& all) { return solid_of(all); });
        });
    builder
        .def("add_material",
             [](SharedBuilder& to, const py::object& material, const std::string& name) {
                 const Material value = material_from(material);
                 return to.change([&](SceneBuilder& all) { return added(all, value, name); });
             })
        .def("add_copies", &add_copies)
        .def("add_sphereflake", &add_sphereflake)
        .def("add_lattice", &add_lattice)
        .def("add_light",
             [](SharedBuilder& to, const py::object& light) {
                 const Light value = light_from(light);
                 to.change([&](SceneBuilder& all) { all.add_light(value); });
             })
        .def("build",
             [](SharedBuilder& of, const py::object& camera, const py::object& background,
                const py::object& fog, const py::object& settings, const py::object& wavelengths,
                const py::object& merge_duplicates, const py::object& camera_lights) {
                 const Surroundings around(camera, background, fog, settings, wavelengths);
                 const bool merge = bool_from(merge_duplicates, "merge_duplicates");
                 const bool lights = bool_from(camera_lights, "camera_lights");
                 return of.change([&](SceneBuilder& whole) {
                     whole.merge_duplicates = merge;
                     whole.camera_lights = lights;
                     return around.built(whole);
                 });
             });
    // Throws the errors of build() for these values, before build() empties the builder.
    module.def("check",
               [](const py::object& camera, const py::object& background, const py::object& fog,
                  const py::object& settings, const py::object& wavelengths) {
                   const Surroundings around(camera, background, fog, settings, wavelengths);
                   const py::gil_scoped_release free;
                   around.check();
               });
}

} // namespace raylane::python
