#include "raylane/solid.hpp"

#include "core/solids/group.hpp"
#include "core/solids/lens.hpp"
#include "core/solids/object_space.hpp"
#include "scenes/api/cpp/convert.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "scenes/api/cpp/translate.hpp"

#include <string>
#include <utility>

namespace raylane {

namespace {

/// Maximum nesting of solids. Deeper recursion would overflow a thread's stack.
constexpr int max_depth = 1024;

Solid checked(core::Solid solid) {
    if (core::depth_of(solid) > max_depth)
        throw InvalidValue("", "must not be nested more than " + std::to_string(max_depth) +
                                   " deep: a union has any number of parts");
    return library::Internals::solid(std::move(solid));
}

Solid made(core::Made by, const std::vector<Solid>& parts) {
    core::Solid solid{by};
    solid.parts.reserve(parts.size());
    for (const Solid& part : parts)
        solid.parts.push_back(library::Internals::of(part));
    return checked(std::move(solid));
}

Solid joined(core::Made by, const Solid& a, const Solid& b) {
    return checked(core::joined(by, library::Internals::of(a), library::Internals::of(b)));
}

std::vector<Solid> with_first(const Solid& first, const std::vector<Solid>& others) {
    std::vector<Solid> operands{first};
    operands.insert(operands.end(), others.begin(), others.end());
    return operands;
}

template <class CoreShape, class Shape>
std::shared_ptr<const core::Solid> of_shape(const Shape& shape, MaterialIndex material) {
    core::Solid solid;
    solid.shape = core::to_doubles(library::core_shape<CoreShape>(shape));
    solid.material = material;
    return std::make_shared<const core::Solid>(std::move(solid));
}

} // namespace

Solid Solid::of(MaterialIndex material) const {
    core::Solid same = *solid_;
    same.material = material;
    return library::Internals::solid(std::move(same));
}

Solid Solid::transformed(const Transform& transform) const {
    return library::translated([&] {
        core::validate_parts(*solid_);
        core::Solid moved = library::Internals::of(transform)(*solid_);
        core::SpaceMover move_space(library::Internals::of(transform));
        move_space(moved);
        return library::Internals::solid(std::move(moved));
    });
}

#define RAYLANE_SOLID_OF(Shape, CoreShape)                                                         \
    template <>                                                                                    \
    Solid::Solid(const Shape& shape) : Solid(of_shape<CoreShape>(shape, core::no_material)) {}     \
    template <>                                                                                    \
    Solid::Solid(const Shape& shape, MaterialIndex material)                                       \
        : Solid(of_shape<CoreShape>(shape, material)) {}
#define RAYLANE_SOLID(Shape, name, text)                                                           \
    RAYLANE_SOLID_OF(Shape, core::Shape)                                                           \
    RAYLANE_SOLID_OF(Shape##Of<double>, core::InDouble<core::Shape>)
RAYLANE_SHAPES(RAYLANE_SOLID)
#undef RAYLANE_SOLID
#undef RAYLANE_SOLID_OF

Solid solid_of(const Lens& lens) {
    const auto vector = [](const Vec3Of<double>& v) { return core::Vec3d(v.x, v.y, v.z); };
    return library::translated([&] {
        return library::Internals::solid(core::solid_of({vector(lens.vertex),
                                                         vector(lens.axis),
                                                         {lens.radii[0], lens.radii[1]},
                                                         {lens.conics[0], lens.conics[1]},
                                                         lens.thickness,
                                                         lens.radius}));
    });
}

Solid union_of(const std::vector<Solid>& parts) {
    return made(core::Made::by_union, parts);
}

Solid intersection_of(const std::vector<Solid>& parts) {
    return made(core::Made::by_intersection, parts);
}

Solid difference_of(const Solid& whole, const std::vector<Solid>& taken_away) {
    return made(core::Made::by_difference, with_first(whole, taken_away));
}

Solid clipped(const Solid& whole, const std::vector<Solid>& by) {
    return made(core::Made::by_clip, with_first(whole, by));
}

Solid operator|(const Solid& a, const Solid& b) {
    return joined(core::Made::by_union, a, b);
}

Solid operator&(const Solid& a, const Solid& b) {
    return joined(core::Made::by_intersection, a, b);
}

Solid operator-(const Solid& a, const Solid& b) {
    return joined(core::Made::by_difference, a, b);
}

} // namespace raylane
