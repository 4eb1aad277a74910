#include "raylane/group.hpp"

#include "core/scene/generators.hpp"
#include "core/shapes/shapes.hpp"
#include "core/solids/group.hpp"
#include "core/solids/object_space.hpp"
#include "raylane/generators.hpp"
#include "scenes/api/cpp/convert.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "scenes/api/cpp/translate.hpp"

#include <bit>
#include <string>
#include <utility>
#include <vector>

namespace raylane {

using library::Internals;
using library::translated;

namespace {

/// Returns a solid with this material, unless it has its own.
Solid with_material(const Solid& solid, MaterialIndex material) {
    return Internals::of(solid).material == core::no_material ? solid.of(material) : solid;
}

} // namespace

#define RAYLANE_ADD_AS(Shape, CoreShape)                                                           \
    template <>                                                                                    \
    void Group::add(const Shape& shape, MaterialIndex material) {                                  \
        translated([&] { core::validate(library::core_shape<CoreShape>(shape)); });                \
        members_.emplace_back(shape, material);                                                    \
    }
#define RAYLANE_ADD(Shape, name, text)                                                             \
    RAYLANE_ADD_AS(Shape, core::Shape)                                                             \
    RAYLANE_ADD_AS(Shape##Of<double>, core::InDouble<core::Shape>)
RAYLANE_SHAPES(RAYLANE_ADD)
#undef RAYLANE_ADD
#undef RAYLANE_ADD_AS

void Group::add(const Solid& solid, MaterialIndex material) {
    // A single shape as a solid is a union of one part, so that it stays a solid.
    const bool is_shape = Internals::of(solid).made == core::Made::of_shape;
    members_.push_back(with_material(is_shape ? union_of({solid}) : solid, material));
}

void Group::add(const Group& group, MaterialIndex material) {
    const Group copied = group.of(material); // a copy, as it may be this group
    members_.insert(members_.end(), copied.members_.begin(), copied.members_.end());
}

Group Group::transformed(const Transform& transform) const {
    return translated([&] {
        Group result;
        result.members_.reserve(members_.size());
        core::SpaceMover move_space(Internals::of(transform));
        for (const Solid& member : members_) {
            core::validate_parts(Internals::of(member));
            core::Solid moved =
                core::transformed_member(Internals::of(member), Internals::of(transform));
            move_space(moved);
            result.members_.push_back(Internals::solid(std::move(moved)));
        }
        return result;
    });
}

Group Group::of(MaterialIndex material) const {
    Group result = *this;
    for (Solid& member : result.members_)
        member = with_material(member, material);
    return result;
}

Lattice centered_at(Lattice lattice, const Vec3Of<double>& center) {
    const core::Vec3d corner =
        core::corner_around({center.x, center.y, center.z}, lattice.n, lattice.spacing);
    lattice.corner = {corner.x, corner.y, corner.z};
    return lattice;
}

BoxOf<double> aligned_box(const Vec3Of<double>& lower, const Vec3Of<double>& upper) {
    const core::Vec3d from(lower.x, lower.y, lower.z), to(upper.x, upper.y, upper.z);
    for (int axis = 0; axis < 3; ++axis)
        if (!(from[axis] < to[axis]))
            throw InvalidValue("upper/" + std::to_string(axis),
                               "must be more than lower's " + core::checks::text_of(from[axis]) +
                                   ", got " + core::checks::text_of(to[axis]));
    return std::bit_cast<BoxOf<double>>(core::aligned_box(from, to - from));
}

Solid solid_of(const Group& group) {
    const std::vector<Solid>& members = Internals::members_of(group);
    if (members.empty()) throw InvalidValue("", "must have at least one member, got none");
    return translated([&] {
        std::vector<core::Solid> parts;
        parts.reserve(members.size());
        for (const Solid& member : members)
            parts.push_back(core::member_as_part(Internals::of(member)));
        return Internals::solid(core::union_of(std::move(parts)));
    });
}

} // namespace raylane
