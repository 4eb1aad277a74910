#include "scenes/structure/gemmi_files.hpp"

#include <algorithm>
#include <gemmi/cif.hpp>
#include <gemmi/mmcif.hpp>
#include <gemmi/pdb.hpp>
#include <gemmi/smcif.hpp>

namespace raylane::scenes::gemmi_files {

namespace {

void copy(const gemmi::Vec3& from, double (&to)[3]) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

/// What PDB files have in place of no cell, one of 1 angstrom, is none.
void take_cell(const gemmi::UnitCell& cell, Model& model) {
    model.has_cell = cell.is_crystal();
    if (!model.has_cell) return;
    const gemmi::Fractional edges[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int k = 0; k < 3; ++k)
        copy(cell.orthogonalize(edges[k]), model.edges[k]);
}

int number_of(const gemmi::Element& element) {
    return element.is_hydrogen() ? 1 : element.atomic_number();
}

Residue residue_of(const gemmi::Residue& residue) {
    Residue result;
    result.name = residue.name;
    result.number = residue.seqid.num.has_value() ? *residue.seqid.num : 0;
    result.insertion = residue.seqid.icode;
    result.is_hetero = residue.het_flag == 'H';
    for (const gemmi::Atom& atom : residue.atoms) {
        Atom copied;
        copy(atom.pos, copied.at);
        copied.element = number_of(atom.element);
        copied.name = atom.name;
        copied.serial = atom.serial;
        copied.b_factor = atom.b_iso;
        copied.occupancy = atom.occ;
        copied.conformer = atom.altloc;
        copied.has_u = atom.aniso.nonzero();
        const float u[] = {atom.aniso.u11, atom.aniso.u22, atom.aniso.u33,
                           atom.aniso.u12, atom.aniso.u13, atom.aniso.u23};
        std::copy_n(u, 6, copied.u);
        result.atoms.push_back(std::move(copied));
    }
    return result;
}

std::vector<Model> models_of(const gemmi::Structure& structure) {
    std::vector<Model> models;
    for (const gemmi::Model& of : structure.models) {
        Model model;
        model.title = structure.get_info("_struct.title");
        take_cell(structure.cell, model);
        bool any = false;
        for (const gemmi::Chain& chain : of.chains) {
            model.chains.push_back({chain.name, {}});
            for (const gemmi::Residue& residue : chain.residues) {
                model.chains.back().residues.push_back(residue_of(residue));
                any = any || !residue.atoms.empty();
            }
        }
        if (any) models.push_back(std::move(model));
    }
    return models;
}

/// A site's atom where an operation of symmetry has it. U of CIF is along the reciprocal cell's
/// edges, of length 1: International Tables D, 4.1.10 (2006).
Atom image_of(const gemmi::SmallStructure::Site& site, const gemmi::UnitCell& cell,
              const gemmi::Fractional& at, const gemmi::Mat33& turned) {
    Atom atom;
    copy(cell.orthogonalize(at), atom.at);
    atom.element = number_of(site.element);
    atom.name = site.label;
    atom.occupancy = static_cast<float>(site.occ);
    atom.has_u = site.aniso.nonzero();
    const double lengths[] = {cell.ar, cell.br, cell.cr};
    const auto in_cell = [&](double u, int i, int j) { return u * lengths[i] * lengths[j]; };
    const gemmi::SMat33<double>& u = site.aniso;
    const gemmi::SMat33<double> of_fractions = {in_cell(u.u11, 0, 0), in_cell(u.u22, 1, 1),
                                                in_cell(u.u33, 2, 2), in_cell(u.u12, 0, 1),
                                                in_cell(u.u13, 0, 2), in_cell(u.u23, 1, 2)};
    const auto along_axes =
        of_fractions.transformed_by<double>(cell.orth.mat.multiply(turned)).elements_pdb();
    for (std::size_t k = 0; k < along_axes.size(); ++k)
        atom.u[k] = static_cast<float>(along_axes[k]);
    return atom;
}

/// All atoms of a cell: of images that are as near as atoms never are, the first.
Model model_of(const gemmi::SmallStructure& structure) {
    constexpr double one_place = 0.4 * 0.4; // angstrom^2
    const gemmi::UnitCell& cell = structure.cell;
    Model model;
    model.title = structure.name;
    model.is_small = true;
    take_cell(cell, model);
    Residue all;
    for (const gemmi::SmallStructure::Site& site : structure.sites) {
        std::vector<gemmi::Fractional> places = {site.fract};
        all.atoms.push_back(image_of(site, cell, site.fract, gemmi::Mat33()));
        for (const gemmi::FTransform& image : cell.images) {
            const gemmi::Fractional at = image.apply(site.fract);
            const auto is_here = [&](const gemmi::Fractional& other) {
                return cell.distance_sq(at, other) < one_place;
            };
            if (std::any_of(places.begin(), places.end(), is_here)) continue;
            places.push_back(at);
            all.atoms.push_back(image_of(site, cell, at, image.mat));
        }
    }
    model.chains.push_back({"", {std::move(all)}});
    return model;
}

/// A file of macromolecules has their coordinates, not parts of a cell.
bool is_small(gemmi::cif::Document& document) {
    return std::any_of(document.blocks.begin(), document.blocks.end(),
                       [](gemmi::cif::Block& block) {
                           return block.find_values("_atom_site_fract_x").length() > 0;
                       });
}

} // namespace

std::vector<Model> read_pdb(std::string_view text, const std::string& name) {
    try {
        return models_of(gemmi::read_pdb_from_memory(text.data(), text.size(), name));
    } catch (const std::exception& error) {
        throw Refused(error.what());
    }
}

std::vector<Model> read_cif(std::string_view text, const std::string& name) {
    try {
        gemmi::cif::Document document =
            gemmi::cif::read_memory(text.data(), text.size(), name.c_str());
        if (!is_small(document)) return models_of(gemmi::make_structure(document));
        std::vector<Model> models;
        for (const gemmi::cif::Block& block : document.blocks) {
            gemmi::SmallStructure structure = gemmi::make_small_structure_from_block(block);
            structure.setup_cell_images();
            if (!structure.sites.empty()) models.push_back(model_of(structure));
        }
        return models;
    } catch (const std::exception& error) {
        throw Refused(error.what());
    }
}

} // namespace raylane::scenes::gemmi_files
