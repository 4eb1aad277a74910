#pragma once

#include "scenes/formats/structure/elements.hpp"

#include <string_view>

/// Elements of atoms whose file has labels in place of symbols. 0 is an unknown element.
namespace raylane::scenes {

/// Reads a label that begins with an element's symbol, as in XYZ, dumps and sites of CIF ("Fe2+",
/// "C12", "CL1", "OW"). A symbol of two letters is preferred to one of one letter. Rules:
/// - Bq, Du, Tv, Vac and Unk are not atoms. Gaussian 16 names ghosts Bq and vectors of translation
///   Tv, Tripos' Mol2 names dummies Du, and minerals have vacancies.
/// - T with a number is a tetrahedral site, of silicon or aluminium; T alone is tritium.
/// - Wat is the oxygen of water (American Mineralogist Crystal Structure Database).
/// - No sample has elements beyond einsteinium: NH4 is nitrogen, not nihonium.
Element element_of_label(std::string_view label);

/// Returns the element of an ion, or 0 for other atoms. An ion is named like its residue ("CA" in
/// "CA2+"), or its residue is "ION" (GROMOS). CHARMM's ions have names of three letters ("SOD").
Element element_of_ion(std::string_view name, std::string_view residue);

/// Reads the name of an atom in a residue, as in GRO, PDB and mmCIF: the symbol, then the place in
/// the residue ("CA", "1HB", "OXT"; PDB format 3.3, Appendix 3). Rules:
/// - Ions follow element_of_ion().
/// - In amino acids and nucleotides the first letter is the symbol.
/// - Elsewhere, BR, CL, CR, CU, FE, NI, PT, SE, SI, SN and TI are symbols of two letters. In other
///   names the first letter is the symbol, or if it is not a symbol, both letters are ("ZN").
Element element_of_atom(std::string_view name, std::string_view residue);

/// Returns true for names of water in any case, such as "HOH", "SOL" and "TIP3".
bool is_water_residue(std::string_view residue);

/// Returns true for the 20 amino acids in their states of protonation, caps, and nucleotides.
bool is_polymer_residue(std::string_view residue);

} // namespace raylane::scenes
