#pragma once

#include "scenes/pov/tokens.hpp"

#include <string>

/// Numbers, vectors, colours and strings.
namespace raylane::scenes::pov {

/// Without comparisons, as they stand everywhere but in parentheses.
Tuple read_tuple(Tokens& tokens);
/// With comparisons, & and |, and ? :.
Tuple read_relation(Tokens& tokens);
double read_number(Tokens& tokens);
core::Vec3d read_vector(Tokens& tokens);
/// The curve of IEC 61966-2-1.
double linear_of_srgb(double value);
/// Five components, behind "color" or without it.
Tuple read_color(Tokens& tokens);
/// True of a word that begins a colour.
bool begins_color(const Token& token);
/// True if a number, vector or colour comes next.
bool at_tuple(Tokens& tokens);
/// True of a string, and of a function that makes one.
bool begins_string(const Token& token);
/// True before a string, or the name of one.
bool at_string(Tokens& tokens);
std::string read_string(Tokens& tokens);

/// "[1][2]", so many at most.
std::vector<std::size_t> read_indices(Tokens& tokens, std::size_t most = deepest);
/// Of an element in its values.
std::size_t index_in(const Array& array, const Token& name, std::span<const std::size_t> indices);

} // namespace raylane::scenes::pov
