#include "scenes/formats/structure/drawing_options.hpp"

#include "core/scene/transfer.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/files/words.hpp"
#include "scenes/formats/structure/colors.hpp"

#include <algorithm>
#include <functional>
#include <optional>

namespace raylane::scenes {

bool on_or_off_of(const std::string& option, const std::string& text) {
    return choice_named<bool>(option, text, {{"on", true}, {"off", false}});
}

namespace {

using SetOption =
    std::function<void(Drawing& drawing, const std::string& option, const std::string&)>;

/// Returns a setter of a text that `parse` accepts.
template <class Parse>
SetOption setter_of_text(std::string Drawing::*member, const Parse& parse) {
    return [=](Drawing& drawing, const std::string& option, const std::string& text) {
        static_cast<void>(parse(option, text));
        drawing.*member = text;
    };
}
template <class T, class Parse>
SetOption setter_of(T Drawing::*member, const Parse& parse) {
    return [=](Drawing& drawing, const std::string& option, const std::string& text) {
        drawing.*member = parse(option, text);
    };
}
SetOption setter_of_ellipsoids(Ellipsoids look) {
    return [=](Drawing& drawing, const std::string& option, const std::string& text) {
        if (on_or_off_of(option, text)) drawing.ellipsoids = std::max(drawing.ellipsoids, look);
    };
}

std::string any_text(const std::string&, const std::string& text) {
    return text;
}
Style style_of(const std::string& option, const std::string& text) {
    return choice_named(option, text, named_styles());
}
std::string palette_of(const std::string& option, const std::string& text) {
    return choice_named(option, text, named_palettes());
}
Finish finish_of(const std::string& option, const std::string& text) {
    return choice_named(option, text, named_finishes());
}
std::array<int, 3> repeat_of(const std::string& option, const std::string& text) {
    std::array<int, 3> result{};
    const std::vector<std::string_view> parts = parts_of(text, 'x');
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::optional<int> number = parts.size() == 3 ? to_int(parts[axis]) : std::nullopt;
        if (!number || *number < 1 || *number > 1000)
            refuse(option, "the number of cells along each edge, from 1 to 1000, such as 2x2x1",
                   text);
        result[axis] = *number;
    }
    return result;
}
float opacity_of(const std::string& option, const std::string& text) {
    const float value = to_float(text).value_or(0.0F);
    if (!(value > 0.0F && value <= 1.0F)) refuse(option, "above 0 and at most 1", text);
    return value;
}
float probability_of(const std::string& option, const std::string& text) {
    return 0.01F * number_between(option, text, 1.0F, 99.0F);
}
float depth_cue_of(const std::string& option, const std::string& text) {
    return number_between(option, text, 0.0F, 0.99F);
}

/// Adds a representation. Its messages name `option`.
void show(Drawing& drawing, const std::string& option, const std::string& text) {
    static_cast<void>(representation_of(option, text));
    drawing.show.push_back({text, option});
}

const std::vector<std::pair<std::string_view, SetOption>>& setters() {
    static const std::vector<std::pair<std::string_view, SetOption>> setters = {
        {"style", setter_of(&Drawing::style, style_of)},
        {"color", setter_of_text(&Drawing::color, color_words_of)},
        {"palette", setter_of(&Drawing::palette, palette_of)},
        {"range", setter_of(&Drawing::range, range_of)},
        {"radius", setter_of_text(&Drawing::radius, size_words_of)},
        {"scale", setter_of_text(&Drawing::scale_radii, size_words_of)},
        {"select", setter_of(&Drawing::select, any_text)},
        {"show", show},
        {"representations",
         [](Drawing& drawing, const std::string& option, const std::string& text) {
             show(drawing, option + "/" + std::to_string(drawing.show.size()), text);
         }},
        {"hide", [](Drawing& drawing, const std::string&,
                    const std::string& text) { drawing.hide.push_back(text); }},
        {"opacity", setter_of(&Drawing::opacity, opacity_of)},
        {"repeat", setter_of(&Drawing::repeat, repeat_of)},
        {"look", setter_of(&Drawing::finish, finish_of)},
        {"cut",
         [](Drawing& drawing, const std::string& option, const std::string& text) {
             drawing.cuts.push_back(cut_plane_of(option, text));
         }},
        {"slab", setter_of(&Drawing::slab, range_of)},
        {"cell-edges", setter_of(&Drawing::show_cell, on_or_off_of)},
        {"cell", setter_of(&Drawing::show_cell, on_or_off_of)},
        {"axes", setter_of(&Drawing::show_axes, on_or_off_of)},
        {"boundary", setter_of(&Drawing::boundary, on_or_off_of)},
        {"whole", setter_of(&Drawing::whole, on_or_off_of)},
        {"polyhedra",
         [](Drawing& drawing, const std::string& option, const std::string& text) {
             static_cast<void>(polyhedra_of(option, text));
             drawing.polyhedra.push_back(text);
         }},
        {"hydrogen-bonds", setter_of(&Drawing::hydrogen_bonds, on_or_off_of)},
        {"ellipsoids", setter_of_ellipsoids(Ellipsoids::plain)},
        {"ellipses", setter_of_ellipsoids(Ellipsoids::ellipses)},
        {"octants", setter_of_ellipsoids(Ellipsoids::octants)},
        {"probability", setter_of(&Drawing::probability, probability_of)},
        {"view", setter_of(&Drawing::view, view_named)},
        {"up", setter_of(&Drawing::up, upward_direction)},
        {"zoom",
         [](Drawing& drawing, const std::string& option, const std::string& text) {
             drawing.fit_camera.zoom = number_between(option, text, 0.01F, 1000.0F);
         }},
        {"depth-cue", setter_of(&Drawing::depth_cue, depth_cue_of)},
        {"background", setter_of(&Drawing::background,
                                 [](const std::string& option, const std::string& text) {
                                     return named_color_of(option, text);
                                 })},
        {"perspective", setter_of(&Drawing::perspective, on_or_off_of)},
        {"orthographic",
         [](Drawing& drawing, const std::string& option, const std::string& text) {
             if (on_or_off_of(option, text))
                 drawing.fit_camera.projection = core::Projection::orthographic;
         }},
    };
    return setters;
}

} // namespace

std::string listed_name(const std::string& option) {
    std::string name = option.substr(option.starts_with("--") ? 2 : 0);
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

void set_option(Drawing& drawing, const std::string& name, const std::string& text) {
    const std::string dashed = listed_name(name);
    std::vector<std::string_view> names = {"atom-style", "frame"}; // of readers
    for (const auto& [known, set] : setters()) {
        if (known == dashed) return set(drawing, name, text);
        names.push_back(known);
    }
    throw BadInput(printable(name, 40), "",
                   "must be the name of an option" + suggestion(dashed, names));
}

Drawing drawing_with(const DrawingOptions& options) {
    Drawing drawing;
    for (const auto& [name, text] : options)
        set_option(drawing, name, text);
    // With ellipsoids, atoms without displacements are balls.
    if (drawing.ellipsoids != Ellipsoids::none) {
        if (drawing.style == Style::automatic) drawing.style = Style::balls;
        return drawing;
    }
    const auto given = std::find_if(options.begin(), options.end(), [](const auto& option) {
        return option.first.ends_with("probability");
    });
    if (given != options.end()) {
        const std::string& name = given->first;
        const std::string dashes = name.starts_with("--") ? "--" : "";
        throw BadInput(name, "",
                       "goes with " + dashes + "ellipsoids, " + dashes + "ellipses or " + dashes +
                           "octants");
    }
    return drawing;
}

std::vector<std::pair<std::string_view, std::string>> named_palettes() {
    std::vector<std::pair<std::string_view, std::string>> names;
    for (const std::string_view name : palette_names())
        names.emplace_back(name, name);
    return names;
}

std::vector<std::pair<std::string_view, Finish>> named_finishes() {
    return {{"matte", Finish::matte},
            {"glossy", Finish::glossy},
            {"flat", Finish::flat},
            {"print", Finish::print}};
}

namespace {

/// Returns a colour of three parts from 0 to 1, such as "0.1,0.2,0.3".
std::optional<core::Color> color_of_parts(const std::string& text) {
    const std::vector<std::string_view> parts = parts_of(text, ',');
    if (parts.size() != 3) return std::nullopt;
    core::Color color(0.0F);
    for (int channel = 0; channel < 3; ++channel) {
        const std::optional<float> part = to_float(parts[static_cast<std::size_t>(channel)]);
        if (!part || !(*part >= 0.0F && *part <= 1.0F)) return std::nullopt;
        color[channel] = *part;
    }
    return color;
}

/// Returns a direction such as "1,-1,-0.5" or "-y"; nothing if it is malformed or 0.
std::optional<core::Vec3f> direction_in(const std::string& text) {
    constexpr std::pair<const char*, core::Vec3f> axes[] = {{"x", {1, 0, 0}},   {"y", {0, 1, 0}},
                                                            {"z", {0, 0, 1}},   {"-x", {-1, 0, 0}},
                                                            {"-y", {0, -1, 0}}, {"-z", {0, 0, -1}}};
    for (const auto& [name, axis] : axes)
        if (text == name) return axis;
    const std::vector<std::string_view> parts = parts_of(text, ',');
    if (parts.size() != 3) return std::nullopt;
    core::Vec3f direction(0.0F);
    for (int axis = 0; axis < 3; ++axis) {
        const std::optional<float> number = to_float(parts[static_cast<std::size_t>(axis)]);
        if (!number) return std::nullopt;
        direction[axis] = *number;
    }
    if (direction == core::Vec3f(0.0F)) return std::nullopt;
    return direction;
}

} // namespace

core::Color named_color_of(const std::string& option, const std::string& text,
                           const std::string& others) {
    if (const std::optional<core::Color> parts = color_of_parts(text)) return *parts;
    const std::optional<std::uint32_t> code = color_named(text);
    if (!code)
        throw BadInput(option, "",
                       "must be " + others +
                           "a colour such as black, #204060 or 0.1,0.2,0.3, got \"" +
                           printable(text) + '"' + suggestion(text, color_names()));
    return core::color_from_srgb(*code);
}

core::Vec3f upward_direction(const std::string& option, const std::string& text) {
    const std::optional<core::Vec3f> direction = direction_in(text);
    if (!direction) refuse(option, "x, y, z, -x, -y or -z, or a direction such as 0,1,1", text);
    return *direction;
}

core::NamedView view_named(const std::string& option, const std::string& text) {
    std::vector<std::string_view> names(std::begin(later_views), std::end(later_views));
    for (const std::string_view later : later_views)
        if (text == later) return {later, core::Vec3f(0.0F), core::Vec3f(0.0F)};
    for (const core::NamedView& view : core::named_views()) {
        names.push_back(view.name);
        if (text == view.name) return view;
    }
    // From the side opposite to x, y or z.
    for (const core::NamedView& view : core::named_views())
        if (view.name.size() == 1 && text == "-" + std::string(view.name))
            return {"", -view.direction, view.up};
    const std::optional<core::Vec3f> direction = direction_in(text);
    if (!direction)
        throw BadInput(option, "",
                       "must be " + alternatives({names.begin(), names.end()}) +
                           ", or a direction such as -y or 1,-1,-0.5, got \"" + printable(text) +
                           "\"" + suggestion(text, names));
    return {"", *direction, core::upright(*direction)};
}

} // namespace raylane::scenes
