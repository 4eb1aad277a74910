#pragma once

#include "scenes/formats/structure/representation.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <string>
#include <vector>

namespace raylane::scenes {

/// Returns true if a style shows bonds.
bool has_sticks(Style style);

/// The radii of a structure's atoms and sticks in a look, in angstrom. The structure must outlive
/// it.
class AtomRadii {
  public:
    /// `look` has a style. `usual`: radius of atoms of unknown elements. `is_metallic`: by
    /// element, for Style::touching, see find_bonds(). `unmatched` receives a message, for
    /// `option`, for each kind of `look` that no atom has.
    AtomRadii(const Structure& structure, const Look& look, float usual,
              std::vector<char> is_metallic, std::vector<std::string>& unmatched);

    /// Returns the radius of an atom's ball.
    float of(AtomIndex atom) const;
    /// Returns the factor between an atom's shape in the file and its shape in the image.
    float share_of_shape(AtomIndex atom) const { return of(atom) / full(atom); }
    /// Returns the radius of the atom's half of a single bond's stick.
    float stick_of(AtomIndex atom) const;

  private:
    float full(AtomIndex atom) const;
    float touching(AtomIndex atom) const;
    float of_style(AtomIndex atom) const;

    const Structure& structure_;
    Style style_;
    float usual_;
    std::vector<char> is_metallic_;     // by element; empty: none
    std::vector<float> radius_, scale_; // by kind; radius 0: that of the style
};

} // namespace raylane::scenes
