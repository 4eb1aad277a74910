#pragma once

#include "scenes/pov/tokens.hpp"

namespace raylane::scenes::pov {

/// True for what begins an object: a statement that is read, or a name of one.
bool begins_object(const Tokens& tokens, const Token& token);
/// An object, all of its statement. Fails, with what it is, for those that are not read.
Shared<Object> read_object(Tokens& tokens);

/// Reads what comes behind an object's numbers, as far as the brace; past it.
void read_modifiers(Tokens& tokens, Object& object);
/// Counts what is so many times in an object from then on. Fails above the limits.
void count_in(Object& object, const Object& part, std::size_t times);

/// A triangle without normals, if one of its own has no direction, and so all have none.
core::PartShape smooth_or_flat(const core::SmoothTriangleOf<double>& triangle);
/// The rest of a mesh, mesh2 or polygon's numbers, behind the brace.
Shared<Mesh> read_mesh(Tokens& tokens);
Shared<Mesh> read_mesh2(Tokens& tokens);
Shared<Mesh> read_polygon(Tokens& tokens);

/// Past a comma, if there is one: "a, b" and "a b" are the same.
inline void skip_comma(Tokens& tokens) {
    tokens.accept(",");
}
/// True, and said once, for a triangle that has no area, as POV-Ray leaves it out.
bool has_no_area(Tokens& tokens, const core::TriangleOf<double>& triangle, const Place& place);

} // namespace raylane::scenes::pov
