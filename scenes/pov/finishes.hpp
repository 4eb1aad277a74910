#pragma once

#include "scenes/pov/tokens.hpp"

/// What objects look like.
namespace raylane::scenes::pov {

/// All of these begin at the brace.
Pigment read_pigment(Tokens& tokens, Pigment pigment);
Finish read_finish(Tokens& tokens, Finish finish);
Shared<Texture> read_texture(Tokens& tokens);
/// The same, with the layers "texture { ... }" behind it.
Shared<Texture> read_layers(Tokens& tokens);
Interior read_interior(Tokens& tokens);
Material read_material(Tokens& tokens);
/// The same behind the brace or bracket, up to its end.
Pigment read_pigment(Tokens& tokens, Pigment pigment, std::string_view end);
Shared<Texture> read_texture(Tokens& tokens, std::string_view end);
/// "#default { ... }"
void read_default(Tokens& tokens);

/// What comes next if it moves things: "translate <1, 2, 3>", ...; null if not.
Shared<Motion> read_motion(Tokens& tokens);
/// "{ ... }", or a name.
Shared<Motion> read_transform(Tokens& tokens);

} // namespace raylane::scenes::pov
