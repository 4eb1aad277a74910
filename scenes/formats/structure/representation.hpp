#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The words for the look of atoms: styles, colours, sizes and opacities of selected atoms.
namespace raylane::scenes {

enum class Style {
    automatic, ///< spheres for more than 500 atoms or atoms with radii, otherwise balls
    balls,     ///< balls and sticks
    sticks,    ///< thin sticks, two or three for double or triple bonds
    licorice,  ///< thick sticks, one for each bond
    spheres,   ///< with van der Waals' radii, or those of the file
    touching,  ///< spheres with radii at which neighbours touch; sticks where a gap remains
    envelope,  ///< the solvent-accessible surface: spheres larger by 1.4 angstrom
    points,    ///< small balls of one size
    polyhedra, ///< the convex hulls of bonded neighbours
    cartoon,   ///< ribbons of proteins, tubes and boxes of nucleic acids
    cylinders, ///< a cartoon with cylinders for helices
    tube,      ///< a round tube along each chain
    trace,     ///< straight rods between the CA, or P, of each chain
};

/// Returns true for the styles that show chains, not atoms.
constexpr bool shows_chains(Style style) {
    return style >= Style::cartoon;
}

/// Returns the styles with the names that users give, in the order of the help.
const std::vector<std::pair<std::string_view, Style>>& named_styles();

/// How atoms reflect light.
enum class Finish : std::uint8_t {
    usual,  ///< a soft highlight
    matte,  ///< none
    glossy, ///< a sharp one
    flat,   ///< the plain colour, without light and shadow, with outlines
    print,  ///< no highlight, thin outlines, no depth cue
};

/// A value for the atoms of an element ("Fe") or of a type ("1", by the label of the file).
template <class T>
struct OfKind {
    std::string kind;
    T value;
};

/// The colours of atoms, in words.
struct ColorWords {
    std::string option = "--color"; ///< in messages
    std::string by;       ///< element, chain, residue, a property or a colour; empty: unset
    bool carbons = false; ///< `by` colours carbon; other atoms have their element's colour
    std::vector<OfKind<std::uint32_t>> of_kinds = {}; ///< sRGB; override the others
    std::string palette;                              ///< of a property; empty: unset
    std::optional<std::pair<double, double>> range;   ///< values at the ends of the palette
};

/// Sizes of atoms: one for all, and others by kind.
struct SizeWords {
    std::string option = {}; ///< in messages
    std::optional<float> of_all;
    std::vector<OfKind<float>> of_kinds = {};
};

/// A look of atoms. Unset values are those of the drawing.
struct Look {
    std::vector<std::string> kinds = {}; ///< elements or types that have the look; empty: all
    std::optional<Style> style;
    ColorWords color;
    std::optional<float> opacity; ///< in (0, 1]
    SizeWords radius;             ///< in angstrom; of sticks, too, in styles without balls
    SizeWords scale;              ///< factors for the radii
    Finish finish = Finish::usual;
};

/// The looks of selected atoms, all at once.
struct Representation {
    std::string select; ///< in the language of select_atoms
    std::vector<Look> looks;
};

/// Parses "SELECTION: LOOK + LOOK ...". A look is a list of words in any order: a style, words of a
/// colour, "opacity A", "radius SIZES", "scale SIZES". ": LOOK" may be missing. `option` is the
/// name in messages. Throws BadInput, with the column.
Representation representation_of(const std::string& option, const std::string& text);

/// Parses "KIND KIND ... LOOK": the polyhedra around atoms of these elements or types. The look is
/// in the words of representation_of(), without a style. Throws BadInput, with the column.
Look polyhedra_of(const std::string& option, const std::string& text);

/// Parses words in any order: "BY" or "carbons BY", "KIND=COLOR", "palette NAME", "range A B".
/// Throws BadInput, with the column.
ColorWords color_words_of(const std::string& option, const std::string& text);

/// Parses words in any order: "SIZE", "KIND=SIZE", above 0 and at most 1e6. Throws BadInput, with
/// the column.
SizeWords size_words_of(const std::string& option, const std::string& text);

/// Returns the message for a KIND that no atom has.
std::string matches_no_kind(const std::string& option, const std::string& kind);

/// Parses "A B", "A:B" or "A,B", two numbers of which the first is less. Throws BadInput.
std::pair<double, double> range_of(const std::string& option, const std::string& text);

} // namespace raylane::scenes
