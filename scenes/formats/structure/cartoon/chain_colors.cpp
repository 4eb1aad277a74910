#include "scenes/formats/structure/cartoon/chain_colors.hpp"

#include "scenes/formats/structure/cartoon/secondary_structure.hpp"
#include "scenes/formats/structure/colors.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace raylane::scenes {

namespace {

struct Named {
    std::uint32_t color;
    const char* name;
};
/// Okabe and Ito, as for chains; gray for coils.
constexpr Named of_helix = {0xd55e00, "helix"}, of_strand = {0x0072b2, "strand"},
                of_coil = {0xb4b4b4, "coil"}, of_nucleic = {0x009e73, "nucleic"},
                of_others = {0xc8c8c8, "other"};

/// Tol, "Colour schemes" (2021), the discrete rainbow without its ends.
constexpr std::array<std::uint32_t, 12> rainbow = {0x1965b0, 0x437dbf, 0x6195cf, 0x7bafde,
                                                   0x4eb265, 0x90c987, 0xcae0ab, 0xf7f056,
                                                   0xf6c141, 0xf1932d, 0xe8601c, 0xdc050c};

/// Sets colours and names by residue.
class ResidueColors {
  public:
    ResidueColors(const Structure& structure, std::vector<std::uint32_t>& colors,
                  std::vector<std::string>& names)
        : structure_(structure), backbone_(backbone_of(structure)), colors_(colors), names_(names) {
        colors_.assign(structure.of_residue.size(), of_others.color);
        names_.assign(structure.of_residue.size(), of_others.name);
    }

    void color_secondary() {
        const std::vector<Secondary> secondary = secondary_structure(structure_, backbone_);
        for (const Segment& segment : backbone_.segments)
            for (const BackboneResidue& residue : segment)
                set(residue.residue, residue.polymer == Polymer::nucleic               ? of_nucleic
                                     : secondary[residue.residue] == Secondary::helix  ? of_helix
                                     : secondary[residue.residue] == Secondary::strand ? of_strand
                                                                                       : of_coil);
    }

    void color_along_chains() {
        std::map<std::uint32_t, std::vector<std::uint32_t>> chains;
        for (const Segment& segment : backbone_.segments)
            for (const BackboneResidue& residue : segment)
                chains[structure_.of_residue[residue.residue].chain].push_back(residue.residue);
        for (const auto& [chain, residues] : chains)
            for (std::size_t i = 0; i < residues.size(); ++i) {
                const std::size_t part = (i * 64) / residues.size();
                colors_[residues[i]] = color_between(rainbow, static_cast<double>(part) / 63.0);
                names_[residues[i]] = "part " + std::to_string(part + 1) + " of 64";
            }
    }

  private:
    void set(std::uint32_t residue, const Named& named) {
        colors_[residue] = named.color;
        names_[residue] = named.name;
    }

    const Structure& structure_;
    Backbone backbone_;
    std::vector<std::uint32_t>& colors_;
    std::vector<std::string>& names_;
};

} // namespace

bool is_chain_color(std::string_view by) {
    return by == "secondary" || by == "rainbow";
}

void chain_colors(const Structure& structure, std::string_view by,
                  std::vector<std::uint32_t>& colors, std::vector<std::string>& names) {
    ResidueColors residues(structure, colors, names);
    if (by == "rainbow")
        residues.color_along_chains();
    else
        residues.color_secondary();
}

const char* usual_chain_color(const Structure& structure) {
    const Backbone backbone = backbone_of(structure);
    const auto chain_of = [&](const Segment& segment) {
        return structure.of_residue[segment.front().residue].chain;
    };
    const auto& segments = backbone.segments;
    const bool is_single =
        std::all_of(segments.begin(), segments.end(), [&](const Segment& segment) {
            return chain_of(segment) == chain_of(segments.front());
        });
    return is_single ? "secondary" : "chain";
}

} // namespace raylane::scenes
