#pragma once

#include "scenes/pov/tokens.hpp"

/// Patterns of colours, pigments and textures.
namespace raylane::scenes::pov {

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
