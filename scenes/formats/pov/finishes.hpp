#pragma once

#include "scenes/formats/pov/tokens.hpp"

/// The look of objects: finishes, patterns, textures, images.
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

/// Returns the mean colour of the image in `{ png "a.png" ... }`, read from the brace to behind its
/// end. Returns nothing if the image is missing or not a PNG.
std::optional<Tuple> read_image_color(Tokens& tokens);

/// Reads a statement of a pattern into the texture that has it: the pattern's name and its list, a
/// map, or a number such as `turbulence`. Returns false, and reads nothing, at other words.
bool read_pattern(Tokens& tokens, Texture& texture);

/// Returns the single colour that replaces a pattern that cannot be rendered.
Tuple color_of(const Pigment& pigment);
/// Returns one texture in place of one texture above another.
Shared<Texture> layered(Tokens& tokens, const Shared<Texture>& below, Shared<Texture> above,
                        const Place& place);

/// Reads "{ [0 rgb 1] [1 rgb 0] }": a map of colours, of pigments or of textures. Begins at the
/// brace.
PatternMap read_map(Tokens& tokens, MapOf kind);
/// Returns the kind of map that a word begins.
std::optional<MapOf> map_of(const Token& word);

} // namespace raylane::scenes::pov
