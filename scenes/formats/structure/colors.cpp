#include "scenes/formats/structure/colors.hpp"

#include "core/scene/transfer.hpp"
#include "scenes/files/number.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace raylane::scenes {

namespace {

/// Okabe and Ito, "Color Universal Design" (2008), without black.
constexpr std::array<std::uint32_t, 7> apart_from_each_other = {
    0x0072b2, 0xe69f00, 0x009e73, 0xd55e00, 0x56b4e9, 0xcc79a7, 0xf0e442};

/// Kelly, "Twenty-two colors of maximum contrast" (1965), without white and black.
constexpr std::array<std::uint32_t, 20> many_apart = {
    0xf3c300, 0x875692, 0xf38400, 0xa1caf1, 0xbe0032, 0xc2b280, 0x848482,
    0x008856, 0xe68fac, 0x0067a5, 0xf99379, 0x604e97, 0xf6a600, 0xb3446c,
    0xdcd300, 0x882d17, 0x8db600, 0x654522, 0xe25822, 0x2b3d26};

/// Nine colours at equal distances.
struct Ramp {
    std::string_view name;
    std::array<std::uint32_t, 9> colors;
};

/// Viridis, magma and plasma: Smith and van der Walt (2015). Cividis: Nunez, Anderton and Renslow,
/// PLoS ONE 13, e0199239 (2018). Coolwarm, for values around a middle: Moreland (2009).
constexpr std::array<Ramp, 5> ramps = {
    {{"viridis",
      {0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c, 0x28ae80, 0x5ec962, 0xaddc30, 0xfde725}},
     {"cividis",
      {0x00224e, 0x1a386f, 0x434e6c, 0x61656f, 0x7d7c78, 0x9b9476, 0xbcae6c, 0xdec958, 0xfee838}},
     {"magma",
      {0x000004, 0x1d1147, 0x51127c, 0x832681, 0xb73779, 0xe75263, 0xfc8961, 0xfec488, 0xfcfdbf}},
     {"plasma",
      {0x0d0887, 0x4c02a1, 0x7e03a8, 0xaa2395, 0xcc4778, 0xe66c5c, 0xf89540, 0xfdc527, 0xf0f921}},
     {"coolwarm",
      {0x3b4cc0, 0x6282ea, 0x8db0fe, 0xb9d0f9, 0xdddcdc, 0xf5c4ac, 0xf4987a, 0xdd5f4b, 0xb40426}}}};

struct NamedColor {
    std::string_view name;
    std::uint32_t srgb;
};

/// Names of CSS Color Module Level 4.
/// All colours of CSS.
// clang-format off
constexpr std::array<NamedColor, 148> named_colors = {{
    {"black", 0x000000}, {"white", 0xffffff}, {"gray", 0x808080}, {"grey", 0x808080},
    {"lightgray", 0xd3d3d3}, {"lightgrey", 0xd3d3d3}, {"darkgray", 0xa9a9a9}, {"silver", 0xc0c0c0},
    {"dimgray", 0x696969}, {"red", 0xff0000}, {"darkred", 0x8b0000}, {"maroon", 0x800000},
    {"firebrick", 0xb22222}, {"crimson", 0xdc143c}, {"tomato", 0xff6347}, {"salmon", 0xfa8072},
    {"coral", 0xff7f50}, {"orange", 0xffa500}, {"darkorange", 0xff8c00}, {"gold", 0xffd700},
    {"yellow", 0xffff00}, {"khaki", 0xf0e68c}, {"wheat", 0xf5deb3}, {"tan", 0xd2b48c},
    {"beige", 0xf5f5dc}, {"ivory", 0xfffff0}, {"brown", 0xa52a2a}, {"chocolate", 0xd2691e},
    {"olive", 0x808000}, {"green", 0x008000}, {"lime", 0x00ff00}, {"darkgreen", 0x006400},
    {"forestgreen", 0x228b22}, {"lightgreen", 0x90ee90}, {"teal", 0x008080},
    {"turquoise", 0x40e0d0}, {"cyan", 0x00ffff}, {"lightblue", 0xadd8e6}, {"skyblue", 0x87ceeb},
    {"steelblue", 0x4682b4}, {"slategray", 0x708090}, {"blue", 0x0000ff}, {"navy", 0x000080},
    {"purple", 0x800080}, {"violet", 0xee82ee}, {"magenta", 0xff00ff}, {"orchid", 0xda70d6},
    {"pink", 0xffc0cb}, {"aliceblue", 0xf0f8ff}, {"antiquewhite", 0xfaebd7}, {"aqua", 0x00ffff},
    {"aquamarine", 0x7fffd4}, {"azure", 0xf0ffff}, {"bisque", 0xffe4c4},
    {"blanchedalmond", 0xffebcd}, {"blueviolet", 0x8a2be2}, {"burlywood", 0xdeb887},
    {"cadetblue", 0x5f9ea0}, {"chartreuse", 0x7fff00}, {"cornflowerblue", 0x6495ed},
    {"cornsilk", 0xfff8dc}, {"darkblue", 0x00008b}, {"darkcyan", 0x008b8b},
    {"darkgoldenrod", 0xb8860b}, {"darkgrey", 0xa9a9a9}, {"darkkhaki", 0xbdb76b},
    {"darkmagenta", 0x8b008b}, {"darkolivegreen", 0x556b2f}, {"darkorchid", 0x9932cc},
    {"darksalmon", 0xe9967a}, {"darkseagreen", 0x8fbc8f}, {"darkslateblue", 0x483d8b},
    {"darkslategray", 0x2f4f4f}, {"darkslategrey", 0x2f4f4f}, {"darkturquoise", 0x00ced1},
    {"darkviolet", 0x9400d3}, {"deeppink", 0xff1493}, {"deepskyblue", 0x00bfff},
    {"dimgrey", 0x696969}, {"dodgerblue", 0x1e90ff}, {"floralwhite", 0xfffaf0},
    {"fuchsia", 0xff00ff}, {"gainsboro", 0xdcdcdc}, {"ghostwhite", 0xf8f8ff},
    {"goldenrod", 0xdaa520}, {"greenyellow", 0xadff2f}, {"honeydew", 0xf0fff0},
    {"hotpink", 0xff69b4}, {"indianred", 0xcd5c5c}, {"indigo", 0x4b0082}, {"lavender", 0xe6e6fa},
    {"lavenderblush", 0xfff0f5}, {"lawngreen", 0x7cfc00}, {"lemonchiffon", 0xfffacd},
    {"lightcoral", 0xf08080}, {"lightcyan", 0xe0ffff}, {"lightgoldenrodyellow", 0xfafad2},
    {"lightpink", 0xffb6c1}, {"lightsalmon", 0xffa07a}, {"lightseagreen", 0x20b2aa},
    {"lightskyblue", 0x87cefa}, {"lightslategray", 0x778899}, {"lightslategrey", 0x778899},
    {"lightsteelblue", 0xb0c4de}, {"lightyellow", 0xffffe0}, {"limegreen", 0x32cd32},
    {"linen", 0xfaf0e6}, {"mediumaquamarine", 0x66cdaa}, {"mediumblue", 0x0000cd},
    {"mediumorchid", 0xba55d3}, {"mediumpurple", 0x9370db}, {"mediumseagreen", 0x3cb371},
    {"mediumslateblue", 0x7b68ee}, {"mediumspringgreen", 0x00fa9a}, {"mediumturquoise", 0x48d1cc},
    {"mediumvioletred", 0xc71585}, {"midnightblue", 0x191970}, {"mintcream", 0xf5fffa},
    {"mistyrose", 0xffe4e1}, {"moccasin", 0xffe4b5}, {"navajowhite", 0xffdead},
    {"oldlace", 0xfdf5e6}, {"olivedrab", 0x6b8e23}, {"orangered", 0xff4500},
    {"palegoldenrod", 0xeee8aa}, {"palegreen", 0x98fb98}, {"paleturquoise", 0xafeeee},
    {"palevioletred", 0xdb7093}, {"papayawhip", 0xffefd5}, {"peachpuff", 0xffdab9},
    {"peru", 0xcd853f}, {"plum", 0xdda0dd}, {"powderblue", 0xb0e0e6}, {"rebeccapurple", 0x663399},
    {"rosybrown", 0xbc8f8f}, {"royalblue", 0x4169e1}, {"saddlebrown", 0x8b4513},
    {"sandybrown", 0xf4a460}, {"seagreen", 0x2e8b57}, {"seashell", 0xfff5ee}, {"sienna", 0xa0522d},
    {"slateblue", 0x6a5acd}, {"slategrey", 0x708090}, {"snow", 0xfffafa}, {"springgreen", 0x00ff7f},
    {"thistle", 0xd8bfd8}, {"whitesmoke", 0xf5f5f5}, {"yellowgreen", 0x9acd32},
}};
// clang-format on

} // namespace

std::uint32_t color_between(std::span<const std::uint32_t> ramp, double share) {
    const auto steps = static_cast<int>(ramp.size()) - 1;
    const double place = share * steps;
    const int below = std::min(static_cast<int>(place), steps - 1);
    const double part = place - below;
    std::uint32_t color = 0;
    for (int shift = 16; shift >= 0; shift -= 8) {
        const auto channel = [&](int step) {
            return static_cast<double>(ramp[static_cast<std::size_t>(step)] >> shift & 255);
        };
        const double value = channel(below) + part * (channel(below + 1) - channel(below));
        color |= static_cast<std::uint32_t>(std::lround(value)) << shift;
    }
    return color;
}

std::uint32_t ramp_at(double share, std::string_view palette) {
    const auto* const named = std::find_if(ramps.begin(), ramps.end(),
                                           [&](const Ramp& ramp) { return ramp.name == palette; });
    const auto& ramp = (named != ramps.end() ? *named : ramps.front()).colors;
    // 64 colours are enough for the eye, and need few materials.
    return color_between(ramp, std::round(std::clamp(share, 0.0, 1.0) * 64.0) / 64.0);
}

std::uint32_t darker(std::uint32_t srgb) {
    return (srgb >> 1 & 0x7F7F7F) + (srgb >> 3 & 0x1F1F1F);
}

std::vector<std::string_view> palette_names() {
    std::vector<std::string_view> names;
    names.reserve(std::size(ramps));
    for (const Ramp& ramp : ramps)
        names.push_back(ramp.name);
    return names;
}

std::optional<std::uint32_t> color_named(std::string_view word) {
    if (word.starts_with('#')) return core::srgb_code_of(word);
    const std::string lower = in_lower_case(word);
    const auto* const found =
        std::find_if(named_colors.begin(), named_colors.end(),
                     [&](const NamedColor& color) { return color.name == lower; });
    if (found == named_colors.end()) return std::nullopt;
    return found->srgb;
}

std::vector<std::string_view> color_names() {
    std::vector<std::string_view> names;
    names.reserve(std::size(named_colors));
    for (const NamedColor& color : named_colors)
        names.push_back(color.name);
    return names;
}

std::uint32_t color_of_one(std::size_t place, std::size_t count) {
    if (count <= apart_from_each_other.size()) return apart_from_each_other[place];
    if (count <= many_apart.size()) return many_apart[place];
    return ramp_at(static_cast<double>(place) / static_cast<double>(count - 1));
}

std::uint32_t color_of_type(std::size_t number) {
    return apart_from_each_other[number % apart_from_each_other.size()];
}

core::MaterialIndex Palette::add(std::uint32_t srgb, std::string_view name) {
    core::Material material;
    material.pattern.colors[0] = core::color_from_srgb(srgb);
    material.ambient = 0.0F;
    material.specular = 0.15F;
    material.exponent = 20.0F;
    if (finish_ == Finish::matte || finish_ == Finish::print) material.specular = 0.0F;
    if (finish_ == Finish::glossy) {
        material.specular = 0.7F;
        material.exponent = 120.0F;
    }
    if (finish_ == Finish::flat) {
        material.ambient = 1.0F;
        material.diffuse = material.specular = 0.0F;
    }
    material.opacity = opacity_;
    const core::MaterialIndex index = builder_.add_material(material);
    builder_.name_material(index, name);
    return index;
}

} // namespace raylane::scenes
