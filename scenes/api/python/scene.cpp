#include "values.hpp"

#include <algorithm>
#include <limits>
#include <pybind11/functional.h>
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
        .def("material",
             [](const Scene& scene, const py::object& index) {
                 const MaterialIndex of = one_material(index, "index");
                 try {
                     return to_python(scene.material(of));
                 } catch (const InvalidValue& error) {
                     throw InvalidValue("index", error.expectation);
                 }
             })
        .def("lights",
             [](const Scene& scene) {
                 py::list all;
                 for (const Light& light : scene.lights())
                     all.append(to_python(light));
                 return all;
             })
        .def("fog", [](const Scene& scene) { return to_python(scene.fog()); })
        .def("camera", [](const Scene& scene) { return to_python(scene.camera()); })
        .def("background", [](const Scene& scene) { return to_python(scene.background()); })
        .def("settings", [](const Scene& scene) { return to_python(scene.settings()); });

    module.def("load", [](const std::filesystem::path& path, const py::object& on_remark) {
        const OnRemark remarks = remarks_to(on_remark);
        const py::gil_scoped_release free;
        return load(path, remarks);
    });
    module.def("parse",
               [](const py::bytes& text, const std::string& name, const py::object& on_remark) {
                   const OnRemark remarks = remarks_to(on_remark);
                   const std::string_view view = text;
                   const py::gil_scoped_release free;
                   return parse(view, name, remarks);
               });
    module.def("parse_atoms", [](const py::bytes& text, const std::string& name, bool show_cell) {
        const std::string_view view = text;
        const py::gil_scoped_release free;
        return raylane::parse_atoms(view, name, show_cell);
    });
    module.def("save", [](const Scene& scene, const std::filesystem::path& path,
                          const py::object& on_remark) {
        const OnRemark remarks = remarks_to(on_remark);
        const py::gil_scoped_release free;
        save(scene, path, remarks);
    });
}

} // namespace raylane::python
