#include "scenes/tool/drawing_arguments.hpp"

#include "scenes/tool/arguments.hpp"

#include <cmath>

namespace raylane::scenes {

namespace {

constexpr const char* group = "Atoms (PDB, mmCIF, CIF, XYZ, GRO, LAMMPS)";

/// Where a camera looks to, and what is up for it.
struct View {
    std::string_view name;
    core::Vec3f direction, up;
};
constexpr float side = 0.5F;
const View views[] = {
    {"front", {0, 0, -1}, {0, 1, 0}}, {"back", {0, 0, 1}, {0, 1, 0}},
    {"right", {-1, 0, 0}, {0, 1, 0}}, {"left", {1, 0, 0}, {0, 1, 0}},
    {"top", {0, -1, 0}, {0, 0, -1}},  {"bottom", {0, 1, 0}, {0, 0, 1}},
    {"x", {-1, 0, 0}, {0, 0, 1}},     {"y", {0, -1, 0}, {0, 0, 1}},
    {"z", {0, 0, -1}, {0, 1, 0}},     {"corner", {-1, -side, -0.7F}, {0, 1, 0}},
};

/// A view by name, or the direction that the camera looks in, as "1,-1,-0.5".
void set_view(const std::string& text, core::Framing& framing) {
    std::vector<std::string_view> names;
    for (const View& view : views) {
        names.push_back(view.name);
        if (text != view.name) continue;
        framing.direction = view.direction;
        framing.up = view.up;
        return;
    }
    core::Vec3f direction(0.0F);
    std::string_view rest = text;
    bool is_direction = true;
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t end = rest.find(',');
        const std::optional<float> number = to_float(rest.substr(0, end));
        is_direction = is_direction && number && (end == std::string_view::npos) == (axis == 2);
        if (!is_direction) break;
        direction[axis] = *number;
        rest.remove_prefix(std::min(end, rest.size() - 1) + 1);
    }
    if (!is_direction || direction == core::Vec3f(0.0F))
        throw BadInput("--view", "",
                       "must be " + alternatives({names.begin(), names.end()}) +
                           ", or a direction such as 1,-1,-0.5, got \"" + printable(text) + "\"" +
                           suggestion(text, names));
    framing.direction = direction;
    // The axis that is upright in most pictures; if that is what one looks along, the next.
    const bool is_steep = std::abs(direction.y) > 100.0F * std::hypot(direction.x, direction.z);
    framing.up = is_steep ? core::Vec3f(0, 0, -1) : core::Vec3f(0, 1, 0);
}

std::array<int, 3> repeat_argument(const std::string& text) {
    std::array<int, 3> result{};
    std::string_view rest = text;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t end = rest.find('x');
        const std::optional<int> number = to_int(rest.substr(0, end));
        if (!number || *number < 1 || *number > 1000 ||
            (end == std::string_view::npos) != (axis == 2))
            throw BadInput("--repeat", "",
                           "must be how many cells along each edge, from 1 to 1000, such as 2x2x1, "
                           "got \"" +
                               printable(text) + "\"");
        result[axis] = *number;
        rest.remove_prefix(std::min(end, rest.size() - 1) + 1);
    }
    return result;
}

} // namespace

void DrawingArguments::add_to(CLI::App& command) {
    const auto add = [&](const char* name, Argument& value, const char* help, const char* type) {
        add_option(command, name, value, help, type)->group(group);
    };
    add("--style", style,
        "balls (and sticks), sticks, licorice, spheres (van der Waals' radii) or points (default: "
        "balls of up to 500 atoms, spheres of more)",
        "balls|sticks|licorice|spheres|points");
    add("--color", color,
        "By element, chain, residue, or a number that the file has for each atom, such as b_factor "
        "(default: element)",
        "BY");
    add("--select", select,
        "The atoms to draw, such as \"chain A and not water\" or \"within 5 of residue HEM\" "
        "(default: all)",
        "WHICH");
    add("--view", view,
        "front, back, left, right, top, bottom, x, y, z, corner, or the direction that the camera "
        "looks in, such as 1,-1,-0.5 (default: front)",
        "WAY");
    add("--zoom", zoom, "How much larger than the whole (default: 1)", "TIMES");
    add("--depth-cue", depth_cue,
        "How much of the page's white the farthest atoms have, 0 to 0.99 (default: 0.3)", "SHARE");
    add("--repeat", repeat, "Cells side by side, such as 2x2x1", "AxBxC");
    const auto flag = [&](const char* name, bool& value, const char* help) {
        add_flag(command, name, value, help);
        command.get_option(name)->group(group);
    };
    flag("--cell", cell, "Show the cell's edges");
    flag("--ellipsoids", ellipsoids,
         "Draw atoms with displacements (ANISOU) as ellipsoids of half their probability");
    flag("--orthographic", orthographic, "Without perspective");
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
    if (repeat) drawing.repeat = repeat_argument(*repeat);
    drawing.show_cell = cell;
    drawing.ellipsoids = ellipsoids;
    if (view) set_view(*view, drawing.framing);
    if (zoom) drawing.framing.zoom = number_argument("--zoom", *zoom, 0.01F, 1000.0F);
    if (orthographic) drawing.framing.projection = core::Projection::orthographic;
    if (depth_cue) drawing.depth_cue = number_argument("--depth-cue", *depth_cue, 0.0F, 0.99F);
    return drawing;
}

std::vector<std::pair<std::string, std::string>> DrawingArguments::given() const {
    std::vector<std::pair<std::string, std::string>> given;
    const std::pair<const char*, const Argument&> values[] = {
        {"--style", style}, {"--color", color},         {"--select", select}, {"--view", view},
        {"--zoom", zoom},   {"--depth-cue", depth_cue}, {"--repeat", repeat}};
    for (const auto& [name, value] : values)
        if (value) given.emplace_back(name, *value);
    const std::pair<const char*, bool> flags[] = {
        {"--cell", cell}, {"--ellipsoids", ellipsoids}, {"--orthographic", orthographic}};
    for (const auto& [name, is_given] : flags)
        if (is_given) given.emplace_back(name, "");
    return given;
}

std::string DrawingArguments::first_given() const {
    const auto all = given();
    return all.empty() ? std::string() : all.front().first;
}

} // namespace raylane::scenes
