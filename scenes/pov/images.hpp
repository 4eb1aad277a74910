#pragma once

#include "scenes/pov/tokens.hpp"

namespace raylane::scenes::pov {

/// Returns the mean colour of the image in `{ png "a.png" ... }`, read from the brace to behind its
/// end. Returns nothing if the image is missing or not a PNG.
std::optional<Tuple> read_image_color(Tokens& tokens);

} // namespace raylane::scenes::pov
