#pragma once

#include "scenes/formats/json/items.hpp"
#include "scenes/formats/json/parameters.hpp"

#include <span>

namespace raylane::scenes {

/// Takes only the parameters of a file and of the files that it includes, in the order in which a
/// scene with these `keys` is read. Leaves all errors to be reported when the scene is read.
void take_parameters(InputFile& file, std::span<const RootKey> keys, Parameters& parameters);

} // namespace raylane::scenes
