#pragma once

#include "core/scene/film.hpp"
#include "core/scene/surroundings.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// Vector graphics over an image. Lengths are in pixels, from the upper left corner of the image;
/// colours are sRGB, 0xRRGGBB.
namespace raylane::scenes {

struct Point {
    double x, y;
};

struct SheetLine {
    Point from, to;
    double width;
    double dash = 0.0; ///< length of dashes and of the gaps between them; 0: none
    std::uint32_t color = 0;
};

struct SheetPolygon {
    std::vector<Point> corners;
    std::uint32_t color = 0;
};

struct SheetBall {
    Point center;
    double radius;
    std::uint32_t color = 0;
};

/// A bar of colours, from the bottom up.
struct SheetRamp {
    Point corner; ///< the upper left one
    double width, height;
    std::vector<std::uint32_t> colors;
    std::uint32_t frame = 0;
};

enum class Anchor : std::uint8_t { start, middle, end };

struct SheetText {
    Point at; ///< on the base line
    double size;
    std::string text; ///< UTF-8
    Anchor anchor = Anchor::start;
    std::uint32_t color = 0;
    std::uint32_t halo = 0xFFFFFF; ///< of the line around the letters
};

using Mark = std::variant<SheetLine, SheetPolygon, SheetBall, SheetRamp, SheetText>;

/// Marks that belong together, such as a label.
struct MarkGroup {
    std::string name;
    std::vector<Mark> marks;
};

struct Sheet {
    int width = 0, height = 0;
    double dpi = 0.0; ///< pixels per inch; 0: unknown
    std::string font;
    std::vector<MarkGroup> groups;
};

/// The width of the line around letters, relative to their size.
inline constexpr double halo_width = 0.2;

/// Returns the sheet as an SVG document of the size of the image. Each MarkGroup is a group of the
/// document. Texts stay texts, and do not become outlines.
std::string svg_of(const Sheet& sheet);

/// The function of the module that renders sheets. `pixels`: width * height premultiplied sRGB
/// codes 0xAARRGGBB, row by row, all 0 before the call. Returns the reason of a failure, or null.
extern "C" using RenderSheet = const char * (*)(const Sheet* sheet, std::uint32_t* pixels);
inline constexpr const char* render_sheet_name = "raylane_render_sheet";

/// The function of the module that finds fonts. Returns the family that texts have in place of the
/// named one, or null if that is installed or generic, such as "serif".
extern "C" using ReplacedFont = const char * (*)(const char* name);
inline constexpr const char* replaced_font_name = "raylane_replaced_font";

/// Composites pixels of a sheet over a film that covers `part` of the image. Blends the codes of
/// an image with this transfer function, not the linear components.
void blend(const std::vector<std::uint32_t>& pixels, int width, const core::Region& part,
           core::Transfer transfer, core::Film& film);

} // namespace raylane::scenes
