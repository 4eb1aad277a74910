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

/// Returns one number for all axes, or one for each.
Transform scaled(const Transform& transform, const py::object& by) {
    if (any_array(by, "scale").ndim() == 0) return transform.scaled(number_of(by, "scale"));
    return transform.scaled(vector_of(by, "scale"));
}

void bind_transform(py::module_& module) {
    py::class_<Transform>(module, "Transform")
        .def(py::init())
        .def("scaled", &scaled)
        .def("rotated",
             [](const Transform& transform, const py::object& degrees) {
                 return transform.rotated(vector_of(degrees, "rotate"));
             })
        .def("translated",
             [](const Transform& transform, const py::object& by) {
                 return transform.translated(vector_of(by, "translate"));
             })
        .def("then", &Transform::then);
    module.def("transform_of", [](const py::object& matrix) {
        const Rows<double> rows(matrix, {3, 4}, "transform", 1);
        std::array<std::array<double, 4>, 3> numbers;
        for (std::size_t i = 0; i < 12; ++i)
            numbers[i / 4][i % 4] = rows.column(i)[0];
        return Transform(numbers);
    });
}

} // namespace

void bind_solids(py::module_& module) {
    py::class_<Solid>(module, "Solid")
        .def("of", [](const Solid& solid,
                      const py::object& material) { return solid.of(one_material(material)); })
        .def("transformed", &Solid::transformed);
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
    module.def("refuse_masked", &refuse_masked);
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
                                    const py::object& radius, const py::object& material,
                                    const py::object& caps) {
        const CappedCylinderOf<double> capped{vector_of(base, "base"), vector_of(axis, "axis"),
                                              number_of(radius, "radius")};
        const OpenCylinderOf<double> open{capped.base, capped.axis, capped.radius};
        return with_material(bool_from(caps, "caps") ? Solid(capped) : Solid(open), material);
    });
    module.def("cone_solid", [](const py::object& base, const py::object& axis,
                                const py::object& base_radius, const py::object& top_radius,
                                const py::object& material, const py::object& caps) {
        const CappedConeOf<double> capped{vector_of(base, "base"), vector_of(axis, "axis"),
                                          number_of(base_radius, "base_radius"),
                                          number_of(top_radius, "top_radius")};
        const OpenConeOf<double> open{capped.base, capped.axis, capped.base_radius,
                                      capped.top_radius};
        return with_material(bool_from(caps, "caps") ? Solid(capped) : Solid(open), material);
    });
    module.def("quadric_solid", [](const py::object& center, const py::object& coefficients,
                                   const py::object& material) {
        const Rows<double> q(coefficients, {10}, "coefficients", 1);
        const auto at = [&](std::size_t k) { return q.column(k)[0]; };
        return with_material(QuadricOf<double>{vector_of(center, "center"),
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
                                               {},
                                               {}},
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
    module.def("unite", [](const Solid& a, const Solid& b) { return a | b; });
    module.def("intersect", [](const Solid& a, const Solid& b) { return a & b; });
    module.def("subtract", [](const Solid& a, const Solid& b) { return a - b; });
    bind_transform(module);
}

} // namespace raylane::python
