#pragma once

#include "scenes/formats/pov/tokens.hpp"

namespace raylane::scenes::pov {

/// Returns true for a token that begins an object: a supported statement, or the name of an object.
bool begins_object(const Tokens& tokens, const Token& token);
/// Reads an object's whole statement. Fails for unsupported objects, and names their kind.
Shared<Object> read_object(Tokens& tokens);

/// Reads the modifiers behind an object's numbers, up to the closing brace and past it.
void read_modifiers(Tokens& tokens, Object& object);
/// Counts a part that the object contains `times` times from now on. Fails above the limits.
void count_in(Object& object, const Object& part, std::size_t times);

/// Returns the triangle, without normals if one of them has no direction.
core::PartShape smooth_or_flat(const core::SmoothTriangleOf<double>& triangle);
/// Read the numbers of a mesh, mesh2 or polygon, behind the opening brace.
Shared<Mesh> read_mesh(Tokens& tokens);
Shared<Mesh> read_mesh2(Tokens& tokens);
Shared<Mesh> read_polygon(Tokens& tokens);

/// Skips a comma, if there is one: "a, b" and "a b" are the same.
inline void skip_comma(Tokens& tokens) {
    tokens.accept(",");
}
/// Returns true, with one remark, for a triangle without an area, which POV-Ray omits, too.
bool has_no_area(Tokens& tokens, const core::TriangleOf<double>& triangle, const Place& place);

} // namespace raylane::scenes::pov
