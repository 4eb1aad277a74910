#pragma once

#include "scenes/json/items.hpp"
#include "scenes/json/parameters.hpp"

#include <span>

namespace raylane::scenes {

/// Takes nothing but the parameters of a file and of those that it includes, in the order in which
/// a scene of these `keys` is read. What is wrong is left for that to tell.
void take_parameters(InputFile& file, std::span<const RootKey> keys, Parameters& parameters);

} // namespace raylane::scenes
