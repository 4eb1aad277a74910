#include "scenes/formats/structure/gemmi_crystal.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <gemmi/cif.hpp>
#include <gemmi/smcif.hpp>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

namespace raylane::scenes::gemmi_files {

namespace {

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
    Residue residue;
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
            residue.atoms.push_back(image_of(sites[i], cell, at, operations[operation].mat));
            residue.atoms.back().serial = static_cast<int>(operation) + 1;
        }
    }
    model.chains.push_back({"", {std::move(residue)}});
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
                                       [&](const auto& each) { return each.label == row.str(0); });
        if (site == sites.end() || site->aniso.nonzero()) continue;
        const auto u = [&](std::size_t column) {
            return gemmi::cif::as_number(row[column], 0.0) / gemmi::u_to_b();
        };
        site->aniso = {u(1), u(2), u(3), u(4), u(5), u(6)};
    }
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
        const gemmi::SmallStructure::Site& site_data = structure.sites.at(site++);
        bool lacks = false;
        for (std::size_t axis = 1; axis < 4; ++axis)
            if (gemmi::cif::is_null(row[axis]))
                lacks = true;
            else
                require_coordinate(row[axis], site_data.label);
        if (row.has(5) && !gemmi::cif::is_null(row[5])) {
            const std::string assembly = row.has(4) ? row.str(4) : std::string();
            if (group_of_assembly.emplace(assembly, row.str(5)).first->second != row.str(5))
                continue;
        }
        if (!lacks) placed.push_back(site_data);
    }
    keep_one_of_each_site(placed, remarks);
    structure.sites = std::move(placed);
    find_operations(block, structure, remarks);
    read_aniso_b(block, structure.sites);
    return structure;
}

} // namespace

std::optional<Model> crystal_in(gemmi::cif::Block& block, std::vector<std::string>& remarks) {
    const gemmi::SmallStructure structure = crystal_of(block, remarks);
    if (structure.sites.empty()) return std::nullopt;
    return model_of(structure);
}

} // namespace raylane::scenes::gemmi_files
