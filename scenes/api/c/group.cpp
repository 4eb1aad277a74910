#include "calls.hpp"
#include "values.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <vector>

/// Transforms, groups and their copies.
using namespace raylane;
using namespace raylane::c;

namespace {

/// Replaces a map by change(map).
template <class Change>
raylane_status changed(raylane_transform* transform, const Change& change) noexcept {
    return guarded([&] {
        Transform& map = checked("transform", transform).transform;
        map = change(map);
    });
}

/// Adds shapes to a group. CShape and Shape hold the same numbers in the same order.
template <class Shape, class CShape>
raylane_status add(raylane_group* group, const CShape* shapes, std::size_t count,
                   std::uint32_t material) noexcept {
    return guarded([&] {
        Group& to = checked("group", group).group;
        add_all("shapes", shapes, count,
                [&](const CShape& shape) { to.add(std::bit_cast<Shape>(shape), material); });
    });
}

} // namespace

raylane_status raylane_transform_create(raylane_transform** transform) {
    return handle_of("transform", transform, [] { return Transform(); });
}

raylane_status raylane_transform_matrix(const double* rows, raylane_transform** transform) {
    return handle_of("transform", transform, [&] {
        static_cast<void>(checked("rows", rows));
        std::array<std::array<double, 4>, 3> matrix;
        for (std::size_t row = 0; row < 3; ++row)
            std::copy_n(rows + 4 * row, 4, matrix[row].begin());
        return Transform(matrix);
    });
}

void raylane_transform_release(raylane_transform* transform) {
    delete transform;
}

raylane_status raylane_transform_scale(raylane_transform* transform, raylane_double_vec3 by) {
    return changed(transform, [&](const Transform& map) {
        return map.scaled(Vec3Of<double>{by.x, by.y, by.z});
    });
}

raylane_status raylane_transform_rotate(raylane_transform* transform, raylane_double_vec3 by) {
    return changed(transform, [&](const Transform& map) {
        return map.rotated({by.x, by.y, by.z});
    });
}

raylane_status raylane_transform_translate(raylane_transform* transform, raylane_double_vec3 by) {
    return changed(transform, [&](const Transform& map) {
        return map.translated({by.x, by.y, by.z});
    });
}

raylane_status raylane_transform_then(raylane_transform* transform, const raylane_transform* next) {
    return changed(transform,
                   [&](const Transform& map) { return map.then(checked("next", next).transform); });
}

raylane_status raylane_solid_transformed(const raylane_solid* solid,
                                         const raylane_transform* transform,
                                         raylane_solid** transformed) {
    return handle_of("transformed", transformed, [&] {
        return checked("solid", solid).solid.transformed(checked("transform", transform).transform);
    });
}

raylane_status raylane_group_create(raylane_group** group) {
    return handle_of("group", group, [] { return Group(); });
}

void raylane_group_release(raylane_group* group) {
    delete group;
}

size_t raylane_group_size(const raylane_group* group) {
    return group != nullptr ? group->group.size() : 0;
}

#define RAYLANE_ADD(shapes, shape, Shape, c_shape)                                                 \
    raylane_status raylane_group_add_##shapes(raylane_group* group,                                \
                                              const raylane_double_##c_shape* values,              \
                                              size_t count, uint32_t material) {                   \
        return add<Shape##Of<double>>(group, values, count, material);                             \
    }
RAYLANE_C_SHAPES(RAYLANE_ADD)
#undef RAYLANE_ADD

raylane_status raylane_group_add_solid(raylane_group* group, const raylane_solid* solid,
                                       uint32_t material) {
    return guarded(
        [&] { checked("group", group).group.add(checked("solid", solid).solid, material); });
}

raylane_status raylane_group_add_group(raylane_group* group, const raylane_group* members,
                                       uint32_t material) {
    return guarded(
        [&] { checked("group", group).group.add(checked("members", members).group, material); });
}

raylane_status raylane_group_transformed(const raylane_group* group,
                                         const raylane_transform* transform,
                                         raylane_group** transformed) {
    return handle_of("transformed", transformed, [&] {
        return checked("group", group).group.transformed(checked("transform", transform).transform);
    });
}

raylane_status raylane_group_of_material(const raylane_group* group, uint32_t material,
                                         raylane_group** result) {
    return handle_of("result", result, [&] { return checked("group", group).group.of(material); });
}

raylane_status raylane_solid_group(const raylane_group* group, uint32_t material,
                                   raylane_solid** solid) {
    return handle_of("solid", solid,
                     [&] { return solid_of(checked("group", group).group).of(material); });
}

raylane_status raylane_add_group(raylane_builder* builder, const raylane_group* group,
                                 uint32_t material, uint32_t* first) {
    return added(builder, first,
                 [&](SceneBuilder& to) { return to.add(checked("group", group).group, material); });
}

raylane_placement raylane_default_placement(void) {
    return std::bit_cast<raylane_placement>(Placement{});
}

raylane_status raylane_add_copies(raylane_builder* builder, const raylane_group* group,
                                  const raylane_placement* placements, size_t count,
                                  uint32_t material, uint32_t* first) {
    return added(builder, first, [&](SceneBuilder& to) {
        std::vector<Placement> placement_list;
        for (const raylane_placement& placement : span_of("placements", placements, count))
            placement_list.push_back(std::bit_cast<Placement>(placement));
        return to.add(checked("group", group).group, placement_list, material);
    });
}

raylane_status raylane_set_keep_from(raylane_builder* builder, size_t shapes) {
    return guarded([&] { checked("builder", builder).builder.keep_from = shapes; });
}
