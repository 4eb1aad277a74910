#include "scenes/tool/drawing_arguments.hpp"

#include "scenes/tool/arguments.hpp"

namespace raylane::scenes {

namespace {

constexpr const char* atoms_group = "Atoms (PDB, mmCIF, CIF, XYZ, GRO, LAMMPS)";

std::array<int, 3> repeat_argument(const std::string& text) {
    std::array<int, 3> result{};
    std::string_view rest = text;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t end = rest.find('x');
        const std::optional<int> number = to_int(rest.substr(0, end));
        if (!number || *number < 1 || *number > 1000 ||
            (end == std::string_view::npos) != (axis == 2))
            throw BadInput("--repeat", "",
                           "must be the number of cells along each edge, from 1 to 1000, such as "
                           "2x2x1, got \"" +
                               printable(text) + "\"");
        result[axis] = *number;
        rest.remove_prefix(std::min(end, rest.size() - 1) + 1);
    }
    return result;
}

} // namespace

void DrawingArguments::add_to(CLI::App& command) {
    const auto add = [&](const char* name, Argument& value, const char* help, const char* type) {
        add_option(command, name, value, help, type)->group(atoms_group);
    };
    add("--style", style,
        "Style of atoms and bonds. balls have sticks; spheres have van der Waals radii. Default: "
        "balls for up to 500 atoms, otherwise spheres.",
        "balls|sticks|licorice|spheres|points");
    add("--color", color,
        "Property that colours the atoms: element, chain, residue, or a number per atom in the "
        "file, such as b_factor. Default: element.",
        "BY");
    add("--select", select,
        "Atoms to show: all, none, protein, nucleic, water, hetero, hydrogen, backbone, chain A B, "
        "residue ALA 17 20-30, element C Fe, name CA, type 1, index 1-100, a number per atom in "
        "the file, such as b_factor < 30, or within 5 of ... Combine these by not, and, or and "
        "parentheses. Default: all.",
        "WHICH");
    add("--opacity", opacity,
        "Opacity of atoms and bonds, above 0 and up to 1. Inner surfaces of overlapping shapes are "
        "hidden. Default: 1.",
        "A");
    add("--repeat", repeat, "Repeat the unit cell along its edges, such as 2x2x1. Default: 1x1x1.",
        "AxBxC");
    add("--atom-style", atom_style,
        "Atom style of a LAMMPS data file, such as full or \"hybrid sphere dipole\". Default: the "
        "comment after Atoms, otherwise the style that fits the columns.",
        "STYLE");
    const auto flag = [&](const char* name, bool& value, const char* help) {
        add_flag(command, name, value, help);
        command.get_option(name)->group(atoms_group);
    };
    flag("--cell", cell, "Show the edges of the unit cell.");
    flag("--ellipsoids", ellipsoids,
         "Show displacements (ANISOU, U and B) as ellipsoids or spheres of 50 % probability.");
}

Drawing DrawingArguments::drawing() const {
    Drawing drawing;
    if (style)
        drawing.style = choice_argument<Style>("--style", *style,
                                               {{"balls", Style::balls},
                                                {"sticks", Style::sticks},
                                                {"licorice", Style::licorice},
                                                {"spheres", Style::spheres},
                                                {"points", Style::points}});
    drawing.color = color.value_or(drawing.color);
    drawing.select = select.value_or(drawing.select);
    if (opacity) {
        const std::optional<float> value = to_float(*opacity);
        if (!value || !(*value > 0.0F && *value <= 1.0F))
            throw BadInput("--opacity", "",
                           "must be above 0 and at most 1, got \"" + printable(*opacity) + "\"");
        drawing.opacity = *value;
    }
    if (repeat) drawing.repeat = repeat_argument(*repeat);
    drawing.show_cell = cell;
    drawing.ellipsoids = ellipsoids;
    if (ellipsoids && !style) drawing.style = Style::balls; // for atoms without displacements
    return drawing;
}

std::vector<std::pair<std::string, std::string>> DrawingArguments::given() const {
    std::vector<std::pair<std::string, std::string>> given;
    const std::pair<const char*, const Argument&> values[] = {
        {"--style", style},     {"--color", color},   {"--select", select},
        {"--opacity", opacity}, {"--repeat", repeat}, {"--atom-style", atom_style}};
    for (const auto& [name, value] : values)
        if (value) given.emplace_back(name, *value);
    const std::pair<const char*, bool> flags[] = {{"--cell", cell}, {"--ellipsoids", ellipsoids}};
    for (const auto& [name, is_given] : flags)
        if (is_given) given.emplace_back(name, "");
    return given;
}

std::string DrawingArguments::first_given() const {
    const auto all = given();
    return all.empty() ? std::string() : all.front().first;
}

} // namespace raylane::scenes
