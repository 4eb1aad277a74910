#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// The columns of a line in the section Atoms of a LAMMPS data file, after the number of the atom.
struct AtomLayout {
    std::string style;                     ///< "charge", "hybrid sphere dipole"
    std::vector<std::string_view> columns; ///< "type", "charge", "x", "y", "z"
    bool allows_bonds = false;
    bool is_open = false; ///< true: columns of unknown meaning may follow

    /// Returns the index of a column in a line, or 0 if it is missing. Indices begin at 1, as the
    /// number of the atom is 0.
    std::size_t index_of(std::string_view column) const;
};

/// Returns the layouts of an atom style in the syntax of the command atom_style: "full", "tdpd 2",
/// "hybrid sphere dipole". Most styles have one layout. Some have older forms after the usual
/// layout. Returns nothing for an unknown style. Source: LAMMPS' documentation of read_data. LAMMPS
/// itself reads the columns of dielectric and template in another order; that order comes first.
std::vector<AtomLayout> layouts_of(std::string_view style);

/// Returns the usual layout of each style with a fixed number of columns, the most usual style
/// first.
std::vector<AtomLayout> fixed_layouts();

/// Returns the names of all styles.
std::vector<std::string_view> atom_style_names();

} // namespace raylane::scenes
