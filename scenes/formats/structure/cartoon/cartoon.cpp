#include "scenes/formats/structure/cartoon/cartoon.hpp"

#include "core/shapes/bounds.hpp"
#include "scenes/formats/structure/cartoon/secondary_structure.hpp"
#include "scenes/formats/structure/cartoon/shapes.hpp"
#include "scenes/formats/structure/labels.hpp"

#include <algorithm>

namespace raylane::scenes {

namespace {

constexpr double tube_radius = 0.5, trace_radius = 0.25, nucleic_radius = 0.6;

/// Returns the distance of triangles from the surface: an eighth of a pixel if the
/// structure's diagonal fills 1500 pixels.
double max_error_of(const Structure& structure, const Backbone& backbone) {
    core::Bounds bounds;
    for (const Segment& segment : backbone.segments)
        for (const BackboneResidue& residue : segment) {
            const core::Vec3f& at = structure.positions[residue.guide()];
            bounds.include({at, at});
        }
    const auto size = core::convert<double>(bounds.upper) - core::convert<double>(bounds.lower);
    return std::clamp(core::length(size) / 12000.0, 0.003, 0.04);
}

class Chains {
  public:
    Chains(const Structure& structure, const ChainLook& look, const IsDrawn& is_drawn,
           const AddShape& add)
        : structure_(structure), look_(look), is_drawn_(is_drawn), add_(add) {}

    ChainRemainder add_all() {
        const Backbone backbone = backbone_of(structure_);
        if (look_.style == ChainStyle::cartoon) {
            secondary_ = secondary_structure(structure_, backbone);
            max_error_ = max_error_of(structure_, backbone);
        } else {
            secondary_.assign(structure_.of_residue.size(), Secondary::coil);
        }
        for (const Segment& segment : backbone.segments) {
            std::size_t drawn = 0;
            for (const BackboneResidue& residue : segment)
                drawn += is_drawn_(residue.guide()) ? 1 : 0;
            if (drawn == 0) continue;
            if (segment.size() == 1) {
                remainder_.broken.push_back(segment[0].residue);
                continue;
            }
            remainder_.drawn += drawn;
            add(segment);
        }
        for (const BackboneResidue& residue : backbone.without_path)
            if (is_drawn_(residue.first)) remainder_.broken.push_back(residue.residue);
        std::sort(remainder_.broken.begin(), remainder_.broken.end());
        find_others(backbone);
        return std::move(remainder_);
    }

  private:
    void find_others(const Backbone& backbone) {
        std::vector<char> is_known(structure_.of_residue.size());
        for (const Segment& segment : backbone.segments)
            for (const BackboneResidue& residue : segment)
                is_known[residue.residue] = 1;
        for (const BackboneResidue& residue : backbone.without_path)
            is_known[residue.residue] = 1;
        for (AtomIndex atom = 0; atom < structure_.residues.size(); ++atom) {
            const std::uint32_t residue = structure_.residues[atom];
            if (is_known[residue] != 0 || !is_drawn_(atom)) continue;
            is_known[residue] = 1;
            if (!is_water_residue(structure_.of_residue[residue].name))
                remainder_.others.push_back(residue);
        }
    }

    void add(const Segment& segment) {
        const bool is_peptide = segment[0].polymer == Polymer::peptide;
        Path path = is_peptide ? path_of_peptide(structure_, segment, secondary_)
                               : path_of_nucleic(structure_, segment);
        switch (look_.style) {
        case ChainStyle::cartoon:
            add_cartoon(segment, path, is_peptide);
            break;
        case ChainStyle::tube:
            add_tube(path, radius_or(tube_radius), is_drawn_, add_);
            break;
        case ChainStyle::trace:
            add_trace(path, radius_or(trace_radius), is_drawn_, add_);
            break;
        }
    }

    double radius_or(double usual) const {
        return static_cast<double>(look_.scale) *
               (look_.radius ? static_cast<double>(*look_.radius) : usual);
    }

    void add_cartoon(const Segment& segment, Path& path, bool is_peptide) {
        RibbonSizes sizes;
        sizes.coil = radius_or(is_peptide ? sizes.coil : nucleic_radius);
        if (!is_peptide) {
            add_ribbon(path, sizes, max_error_, is_drawn_, add_);
            remainder_.without_base += add_bases(structure_, segment, path, is_drawn_, add_);
            return;
        }
        smooth(path);
        if (look_.cylinders)
            add_with_cylinders(path, sizes, max_error_, is_drawn_, add_);
        else
            add_ribbon(path, sizes, max_error_, is_drawn_, add_);
    }

    const Structure& structure_;
    const ChainLook& look_;
    const IsDrawn& is_drawn_;
    const AddShape& add_;
    std::vector<Secondary> secondary_; // by residue
    double max_error_ = 0.0;
    ChainRemainder remainder_;
};

std::string name_of(const Structure& structure, std::uint32_t index) {
    const Residue& residue = structure.of_residue[index];
    std::string name = residue.name + " " + std::to_string(residue.number);
    if (residue.insertion != ' ') name += residue.insertion;
    const std::string& chain = structure.chains[residue.chain];
    return chain.empty() ? name : name + " in chain " + chain;
}

} // namespace

std::string ChainRemainder::remark(const Structure& structure, bool names_others) const {
    std::string text;
    const auto list = [&](const std::vector<std::uint32_t>& residues) {
        constexpr std::size_t most = 3;
        for (std::size_t i = 0; i < std::min(most, residues.size()); ++i)
            text += (i == 0 ? "" : ", ") + name_of(structure, residues[i]);
        if (residues.size() > most) text += ", ...";
    };
    if (!broken.empty()) {
        text = broken.size() == 1 ? "1 residue could not be drawn"
                                  : std::to_string(broken.size()) + " residues could not be drawn";
        text += ", because CA, P or neighbours are missing: ";
        list(broken);
    }
    if (names_others && !others.empty()) {
        text += text.empty() ? "" : "; ";
        text += others.size() == 1 ? "1 residue is not part of a chain, and is not drawn: "
                                   : std::to_string(others.size()) +
                                         " residues are not parts of chains, and are not drawn: ";
        list(others);
    }
    if (without_base != 0)
        text += (text.empty() ? "" : "; ") + std::to_string(without_base) +
                (without_base == 1 ? " nucleotide lacks atoms of its base, which is not drawn"
                                   : " nucleotides lack atoms of their bases, which are not drawn");
    return text;
}

ChainRemainder add_chains(const Structure& structure, const ChainLook& look,
                          const IsDrawn& is_drawn, const AddShape& add) {
    return Chains(structure, look, is_drawn, add).add_all();
}

} // namespace raylane::scenes
