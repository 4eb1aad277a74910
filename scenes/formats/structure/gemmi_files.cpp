#include "scenes/formats/structure/gemmi_files.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <gemmi/cif.hpp>
#include <gemmi/pdb.hpp>
#include <gemmi/smcif.hpp>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

namespace raylane::scenes::gemmi_files {

namespace {

void copy(const gemmi::Vec3& from, double (&to)[3]) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

/// Ignores a cell of 1 angstrom, which PDB files have in place of no cell.
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
        if (models.empty()) model.title = structure.get_info("_struct.title");
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

using Sites = std::vector<gemmi::SmallStructure::Site>;

/// Returns a site's atom at its image under an operation of symmetry. U of CIF is along the
/// reciprocal cell's edges, of length 1: International Tables D, 4.1.10 (2006).
Atom image_of(const gemmi::SmallStructure::Site& site, const gemmi::UnitCell& cell,
              const gemmi::Fractional& at, const gemmi::Mat33& turned) {
    Atom atom;
    copy(cell.orthogonalize(at), atom.at);
    // gemmi copies the label in place of a missing symbol.
    atom.element = site.type_symbol == site.label ? 0 : number_of(site.element);
    atom.name = site.label;
    atom.b_factor = static_cast<float>(site.u_iso * gemmi::u_to_b());
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

/// Returns the longest bond of two atoms, in angstrom, with the tolerance of rendered bonds.
double longest_bond(const gemmi::SmallStructure::Site& a, const gemmi::SmallStructure::Site& b) {
    constexpr double tolerance = 0.4;
    return static_cast<double>(a.element.covalent_r()) +
           static_cast<double>(b.element.covalent_r()) + tolerance;
}

/// Groups sites into molecules of bonded atoms. Returns for each site the first of its molecule.
std::vector<std::size_t> molecules_of(const Sites& sites, const gemmi::UnitCell& cell) {
    constexpr std::size_t most = 4000; // with more sites, each is a molecule
    std::vector<std::size_t> first(sites.size());
    std::iota(first.begin(), first.end(), std::size_t{0});
    if (sites.size() > most) return first;
    std::vector<gemmi::Position> places;
    for (const auto& site : sites)
        places.push_back(cell.orthogonalize(site.fract));
    const auto root = [&](std::size_t i) {
        while (first[i] != i)
            i = first[i] = first[first[i]];
        return i;
    };
    for (std::size_t i = 0; i < sites.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const double reach = longest_bond(sites[i], sites[j]);
            if (places[i].dist_sq(places[j]) >= reach * reach) continue;
            const std::size_t a = root(i), b = root(j);
            first[std::max(a, b)] = std::min(a, b);
        }
    for (std::size_t i = 0; i < sites.size(); ++i)
        first[i] = root(i);
    return first;
}

/// Flags of the operations that are omitted for some sites, by index.
using LeftOut = std::vector<char>;

/// Returns for each site the operations whose images are omitted, or null for none. Atoms of a
/// negative disorder group have no bonds to their images (SHELXL's PART): images of a molecule's
/// part that would be bonded exclude each other, and the first is taken. `place` (site, operation)
/// returns fractional coordinates.
template <class Place>
std::vector<std::shared_ptr<const LeftOut>>
images_left_out(const gemmi::SmallStructure& structure, const std::vector<std::size_t>& molecule,
                std::size_t operations, const Place& place) {
    std::size_t max_comparisons = 30'000'000; // crystals need far fewer
    const Sites& sites = structure.sites;
    std::map<std::pair<std::size_t, int>, std::vector<std::size_t>> parts;
    for (std::size_t i = 0; i < sites.size(); ++i)
        if (sites[i].disorder_group < 0) parts[{molecule[i], sites[i].disorder_group}].push_back(i);
    std::vector<std::shared_ptr<const LeftOut>> result(sites.size());
    for (const auto& [key, part] : parts) {
        const auto left_out = std::make_shared<LeftOut>(operations);
        std::vector<std::pair<std::size_t, gemmi::Fractional>> taken;
        for (std::size_t operation = 0; operation < operations; ++operation) {
            const std::size_t before = taken.size();
            bool is_free = true;
            for (const std::size_t i : part) {
                const gemmi::Fractional at = place(i, operation);
                const auto is_apart = [&](const auto& other) {
                    if (max_comparisons == 0) return true;
                    --max_comparisons;
                    const double reach = longest_bond(sites[i], sites[other.first]);
                    return structure.cell.distance_sq(at, other.second) >= reach * reach;
                };
                const auto end = taken.begin() + static_cast<std::ptrdiff_t>(before);
                is_free =
                    is_free && (max_comparisons == 0 || std::all_of(taken.begin(), end, is_apart));
                taken.emplace_back(i, at);
            }
            if (is_free) continue;
            (*left_out)[operation] = 1;
            taken.resize(before, {0, gemmi::Fractional()});
        }
        for (const std::size_t i : part)
            result[i] = left_out;
    }
    return result;
}

/// Returns all atoms of a cell. If images are nearer to each other than atoms can be, takes the
/// first. Molecules stay together, with their middles in the cell.
Model model_of(const gemmi::SmallStructure& structure) {
    constexpr double one_place = 0.4 * 0.4; // angstrom^2
    constexpr double at_edge = 1e-6;        // of a cell: rounding must not move a molecule
    const gemmi::UnitCell& cell = structure.cell;
    const Sites& sites = structure.sites;
    Model model;
    model.title = structure.name;
    model.is_small = true;
    take_cell(cell, model);
    const std::vector<std::size_t> molecule = molecules_of(sites, cell);
    std::vector<gemmi::Fractional> middle(sites.size());
    std::vector<double> size(sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i) {
        middle[molecule[i]] = gemmi::Fractional(middle[molecule[i]] + sites[i].fract);
        size[molecule[i]] += 1.0;
    }
    std::vector<gemmi::FTransform> operations = {gemmi::FTransform(gemmi::Transform())};
    operations.insert(operations.end(), cell.images.begin(), cell.images.end());
    const auto place = [&](std::size_t i, std::size_t operation) {
        const gemmi::Vec3 of_molecule = middle[molecule[i]] / size[molecule[i]];
        const gemmi::Fractional moved = operations[operation].apply(gemmi::Fractional(of_molecule));
        const gemmi::Fractional cells(std::floor(moved.x + at_edge), std::floor(moved.y + at_edge),
                                      std::floor(moved.z + at_edge));
        return gemmi::Fractional(operations[operation].apply(sites[i].fract) - cells);
    };
    const auto left_out = images_left_out(structure, molecule, operations.size(), place);
    Residue all;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        std::vector<gemmi::Fractional> places;
        for (std::size_t operation = 0; operation < operations.size(); ++operation) {
            if (left_out[i] && (*left_out[i])[operation] != 0) continue;
            const gemmi::Fractional at = place(i, operation);
            const auto is_here = [&](const gemmi::Fractional& other) {
                return cell.distance_sq(at, other) < one_place;
            };
            if (std::any_of(places.begin(), places.end(), is_here)) continue;
            places.push_back(at);
            all.atoms.push_back(image_of(sites[i], cell, at, operations[operation].mat));
        }
    }
    model.chains.push_back({"", {std::move(all)}});
    return model;
}

/// Returns an operation of symmetry with its decimals in 24ths: "0.5-Y" becomes "12/24-Y".
std::string with_fractions(const std::string& operation) {
    constexpr double parts = 24.0;
    std::string result;
    for (std::size_t at = 0; at < operation.size();) {
        const std::size_t end =
            std::min(operation.find_first_not_of("0123456789.", at), operation.size());
        const std::string number = operation.substr(at, end - at);
        if (number.find('.') != std::string::npos) {
            const double value = parts * std::strtod(number.c_str(), nullptr);
            result += std::to_string(std::lround(value)) + "/24";
            at = end;
        } else {
            result += operation[at++];
        }
    }
    return result;
}

/// Returns a space group's name without the marks of subscripts ("P2(1)/c", "P 2_1/c") and without
/// remarks in parentheses ("P 1 21/c 1 (b)").
std::string plain_name(const std::string& name) {
    std::string plain;
    for (std::size_t at = 0; at < name.size(); ++at)
        if (name[at] == '(' && at + 2 < name.size() && name[at + 1] >= '1' && name[at + 1] <= '5' &&
            name[at + 2] == ')') {
            plain += name[at + 1];
            at += 2;
        } else if (name[at] == '(') {
            break;
        } else if (name[at] != '_') {
            plain += name[at];
        }
    return plain.substr(0, plain.find_last_not_of(' ') + 1);
}

/// Finds a space group by its name: unchanged, with the setting in ICSD's notation (H, R; S and Z
/// for origins 1 and 2), with a bar that older names omit, or short ("F 4/m -3 2/m" is "F m -3 m").
const gemmi::SpaceGroup* group_of(const std::string& name, const gemmi::UnitCell& cell) {
    const auto find = [&](const std::string& as) {
        return gemmi::find_spacegroup_by_name(as, cell.alpha, cell.gamma);
    };
    if (const gemmi::SpaceGroup* group = find(name)) return group;
    std::string own = plain_name(name), setting;
    const std::size_t last = own.find_last_not_of(' ');
    if (last != std::string::npos && last > 1 && own[last - 1] == ' ')
        if (const std::size_t known = std::string("HRSZ").find(own[last]); known < 4) {
            setting = std::string(":") + "HR12"[known];
            own.resize(last - 1);
        }
    std::string with_bar = own, short_name;
    if (const std::size_t three = with_bar.find(" 3 "); three != std::string::npos)
        with_bar.insert(three + 1, "-");
    for (std::size_t at = 0; at < own.size(); ++at)
        if (at + 1 < own.size() && own[at + 1] == '/')
            ++at;
        else
            short_name += own[at];
    for (const std::string& other : {own, with_bar, short_name})
        if (const gemmi::SpaceGroup* group = find(other + setting)) return group;
    return nullptr;
}

void add_operation(const gemmi::Op& op, gemmi::UnitCell& cell) {
    if (op != gemmi::Op::identity())
        cell.images.emplace_back(
            gemmi::Transform{gemmi::rot_as_mat33(op), gemmi::tran_as_vec3(op)});
}

constexpr int max_operations = 192; ///< F m -3 m has as many

/// Takes the file's operations, or if it has none, those of its space group.
void find_operations(gemmi::cif::Block& block, gemmi::SmallStructure& structure,
                     std::vector<std::string>& remarks) {
    for (const char* tag : {"_space_group_symop_operation_xyz", "_symmetry_equiv_pos_as_xyz"}) {
        gemmi::cif::Column operations = block.find_values(tag);
        if (std::all_of(operations.begin(), operations.end(), gemmi::cif::is_null)) continue;
        if (operations.length() > max_operations)
            throw std::runtime_error("must have at most " + std::to_string(max_operations) +
                                     " operations of symmetry, got " +
                                     std::to_string(operations.length()));
        structure.cell.images.clear();
        for (const std::string& text : operations)
            add_operation(gemmi::parse_triplet(with_fractions(gemmi::cif::as_string(text))),
                          structure.cell);
        return;
    }
    for (const char* tag : {"_space_group_name_Hall", "_symmetry_space_group_name_Hall"}) {
        const std::string* hall = block.find_value(tag);
        if (hall == nullptr || gemmi::cif::is_null(*hall)) continue;
        try {
            const gemmi::GroupOps operations =
                gemmi::symops_from_hall(gemmi::cif::as_string(*hall).c_str());
            structure.cell.images.clear();
            for (const gemmi::Op& op : operations)
                add_operation(op, structure.cell);
        } catch (const std::exception&) {
            continue; // may be misspelt: tries the other name
        }
        return;
    }
    const gemmi::SpaceGroup* group = group_of(structure.spacegroup_hm, structure.cell);
    for (const char* tag : {"_space_group_IT_number", "_symmetry_Int_Tables_number"})
        if (const std::string* number = block.find_value(tag); number && group == nullptr) {
            group = gemmi::find_spacegroup_by_number(gemmi::cif::as_int(*number, 0));
            if (group != nullptr && !structure.spacegroup_hm.empty())
                remarks.push_back("the space group \"" + structure.spacegroup_hm +
                                  "\" is unknown: number " + gemmi::cif::as_string(*number) +
                                  " is used in its standard setting, " + group->hm);
        }
    if (group == nullptr && !structure.spacegroup_hm.empty())
        throw std::runtime_error("space group \"" + structure.spacegroup_hm +
                                 "\" is unknown, and the file has no operations of symmetry");
    structure.cell.set_cell_images_from_spacegroup(group);
}

/// Reads B of CIF for sites without U.
void read_aniso_b(gemmi::cif::Block& block, Sites& sites) {
    for (auto row : block.find("_atom_site_aniso_",
                               {"label", "B_11", "B_22", "B_33", "B_12", "B_13", "B_23"})) {
        const auto site = std::find_if(sites.begin(), sites.end(),
                                       [&](const auto& of) { return of.label == row.str(0); });
        if (site == sites.end() || site->aniso.nonzero()) continue;
        const auto u = [&](std::size_t column) {
            return gemmi::cif::as_number(row[column], 0.0) / gemmi::u_to_b();
        };
        site->aniso = {u(1), u(2), u(3), u(4), u(5), u(6)};
    }
}

void require_coordinate(const std::string& text, const std::string& of) {
    if (!std::isfinite(gemmi::cif::as_number(text)))
        throw std::runtime_error("the coordinates of " + of + " must be numbers, got \"" + text +
                                 "\"");
}

/// Keeps the atom of the highest occupancy, or the first one, of those that share a site, as in a
/// solid solution.
void keep_one_of_each_site(Sites& sites, std::vector<std::string>& remarks) {
    std::map<std::array<double, 3>, std::size_t> at;
    Sites kept;
    std::string shared; // the first two elements on one site
    for (auto& site : sites) {
        const auto [found, is_new] =
            at.try_emplace({site.fract.x, site.fract.y, site.fract.z}, kept.size());
        if (is_new) {
            kept.push_back(std::move(site));
            continue;
        }
        auto& other = kept[found->second];
        if (shared.empty() && other.element != site.element)
            shared = other.label + " and " + site.label;
        if (site.occ > other.occ) other = std::move(site);
    }
    sites = std::move(kept);
    if (!shared.empty())
        remarks.push_back("different elements share a site (" + shared +
                          "): only the one of the highest occupancy is rendered");
}

/// Returns the structure of a block, without sites that lack coordinates and without alternative
/// disorder groups.
gemmi::SmallStructure crystal_of(gemmi::cif::Block& block, std::vector<std::string>& remarks) {
    gemmi::SmallStructure structure = gemmi::make_small_structure_from_block(block);
    if (structure.sites.empty()) return structure;
    const gemmi::UnitCell& cell = structure.cell;
    if (!cell.is_crystal() || !(cell.volume > 0.0 && cell.volume < 1e30))
        throw std::runtime_error(
            "must have a cell (_cell_length_a, ...), because its coordinates are fractions of it");
    std::size_t site = 0;
    Sites placed;
    std::map<std::string, std::string>
        group_of_assembly; // the first of those that exclude each other
    for (auto row : block.find("_atom_site_", {"label", "fract_x", "fract_y", "fract_z",
                                               "?disorder_assembly", "?disorder_group"})) {
        const gemmi::SmallStructure::Site& of = structure.sites.at(site++);
        bool lacks = false;
        for (std::size_t axis = 1; axis < 4; ++axis)
            if (gemmi::cif::is_null(row[axis]))
                lacks = true;
            else
                require_coordinate(row[axis], of.label);
        if (row.has(5) && !gemmi::cif::is_null(row[5])) {
            const std::string assembly = row.has(4) ? row.str(4) : std::string();
            if (group_of_assembly.emplace(assembly, row.str(5)).first->second != row.str(5))
                continue;
        }
        if (!lacks) placed.push_back(of);
    }
    keep_one_of_each_site(placed, remarks);
    structure.sites = std::move(placed);
    find_operations(block, structure, remarks);
    read_aniso_b(block, structure.sites);
    return structure;
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
        if (const std::string of = text(conformer); !of.empty()) added.conformer = of[0];
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
                std::vector<Model> of_block = models_of(block);
                std::move(of_block.begin(), of_block.end(), std::back_inserter(models));
                read_secondary(block, result.secondary);
                continue;
            }
            const gemmi::SmallStructure structure = crystal_of(block, remarks);
            if (!structure.sites.empty()) models.push_back(model_of(structure));
        }
        return result;
    } catch (const std::exception& error) {
        throw Refused(error.what());
    }
}

} // namespace raylane::scenes::gemmi_files
