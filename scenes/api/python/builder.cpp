#include "broadcast.hpp"
#include "values.hpp"

#include <algorithm>
#include <array>
#include <bit>
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
        const Range range = change([&](To& target) {
            const std::size_t first = count_in(target);
            add(target);
            return Range(first, count_in(target));
        });
        return py::make_tuple(range.first, range.second);
    }
};
using SharedBuilder = Shared<SceneBuilder>;
using SharedGroup = Shared<Group>;

/// Returns a group as Python holds it.
std::unique_ptr<SharedGroup> shared(Group group) {
    auto made = std::make_unique<SharedGroup>();
    made->to = std::move(group);
    return made;
}

/// Returns the index of a material; None: no material.
MaterialIndex material_or_none(const py::object& material) {
    return material.is_none() ? no_material : one_material(material);
}

/// An argument of a function that adds shapes. `row`: the axes of a single shape's value.
struct Argument {
    const py::object& values;
    Axes row;
    const char* name;
};
using Arguments = std::vector<Argument>;

/// Returns the number of shapes: the rows of the first argument with more axes than a single
/// shape's value, or 1 if no argument has more.
std::size_t count_of_shapes(const Arguments& columns) {
    for (const Argument& each : columns) {
        const py::array array = any_array(each.values, each.name);
        if (array.ndim() > static_cast<py::ssize_t>(each.row.size()))
            return static_cast<std::size_t>(array.shape(0));
    }
    return 1;
}

/// Shapes with the numbers of arguments, which a struct holds one after the other.
template <class Shape, class T>
class ShapeRows {
  public:
    ShapeRows(const Arguments& arguments, std::size_t count) {
        std::size_t next = 0;
        for (const Argument& each : arguments) {
            if (each.row.empty()) {
                values_.emplace_back(each.values, count, each.name);
                columns_[next++] = values_.back().column();
                continue;
            }
            rows_.emplace_back(each.values, each.row, each.name, count);
            const std::size_t end = next + static_cast<std::size_t>(count_of(each.row));
            for (std::size_t number = 0; next < end; ++next, ++number)
                columns_[next] = rows_.back().column(number);
        }
    }
    Shape operator()(std::size_t i) const {
        std::array<T, size> numbers;
        for (std::size_t number = 0; number < size; ++number)
            numbers[number] = columns_[number][i];
        return std::bit_cast<Shape>(numbers);
    }

  private:
    static constexpr std::size_t size = sizeof(Shape) / sizeof(T);
    std::vector<Rows<T>> rows_;
    std::vector<Values<T>> values_;
    std::array<Column<T>, size> columns_;
};

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

/// Calls `call` with the type float if all arguments are of float32, otherwise with double.
template <class Call>
py::tuple by_type(const Arguments& arguments, const Call& call) {
    const bool floats = std::all_of(arguments.begin(), arguments.end(),
                                    [](const Argument& each) { return is_float(each.values); });
    return floats ? call(std::type_identity<float>()) : call(std::type_identity<double>());
}

/// Adds shapes with the numbers of arguments.
template <template <class> class Shape, class To>
py::tuple add_shapes(Shared<To>& to, const py::object& material, const Arguments& arguments) {
    return by_type(arguments, [&]<class T>(std::type_identity<T>) {
        const std::size_t count = count_of_shapes(arguments);
        return add_all(to, count, material, ShapeRows<Shape<T>, T>(arguments, count));
    });
}

template <class To>
py::tuple add_spheres(Shared<To>& to, const py::object& centers, const py::object& radii,
                      const py::object& material) {
    return add_shapes<SphereOf>(to, material, {{centers, {3}, "centers"}, {radii, {}, "radii"}});
}
template <class To>
py::tuple add_ellipsoids(Shared<To>& to, const py::object& centers, const py::object& axes,
                         const py::object& material) {
    return add_shapes<EllipsoidOf>(to, material,
                                   {{centers, {3}, "centers"}, {axes, {3, 3}, "axes"}});
}
template <class To>
py::tuple add_planes(Shared<To>& to, const py::object& points, const py::object& normals,
                     const py::object& material) {
    return add_shapes<PlaneOf>(to, material, {{points, {3}, "points"}, {normals, {3}, "normals"}});
}
template <class To>
py::tuple add_discs(Shared<To>& to, const py::object& centers, const py::object& normals,
                    const py::object& radii, const py::object& material) {
    return add_shapes<DiscOf>(
        to, material, {{centers, {3}, "centers"}, {normals, {3}, "normals"}, {radii, {}, "radii"}});
}
template <class To>
py::tuple add_boxes(Shared<To>& to, const py::object& corners, const py::object& edges,
                    const py::object& material) {
    return add_shapes<BoxOf>(to, material, {{corners, {3}, "corners"}, {edges, {3, 3}, "edges"}});
}
template <class To>
py::tuple add_cylinders(Shared<To>& to, const py::object& bases, const py::object& axes,
                        const py::object& radii, const py::object& material,
                        const py::object& with_caps) {
    const Arguments columns = {{bases, {3}, "bases"}, {axes, {3}, "axes"}, {radii, {}, "radii"}};
    return bool_from(with_caps, "caps") ? add_shapes<CappedCylinderOf>(to, material, columns)
                                        : add_shapes<OpenCylinderOf>(to, material, columns);
}
template <class To>
py::tuple add_cones(Shared<To>& to, const py::object& bases, const py::object& axes,
                    const py::object& base_radii, const py::object& top_radii,
                    const py::object& material, const py::object& with_caps) {
    const Arguments columns = {{bases, {3}, "bases"},
                               {axes, {3}, "axes"},
                               {base_radii, {}, "base_radii"},
                               {top_radii, {}, "top_radii"}};
    return bool_from(with_caps, "caps") ? add_shapes<CappedConeOf>(to, material, columns)
                                        : add_shapes<OpenConeOf>(to, material, columns);
}
template <class To>
py::tuple add_triangles(Shared<To>& to, const py::object& corners, const py::object& normals,
                        const py::object& material, bool polygon) {
    Arguments columns = {{corners, {3, 3}, "corners"}};
    const std::size_t count = count_of_shapes(columns);
    const auto add = [&](const auto& make) {
        if constexpr (std::is_same_v<To, SceneBuilder>)
            if (polygon) {
                const MaterialIndex material_index = material_or_none(material);
                return to.numbers([&](SceneBuilder& builder) {
                    std::vector<decltype(make(0))> triangles;
                    for (std::size_t i = 0; i < count; ++i)
                        triangles.push_back(make(i));
                    builder.add_polygon(triangles, material_index);
                });
            }
        return add_all(to, count, material, make);
    };
    if (!normals.is_none()) columns.push_back({normals, {3, 3}, "normals"});
    return by_type(columns, [&]<class T>(std::type_identity<T>) {
        return normals.is_none() ? add(ShapeRows<TriangleOf<T>, T>(columns, count))
                                 : add(ShapeRows<SmoothTriangleOf<T>, T>(columns, count));
    });
}
template <class To>
py::tuple add_quadrics(Shared<To>& to, const py::object& centers, const py::object& coefficients,
                       const py::object& lower, const py::object& upper,
                       const py::object& material) {
    return add_shapes<QuadricOf>(to, material,
                                 {{centers, {3}, "centers"},
                                  {coefficients, {10}, "coefficients"},
                                  {lower, {3}, "lower"},
                                  {upper, {3}, "upper"}});
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
    const MaterialIndex material_index = material_or_none(material);
    return shared.numbers([&](To& to) { to.add(solid, material_index); });
}

template <class To>
py::tuple add_group(Shared<To>& shared, SharedGroup& group, const py::object& material) {
    const MaterialIndex material_index = material_or_none(material);
    const Group members = group.change([](const Group& shapes) { return shapes; });
    return shared.numbers([&](To& to) { to.add(members, material_index); });
}

py::tuple add_copies(SharedBuilder& builder, SharedGroup& group, const py::object& translate,
                     const py::object& rotate, const py::object& scale, const py::object& material,
                     const py::object& keep_from) {
    const Arguments arguments = {
        {translate, {3}, "translate"}, {rotate, {3}, "rotate"}, {scale, {}, "scale"}};
    const std::size_t count = count_of_shapes(arguments);
    const ShapeRows<Placement, double> rows(arguments, count);
    std::vector<Placement> placements(count);
    for (std::size_t i = 0; i < count; ++i)
        placements[i] = rows(i);
    const MaterialIndex material_index = material_or_none(material);
    const Group members = group.change([](const Group& shapes) { return shapes; });
    const std::size_t keep = count_from(keep_from, "keep_from");
    return builder.numbers([&](SceneBuilder& to) {
        to.keep_from = keep;
        to.add(members, placements, material_index);
    });
}

py::tuple add_sphereflake(SharedBuilder& builder, const py::object& center,
                          const py::object& radius, const py::object& depth, const py::object& up,
                          const py::object& material) {
    const Sphereflake flake{vector_from(center, "center"), number_from(radius, "radius"),
                            int_from(depth, "depth"), vector_from(up, "up")};
    const MaterialIndex material_index = material_or_none(material);
    return builder.numbers([&](SceneBuilder& to) { to.add(flake, material_index); });
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
    const MaterialIndex material_index = material_or_none(material),
                        of_struts = material_or_none(strut_material);
    return builder.numbers([&](SceneBuilder& to) { to.add(lattice, material_index, of_struts); });
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
        .def("count", [](Shared<To>& counted) {
            return counted.change([](const To& to) { return count_in(to); });
        });
}

} // namespace

void bind_builder(py::module_& module) {
    py::class_<SharedGroup> group(module, "Group");
    py::class_<SharedBuilder> builder(module, "Builder");
    bind_adding(group);
    bind_adding(builder);
    group
        .def("of",
             [](SharedGroup& shared_group, const py::object& material) {
                 const MaterialIndex index = one_material(material);
                 return shared_group.change(
                     [&](const Group& shapes) { return shared(shapes.of(index)); });
             })
        .def("transformed",
             [](SharedGroup& shared_group, const Transform& transform) {
                 return shared_group.change(
                     [&](const Group& shapes) { return shared(shapes.transformed(transform)); });
             })
        .def("solid", [](SharedGroup& shared_group) {
            return shared_group.change([](const Group& shapes) { return solid_of(shapes); });
        });
    builder
        .def("add_material",
             [](SharedBuilder& to, const py::object& material, const std::string& name) {
                 const Material value = material_from(material);
                 return to.change([&](SceneBuilder& target) { return added(target, value, name); });
             })
        .def("add_copies", &add_copies)
        .def("add_sphereflake", &add_sphereflake)
        .def("add_lattice", &add_lattice)
        .def("add_light",
             [](SharedBuilder& to, const py::object& light) {
                 const Light value = light_from(light);
                 to.change([&](SceneBuilder& target) { target.add_light(value); });
             })
        .def("build", [](SharedBuilder& shared_builder, const py::object& camera,
                         const py::object& background, const py::object& fog,
                         const py::object& settings, const py::object& wavelengths,
                         const py::object& merge_duplicates, const py::object& camera_lights) {
            const Surroundings around(camera, background, fog, settings, wavelengths);
            const bool merge = bool_from(merge_duplicates, "merge_duplicates");
            const bool lights = bool_from(camera_lights, "camera_lights");
            return shared_builder.change([&](SceneBuilder& to) {
                to.merge_duplicates = merge;
                to.camera_lights = lights;
                return around.built(to);
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
