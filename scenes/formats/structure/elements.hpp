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
    /// In angstrom, for single bonds: Cordero et al., Dalton Trans. 2832 (2008); 0: unknown.
    float covalent_radius;
    /// Van der Waals', in angstrom: Bondi, J. Phys. Chem. 68, 441 (1964), and Mantina et al., J.
    /// Phys. Chem. A 113, 5806 (2009); for other elements Alvarez, Dalton Trans. 42, 8617 (2013);
    /// 0: unknown.
    float van_der_waals_radius;
    float mass; ///< in daltons; without stable isotopes, that of the longest-lived one
    /// sRGB: Jmol's, "Jmol colors", which are those of CPK (Corey, Pauling, Koltun) where CPK has
    /// one.
    std::uint32_t color;
};

const ElementData& data_of(Element element);

/// Returns true for elements that form no molecules with each other: alkali and alkaline earth
/// metals, transition and rare earth metals, and the elements after them except metalloids.
bool is_metal(Element element);

/// Returns the radius of an atom in a metal with 12 neighbours, in angstrom: Greenwood and
/// Earnshaw, "Chemistry of the Elements" (1997). Returns the covalent radius of other elements.
float metallic_radius(Element element);

/// Returns the element of a symbol in any case, or 0. "D" and "T" are hydrogen.
Element element_of(std::string_view symbol);

/// Returns the element with this mass in daltons, or with a light isotope of this mass, or 0. The
/// mass may be rounded: 55.8 and 56 are iron. United atoms are not elements: CH2, 14.027, is not
/// nitrogen.
Element element_of_mass(double mass);

enum class MassUnits { unknown, daltons, others };

/// Returns the elements of types of atoms by their masses. Returns nothing if a mass is not an
/// element's, or if the masses may be in other units: in reduced units most masses are about 1, or
/// all types have the same mass. Other masses that fit elements are in daltons if they have
/// decimals, or if they are whole numbers with 12 or 16 and another one among them.
std::vector<Element> elements_of_masses(const std::vector<double>& masses, MassUnits units);

} // namespace raylane::scenes
