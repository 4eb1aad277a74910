#pragma once

#include "scenes/formats/structure/structure.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// 1 for each selected atom, 0 for the others.
using Selected = std::vector<char>;

template <class Test>
Selected where(const Structure& structure, const Test& test) {
    Selected result(structure.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = test(static_cast<AtomIndex>(i)) ? 1 : 0;
    return result;
}
template <class Test>
Selected where_residue(const Structure& structure, const Test& test) {
    if (structure.residues.empty()) return Selected(structure.size());
    std::vector<char> of_residue;
    for (const Residue& residue : structure.of_residue)
        of_residue.push_back(test(residue) ? 1 : 0);
    return where(structure, [&](AtomIndex i) { return of_residue[structure.residues[i]] != 0; });
}

inline Selected without(Selected result, const Selected& other) {
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = static_cast<char>(result[i] & (1 - other[i]));
    return result;
}
inline Selected opposite(Selected result) {
    for (char& is_selected : result)
        is_selected = static_cast<char>(1 - is_selected);
    return result;
}

/// Returns the atoms of a word that stands by itself, in lower case, such as "protein", or none.
std::optional<Selected> named_selection(const Structure& structure, std::string_view word);

} // namespace raylane::scenes
