#pragma once

#include "scenes/formats/structure/representation.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// A range of a property.
using ColorRange = std::pair<double, double>;

/// The colours of a structure's atoms by words. The structure must outlive it.
class AtomColors {
  public:
    /// Throws BadInput for words that mean nothing in this structure. `unmatched` receives a
    /// message for each kind that no atom has.
    AtomColors(const Structure& structure, const ColorWords& words,
               std::vector<std::string>& unmatched);

    /// Returns the property that colours stand for; null: none.
    const AtomProperty* property() const { return property_; }
    /// Sets the range of the property. Call it before of() if there is a property.
    void set_range(const ColorRange& range) { range_ = range; }
    const ColorRange& range() const { return range_; }
    /// Returns false if the atom's colour stands for a number.
    bool has_name(AtomIndex atom) const { return property_ == nullptr || is_by_kind(atom); }

    /// Returns the atom's colour, in sRGB, 0xRRGGBB.
    std::uint32_t of(AtomIndex atom) const;
    /// Returns the meaning of the atom's colour, as the name of a material: an element, a type, a
    /// chain, a residue, a value or a colour.
    std::string meaning_of(AtomIndex atom) const;

  private:
    void find_elements();
    void color_by(const ColorWords& words);
    void color_by_residue(bool by_chain);
    void override_kinds(const ColorWords& words, std::vector<std::string>& unmatched);
    bool is_by_kind(AtomIndex atom) const;

    const Structure& structure_;
    std::string palette_;
    bool only_carbons_ = false;
    std::vector<std::uint32_t> of_kind_;    // by kind
    std::vector<char> is_overridden_;       // by kind
    std::vector<std::uint32_t> of_residue_; // by residue; empty: unused
    std::vector<std::string> name_of_residue_;
    std::optional<std::uint32_t> one_;
    std::string one_name_;
    const AtomProperty* property_ = nullptr;
    ColorRange range_ = {0.0, 0.0};
};

} // namespace raylane::scenes
