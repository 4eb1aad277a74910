#pragma once

#include "scenes/annotation/annotations.hpp"
#include "scenes/annotation/layout.hpp"
#include "scenes/annotation/projector.hpp"
#include "scenes/formats/structure/structure_file.hpp"

#include <utility>
#include <vector>

namespace raylane::scenes {

/// Half of a capital letter's height, relative to the size of the font.
inline constexpr double rise = 0.36;

/// The colours of texts and of the lines around them.
struct Inks {
    std::uint32_t ink = 0x111111, paper = 0xFFFFFF;
};

/// Throws BadInput for a legend without colours, and for axes of a cell without a cell.
void require_contents(const Annotations& annotations, const Legend& legend);

/// Makes the annotations of an image that are not at atoms: legend, axes and scale bar.
class Furniture {
  public:
    /// All must outlive it.
    Furniture(const Annotations& annotations, const Legend& legend, const Projector& projector,
              int width, int height, Inks inks);

    /// Returns the blocks, with texts of a size in pixels. Throws BadInput for a scale bar that is
    /// wider than the image, or too short to be seen.
    std::vector<Block> blocks(double size) const;

  private:
    struct Maker;

    const Annotations& annotations_;
    const Legend& legend_;
    const Projector& projector_;
    int width_, height_;
    Inks inks_;
};

/// Returns round numbers within a range, ascending: three to eight of them if `least` < `most`.
std::vector<double> round_numbers_in(double least, double most);

/// Returns a number with this many decimals, and with U+2212 as its minus sign.
std::string decimal_text(double number, int decimals);

} // namespace raylane::scenes
