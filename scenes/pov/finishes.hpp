#pragma once

#include "scenes/pov/tokens.hpp"

/// The look of objects.
namespace raylane::scenes::pov {

/// All of these begin at the opening brace.
Pigment read_pigment(Tokens& tokens, Pigment pigment);
Finish read_finish(Tokens& tokens, Finish finish);
Shared<Texture> read_texture(Tokens& tokens);
/// Reads a texture with the layers "texture { ... }" behind it.
Shared<Texture> read_layers(Tokens& tokens);
Interior read_interior(Tokens& tokens);
Material read_material(Tokens& tokens);
/// These begin behind the brace or bracket, and read up to its end.
Pigment read_pigment(Tokens& tokens, Pigment pigment, std::string_view end);
Shared<Texture> read_texture(Tokens& tokens, std::string_view end);
/// Reads the braces of "#default { ... }".
void read_default(Tokens& tokens);

/// Reads a transformation, "translate <1, 2, 3>" and the like; returns null if something else comes
/// next.
Shared<Motion> read_motion(Tokens& tokens);
/// Reads "{ ... }", or a name.
Shared<Motion> read_transform(Tokens& tokens);

} // namespace raylane::scenes::pov
