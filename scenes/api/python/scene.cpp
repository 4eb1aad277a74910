#include "values.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace raylane::python {

namespace {

/// Returns a callback that calls a Python function. It holds the function by reference: the library
/// may copy the callback without Python's lock, which a change of the reference count would need.
OnRemark remarks_to(const py::object& on_remark) {
    return [&on_remark](const std::string& text) {
        const py::gil_scoped_acquire lock;
        on_remark(text);
    };
}

py::tuple exactly(const Vec3& v) {
    return py::make_tuple(v.x, v.y, v.z);
}

/// Calls `call` for one shape id, or for each of an array of ids. Returns an int or an array.
template <class Result, class Call>
py::object for_each_shape(const py::object& shapes, const Call& call) {
    constexpr ShapeId most = std::numeric_limits<ShapeId>::max();
    const py::array_t<ShapeId, py::array::c_style> ids(whole_numbers(shapes, "shapes", most));
    py::array_t<Result> result(axes_of(ids));
    try {
        std::transform(ids.data(), ids.data() + ids.size(), result.mutable_data(), call);
    } catch (const InvalidValue& error) {
        throw InvalidValue("shapes", error.expectation);
    }
    if (ids.ndim() == 0 && !py::isinstance<py::array>(shapes)) return py::int_(result.data()[0]);
    return result;
}

template <class Number>
Scene with_positions(const Scene& scene, const py::object& positions) {
    const Rows<Number> checked(positions, {3}, "positions");
    const py::array_t<Number, py::array::c_style | py::array::forcecast> rows(
        converted(positions, "positions"));
    const std::span centers(reinterpret_cast<const Vec3Of<Number>*>(rows.data()), checked.count());
    const py::gil_scoped_release free;
    return scene.with_positions(centers);
}

/// Returns shapes as an array of their numbers, (n, k): of float32 if all of them are floats,
/// otherwise of float64.
template <class Shape>
py::array numbers_of(const std::vector<Shape>& shapes) {
    constexpr std::size_t width = sizeof(Shape) / sizeof(double);
    const std::span numbers(reinterpret_cast<const double*>(shapes.data()), width * shapes.size());
    const auto stored = [&]<class Number>(std::type_identity<Number>) -> py::array {
        py::array_t<Number> array(Axes{static_cast<py::ssize_t>(shapes.size()), width});
        std::ranges::transform(numbers, array.mutable_data(),
                               [](double number) { return static_cast<Number>(number); });
        return array;
    };
    const bool are_floats = std::ranges::all_of(
        numbers, [](double number) { return double(static_cast<float>(number)) == number; });
    return are_floats ? stored(std::type_identity<float>()) : stored(std::type_identity<double>());
}

/// Returns the ids, material indices and numbers of all shapes of a type.
template <template <class> class ShapeOf>
py::tuple shapes_of(const Scene& scene) {
    ShapesOf<ShapeOf<double>> shapes = [&] {
        const py::gil_scoped_release free;
        return scene.shapes<ShapeOf>();
    }();
    const py::array numbers = numbers_of(shapes.shape);
    return py::make_tuple(array_from(std::move(shapes.id)), array_from(std::move(shapes.material)),
                          numbers);
}

/// The types of shapes in the order of ShapeVariant, by the names of raylane/_shapes.py.
struct ShapeType {
    const char* name;
    py::tuple (*shapes)(const Scene&);
};
constexpr ShapeType shape_types[] = {{"sphere", &shapes_of<SphereOf>},
                                     {"plane", &shapes_of<PlaneOf>},
                                     {"disc", &shapes_of<DiscOf>},
                                     {"triangle", &shapes_of<TriangleOf>},
                                     {"smooth triangle", &shapes_of<SmoothTriangleOf>},
                                     {"box", &shapes_of<BoxOf>},
                                     {"open cylinder", &shapes_of<OpenCylinderOf>},
                                     {"capped cylinder", &shapes_of<CappedCylinderOf>},
                                     {"open cone", &shapes_of<OpenConeOf>},
                                     {"capped cone", &shapes_of<CappedConeOf>},
                                     {"quadric", &shapes_of<QuadricOf>},
                                     {"ellipsoid", &shapes_of<EllipsoidOf>}};
static_assert(std::size(shape_types) == std::variant_size_v<ShapeVariant>);

py::tuple shapes_of_type(const Scene& scene, const std::string& name) {
    return std::ranges::find(shape_types, name, &ShapeType::name)->shapes(scene);
}

/// Returns the type's name and the numbers, (1, k), of one shape.
py::tuple one_shape(const Scene& scene, const py::object& id) {
    const std::size_t number = count_from(id, "id");
    try {
        const ShapeVariant shape =
            scene.shape(static_cast<ShapeId>(std::min(number, std::size_t{no_shape})));
        const py::array numbers = std::visit(
            []<class Shape>(const Shape& value) { return numbers_of(std::vector<Shape>{value}); },
            shape);
        return py::make_tuple(shape_types[shape.index()].name, numbers);
    } catch (const InvalidValue& error) {
        throw InvalidValue("id", error.expectation);
    }
}

/// Returns the origins and directions of an image's rays, each (3, height, width).
py::tuple rays_of(const py::object& camera, const py::object& width, const py::object& height) {
    const Camera from = camera_from(camera);
    const int columns = int_from(width, "width"), rows = int_from(height, "height");
    PixelRays rays = [&] {
        const py::gil_scoped_release free;
        return camera_rays(from, columns, rows);
    }();
    const Axes planes{3, rows, columns};
    return py::make_tuple(array_from(std::move(rays.origins)).reshape(planes),
                          array_from(std::move(rays.directions)).reshape(planes));
}

} // namespace

void bind_scene(py::module_& module) {
    py::class_<Scene>(module, "Scene")
        .def("shape_count", &Scene::shape_count)
        .def("material_count", &Scene::material_count)
        .def("seen_by",
             [](const Scene& scene, const py::object& camera) {
                 const Camera other = camera_from(camera);
                 const py::gil_scoped_release free;
                 return scene.seen_by(other);
             })
        .def("with_positions",
             [](const Scene& scene, const py::object& positions) {
                 return is_float(positions) ? with_positions<float>(scene, positions)
                                            : with_positions<double>(scene, positions);
             })
        .def("camera_on_all",
             [](const Scene& scene, const py::object& direction, const py::object& aspect) {
                 const Vec3 way = color_from(direction, "direction");
                 const float ratio = number_from(aspect, "aspect");
                 const Camera found = [&] {
                     const py::gil_scoped_release free;
                     return scene.camera_on_all(way, ratio);
                 }();
                 return to_python(found);
             })
        .def("bounds",
             [](const Scene& scene) {
                 const Bounds bounds = scene.bounds();
                 return py::make_tuple(exactly(bounds.lower), exactly(bounds.upper));
             })
        .def("material_of",
             [](const Scene& scene, const py::object& shapes) {
                 return for_each_shape<std::int64_t>(shapes, [&](ShapeId id) {
                     return id == no_shape ? -1 : std::int64_t{scene.material_of(id)};
                 });
             })
        .def("solid_of",
             [](const Scene& scene, const py::object& shapes) {
                 return for_each_shape<ShapeId>(
                     shapes, [&](ShapeId id) { return id == no_shape ? id : scene.solid_of(id); });
             })
        .def("shape", &one_shape)
        .def("shapes", &shapes_of_type)
        .def("material",
             [](const Scene& scene, const py::object& index) {
                 const MaterialIndex material = one_material(index, "index");
                 try {
                     return to_python(scene.material(material));
                 } catch (const InvalidValue& error) {
                     throw InvalidValue("index", error.expectation);
                 }
             })
        .def("material_name",
             [](const Scene& scene, const py::object& index) {
                 return scene.material_name(one_material(index, "index"));
             })
        .def("lights",
             [](const Scene& scene) {
                 py::list list;
                 for (const Light& light : scene.lights())
                     list.append(to_python(light));
                 return list;
             })
        .def("fog", [](const Scene& scene) { return to_python(scene.fog()); })
        .def("camera", [](const Scene& scene) { return to_python(scene.camera()); })
        .def("background", [](const Scene& scene) { return to_python(scene.background()); })
        .def("settings", [](const Scene& scene) { return to_python(scene.settings()); });

    module.def("camera_rays", &rays_of);
    module.def("load", [](const std::filesystem::path& path, const AtomOptions& options,
                          const py::object& on_remark) {
        const OnRemark remarks = remarks_to(on_remark);
        const py::gil_scoped_release free;
        return load_atoms(path, options, remarks);
    });
    module.def("parse",
               [](const py::bytes& text, const std::string& name, const py::object& on_remark) {
                   const OnRemark remarks = remarks_to(on_remark);
                   const std::string_view view = text;
                   const py::gil_scoped_release free;
                   return parse(view, name, remarks);
               });
    module.def("parse_atoms", [](const py::bytes& text, const std::string& name,
                                 const AtomOptions& options, const py::object& on_remark) {
        const OnRemark remarks = remarks_to(on_remark);
        const std::string_view view = text;
        const py::gil_scoped_release free;
        return raylane::parse_atoms(view, name, options, remarks);
    });
    module.def("material_preset",
               [](const std::string& name) { return to_python(material_preset(name)); });
    module.def("catalogue_glass",
               [](const std::string& name) { return to_python(catalogue_glass(name)); });
    module.def("save", [](const Scene& scene, const std::filesystem::path& path,
                          const py::object& on_remark) {
        const OnRemark remarks = remarks_to(on_remark);
        const py::gil_scoped_release free;
        save(scene, path, remarks);
    });
}

} // namespace raylane::python
