#include "scenes/formats/structure/selection_words.hpp"

#include "scenes/files/number.hpp"

#include <algorithm>

namespace raylane::scenes {

namespace {

/// A word of PyMOL or VMD.
struct Alias {
    std::string_view elsewhere, here;
};
constexpr std::array aliases = {
    Alias{"*", "all"},
    Alias{"atomname", "name"},
    Alias{"b.", "b_factor"},
    Alias{"bb.", "backbone"},
    Alias{"betasheet", "strand"},
    Alias{"br.", "byres"},
    Alias{"byresidue", "byres"},
    Alias{"c.", "chain"},
    Alias{"e.", "element"},
    Alias{"elem", "element"},
    Alias{"everything", "all"},
    Alias{"h.", "hydrogen"},
    Alias{"hetatm", "hetero"},
    Alias{"hydro", "hydrogen"},
    Alias{"hydrogens", "hydrogen"},
    Alias{"ions", "ion"},
    Alias{"metals", "metal"},
    Alias{"n.", "name"},
    Alias{"organic", "ligand"},
    Alias{"polymer.nucleic", "nucleic"},
    Alias{"polymer.protein", "protein"},
    Alias{"r.", "resn"},
    Alias{"i.", "resi"},
    Alias{"resid", "resi"},
    Alias{"resname", "resn"},
    Alias{"sc.", "sidechain"},
    Alias{"serial", "index"},
    Alias{"sheet", "strand"},
    Alias{"solvent", "water"},
    Alias{"waters", "water"},
};

} // namespace

bool is_any_word(std::string_view word, std::initializer_list<std::string_view> words) {
    const std::string lower = in_lower_case(word);
    return std::find(words.begin(), words.end(), lower) != words.end();
}

bool is_same_word(std::string_view a, std::string_view b) {
    return in_lower_case(a) == in_lower_case(b);
}

std::string keyword_of(std::string_view word) {
    std::string lower = in_lower_case(word);
    for (const Alias& alias : aliases)
        if (lower == alias.elsewhere) return std::string(alias.here);
    return lower;
}

std::string_view property_name_of(std::string_view word) {
    if (is_any_word(word, {"b", "beta", "bfactor", "tempfactor"})) return "b_factor";
    return is_same_word(word, "q") ? "occupancy" : word;
}

} // namespace raylane::scenes
