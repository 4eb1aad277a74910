#include "scenes/formats/structure/labels.hpp"

#include "scenes/files/number.hpp"
#include "scenes/formats/structure/lines.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace raylane::scenes {

namespace {

bool is_small_letter(char c) {
    return c >= 'a' && c <= 'z';
}

template <std::size_t count>
bool is_one_of(const std::string_view (&words)[count], std::string_view word) {
    return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

/// Returns the label from its first letter on.
std::string_view from_letter(std::string_view label) {
    while (!label.empty() && !is_letter(label.front()))
        label.remove_prefix(1);
    return label;
}

/// Returns the letters that the label begins with.
std::string_view first_letters(std::string_view label) {
    return label.substr(
        0, static_cast<std::size_t>(std::find_if_not(label.begin(), label.end(), is_letter) -
                                    label.begin()));
}

/// Returns the element of the first two letters, or 0.
Element element_of_two(std::string_view letters) {
    if (letters.size() < 2) return 0;
    return element_of(letters.substr(0, 2));
}

} // namespace

Element element_of_label(std::string_view label) {
    constexpr Element einsteinium = 99;
    constexpr std::string_view dummies[] = {"bq", "du", "tv", "unk", "vac"};
    const std::string_view letters = first_letters(from_letter(label));
    if (letters.empty()) return 0;
    const std::string in_small = in_lower_case(letters);
    if (is_one_of(dummies, in_small)) return 0;
    if (in_small == "wat") return element_of("O");
    if (in_small == "t" && label.size() > 1) return 0;
    const Element element = element_of_two(letters);
    if (element != 0 && (element <= einsteinium || is_small_letter(letters[1]))) return element;
    return element_of(letters.substr(0, 1));
}

bool is_polymer_residue(std::string_view residue) {
    constexpr std::string_view known[] = {
        "A",   "ACE", "ALA", "ARG", "ASH", "ASN", "ASP", "C",   "CYM", "CYS", "CYX",
        "DA",  "DC",  "DG",  "DT",  "DU",  "G",   "GLH", "GLN", "GLU", "GLY", "HID",
        "HIE", "HIP", "HIS", "HSD", "HSE", "HSP", "I",   "ILE", "LEU", "LYN", "LYS",
        "MET", "NME", "PHE", "PRO", "SER", "T",   "THR", "TRP", "TYR", "U",   "VAL"};
    return is_one_of(known, residue);
}

bool is_water_residue(std::string_view residue) {
    constexpr std::string_view known[] = {"hoh", "wat", "sol", "h2o", "dod", "tip3", "tip4", "spc"};
    return is_one_of(known, in_lower_case(residue));
}

Element element_of_ion(std::string_view name, std::string_view residue) {
    // CHARMM36, toppar_water_ions.str.
    constexpr std::pair<std::string_view, std::string_view> of_charmm[] = {
        {"BAR", "Ba"}, {"CAD", "Cd"}, {"CAL", "Ca"}, {"CES", "Cs"}, {"CLA", "Cl"},
        {"LIT", "Li"}, {"POT", "K"},  {"RUB", "Rb"}, {"SOD", "Na"}};
    const std::string_view letters = first_letters(from_letter(name));
    const std::string_view of_residue = first_letters(residue);
    const bool is_named_alike =
        in_lower_case(letters) == in_lower_case(of_residue) &&
        residue.find_first_not_of("0123456789+-", of_residue.size()) == std::string_view::npos;
    if (!is_named_alike && residue != "ION") return 0;
    for (const auto& [label, symbol] : of_charmm)
        if (letters == label) return element_of(symbol);
    return element_of(letters);
}

Element element_of_atom(std::string_view name, std::string_view residue) {
    constexpr std::string_view of_two[] = {"br", "cl", "cr", "cu", "fe", "ni",
                                           "pt", "se", "si", "sn", "ti"};
    name = from_letter(name);
    const std::string_view letters = first_letters(name);
    if (letters.empty()) return 0;
    if (const Element of_ion = element_of_ion(name, residue)) return of_ion;
    const Element of_both = element_of_two(letters);
    if (of_both != 0) {
        const std::string in_small = in_lower_case(letters);
        if (is_small_letter(letters[1])) return of_both;
        if (!is_polymer_residue(residue) && is_one_of(of_two, in_small.substr(0, 2)))
            return of_both;
    }
    const Element of_first = element_of(letters.substr(0, 1));
    return of_first != 0 ? of_first : of_both;
}

} // namespace raylane::scenes
