#include "scenes/pov/includes.hpp"

#include <algorithm>
#include <array>

namespace raylane::scenes::pov {

namespace {

/// "#declare NAME = rgb <RED, GREEN, BLUE>;", of colors.inc: X11's colours, and others.
constexpr std::string_view colors =
    "Red 1 0 0; Green 0 1 0; Blue 0 0 1; Yellow 1 1 0; Cyan 0 1 1; Magenta 1 0 1; "
    "White 1 1 1; Black 0 0 0; Gray05 0.05 0.05 0.05; Gray10 0.1 0.1 0.1; "
    "Gray15 0.15 0.15 0.15; Gray20 0.2 0.2 0.2; Gray25 0.25 0.25 0.25; "
    "Gray30 0.3 0.3 0.3; Gray35 0.35 0.35 0.35; Gray40 0.4 0.4 0.4; "
    "Gray45 0.45 0.45 0.45; Gray50 0.5 0.5 0.5; Gray55 0.55 0.55 0.55; "
    "Gray60 0.6 0.6 0.6; Gray65 0.65 0.65 0.65; Gray70 0.7 0.7 0.7; "
    "Gray75 0.75 0.75 0.75; Gray80 0.8 0.8 0.8; Gray85 0.85 0.85 0.85; "
    "Gray90 0.9 0.9 0.9; Gray95 0.95 0.95 0.95; DimGray 0.329412 0.329412 0.329412; "
    "DimGrey 0.329412 0.329412 0.329412; Gray 0.752941 0.752941 0.752941; "
    "Grey 0.752941 0.752941 0.752941; LightGray 0.658824 0.658824 0.658824; "
    "LightGrey 0.658824 0.658824 0.658824; VLightGray 0.8 0.8 0.8; "
    "VLightGrey 0.8 0.8 0.8; Aquamarine 0.439216 0.858824 0.576471; "
    "BlueViolet 0.62352 0.372549 0.623529; Brown 0.647059 0.164706 0.164706; "
    "CadetBlue 0.372549 0.623529 0.623529; Coral 1 0.498039 0; "
    "CornflowerBlue 0.258824 0.258824 0.435294; "
    "DarkGreen 0.184314 0.309804 0.184314; "
    "DarkOliveGreen 0.309804 0.309804 0.184314; DarkOrchid 0.6 0.196078 0.8; "
    "DarkSlateBlue 0.119608 0.137255 0.556863; "
    "DarkSlateGray 0.184314 0.309804 0.309804; "
    "DarkSlateGrey 0.184314 0.309804 0.309804; "
    "DarkTurquoise 0.439216 0.576471 0.858824; Firebrick 0.556863 0.137255 0.137255; "
    "ForestGreen 0.137255 0.556863 0.137255; Gold 0.8 0.498039 0.196078; "
    "Goldenrod 0.858824 0.858824 0.439216; GreenYellow 0.576471 0.858824 0.439216; "
    "IndianRed 0.309804 0.184314 0.184314; Khaki 0.623529 0.623529 0.372549; "
    "LightBlue 0.74902 0.847059 0.847059; LightSteelBlue 0.560784 0.560784 0.737255; "
    "LimeGreen 0.196078 0.8 0.196078; Maroon 0.556863 0.137255 0.419608; "
    "MediumAquamarine 0.196078 0.8 0.6; MediumBlue 0.196078 0.196078 0.8; "
    "MediumForestGreen 0.419608 0.556863 0.137255; "
    "MediumGoldenrod 0.917647 0.917647 0.678431; "
    "MediumOrchid 0.576471 0.439216 0.858824; "
    "MediumSeaGreen 0.258824 0.435294 0.258824; MediumSlateBlue 0.498039 0 1; "
    "MediumSpringGreen 0.498039 1 0; MediumTurquoise 0.439216 0.858824 0.858824; "
    "MediumVioletRed 0.858824 0.439216 0.576471; "
    "MidnightBlue 0.184314 0.184314 0.309804; Navy 0.137255 0.137255 0.556863; "
    "NavyBlue 0.137255 0.137255 0.556863; Orange 1 0.5 0; OrangeRed 1 0.25 0; "
    "Orchid 0.858824 0.439216 0.858824; PaleGreen 0.560784 0.737255 0.560784; "
    "Pink 0.737255 0.560784 0.560784; Plum 0.917647 0.678431 0.917647; "
    "Salmon 0.435294 0.258824 0.258824; SeaGreen 0.137255 0.556863 0.419608; "
    "Sienna 0.556863 0.419608 0.137255; SkyBlue 0.196078 0.6 0.8; "
    "SlateBlue 0 0.498039 1; SpringGreen 0 1 0.498039; "
    "SteelBlue 0.137255 0.419608 0.556863; Tan 0.858824 0.576471 0.439216; "
    "Thistle 0.847059 0.74902 0.847059; Turquoise 0.678431 0.917647 0.917647; "
    "Violet 0.309804 0.184314 0.309804; VioletRed 0.8 0.196078 0.6; "
    "Wheat 0.847059 0.847059 0.74902; YellowGreen 0.6 0.8 0.196078; "
    "SummerSky 0.22 0.69 0.87; RichBlue 0.35 0.35 0.67; Brass 0.71 0.65 0.26; "
    "Copper 0.72 0.45 0.2; Bronze 0.55 0.47 0.14; Bronze2 0.65 0.49 0.24; "
    "Silver 0.9 0.91 0.98; BrightGold 0.85 0.85 0.1; OldGold 0.81 0.71 0.23; "
    "Feldspar 0.82 0.57 0.46; Quartz 0.85 0.85 0.95; Mica 0 0 0; "
    "NeonPink 1 0.43 0.78; DarkPurple 0.53 0.12 0.47; NeonBlue 0.3 0.3 1; "
    "CoolCopper 0.85 0.53 0.1; MandarinOrange 0.89 0.47 0.2; "
    "LightWood 0.91 0.76 0.65; MediumWood 0.65 0.5 0.39; DarkWood 0.52 0.37 0.26; "
    "SpicyPink 1 0.11 0.68; SemiSweetChoc 0.42 0.26 0.15; BakersChoc 0.36 0.2 0.09; "
    "Flesh 0.96 0.8 0.69; NewTan 0.92 0.78 0.62; NewMidnightBlue 0 0 0.61; "
    "VeryDarkBrown 0.35 0.16 0.14; DarkBrown 0.36 0.25 0.2; DarkTan 0.59 0.41 0.31; "
    "GreenCopper 0.32 0.49 0.46; DkGreenCopper 0.29 0.46 0.43; "
    "DustyRose 0.52 0.39 0.39; HuntersGreen 0.13 0.37 0.31; Scarlet 0.55 0.09 0.09; "
    "Med_Purple 0.73 0.16 0.96; Light_Purple 0.87 0.58 0.98; "
    "Very_Light_Purple 0.94 0.81 0.99; ";

/// Of metals.inc: ambient, brilliance, diffuse, specular, 1 / roughness, reflection.
constexpr std::string_view metals = R"(
#macro Metal_(A, B, D, S, R, M)
  finish { ambient A brilliance B diffuse D metallic specular S roughness 1/R reflection M }
#end
#declare F_MetalA = Metal_(0.35, 2, 0.3, 0.8, 20, 0.1)
#declare F_MetalB = Metal_(0.30, 3, 0.4, 0.7, 60, 0.25)
#declare F_MetalC = Metal_(0.25, 4, 0.5, 0.8, 80, 0.5)
#declare F_MetalD = Metal_(0.15, 5, 0.6, 0.8, 100, 0.65)
#declare F_MetalE = Metal_(0.10, 6, 0.7, 0.8, 120, 0.8)
)";

constexpr std::string_view finishes = R"(
#declare Dull = finish { specular 0.5 roughness 0.15 }
#declare Shiny = finish { specular 1 roughness 0.001 }
#declare Phong_Dull = finish { phong 0.5 phong_size 1 }
#declare Phong_Shiny = finish { phong 1 phong_size 200 }
#declare Glossy = finish { specular 1 roughness 0.0001 reflection 0.13 }
#declare Phong_Glossy = finish { phong 1 phong_size 300 reflection 0.13 }
#declare Luminous = finish { ambient 1 diffuse 0 }
#declare Mirror = finish { ambient 0 diffuse 0 reflection 1 }
)";

/// What of glass.inc has no dependence on depth.
constexpr std::string_view glass = R"(
#declare I_Glass = interior { ior 1.5 }
#declare F_Glass1 = finish { specular 1 roughness 0.001 ambient 0 diffuse 0 reflection 0.1 }
)";

constexpr std::string_view transforms = R"(
#macro Axis_Rotate_Trans(Axis_, Angle_)
  #local X_ = vaxis_rotate(x, Axis_, Angle_);
  #local Y_ = vaxis_rotate(y, Axis_, Angle_);
  #local Z_ = vaxis_rotate(z, Axis_, Angle_);
  transform { matrix <X_.x, X_.y, X_.z, Y_.x, Y_.y, Y_.z, Z_.x, Z_.y, Z_.z, 0, 0, 0> }
#end
#macro Rotate_Around_Trans(Rotation_, Point_)
  transform { translate -Point_ rotate Rotation_ translate Point_ }
#end
)";

std::string color_declarations() {
    std::string text = "#declare Clear = rgbf 1;\n";
    std::string_view left = colors;
    while (!left.empty()) {
        const std::size_t end = left.find("; ");
        std::string row(left.substr(0, end));
        left.remove_prefix(end + 2);
        const std::size_t name = row.find(' ');
        text += "#declare " + row.substr(0, name) + " = rgb <";
        std::replace(row.begin(), row.end(), ' ', ',');
        text += row.substr(name + 1) + ">;\n";
    }
    return text;
}

} // namespace

std::optional<std::string> standard_include(std::string_view name) {
    static constexpr std::array<std::string_view, 11> without_use = {
        "arrays.inc", "consts.inc",  "functions.inc", "golds.inc", "math.inc",   "rand.inc",
        "shapes.inc", "shapes2.inc", "stones.inc",    "woods.inc", "strings.inc"};
    if (name == "colors.inc") return color_declarations();
    if (name == "finish.inc" || name == "textures.inc") return std::string(finishes);
    if (name == "metals.inc") return std::string(metals);
    if (name == "glass.inc") return std::string(glass);
    if (name == "transforms.inc") return std::string(transforms);
    if (name == "stdinc.inc") return color_declarations().append(finishes).append(transforms);
    // Their names are not known where they are used.
    if (std::find(without_use.begin(), without_use.end(), name) != without_use.end()) return "";
    return std::nullopt;
}

} // namespace raylane::scenes::pov
