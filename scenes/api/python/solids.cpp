#include "values.hpp"

#include <pybind11/stl.h>

namespace raylane::python {

namespace {

/// Returns three numbers as a vector of doubles, the type of all numbers in solids.
Vec3Of<double> vector_of(const py::object& values, const char* field) {
    const Rows<double> row(values, {3}, field, 1);
    return row.vector(0);
}
Solid with_material(const Solid& solid, const py::object& material) {
    return material.is_none() ? solid : solid.of(one_material(material));
}

double number_of(const py::object& value, const char* field) {
    return Values<double>(value, 1, field)[0];
}
std::array<double, 2> pair_of(const py::object& values, const char* field) {
    const Rows<double> row(values, {2}, field, 1);
    return {row.column(0)[0], row.column(1)[0]};
}

} // namespace

void bind_solids(py::module_& module) {
    py::class_<Solid>(module, "Solid")
        .def("of", [](const Solid& solid, const py::object& material) {
            return solid.of(one_material(material));
        });
    module.def("sphere_solid", [](const py::object& center, const py::object& radius,
                                  const py::object& material) {
        return with_material(
            SphereOf<double>{vector_of(center, "center"), number_of(radius, "radius")}, material);
    });
    module.def("half_space_solid", [](const py::object& point, const py::object& normal,
                                      const py::object& material) {
        return with_material(
            PlaneOf<double>{vector_of(point, "point"), vector_of(normal, "normal")}, material);
    });
    module.def("box_solid", [](const py::object& corner, const py::object& edges,
                               const py::object& material) {
        const Rows<double> edge(edges, {3, 3}, "edges", 1);
        return with_material(BoxOf<double>{vector_of(corner, "corner"), edge.vector(0, 0),
                                           edge.vector(0, 3), edge.vector(0, 6)},
                             material);
    });
    module.def("ellipsoid_solid", [](const py::object& center, const py::object& axes,
                                     const py::object& material) {
        const Rows<double> axis(axes, {3, 3}, "axes", 1);
        return with_material(EllipsoidOf<double>{vector_of(center, "center"), axis.vector(0, 0),
                                                 axis.vector(0, 3), axis.vector(0, 6)},
                             material);
    });
    module.def("cylinder_solid", [](const py::object& base, const py::object& axis,
                                    const py::object& radius, const py::object& material) {
        return with_material(CappedCylinderOf<double>{vector_of(base, "base"),
                                                      vector_of(axis, "axis"),
                                                      number_of(radius, "radius")},
                             material);
    });
    module.def("cone_solid", [](const py::object& base, const py::object& axis,
                                const py::object& base_radius, const py::object& top_radius,
                                const py::object& material) {
        return with_material(CappedConeOf<double>{vector_of(base, "base"), vector_of(axis, "axis"),
                                                  number_of(base_radius, "base_radius"),
                                                  number_of(top_radius, "top_radius")},
                             material);
    });
    module.def("lens_solid",
               [](const py::object& vertex, const py::object& axis, const py::object& radii,
                  const py::object& conics, const py::object& thickness, const py::object& radius,
                  const py::object& material) {
                   const auto [r1, r2] = pair_of(radii, "radii");
                   const auto [k1, k2] = pair_of(conics, "conics");
                   return with_material(solid_of(Lens{vector_of(vertex, "vertex"),
                                                      vector_of(axis, "axis"),
                                                      {r1, r2},
                                                      {k1, k2},
                                                      number_of(thickness, "thickness"),
                                                      number_of(radius, "radius")}),
                                        material);
               });
    module.def("union_of", &union_of);
    module.def("intersection_of", &intersection_of);
    module.def("difference_of", &difference_of);
    module.def("clipped", &clipped);
}

} // namespace raylane::python
