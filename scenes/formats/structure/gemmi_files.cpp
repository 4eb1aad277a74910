#include "scenes/formats/structure/gemmi_files.hpp"

#include "scenes/formats/structure/gemmi_crystal.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <gemmi/cif.hpp>
#include <gemmi/pdb.hpp>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace raylane::scenes::gemmi_files {

namespace {

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
    for (const gemmi::Model& source : structure.models) {
        Model model;
        if (models.empty()) model.title = structure.get_info("_struct.title");
        take_cell(structure.cell, model);
        bool any = false;
        for (const gemmi::Chain& chain : source.chains) {
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

using Tensors = std::map<std::string, std::array<float, 6>, std::less<>>;

/// Returns the displacements of a macromolecule's atoms, by `id`.
Tensors tensors_of(gemmi::cif::Block& block) {
    Tensors tensors;
    for (auto row : block.find("_atom_site_anisotrop.", {"id", "U[1][1]", "U[2][2]", "U[3][3]",
                                                         "U[1][2]", "U[1][3]", "U[2][3]"})) {
        std::array<float, 6>& u = tensors[row.str(0)];
        for (std::size_t k = 0; k < u.size(); ++k)
            u[k] = static_cast<float>(gemmi::cif::as_number(row[k + 1], 0.0));
    }
    return tensors;
}

void take_cell(gemmi::cif::Block& block, Model& model) {
    std::vector<double> parts;
    for (const char* tag :
         {"length_a", "length_b", "length_c", "angle_alpha", "angle_beta", "angle_gamma"}) {
        const std::string* value = block.find_value("_cell." + std::string(tag));
        parts.push_back(value == nullptr ? std::nan("") : gemmi::cif::as_number(*value));
        if (!std::isfinite(parts.back())) return;
    }
    gemmi::UnitCell cell;
    cell.set(parts[0], parts[1], parts[2], parts[3], parts[4], parts[5]);
    take_cell(cell, model);
}

int whole_number_in(const std::string& text) {
    int number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

/// Reads helices and strands. Kinds of helices begin with HELX, kinds of strands with STRN.
void read_secondary(gemmi::cif::Block& block, std::vector<SecondaryRange>& ranges) {
    for (const bool is_sheet : {false, true}) {
        const std::string table = is_sheet ? "_struct_sheet_range." : "_struct_conf.";
        for (auto row : block.find(
                 table, {is_sheet ? "sheet_id" : "conf_type_id", "?beg_auth_asym_id",
                         "?beg_label_asym_id", "?beg_auth_seq_id", "?beg_label_seq_id",
                         "?pdbx_beg_PDB_ins_code", "?end_auth_asym_id", "?end_label_asym_id",
                         "?end_auth_seq_id", "?end_label_seq_id", "?pdbx_end_PDB_ins_code"})) {
            const std::string kind = is_sheet ? "STRN" : row.str(0);
            const bool is_strand = kind.rfind("STRN", 0) == 0;
            const bool is_polyproline = kind.find("_PP_") != std::string::npos;
            if (!is_strand && (kind.rfind("HELX", 0) != 0 || is_polyproline)) continue;
            const auto text = [&](std::size_t column) {
                return row.has2(column) ? row.str(static_cast<int>(column)) : std::string();
            };
            const auto place = [&](std::size_t column) {
                ResiduePlace at;
                at.chain = text(row.has2(column) ? column : column + 1);
                at.number = whole_number_in(text(row.has2(column + 2) ? column + 2 : column + 3));
                if (const std::string letter = text(column + 4); !letter.empty())
                    at.insertion = letter[0];
                return at;
            };
            ranges.push_back({is_strand, place(1), place(6)});
        }
    }
}

/// Reads the models of a macromolecule's table of atoms. Only the columns of coordinates are
/// required. gemmi's own function requires others, and takes a time quadratic in the residues of a
/// chain.
std::vector<Model> models_of(gemmi::cif::Block& block) {
    enum : std::size_t {
        x,
        y,
        z,
        id,
        group,
        symbol,
        atom,
        atom_by_author,
        conformer,
        residue,
        residue_by_author,
        chain,
        chain_by_author,
        number,
        number_by_author,
        insertion,
        occupancy,
        b_factor,
        model
    };
    gemmi::cif::Table table = block.find(
        "_atom_site.",
        {"Cartn_x", "Cartn_y", "Cartn_z", "?id", "?group_PDB", "?type_symbol", "?label_atom_id",
         "?auth_atom_id", "?label_alt_id", "?label_comp_id", "?auth_comp_id", "?label_asym_id",
         "?auth_asym_id", "?label_seq_id", "?auth_seq_id", "?pdbx_PDB_ins_code", "?occupancy",
         "?B_iso_or_equiv", "?pdbx_PDB_model_num"});
    const Tensors tensors = tensors_of(block);
    std::vector<Model> models;
    std::map<std::string, std::size_t> index_of_model;
    std::map<std::tuple<int, char, std::string>, std::size_t> index_of_residue; // of the last chain
    std::size_t last_model = 0, rows = 0;
    for (auto row : table) {
        ++rows;
        const auto text = [&](std::size_t column) {
            return row.has(column) ? row.str(static_cast<int>(column)) : std::string();
        };
        const auto first_of = [&](std::size_t column, std::size_t other) {
            return row.has2(column) ? text(column) : text(other);
        };
        const std::string number_of_row = row.has2(id) ? text(id) : std::to_string(rows);
        for (const std::size_t axis : {x, y, z})
            require_coordinate(row[axis], "atom " + number_of_row);

        const auto [in, is_new] = index_of_model.try_emplace(text(model), models.size());
        if (is_new) take_cell(block, models.emplace_back());
        std::vector<Chain>& chains = models[in->second].chains;
        std::string name = first_of(chain_by_author, chain);
        if (name.empty()) name = "A";
        if (in->second != last_model || chains.empty() || chains.back().name != name) {
            chains.push_back({name, {}});
            index_of_residue.clear();
        }
        last_model = in->second;

        const std::string place = first_of(number_by_author, number), letter = text(insertion);
        Residue in_residue;
        in_residue.name = first_of(residue_by_author, residue);
        in_residue.number = whole_number_in(place);
        if (!letter.empty()) in_residue.insertion = letter[0];
        const std::string of_group = text(group);
        in_residue.is_hetero = !of_group.empty() && (of_group[0] == 'H' || of_group[0] == 'h');
        std::vector<Residue>& residues = chains.back().residues;
        const auto [at, is_first] = index_of_residue.try_emplace(
            {in_residue.number, in_residue.insertion, in_residue.name}, residues.size());
        if (is_first) residues.push_back(std::move(in_residue));

        Atom& added = residues[at->second].atoms.emplace_back();
        for (const std::size_t axis : {x, y, z})
            added.at[axis] = gemmi::cif::as_number(row[axis]);
        added.element = number_of(gemmi::Element(text(symbol)));
        added.name = first_of(atom_by_author, atom);
        if (added.name.empty()) added.name = text(symbol);
        const auto value = [&](std::size_t column, double otherwise) {
            return static_cast<float>(
                row.has(column) ? gemmi::cif::as_number(row[column], otherwise) : otherwise);
        };
        added.b_factor = value(b_factor, 0.0);
        added.occupancy = value(occupancy, 1.0);
        if (const std::string word = text(conformer); !word.empty()) added.conformer = word[0];
        const auto tensor = tensors.find(number_of_row);
        added.has_u = tensor != tensors.end() && tensor->second != std::array<float, 6>{};
        if (added.has_u) std::copy(tensor->second.begin(), tensor->second.end(), added.u);
    }
    if (const std::string* title = block.find_value("_struct.title"); title && !models.empty())
        models[0].title = gemmi::cif::as_string(*title); // the others share it
    return models;
}

/// Returns true for coordinates that are parts of a cell, which files of macromolecules do not
/// have.
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

Models read_cif(std::string_view text, const std::string& name, std::vector<std::string>& remarks) {
    try {
        gemmi::cif::Document document =
            gemmi::cif::read_memory(text.data(), text.size(), name.c_str());
        Models result;
        std::vector<Model>& models = result.models;
        const bool has_small = is_small(document);
        for (gemmi::cif::Block& block : document.blocks) {
            if (!has_small) {
                for (Model& model : models_of(block)) {
                    model.entry = result.secondary_of_entry.size();
                    models.push_back(std::move(model));
                }
                read_secondary(block, result.secondary_of_entry.emplace_back());
                continue;
            }
            if (std::optional<Model> crystal = crystal_in(block, remarks))
                models.push_back(*std::move(crystal));
        }
        if (has_small || document.blocks.empty()) result.secondary_of_entry.emplace_back();
        return result;
    } catch (const std::exception& error) {
        throw Refused(error.what());
    }
}

} // namespace raylane::scenes::gemmi_files
