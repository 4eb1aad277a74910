#pragma once

#include "scenes/formats/structure/structure.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// Returns true for the ways to colour residues of this header.
bool is_chain_color(std::string_view by);

/// Sets the colour of each residue, in sRGB, 0xRRGGBB, and its name. `by`:
/// - "secondary": helices red, strands blue, coils gray, nucleic acids green.
/// - "rainbow": from blue at the start of each chain to red at its end.
/// Others, such as water, are light gray.
void chain_colors(const Structure& structure, std::string_view by,
                  std::vector<std::uint32_t>& colors, std::vector<std::string>& names);

/// Returns the colours that fit a cartoon best: "chain", or "secondary" for a single chain.
const char* usual_chain_color(const Structure& structure);

} // namespace raylane::scenes
