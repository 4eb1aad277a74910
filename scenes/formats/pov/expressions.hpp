#pragma once

#include "scenes/formats/pov/tokens.hpp"

#include <string>

/// Numbers, vectors, colours and strings.
namespace raylane::scenes::pov {

/// Reads a value without comparisons, as allowed everywhere except in parentheses.
Tuple read_tuple(Tokens& tokens);
/// Reads a value with comparisons, & and |, and ? :.
Tuple read_relation(Tokens& tokens);
double read_number(Tokens& tokens);
core::Vec3d read_vector(Tokens& tokens);
/// Returns five components. "color" in front is optional.
Tuple read_color(Tokens& tokens);
/// Returns true for a word that begins a colour.
bool begins_color(const Token& token);
/// Returns true if a number, vector or colour comes next.
bool at_tuple(Tokens& tokens);
/// Returns true for a string, and for a function that returns one.
bool begins_string(const Token& token);
/// Returns true if a string, or the name of one, comes next.
bool at_string(Tokens& tokens);
std::string read_string(Tokens& tokens);

/// Reads "[1][2]", with at most `most` indices.
std::vector<std::size_t> read_indices(Tokens& tokens, std::size_t most = deepest);
/// Returns the index of an element in the array's values.
std::size_t index_in(const Array& array, const Token& name, std::span<const std::size_t> indices);

/// Returns true for names of the language's numbers and functions.
bool is_function(std::string_view name);
/// Reads the rest of a function behind its name. Returns nothing if the name is not a function's.
std::optional<Tuple> read_function(Tokens& tokens, const Token& name);

} // namespace raylane::scenes::pov
