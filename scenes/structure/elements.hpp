#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// Atomic number; 0 is an unknown element.
using Element = std::uint8_t;
inline constexpr Element element_count = 119;

struct ElementData {
    std::string_view symbol;
    /// In angstrom, of single bonds: Cordero et al., Dalton Trans. 2832 (2008); 0: not known.
    float covalent_radius;
    /// In angstrom, van der Waals': Bondi, J. Phys. Chem. 68, 441 (1964), and Mantina et al., J.
    /// Phys. Chem. A 113, 5806 (2009); what these have not, Alvarez, Dalton Trans. 42, 8617 (2013);
    /// 0: not known.
    float van_der_waals_radius;
    float mass; ///< in daltons; of what is never stable, that of the longest-lived isotope
    /// sRGB: Jmol's, "Jmol colors", which are CPK's (Corey, Pauling, Koltun) where that has one.
    std::uint32_t color;
};

const ElementData& data_of(Element element);

/// By symbol, whatever its case; 0 if there is none. "D" and "T" are hydrogen.
Element element_of(std::string_view symbol);

/// Returns the element with that mass in daltons, or with a light isotope of that mass, or 0. The
/// mass may be rounded: 55.8 and 56 are iron. United atoms are no elements: CH2, 14.027, is not
/// nitrogen.
Element element_of_mass(double mass);

enum class MassUnits { unknown, daltons, others };

/// Returns the elements of types of atoms by their masses. Empty if a mass is not an element's, or
/// if the masses may be in other units: in reduced units most masses are about 1, or those of all
/// types the same. Other masses with decimals that fit elements are in daltons, and whole numbers
/// are if 12 or 16 is among them beside another one.
std::vector<Element> elements_of_masses(const std::vector<double>& masses, MassUnits units);

} // namespace raylane::scenes
