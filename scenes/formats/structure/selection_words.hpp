#pragma once

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>

namespace raylane::scenes {

/// Words of the language, except and, or, of, to, x, y and z.
constexpr std::array<std::string_view, 26> selection_keywords = {
    "all",      "none",      "protein",  "nucleic", "polymer", "helix",    "strand",
    "water",    "ligand",    "metal",    "ion",     "hetero",  "hydrogen", "noh",
    "backbone", "sidechain", "chain",    "residue", "element", "name",     "type",
    "index",    "within",    "exwithin", "byres",   "not"};

/// Returns the word of the language for a word in any case, of PyMOL or VMD, too.
std::string keyword_of(std::string_view word);

/// Returns the property that PyMOL or VMD calls `word`, or `word`.
std::string_view property_name_of(std::string_view word);

/// These ignore case.
bool is_any_word(std::string_view word, std::initializer_list<std::string_view> words);
bool is_same_word(std::string_view a, std::string_view b);

} // namespace raylane::scenes
