#include "calls.hpp"
#include "values.hpp"

#include <bit>
#include <string>
#include <vector>

using namespace raylane;
using namespace raylane::c;

namespace {

/// Adds shapes. CShape and Shape hold the same numbers in the same order.
template <class Shape, class CShape>
raylane_status add(raylane_builder* builder, const CShape* shapes, std::size_t count,
                   std::uint32_t material, std::uint32_t* first) noexcept {
    return guarded([&] {
        SceneBuilder& to = checked("builder", builder).builder;
        if (count != 0) static_cast<void>(checked("shapes", shapes));
        if (first != nullptr) *first = static_cast<std::uint32_t>(to.shape_count());
        add_all("shapes", shapes, count,
                [&](const CShape& shape) { to.add(std::bit_cast<Shape>(shape), material); });
    });
}

template <class Shape, class CShape>
raylane_status add_polygon(raylane_builder* builder, const CShape* triangles, std::size_t count,
                           std::uint32_t material, std::uint32_t* first) noexcept {
    return added(builder, first, [&](SceneBuilder& to) {
        std::vector<Shape> converted;
        for (const CShape& triangle : span_of("triangles", triangles, count))
            converted.push_back(std::bit_cast<Shape>(triangle));
        return to.add_polygon(converted, material);
    });
}

} // namespace

raylane_material raylane_default_material(void) {
    return converted<raylane_material>(Material{});
}
raylane_light raylane_default_light(void) {
    return converted<raylane_light>(Light{});
}
raylane_fog raylane_default_fog(void) {
    return converted<raylane_fog>(Fog{});
}
raylane_camera raylane_default_camera(void) {
    return converted<raylane_camera>(Camera{});
}
raylane_settings raylane_default_settings(void) {
    return converted<raylane_settings>(Settings{});
}

raylane_status raylane_builder_create(raylane_builder** builder) {
    return guarded([&] {
        raylane_builder*& to = checked("builder", builder);
        to = nullptr;
        to = new raylane_builder;
    });
}

void raylane_builder_release(raylane_builder* builder) {
    delete builder;
}

raylane_status raylane_add_material(raylane_builder* builder, const raylane_material* material,
                                    uint32_t* index) {
    return raylane_add_named_material(builder, material, "", index);
}

raylane_status raylane_add_named_material(raylane_builder* builder,
                                          const raylane_material* material, const char* name,
                                          uint32_t* index) {
    return added(builder, index, [&](SceneBuilder& to) {
        return to.add_material(converted<Material>(checked("material", material)),
                               &checked("name", name));
    });
}

raylane_status raylane_add_light(raylane_builder* builder, const raylane_light* light) {
    return guarded([&] {
        checked("builder", builder).builder.add_light(converted<Light>(checked("light", light)));
    });
}

raylane_status raylane_set_fog(raylane_builder* builder, const raylane_fog* fog) {
    return guarded(
        [&] { checked("builder", builder).builder.fog = converted<Fog>(checked("fog", fog)); });
}

raylane_status raylane_set_camera(raylane_builder* builder, const raylane_camera* camera) {
    return guarded([&] {
        checked("builder", builder).builder.camera = converted<Camera>(checked("camera", camera));
    });
}

raylane_status raylane_set_background(raylane_builder* builder, raylane_vec3 color) {
    return guarded(
        [&] { checked("builder", builder).builder.background = converted<Color>(color); });
}

raylane_status raylane_set_merge_duplicates(raylane_builder* builder, int merge) {
    return guarded([&] { checked("builder", builder).builder.merge_duplicates = merge != 0; });
}

raylane_status raylane_set_wavelengths(raylane_builder* builder, const double* wavelengths,
                                       size_t count) {
    return guarded([&] {
        const std::span<const double> values = span_of("wavelengths", wavelengths, count);
        checked("builder", builder).builder.wavelengths.assign(values.begin(), values.end());
    });
}

raylane_status raylane_set_settings(raylane_builder* builder, const raylane_settings* settings) {
    return guarded([&] {
        checked("builder", builder).builder.settings =
            converted<Settings>(checked("settings", settings));
    });
}

#define RAYLANE_ADD(shapes, shape, Shape, c_shape)                                                 \
    raylane_status raylane_add_##shapes(raylane_builder* builder, const raylane_##c_shape* values, \
                                        size_t count, uint32_t material, uint32_t* first) {        \
        return add<Shape>(builder, values, count, material, first);                                \
    }                                                                                              \
    raylane_status raylane_add_##shapes##_doubles(                                                 \
        raylane_builder* builder, const raylane_double_##c_shape* values, size_t count,            \
        uint32_t material, uint32_t* first) {                                                      \
        return add<Shape##Of<double>>(builder, values, count, material, first);                    \
    }
RAYLANE_C_SHAPES(RAYLANE_ADD)
#undef RAYLANE_ADD

raylane_status raylane_add_polygon(raylane_builder* builder, const raylane_triangle* triangles,
                                   size_t count, uint32_t material, uint32_t* first) {
    return add_polygon<Triangle>(builder, triangles, count, material, first);
}

raylane_status raylane_add_polygon_doubles(raylane_builder* builder,
                                           const raylane_double_triangle* triangles, size_t count,
                                           uint32_t material, uint32_t* first) {
    return add_polygon<TriangleOf<double>>(builder, triangles, count, material, first);
}

raylane_status raylane_add_smooth_polygon(raylane_builder* builder,
                                          const raylane_smooth_triangle* triangles, size_t count,
                                          uint32_t material, uint32_t* first) {
    return add_polygon<SmoothTriangle>(builder, triangles, count, material, first);
}

raylane_status raylane_add_smooth_polygon_doubles(raylane_builder* builder,
                                                  const raylane_double_smooth_triangle* triangles,
                                                  size_t count, uint32_t material,
                                                  uint32_t* first) {
    return add_polygon<SmoothTriangleOf<double>>(builder, triangles, count, material, first);
}

raylane_sphereflake raylane_default_sphereflake(void) {
    return std::bit_cast<raylane_sphereflake>(Sphereflake{});
}

raylane_lattice raylane_default_lattice(void) {
    return std::bit_cast<raylane_lattice>(Lattice{});
}

raylane_status raylane_add_sphereflake(raylane_builder* builder, const raylane_sphereflake* flake,
                                       uint32_t material, uint32_t* first) {
    return added(builder, first, [&](SceneBuilder& to) {
        return to.add(std::bit_cast<Sphereflake>(checked("flake", flake)), material);
    });
}

raylane_status raylane_add_lattice(raylane_builder* builder, const raylane_lattice* lattice,
                                   uint32_t material, uint32_t strut_material, uint32_t* first) {
    return added(builder, first, [&](SceneBuilder& to) {
        return to.add(std::bit_cast<Lattice>(checked("lattice", lattice)), material,
                      strut_material);
    });
}

raylane_status raylane_add_solid(raylane_builder* builder, const raylane_solid* solid,
                                 uint32_t material, uint32_t* first) {
    return added(builder, first,
                 [&](SceneBuilder& to) { return to.add(checked("solid", solid).solid, material); });
}
