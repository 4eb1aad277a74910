#pragma once

#include "core/scene/appearance.hpp"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

/// The one list of the fields of materials, patterns, glass, lights, fog, cameras, outlines and
/// settings. The checks, the JSON reader and writer, the conversions of the library, of C and of
/// Python, and the tests of the schema and of the pages follow from it. It includes enumerators
/// alone, because it serves any struct with these members.
namespace raylane::core::fields {

/// The words of an enumeration, as in JSON. Python has _ in place of -.
using Words = std::span<const char* const>;

inline constexpr const char* pattern_words[] = {"solid",   "checker", "stripes", "gradient",
                                                "formula", "image",   "cutaway"};
inline constexpr const char* space_words[] = {"world", "object"};
inline constexpr const char* wrap_words[] = {"repeat", "clamp"};
inline constexpr const char* reflection_words[] = {"constant", "schlick", "dielectric"};
inline constexpr const char* highlight_words[] = {"blinn", "phong"};
inline constexpr const char* visible_words[] = {"both", "outside", "inside"};
inline constexpr const char* light_words[] = {"point",  "directional", "sky",
                                              "sphere", "disc",        "rectangle"};
inline constexpr const char* fog_words[] = {"none", "linear-z", "linear", "exponential"};
inline constexpr const char* projection_words[] = {"perspective", "orthographic"};
inline constexpr const char* transfer_words[] = {"srgb", "linear"};
inline constexpr const char* sample_words[] = {"regular", "stratified"};
inline constexpr const char* filter_words[] = {"box", "gaussian", "blackman-harris"};

enum class Rule : std::uint8_t {
    word,        ///< one of `words`
    flag,        ///< true or false
    count,       ///< a whole number from `least` to `most`
    number,      ///< from `least` to `most`
    inside,      ///< between `least` and `most`, without the ends
    number_or_0, ///< 0, or from `least` to `most`
    positive,    ///< above 0, at most `most`
    direction,   ///< three numbers from `least` to `most` that are not all 0
    axes,        ///< a bit for each axis
    formula,     ///< three texts, for red, green and blue
    image,       ///< the pixels; in files, the name of a file
    several,     ///< a struct with its own list, or several numbers
};

/// The values of a field that are valid, and their unit. A vector, or each of several vectors, has
/// the valid values of its components.
struct Valid {
    Rule rule;
    double least = 0.0, most = 0.0;
    const char* unit = "";
    Words words{};
    int hidden_words = 0;  ///< at the start of `words`: JSON expresses them without this field
    bool is_color = false; ///< in JSON also "#rrggbb"
};

inline constexpr double limit = 1e30; ///< of coordinates and lengths
inline constexpr Valid flag{Rule::flag}, axes{Rule::axes}, formula{Rule::formula},
    image{Rule::image}, several{Rule::several}, fraction{Rule::number, 0.0, 1.0},
    brightness{Rule::number, 0.0, 1e10}, not_negative{Rule::number, 0.0, limit},
    positive{Rule::positive, 0.0, limit}, coordinate{Rule::number, -limit, limit, "length"},
    distance{Rule::number, 0.0, limit, "length"}, length{Rule::positive, 0.0, limit, "length"},
    length_or_infinity{Rule::positive, 0.0, std::numeric_limits<double>::infinity(), "length"},
    density{Rule::positive, 0.0, limit, "1 / length"}, direction{Rule::direction, -limit, limit},
    color{Rule::number, 0.0, 1e10, "", {}, 0, true};

constexpr Valid word(Words words, int hidden = 0) {
    return {Rule::word, 0.0, 0.0, "", words, hidden};
}
constexpr Valid count(int least, int most, const char* unit = "") {
    return {Rule::count, static_cast<double>(least), static_cast<double>(most), unit};
}
constexpr Valid between(double least, double most, const char* unit, Rule rule = Rule::number) {
    return {rule, least, most, unit};
}

inline constexpr Valid pattern_kind = word(pattern_words, 1), light_kind = word(light_words),
                       fog_kind = word(fog_words, 1), projection = word(projection_words);

/// Kinds of a struct, such as the kinds of lights: a bit for each enumerator.
using Kinds = unsigned;
inline constexpr Kinds every = ~0U;

/// Returns the kinds with these words. A word that does not exist does not compile.
template <class... Names>
consteval Kinds kinds(Words words, Names... names) {
    Kinds bits = 0;
    for (const std::string_view name : {std::string_view(names)...}) {
        std::size_t i = 0;
        while (words[i] != name)
            ++i;
        bits |= 1U << i;
    }
    return bits;
}

/// Kinds that use a field, and kinds whose objects in JSON must have it.
struct Use {
    Kinds used = every, required = 0;
    bool selects_kind = false; ///< the field is the kind itself
};
constexpr Use must(Kinds kinds = every) {
    return {kinds, kinds};
}
constexpr Use may(Kinds kinds) {
    return {kinds};
}
inline constexpr Use selects_kind{every, every, true};

/// Features of a field in files and in Python.
struct Spelling {
    const char* key = nullptr;    ///< in JSON, if it is not `name`
    const char* python = nullptr; ///< in Python, if it is not `name`
    const char* group = "";       ///< settings: the object in JSON that has the field
    bool sparse = false;          ///< files omit the default value
    int first_bit = 0;            ///< of axes
};
inline constexpr Spelling sparse{.sparse = true};
constexpr Spelling key(const char* name, const char* group = "") {
    return {.key = name, .group = group};
}
constexpr Spelling in_python(const char* name) {
    return {.python = name};
}
constexpr Spelling in(const char* group, bool is_sparse = false) {
    return {.group = group, .sparse = is_sparse};
}

/// Description of one field. A member has several fields if they differ between kinds.
struct Field {
    constexpr Field(const char* name_, const Valid& valid_, const char* about_, Use use_ = {},
                    Spelling spelling_ = {})
        : name(name_), valid(valid_), about(about_), use(use_), spelling(spelling_) {}
    constexpr Field(const char* name_, const Valid& valid_, const char* about_, Spelling spelling_)
        : Field(name_, valid_, about_, Use{}, spelling_) {}

    const char* name; ///< of the member
    Valid valid;
    const char* about; ///< the beginning of its description in the schema
    Use use;
    Spelling spelling;

    /// Returns true if an object of this group in JSON has the field. Only settings have groups.
    constexpr bool is_in(std::string_view group, Kinds kind) const {
        return (use.used & kind) != 0 && spelling.group == group;
    }
    constexpr std::string_view key() const { return spelling.key ? spelling.key : name; }
    constexpr const char* python() const { return spelling.python ? spelling.python : name; }
};

template <class T>
concept PatternLike = requires(T object) {
    object.colors;
};
template <class T>
concept GlassLike = requires(T object) {
    object.B;
};
template <class T>
concept MaterialLike = requires(T object) {
    object.reflectivity;
};
template <class T>
concept LightLike = requires(T object) {
    object.reach;
};
template <class T>
concept FogLike = requires(T object) {
    object.density;
};
template <class T>
concept CameraLike = requires(T object) {
    object.lens_radius;
};
template <class T>
concept OutlineLike = requires(T object) {
    object.creases;
};
template <class T>
concept SettingsLike = requires(T object) {
    object.max_depth;
};
// The C interface lacks this field.
template <class T>
concept HasAlpha = requires(T object) {
    object.alpha;
};

/// The functions for_each_field() call visit(field, a.member, b.member, ...) for each field of one
/// or more structs, in the order of files.
template <class Visit, PatternLike... Of>
constexpr void for_each_field(const Visit& visit, Of&... of) {
    constexpr Kinds checker = kinds(pattern_words, "checker"),
                    stripes = kinds(pattern_words, "stripes"),
                    gradient = kinds(pattern_words, "gradient"),
                    formulas = kinds(pattern_words, "formula"),
                    images = kinds(pattern_words, "image");
    visit(Field("kind", pattern_kind, "Kind of pattern.", selects_kind, key("type")), of.kind...);
    visit(Field("colors", color, "The two colors", must(checker | stripes | gradient)),
          of.colors...);
    visit(Field("size", length, "Edge length of a cell.", must(checker)), of.size...);
    visit(Field("size", length, "Width of a band.", must(stripes), key("width")), of.size...);
    visit(Field("axes", axes, "Coordinates along which the color alternates.", may(checker)),
          of.axes...);
    visit(Field("axes", axes,
                "Coordinates along which a cell contains its upper edge instead of its lower one.",
                may(checker),
                {.key = "upper_edges", .python = "upper_edges", .sparse = true, .first_bit = 3}),
          of.axes...);
    visit(Field("direction", direction, "Direction across the bands.", may(stripes)),
          of.direction...);
    visit(Field("from", coordinate, "Start of the transition.", must(gradient), in_python("start")),
          of.from...);
    visit(Field("to", coordinate, "End of the transition;", must(gradient), in_python("end")),
          of.to...);
    visit(
        Field("formula", formula, "Formulas of red, green and blue", must(formulas), key("color")),
        of.formula...);
    visit(Field("space", word(space_words), "Coordinates of the points.",
                may(checker | stripes | gradient | formulas), sparse),
          of.space...);
    visit(Field("image", image, "PNG file", must(images), key("file")), of.image...);
    visit(Field("width", length, "Extent of the image along u.", may(images), sparse), of.width...);
    visit(Field("height", length, "Extent of the image along v.", may(images), sparse),
          of.height...);
    visit(Field("wrap", word(wrap_words), "Colors beyond the edges of the image.", may(images),
                sparse),
          of.wrap...);
    visit(Field("axis", direction, "Axis of spheres and ellipsoids", may(images), sparse),
          of.axis...);
}

template <class Visit, GlassLike... Of>
constexpr void for_each_field(const Visit& visit, Of&... of) {
    visit(Field("B", several, "Without a unit.", must()), of.B...);
    visit(Field("C", several, "In square micrometres.", must()), of.C...);
}

} // namespace raylane::core::fields

namespace raylane::core {

/// Sides from which a surface is visible. Rays pass the other side as if nothing were there. A
/// shadow ray looks from a surface to the light.
enum class Visible : std::uint8_t { both, outside, inside };

/// The colour seen along a ray that hits this material. Symbols: light l of colour L_l; unit
/// vectors n (normal), l (to the light) and h (halfway between l and the viewer; for Phong's
/// highlight n.h stands for the cosine between l and the reflected ray); S the share of
/// the light that the shadow lets through; C the pattern's colour; R the reflected fraction. The
/// colour is
///   C ambient + sum_l S L_l (C diffuse max(n.l, 0) + specular max(n.h, 0)^exponent)
///   + R (colour reflected) + (1 - R) transmission (colour transmitted)
/// This counts with weight `opacity`, and the colour straight behind the surface with 1 - opacity.
///
/// `Material` names it. A new member has its default here and its description in the list below.
template <class Vec3, class Pattern, class Glass>
struct MaterialOf {
    Pattern pattern{};
    float ambient = 0.1F;   ///< >= 0
    float diffuse = 0.8F;   ///< >= 0
    float specular = 0.0F;  ///< >= 0, of the highlight, in the light's colour
    float exponent = 32.0F; ///< >= 0
    Highlight highlight = Highlight::blinn;
    Reflection reflection = Reflection::constant;
    float reflectivity = 0.0F; ///< [0, 1]
    float transmission = 0.0F; ///< [0, 1] per surface crossed; 0 is opaque
    float index = 1.5F;        ///< index of refraction, > 0; empty space has 1
    Glass glass{}; ///< if set, `index` is its n_d, or its index at each wavelength of a scene
    /// Per unit of length inside, >= 0 (Beer-Lambert: exp(-absorption * length)).
    Vec3 absorption{};
    /// [0, 1]: the share of the colour that comes from the surface, as with paint on a pane. The
    /// rest comes from straight behind it. Unlike transmitted light, the rest is not refracted,
    /// absorbed, or reduced by reflections.
    float opacity = 1.0F;
    Visible visible = Visible::both;

    bool transmits() const { return transmission > 0.0F; }
    bool is_transparent() const { return opacity < 1.0F; }
    /// Returns true if light may pass it in any way.
    bool lets_light_pass() const { return transmits() || is_transparent(); }
    bool reflects() const { return reflection != Reflection::constant || reflectivity > 0.0F; }
    /// Returns true if a ray that enters (or leaves) here sees the surface.
    bool is_seen(bool entering) const {
        return visible == Visible::both || (visible == Visible::outside) == entering;
    }
};

} // namespace raylane::core

namespace raylane::core::fields {

template <class Visit, MaterialLike... Of>
constexpr void for_each_field(const Visit& visit, Of&... of) {
    visit(Field("pattern", several,
                "Color as a function of the point in space, or an image on the surface.",
                in_python("color")),
          of.pattern...);
    visit(Field("ambient", brightness, "Weight of the color without any light."), of.ambient...);
    visit(Field("diffuse", brightness, "Weight of the color in light from straight above."),
          of.diffuse...);
    visit(Field("specular", brightness, "Weight of the light's color at the center of a highlight"),
          of.specular...);
    visit(Field("exponent", not_negative, "Sharpness of the highlight."), of.exponent...);
    visit(Field("highlight", word(highlight_words), "Cosine whose power is the highlight", sparse),
          of.highlight...);
    visit(Field("reflection", word(reflection_words, 1), "Computes the reflected fraction"),
          of.reflection...);
    visit(Field("reflectivity", fraction, "Reflected fraction, the same at every angle."),
          of.reflectivity...);
    visit(
        Field("transmission", fraction, "Transmitted fraction of the light that is not reflected"),
        of.transmission...);
    visit(Field("opacity", fraction, "Weight of the surface's color.", sparse), of.opacity...);
    visit(Field("index", positive, "Index of refraction; outside of all shapes it is 1."),
          of.index...);
    visit(Field("glass", several, "Replaces index: glass by name, or by the coefficients"),
          of.glass...);
    visit(Field("absorption", not_negative, "Absorption [red, green, blue] per unit of length"),
          of.absorption...);
    visit(Field("visible", word(visible_words), "Sides from which the surface is visible.", sparse),
          of.visible...);
}

template <class Visit, LightLike... Of>
constexpr void for_each_field(const Visit& visit, Of&... of) {
    constexpr Kinds sky = kinds(light_words, "sky"), rectangle = kinds(light_words, "rectangle"),
                    round = kinds(light_words, "sphere", "disc");
    visit(Field("kind", light_kind, "Kind of light.", selects_kind, key("type")), of.kind...);
    visit(Field("position", coordinate, "Position of the light; not on a surface.",
                must(kinds(light_words, "point") | round | rectangle)),
          of.position...);
    constexpr Kinds directed = kinds(light_words, "directional", "disc");
    visit(Field("direction", direction, "Direction in which the light travels.",
                Use{directed | sky, directed}),
          of.direction...);
    visit(Field("color", color, "Color of the light."), of.color...);
    visit(Field("ground", color, "Color of the nadir.", may(sky)), of.ground...);
    visit(Field("reach", length_or_infinity,
                "Shapes farther than this from a surface do not shade it.", may(sky), sparse),
          of.reach...);
    visit(Field("radius", length, "Radius.", must(round)), of.radius...);
    visit(Field("edge_u", direction, "Edge from that corner.", must(rectangle)), of.edge_u...);
    visit(Field("edge_v", direction, "Other edge from that corner", must(rectangle)), of.edge_v...);
}

template <class Visit, FogLike... Of>
constexpr void for_each_field(const Visit& visit, Of&... of) {
    constexpr Kinds by_z = kinds(fog_words, "linear-z"), by_distance = kinds(fog_words, "linear"),
                    exponential = kinds(fog_words, "exponential");
    visit(Field("kind", fog_kind, "Kind of fog.", selects_kind, key("type")), of.kind...);
    visit(Field("color", color, "Color of the fog.", may(by_z | by_distance | exponential)),
          of.color...);
    visit(Field("start", coordinate, "World z where the fraction is 0.", must(by_z)), of.start...);
    visit(Field("start", distance, "Distance where the fog begins.", must(by_distance)),
          of.start...);
    visit(Field("end", coordinate, "World z where the fraction is 1;", must(by_z)), of.end...);
    visit(Field("end", length, "Distance from which only fog is visible;", must(by_distance)),
          of.end...);
    visit(Field("density", density, "Density per unit of length.", must(exponential)),
          of.density...);
}

template <class Visit, CameraLike... Of>
constexpr void for_each_field(const Visit& visit, Of&... of) {
    constexpr Kinds perspective = kinds(projection_words, "perspective"),
                    orthographic = kinds(projection_words, "orthographic");
    visit(Field("projection", projection, "Kind of camera.", Use{every, orthographic, true},
                key("type")),
          of.projection...);
    visit(Field("from", coordinate, "Position of the camera.", must(), in_python("position")),
          of.from...);
    visit(Field("at", coordinate, "Point at the center of the image;", must()), of.at...);
    visit(Field("up", direction, "Upward direction in the image;"), of.up...);
    visit(Field("field_of_view", between(0.0, 180.0, "degrees", Rule::inside),
                "Degrees from the lower to the upper edge of the image.", may(perspective)),
          of.field_of_view...);
    visit(Field("height", length, "Height of the image", must(orthographic)), of.height...);
    visit(Field("lens_radius", distance, "Radius of the thin lens", sparse), of.lens_radius...);
    visit(
        Field("focus_distance", distance, "Distance from the lens to the plane of focus.", sparse),
        of.focus_distance...);
}

template <class Visit, OutlineLike... Of>
constexpr void for_each_field(const Visit& visit, Of&... of) {
    visit(Field("width", between(0.0, 32.0, "pixels"), "Width of the lines in pixels", must()),
          of.width...);
    visit(Field("color", color, "Color of the lines."), of.color...);
    visit(
        Field("creases", between(0.0, 180.0, "degrees"), "Degrees. Surfaces that meet have a line"),
        of.creases...);
}

template <class Visit, SettingsLike... Of>
constexpr void for_each_field(const Visit& visit, Of&... of) {
    constexpr Valid side = count(1, 65535, "pixels");
    visit(Field("width", side, "Width in pixels.", in("image")), of.width...);
    visit(Field("height", side, "Height in pixels.", in("image")), of.height...);
    visit(Field("transfer", word(transfer_words), "Transfer curve from linear color", in("image")),
          of.transfer...);
    if constexpr ((HasAlpha<Of> && ...))
        visit(Field("alpha", flag, "True: the image omits the background", in("image", true)),
              of.alpha...);
    visit(Field("grid", count(1, 256), "Samples in each direction.", in("sampling")), of.grid...);
    visit(
        Field("samples", word(sample_words), "Places of the samples.", key("pattern", "sampling")),
        of.samples...);
    visit(Field("filter", word(filter_words), "Reconstruction filter of a pixel.",
                in("sampling", true)),
          of.filter...);
    visit(Field("light_samples", count(-1, 4096), "Shadow rays to each light with a size",
                in("sampling", true)),
          of.light_samples...);
    visit(Field("quality", between(10.0, 80.0, "decibels", Rule::number_or_0),
                "PSNR of the image against a converged one, in decibels;", in("sampling", true)),
          of.quality...);
    visit(Field("transparent_shadows", flag,
                "False: surfaces of opacity below 1 and glass cast no shadows",
                in("sampling", true)),
          of.transparent_shadows...);
    visit(Field("max_depth", count(0, 1000), "Maximum number of reflections and refractions",
                in("limits")),
          of.max_depth...);
    visit(Field("min_weight", fraction, "A path ends when its largest possible contribution",
                in("limits")),
          of.min_weight...);
    visit(Field("max_transparent", count(1, 1'000'000),
                "Maximum number of surfaces of opacity below 1 that are visible",
                in("limits", true)),
          of.max_transparent...);
    visit(
        Field("outline", several, "Lines where one surface is in front of another", in("outline")),
        of.outline...);
}

/// Returns the kind of a struct, or all kinds if its enumerator is invalid or if it has no kinds.
template <class Of>
Kinds kind_of(const Of& object) {
    Kinds kind = every;
    for_each_field(
        [&](const Field& field, const auto& value) {
            if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(value)>>) {
                const auto number = static_cast<std::size_t>(value);
                if (field.use.selects_kind && number < field.valid.words.size())
                    kind = 1U << number;
            }
        },
        object);
    return kind;
}

} // namespace raylane::core::fields
