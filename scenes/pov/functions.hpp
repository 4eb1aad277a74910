#pragma once

#include "scenes/pov/tokens.hpp"

namespace raylane::scenes::pov {

/// Returns true for names of the language's numbers and functions.
bool is_function(std::string_view name);
/// Reads the rest of a function behind its name. Returns nothing if the name is not a function's.
std::optional<Tuple> read_function(Tokens& tokens, const Token& name);

} // namespace raylane::scenes::pov
