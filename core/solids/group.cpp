#include "core/solids/group.hpp"

#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <utility>

namespace raylane::core {

namespace {

bool is_quadric(const Solid& solid) {
    return solid.made == Made::of_shape && std::holds_alternative<QuadricOf<double>>(solid.shape);
}

/// Returns a quadric combined with its box as a solid.
Solid in_box(const Solid& solid, Made by) {
    const auto& quadric = std::get<QuadricOf<double>>(solid.shape);
    Solid result{by};
    result.parts = {solid, of_shape(aligned_box(quadric.center + quadric.lower,
                                                quadric.upper - quadric.lower))};
    result.parts.back().space = solid.space;
    result.material = solid.material;
    return result;
}

} // namespace

BoxOf<double> aligned_box(const Vec3d& corner, const Vec3d& size) {
    return {corner, {size.x, 0.0, 0.0}, {0.0, size.y, 0.0}, {0.0, 0.0, size.z}};
}

Solid transformed_member(Solid member, const Transform& transform) {
    if (is_quadric(member)) member = in_box(member, Made::by_clip);
    return transform(member);
}

Solid member_as_part(Solid member) {
    return is_quadric(member) ? in_box(member, Made::by_intersection) : member;
}

void validate_part(const PartShape& shape) {
    std::visit(
        []<class Shape>(Shape part) {
            if constexpr (kind_of<Shape> == Kind::quadric) {
                part.lower = Vec3d(-1.0);
                part.upper = Vec3d(1.0);
            }
            validate(part);
        },
        shape);
}

void validate_parts(const Solid& solid) {
    if (solid.made == Made::of_shape) return validate_part(solid.shape);
    for (std::size_t i = 0; i < solid.parts.size(); ++i)
        check_object(i, [&] { validate_parts(solid.parts[i]); });
}

Solid joined(Made made, Solid first, const Solid& second) {
    if (first.made != made) {
        Solid result{made};
        result.parts = {std::move(first), second};
        return result;
    }
    for (Solid& part : first.parts)
        if (part.material == no_material) part.material = first.material;
    first.material = no_material;
    first.parts.push_back(second);
    return first;
}

Solid union_of(std::vector<Solid> parts) {
    if (parts.size() == 1) return std::move(parts[0]);
    Solid joined{Made::by_union};
    joined.parts = std::move(parts);
    return joined;
}

bool has_materials(const Solid& solid) {
    if (solid.material != no_material) return true;
    if (solid.made == Made::of_shape) return false;
    if (solid.made == Made::by_clip) return has_materials(solid.parts.front());
    return std::all_of(solid.parts.begin(), solid.parts.end(), has_materials);
}

} // namespace raylane::core
