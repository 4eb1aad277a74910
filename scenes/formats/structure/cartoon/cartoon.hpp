#pragma once

#include "scenes/formats/structure/cartoon/shapes.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace raylane::scenes {

enum class ChainStyle : std::uint8_t {
    cartoon, ///< ribbons for helices, arrows for strands, tubes for coils; boxes for bases
    tube,    ///< a round tube along a spline
    trace,   ///< straight rods between CA, or between P
};

struct ChainLook {
    ChainStyle style = ChainStyle::cartoon;
    bool cylinders = false;        ///< of a cartoon: cylinders for helices
    std::optional<float> radius{}; ///< of tubes and rods, in angstrom, > 0
    float scale = 1.0F;            ///< factor for this radius, > 0
};

/// The residues that a style of chains omits.
struct ChainRemainder {
    std::vector<std::uint32_t> broken; ///< of proteins and nucleic acids: no CA, or no neighbour
    std::vector<std::uint32_t> others; ///< no proteins, nucleic acids or water
    std::size_t without_base = 0;      ///< drawn nucleotides
    std::size_t drawn = 0;             ///< residues

    /// Returns a message for users. It is empty if nothing is missing. `names_others`: whether it
    /// includes `others`.
    std::string remark(const Structure& structure, bool names_others = true) const;
};

/// Adds the residues whose CA, P or first atom is drawn. A part of a chain has the same shape as in
/// the whole chain. The number of triangles depends on the size of the structure, such that no
/// facet is visible in an image of the whole.
ChainRemainder add_chains(const Structure& structure, const ChainLook& look,
                          const IsDrawn& is_drawn, const AddShape& add);

} // namespace raylane::scenes
