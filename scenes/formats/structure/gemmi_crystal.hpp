#pragma once

#include "scenes/formats/structure/gemmi_files.hpp"

#include <cmath>
#include <gemmi/cifdoc.hpp>
#include <gemmi/elem.hpp>
#include <gemmi/numb.hpp>
#include <gemmi/unitcell.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace raylane::scenes::gemmi_files {

/// Returns all atoms in the cell of a block's crystal, or none if it has no sites.
std::optional<Model> crystal_in(gemmi::cif::Block& block, std::vector<std::string>& remarks);

inline void copy(const gemmi::Vec3& from, double (&to)[3]) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

/// Ignores a cell of 1 angstrom, which PDB files have in place of no cell.
inline void take_cell(const gemmi::UnitCell& cell, Model& model) {
    model.has_cell = cell.is_crystal();
    if (!model.has_cell) return;
    const gemmi::Fractional edges[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int k = 0; k < 3; ++k)
        copy(cell.orthogonalize(edges[k]), model.edges[k]);
}

inline int number_of(const gemmi::Element& element) {
    return element.is_hydrogen() ? 1 : element.atomic_number();
}

inline void require_coordinate(const std::string& text, const std::string& owner) {
    if (!std::isfinite(gemmi::cif::as_number(text)))
        throw std::runtime_error("the coordinates of " + owner + " must be numbers, got \"" + text +
                                 "\"");
}

} // namespace raylane::scenes::gemmi_files
