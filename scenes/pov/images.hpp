#pragma once

#include "scenes/pov/tokens.hpp"

namespace raylane::scenes::pov {

/// The mean colour of the picture in `{ png "a.png" ... }`, from the brace to behind its end.
/// Returns nothing for a picture that is no PNG, or is not there.
std::optional<Tuple> read_image_color(Tokens& tokens);

} // namespace raylane::scenes::pov
