#include "scenes/formats/structure/lammps_atom_styles.hpp"

#include "scenes/files/number.hpp"

#include <algorithm>
#include <iterator>

namespace raylane::scenes {

namespace {

struct StyleRow {
    std::string_view name, columns;
    bool allows_bonds = false;
};

// A guess names the first of the styles with the same columns, so the others come after it. Older
// forms of a style come after the usual one.
constexpr StyleRow rows[] = {
    {"atomic", "type x y z"},
    {"charge", "type charge x y z"},
    {"molecular", "molecule type x y z", true},
    {"full", "molecule type charge x y z", true},
    {"sphere", "type diameter density x y z"},
    {"dipole", "type charge x y z mux muy muz"},
    {"electron", "type charge espin eradius x y z"},
    {"spin", "type x y z spx spy spz sp"},
    {"spin", "type sp x y z spx spy spz"},
    {"ellipsoid", "type ellipsoidflag density x y z"},
    {"body", "type bodyflag mass x y z"},
    {"line", "molecule type lineflag density x y z"},
    {"tri", "molecule type triangleflag density x y z"},
    {"bpm/sphere", "molecule type diameter density x y z", true},
    {"peri", "type volume density x y z"},
    {"sph", "type rho esph cv x y z"},
    {"smd", "type molecule volume mass kradius cradius x0 y0 z0 x y z"},
    {"smd", "type molecule volume mass kradius cradius x y z"},
    {"dpd", "type theta x y z"},
    {"edpd", "type edpd_temp edpd_cv x y z"},
    {"mdpd", "type rho x y z"},
    {"rheo", "type status rho x y z"},
    {"rheo/thermal", "type status rho esph x y z"},
    {"dielectric",
     "molecule type charge x y z mux muy muz area ed em epsilon curvature", // as LAMMPS reads it
     true},
    {"dielectric", "type charge x y z mux muy muz area ed em epsilon curvature", true},
    {"template", "molecule template_index template_atom type x y z"}, // as LAMMPS reads it
    {"template", "type molecule template_index template_atom x y z"},
    {"wavepacket", "type charge espin eradius etag cs_re cs_im x y z"},
    {"mesont", "molecule type bond_nt mass mradius mlength buckling x y z"},
    {"tdpd", "type x y z"}, // and a concentration of each species
    {"angle", "molecule type x y z", true},
    {"bond", "molecule type x y z", true},
    {"amoeba", "molecule type charge x y z", true},
    {"oxdna", "type x y z", true},
    {"meso", "type rho esph cv x y z"}, // the former name of sph
};
constexpr std::string_view species_columns[] = {"cc1", "cc2", "cc3", "cc4",
                                                "cc5", "cc6", "cc7", "cc8"};

std::vector<std::string_view> words_of(std::string_view text) {
    constexpr std::string_view blanks = " \t";
    std::vector<std::string_view> words;
    for (;;) {
        text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
        if (text.empty()) return words;
        const std::size_t end = std::min(text.find_first_of(blanks), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
}

/// Removes the suffix of an accelerated style.
std::string_view without_suffix(std::string_view style) {
    for (const std::string_view suffix : {"/kk/device", "/kk/host", "/kk"})
        if (style.ends_with(suffix)) return style.substr(0, style.size() - suffix.size());
    return style;
}

bool is_style(std::string_view word) {
    return std::any_of(std::begin(rows), std::end(rows),
                       [&](const StyleRow& row) { return row.name == without_suffix(word); });
}

bool takes_arguments(std::string_view style) {
    constexpr std::string_view styles[] = {"body", "bpm/sphere", "sphere", "tdpd", "template"};
    return std::find(std::begin(styles), std::end(styles), style) != std::end(styles);
}

AtomLayout layout_of(const StyleRow& row) {
    return {std::string(row.name), words_of(row.columns), row.allows_bonds, false};
}

/// Adds the concentrations of tdpd. If their number is unknown, allows any columns instead.
void add_species(AtomLayout& layout, std::string_view count) {
    const int number = to_int(count).value_or(0);
    layout.is_open = number < 1 || number > static_cast<int>(std::size(species_columns));
    if (!layout.is_open)
        layout.columns.insert(layout.columns.end(), std::begin(species_columns),
                              species_columns + number);
}

/// Returns true if LAMMPS has one field for two columns of different names.
bool is_same_field(std::string_view a, std::string_view b) {
    const auto is_pair = [&](std::string_view one, std::string_view other) {
        return (a == one && b == other) || (a == other && b == one);
    };
    return a == b || is_pair("density", "mass") || is_pair("diameter", "kradius");
}

/// Returns the layout of sub-styles with their arguments: the five columns that all of them have,
/// and then the others of each one. Returns nothing for an unknown sub-style.
std::vector<AtomLayout> hybrid_of(const std::vector<std::string_view>& words) {
    AtomLayout layout{"hybrid", {"type", "x", "y", "z"}, words.size() == 1, words.size() == 1};
    std::string_view sub_style;
    for (std::size_t i = 1; i < words.size(); ++i) {
        if (!is_style(words[i])) {
            if (!takes_arguments(sub_style)) return {};
            continue;
        }
        sub_style = without_suffix(words[i]);
        layout.style.append(" ").append(sub_style);
        AtomLayout one = layouts_of(sub_style)[0];
        if (sub_style == "tdpd") add_species(one, i + 1 < words.size() ? words[i + 1] : "");
        layout.allows_bonds = layout.allows_bonds || one.allows_bonds;
        if (layout.is_open) continue; // its columns follow an unknown number of others
        layout.is_open = one.is_open;
        for (const std::string_view column : one.columns)
            if (std::none_of(layout.columns.begin(), layout.columns.end(),
                             [&](std::string_view field) { return is_same_field(field, column); }))
                layout.columns.push_back(column);
    }
    return {layout};
}

} // namespace

std::size_t AtomLayout::index_of(std::string_view column) const {
    const auto found = std::find(columns.begin(), columns.end(), column);
    return found == columns.end() ? 0 : static_cast<std::size_t>(found - columns.begin()) + 1;
}

std::vector<AtomLayout> layouts_of(std::string_view style) {
    const std::vector<std::string_view> words = words_of(style);
    if (words.empty()) return {};
    const std::string_view name = without_suffix(words[0]);
    if (name == "hybrid") return hybrid_of(words);
    if (words.size() > 1 && !takes_arguments(name)) return {};
    std::vector<AtomLayout> layouts;
    for (const StyleRow& row : rows)
        if (row.name == name) layouts.push_back(layout_of(row));
    if (name == "tdpd") add_species(layouts[0], words.size() > 1 ? words[1] : "");
    return layouts;
}

std::vector<AtomLayout> fixed_layouts() {
    std::vector<AtomLayout> layouts;
    std::string_view last;
    for (const StyleRow& row : rows) {
        if (row.name != "tdpd" && row.name != last) layouts.push_back(layout_of(row));
        last = row.name;
    }
    return layouts;
}

std::vector<std::string_view> atom_style_names() {
    std::vector<std::string_view> names = {"hybrid"};
    for (const StyleRow& row : rows)
        if (names.back() != row.name) names.push_back(row.name);
    return names;
}

} // namespace raylane::scenes
