#include "scenes/formats/structure/atom_radii.hpp"

#include "scenes/formats/structure/kind_table.hpp"

#include <algorithm>
#include <utility>

namespace raylane::scenes {

namespace {

constexpr float part_of_radius = 0.25F; // of van der Waals', for balls with sticks
constexpr float stick_with_balls = 0.12F, stick = 0.16F, licorice_stick = 0.3F, dot_size = 0.2F;
constexpr float water_radius = 1.4F; // the probe of Lee and Richards, J. Mol. Biol. 55, 379 (1971)

std::vector<float> by_kind(const Structure& structure, const SizeWords& words, float usual,
                           std::vector<std::string>& unmatched) {
    std::vector<float> sizes(structure.of_kind.size(), words.of_all.value_or(usual));
    for (const OfKind<float>& words_of_kind : words.of_kinds) {
        const std::vector<std::size_t> kinds = kinds_named(structure.of_kind, words_of_kind.kind);
        if (kinds.empty()) unmatched.push_back(matches_no_kind(words.option, words_of_kind.kind));
        for (const std::size_t kind : kinds)
            sizes[kind] = words_of_kind.value;
    }
    return sizes;
}

} // namespace

bool has_sticks(Style style) {
    return style != Style::spheres && style != Style::envelope && style != Style::points &&
           style != Style::polyhedra && !shows_chains(style);
}

AtomRadii::AtomRadii(const Structure& structure, const Look& look, float usual,
                     std::vector<char> is_metallic, std::vector<std::string>& unmatched)
    : structure_(structure), style_(*look.style), usual_(usual),
      is_metallic_(std::move(is_metallic)),
      radius_(by_kind(structure, look.radius, 0.0F, unmatched)),
      scale_(by_kind(structure, look.scale, 1.0F, unmatched)) {}

float AtomRadii::full(AtomIndex atom) const {
    if (!structure_.radii.empty() && structure_.radii[atom] > 0.0F) return structure_.radii[atom];
    const Element element = structure_.element(atom);
    if (element == 0) return usual_;
    const float radius = data_of(element).van_der_waals_radius;
    return radius > 0.0F ? radius : 2.0F;
}

float AtomRadii::touching(AtomIndex atom) const {
    if (!structure_.radii.empty() && structure_.radii[atom] > 0.0F) return structure_.radii[atom];
    const Element element = structure_.element(atom);
    if (!is_metallic_.empty() && is_metallic_[element] != 0) return metallic_radius(element);
    const float radius = data_of(element).covalent_radius;
    return radius > 0.0F ? radius : full(atom);
}

float AtomRadii::of_style(AtomIndex atom) const {
    switch (style_) {
    case Style::automatic:
    case Style::spheres:
        return full(atom);
    case Style::envelope:
        return full(atom) + water_radius;
    case Style::touching:
        return touching(atom);
    case Style::balls:
        return (structure_.element(atom) == 0 ? 0.5F : part_of_radius) * full(atom);
    case Style::sticks:
        return stick;
    case Style::licorice:
        return licorice_stick;
    case Style::points:
        return std::min(dot_size, 0.5F * full(atom));
    case Style::polyhedra:
    case Style::cartoon:
    case Style::cylinders:
    case Style::tube:
    case Style::trace:
        break;
    }
    return 0.0F;
}

float AtomRadii::of(AtomIndex atom) const {
    const std::size_t kind = structure_.kinds[atom];
    return scale_[kind] * (radius_[kind] > 0.0F ? radius_[kind] : of_style(atom));
}

float AtomRadii::stick_of(AtomIndex atom) const {
    const bool has_balls = style_ == Style::balls || style_ == Style::touching;
    return has_balls ? std::min(stick_with_balls, of(atom)) : of(atom);
}

} // namespace raylane::scenes
