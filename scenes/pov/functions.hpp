#pragma once

#include "scenes/pov/tokens.hpp"

namespace raylane::scenes::pov {

/// True of names of numbers and functions that the language has.
bool is_function(std::string_view name);
/// Reads on behind its name; nothing if it is none.
std::optional<Tuple> read_function(Tokens& tokens, const Token& name);

} // namespace raylane::scenes::pov
