#include "values.hpp"

#include <limits>
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace raylane::python {

namespace {

/// True if all of them are arrays of float32.
template <class... Arrays>
bool are_floats(const Arrays&... arrays) {
    return (is_float(arrays) && ...);
}

/// Materials of shapes: one for all, or one for each.
class Materials {
  public:
    Materials(const py::object& material, std::size_t count)
        : values_(checked(material), count, "material") {}
    MaterialIndex operator[](std::size_t i) const {
        const std::int64_t index = values_[i];
        if (index < 0 || index > std::numeric_limits<MaterialIndex>::max())
            throw InvalidValue("material",
                               "must be the index of one, got " + std::to_string(index));
        return static_cast<MaterialIndex>(index);
    }

  private:
    static const py::object& checked(const py::object& material) {
        const py::array array = py::array::ensure(material);
        const char kind = array ? array.dtype().kind() : '?';
        if (kind != 'i' && kind != 'u')
            throw InvalidValue("material", "must be a whole number, or an array of them");
        return material;
    }
    Values<std::int64_t> values_;
};

MaterialIndex one_material(const py::object& material) {
    return Materials(material, 1)[0];
}

/// Adds what make(i) makes, and returns the ids: first, and behind the last. Of what is thrown, the
/// field says which shape it is.
template <class Make>
py::tuple add_all(SceneBuilder& builder, std::size_t count, const py::object& material,
                  const Make& make) {
    const Materials materials(material, count);
    const auto first = static_cast<ShapeId>(builder.shape_count());
    {
        const py::gil_scoped_release free;
        for (std::size_t i = 0; i < count; ++i) {
            try {
                builder.add(make(i), materials[i]);
            } catch (const InvalidValue& error) {
                throw InvalidValue(std::to_string(i) + (error.field.empty() ? "" : "/") +
                                       error.field,
                                   error.expectation);
            }
        }
    }
    return py::make_tuple(first, builder.shape_count());
}

/// Calls it with float or double, as the arrays have it.
template <class Call, class... Arrays>
py::tuple by_type(const Call& call, const Arrays&... arrays) {
    return are_floats(arrays...) ? call(std::type_identity<float>())
                                 : call(std::type_identity<double>());
}

py::tuple add_spheres(SceneBuilder& builder, const py::object& centers, const py::object& radii,
                      const py::object& material) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const Rows<T> center(centers, {3}, "centers");
            const Values<T> radius(radii, center.count(), "radii");
            const std::array columns = {center.column(0), center.column(1), center.column(2)};
            return add_all(builder, center.count(), material, [&](std::size_t i) {
                return SphereOf<T>{{columns[0][i], columns[1][i], columns[2][i]}, radius[i]};
            });
        },
        centers, radii);
}
py::tuple add_ellipsoids(SceneBuilder& builder, const py::object& centers, const py::object& axes,
                         const py::object& material) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const Rows<T> center(centers, {3}, "centers");
            const Rows<T> axis(axes, {3, 3}, "axes", center.count());
            return add_all(builder, center.count(), material, [&](std::size_t i) {
                return EllipsoidOf<T>{center.vector(i), axis.vector(i, 0), axis.vector(i, 3),
                                      axis.vector(i, 6)};
            });
        },
        centers, axes);
}
py::tuple add_planes(SceneBuilder& builder, const py::object& points, const py::object& normals,
                     const py::object& material) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const Rows<T> point(points, {3}, "points");
            const Rows<T> normal(normals, {3}, "normals", point.count());
            return add_all(builder, point.count(), material, [&](std::size_t i) {
                return PlaneOf<T>{point.vector(i), normal.vector(i)};
            });
        },
        points, normals);
}
py::tuple add_discs(SceneBuilder& builder, const py::object& centers, const py::object& normals,
                    const py::object& radii, const py::object& material) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const Rows<T> center(centers, {3}, "centers");
            const Rows<T> normal(normals, {3}, "normals", center.count());
            const Values<T> radius(radii, center.count(), "radii");
            return add_all(builder, center.count(), material, [&](std::size_t i) {
                return DiscOf<T>{center.vector(i), normal.vector(i), radius[i]};
            });
        },
        centers, normals, radii);
}
py::tuple add_triangles(SceneBuilder& builder, const py::object& corners, const py::object& normals,
                        const py::object& material, bool polygon) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const Rows<T> corner(corners, {3, 3}, "corners");
            const auto flat = [&](std::size_t i) {
                return TriangleOf<T>{corner.vector(i, 0), corner.vector(i, 3), corner.vector(i, 6)};
            };
            const auto add = [&](const auto& make) {
                if (!polygon) return add_all(builder, corner.count(), material, make);
                std::vector<decltype(make(0))> all;
                for (std::size_t i = 0; i < corner.count(); ++i)
                    all.push_back(make(i));
                const ShapeId first = builder.add_polygon(all, one_material(material));
                return py::make_tuple(first, builder.shape_count());
            };
            if (normals.is_none()) return add(flat);
            const Rows<T> normal(normals, {3, 3}, "normals", corner.count());
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
py::tuple add_boxes(SceneBuilder& builder, const py::object& corners, const py::object& edges,
                    const py::object& material) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const Rows<T> corner(corners, {3}, "corners");
            const Rows<T> edge(edges, {3, 3}, "edges", corner.count());
            return add_all(builder, corner.count(), material, [&](std::size_t i) {
                return BoxOf<T>{corner.vector(i), edge.vector(i, 0), edge.vector(i, 3),
                                edge.vector(i, 6)};
            });
        },
        corners, edges);
}
py::tuple add_cylinders(SceneBuilder& builder, const py::object& bases, const py::object& axes,
                        const py::object& radii, const py::object& material, bool caps) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const Rows<T> base(bases, {3}, "bases");
            const Rows<T> axis(axes, {3}, "axes", base.count());
            const Values<T> radius(radii, base.count(), "radii");
            const auto add = [&]<class Shape>(std::type_identity<Shape>) {
                return add_all(builder, base.count(), material, [&](std::size_t i) {
                    return Shape{base.vector(i), axis.vector(i), radius[i]};
                });
            };
            return caps ? add(std::type_identity<CappedCylinderOf<T>>())
                        : add(std::type_identity<OpenCylinderOf<T>>());
        },
        bases, axes, radii);
}
py::tuple add_cones(SceneBuilder& builder, const py::object& bases, const py::object& axes,
                    const py::object& base_radii, const py::object& top_radii,
                    const py::object& material, bool caps) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const Rows<T> base(bases, {3}, "bases");
            const Rows<T> axis(axes, {3}, "axes", base.count());
            const Values<T> lower(base_radii, base.count(), "base_radii");
            const Values<T> upper(top_radii, base.count(), "top_radii");
            const auto add = [&]<class Shape>(std::type_identity<Shape>) {
                return add_all(builder, base.count(), material, [&](std::size_t i) {
                    return Shape{base.vector(i), axis.vector(i), lower[i], upper[i]};
                });
            };
            return caps ? add(std::type_identity<CappedConeOf<T>>())
                        : add(std::type_identity<OpenConeOf<T>>());
        },
        bases, axes, base_radii, top_radii);
}
py::tuple add_quadrics(SceneBuilder& builder, const py::object& centers,
                       const py::object& coefficients, const py::object& lower,
                       const py::object& upper, const py::object& material) {
    return by_type(
        [&]<class T>(std::type_identity<T>) {
            const Rows<T> center(centers, {3}, "centers");
            const Rows<T> q(coefficients, {10}, "coefficients", center.count());
            const Rows<T> least(lower, {3}, "lower", center.count());
            const Rows<T> most(upper, {3}, "upper", center.count());
            return add_all(builder, center.count(), material, [&](std::size_t i) {
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

/// A vector of doubles, as solids are made of.
Vec3Of<double> vector_of(const py::object& values, const char* field) {
    const Rows<double> row(values, {3}, field, 1);
    return row.vector(0);
}
Solid with_material(const Solid& solid, const py::object& material) {
    return material.is_none() ? solid : solid.of(one_material(material));
}

/// By reference: the library may copy it, without the lock that counting references takes.
OnRemark remarks_to(const py::object& on_remark) {
    return [&on_remark](const std::string& text) {
        const py::gil_scoped_acquire lock;
        on_remark(text);
    };
}

py::tuple exactly(const Vec3& v) {
    return py::make_tuple(v.x, v.y, v.z);
}

template <class Call>
py::object for_each_shape(const py::object& shapes, const Call& call) {
    if (py::isinstance<py::int_>(shapes)) return py::int_(call(py::cast<ShapeId>(shapes)));
    const py::array array = py::array::ensure(shapes);
    const char kind = array ? array.dtype().kind() : '?';
    if (kind != 'i' && kind != 'u') throw InvalidValue("shapes", "must be ids of shapes");
    const auto ids =
        py::array_t<ShapeId, py::array::c_style | py::array::forcecast>::ensure(shapes);
    py::array_t<std::uint32_t> result(
        std::vector<py::ssize_t>(ids.shape(), ids.shape() + ids.ndim()));
    std::transform(ids.data(), ids.data() + ids.size(), result.mutable_data(), call);
    return result;
}

} // namespace

void bind_scene(py::module_& module) {
    py::class_<Solid>(module, "Solid").def("of", [](const Solid& solid, MaterialIndex material) {
        return solid.of(material);
    });
    module.def(
        "sphere_solid", [](const py::object& center, double radius, const py::object& material) {
            return with_material(SphereOf<double>{vector_of(center, "center"), radius}, material);
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
    module.def("cylinder_solid", [](const py::object& base, const py::object& axis, double radius,
                                    const py::object& material) {
        return with_material(
            CappedCylinderOf<double>{vector_of(base, "base"), vector_of(axis, "axis"), radius},
            material);
    });
    module.def("cone_solid", [](const py::object& base, const py::object& axis, double base_radius,
                                double top_radius, const py::object& material) {
        return with_material(CappedConeOf<double>{vector_of(base, "base"), vector_of(axis, "axis"),
                                                  base_radius, top_radius},
                             material);
    });
    module.def("lens_solid", [](const py::object& vertex, const py::object& axis,
                                std::array<double, 2> radii, std::array<double, 2> conics,
                                double thickness, double radius, const py::object& material) {
        return with_material(solid_of(Lens{vector_of(vertex, "vertex"),
                                           vector_of(axis, "axis"),
                                           {radii[0], radii[1]},
                                           {conics[0], conics[1]},
                                           thickness,
                                           radius}),
                             material);
    });
    module.def("union_of", &union_of);
    module.def("intersection_of", &intersection_of);
    module.def("difference_of", &difference_of);
    module.def("clipped", &clipped);

    py::class_<SceneBuilder>(module, "Builder")
        .def(py::init())
        .def("add_material",
             [](SceneBuilder& builder, const py::object& material) {
                 return builder.add_material(material_from(material));
             })
        .def("add_light", [](SceneBuilder& builder,
                             const py::object& light) { builder.add_light(light_from(light)); })
        .def("add_solid",
             [](SceneBuilder& builder, const Solid& solid, MaterialIndex material) {
                 const ShapeId first = builder.add(solid, material);
                 return py::make_tuple(first, builder.shape_count());
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
        .def("shape_count", &SceneBuilder::shape_count)
        .def("build", [](SceneBuilder& builder, const py::object& camera,
                         const py::object& background, const py::object& fog,
                         const py::object& settings, const std::vector<double>& wavelengths) {
            builder.camera = camera_from(camera);
            builder.background = color_from(background, "background");
            builder.fog = fog_from(fog);
            builder.settings = settings_from(settings);
            builder.wavelengths = wavelengths;
            const py::gil_scoped_release free;
            return builder.build();
        });

    py::class_<Scene>(module, "Scene")
        .def("shape_count", &Scene::shape_count)
        .def("material_count", &Scene::material_count)
        .def("bounds",
             [](const Scene& scene) {
                 const Bounds bounds = scene.bounds();
                 return py::make_tuple(exactly(bounds.lower), exactly(bounds.upper));
             })
        .def("material_of",
             [](const Scene& scene, const py::object& shapes) {
                 return for_each_shape(shapes, [&](ShapeId id) { return scene.material_of(id); });
             })
        .def("solid_of",
             [](const Scene& scene, const py::object& shapes) {
                 return for_each_shape(shapes, [&](ShapeId id) { return scene.solid_of(id); });
             })
        .def("material", [](const Scene& scene,
                            MaterialIndex index) { return to_python(scene.material(index)); })
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
}

} // namespace raylane::python
