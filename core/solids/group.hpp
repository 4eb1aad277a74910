#pragma once

#include "core/shapes/invalid_value.hpp"
#include "core/solids/transform.hpp"

#include <string>
#include <vector>

/// Groups of objects with a common transform or material. Each member is a shape or a compound
/// solid, which a scene takes as if it were added by itself.
namespace raylane::core {

/// Calls check(). Fields of an InvalidValue then begin with "objects/" and the number of an object.
template <class Check>
void check_object(std::size_t number, const Check& check) {
    try {
        check();
    } catch (const InvalidValue& invalid) {
        throw InvalidValue("objects/" + std::to_string(number) +
                               (invalid.field.empty() ? "" : "/") + invalid.field,
                           invalid.expectation);
    }
}

/// Returns the box with edges of these lengths along the axes.
BoxOf<double> aligned_box(const Vec3d& corner, const Vec3d& size);

/// Transforms a member of a group. A quadric becomes a solid that its box clips.
Solid transformed_member(Solid member, const Transform& transform);

/// Returns a member of a group as a part of a solid. A quadric becomes the solid inside of its
/// form and its box.
Solid member_as_part(Solid member);

/// Checks the shape of a part of a solid. Ignores the bounds of quadrics. Throws InvalidValue.
void validate_part(const PartShape& shape);
/// Checks the shapes of all parts. The field of an error begins with "objects/2/", ...
void validate_parts(const Solid& solid);

/// Returns a solid made of two. If the first is made in the same way, the second becomes another
/// part of it, so that a | b | c does not nest. `made`: union, intersection or difference.
Solid joined(Made made, Solid first, const Solid& second);

/// Returns the union of parts; a single part itself.
Solid union_of(std::vector<Solid> parts);

/// Returns true if all parts that have surfaces have materials, their own or those of a whole.
bool has_materials(const Solid& solid);

} // namespace raylane::core
