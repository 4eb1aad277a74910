#include "core/shapes/checks.hpp"
#include "scenes/errors.hpp"
#include "scenes/structure/kind_table.hpp"
#include "scenes/structure/labels.hpp"
#include "scenes/structure/lines.hpp"
#include "scenes/structure/readers.hpp"

#ifdef RAYLANE_WITH_GEMMI

#include "scenes/structure/gemmi_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

namespace raylane::scenes {

namespace {

/// "file:line:column(byte): message" and the like: the message alone, with its line.
[[noreturn]] void fail(const std::string& name, std::string text) {
    TextPosition position;
    if (text.starts_with(name + ":")) {
        text.erase(0, name.size() + 1);
        const std::size_t end = text.find(": ");
        if (end != std::string::npos) {
            const int read =
                std::sscanf(text.c_str(), "%zu:%zu", &position.line, &position.column); // NOLINT
            if (read < 1) position = {};
            text.erase(0, end + 2);
        }
    }
    throw BadInput(
        {{.file = name, .position = position, .place = {}, .message = printable(text, 200)}});
}

using Orders = std::map<std::pair<int, int>, int>; ///< of bonds, by serial numbers, ascending

/// Models, one after the other.
class ModelReader : public FrameReader {
  public:
    ModelReader(std::string file, std::vector<gemmi_files::Model> models, Orders bonds)
        : file_(std::move(file)), models_(std::move(models)), bonds_(std::move(bonds)) {}

    bool next(Structure& frame) override {
        if (number_ == models_.size()) return false;
        const gemmi_files::Model& model = models_[number_++];
        frame = {};
        frame.title = model.title;
        if (model.has_cell)
            for (std::size_t k = 0; k < 3; ++k)
                frame.cell.edges[k] = {model.edges[k][0], model.edges[k][1], model.edges[k][2]};
        frame.properties = {{"b_factor", {}}, {"occupancy", {}}};
        KindTable kinds(frame.of_kind);
        std::unordered_map<int, AtomIndex> atom_of;
        for (const gemmi_files::Chain& chain : model.chains) {
            if (!model.is_small) frame.chains.push_back(chain.name);
            for (const gemmi_files::Residue& residue : chain.residues)
                add(residue, model.is_small, frame, kinds, atom_of);
        }
        if (model.is_small) frame.properties.erase(frame.properties.begin());
        for (const auto& [serials, order] : bonds_) {
            const auto a = atom_of.find(serials.first), b = atom_of.find(serials.second);
            if (a == atom_of.end() || b == atom_of.end()) continue;
            frame.bonds.push_back({std::min(a->second, b->second), std::max(a->second, b->second),
                                   static_cast<std::uint8_t>(std::clamp(order, 1, 3))});
        }
        return true;
    }

  private:
    void add(const gemmi_files::Residue& residue, bool is_small, Structure& frame, KindTable& kinds,
             std::unordered_map<int, AtomIndex>& atom_of) const {
        const auto index = static_cast<std::uint32_t>(frame.of_residue.size());
        if (!is_small)
            frame.of_residue.push_back(
                {.name = residue.name,
                 .number = residue.number,
                 .insertion = residue.insertion,
                 .chain = static_cast<std::uint32_t>(frame.chains.size() - 1),
                 .is_hetero = residue.is_hetero});
        // Of places that exclude each other, those of the first.
        char conformer = '\0';
        for (const gemmi_files::Atom& atom : residue.atoms) {
            if (conformer == '\0') conformer = atom.conformer;
            if (atom.conformer != '\0' && atom.conformer != conformer) continue;
            const auto at = static_cast<AtomIndex>(frame.size());
            for (const double coordinate : atom.at) // may be none of a float's
                if (!(std::abs(coordinate) <= static_cast<double>(core::coordinate_limit)))
                    throw BadInput(file_, "",
                                   "the coordinates of " + printable(atom.name) +
                                       " must be from -1e30 to 1e30");
            const Element element = atom.element > 0 && atom.element < element_count
                                        ? static_cast<Element>(atom.element)
                                    : is_small ? element_of_label(atom.name)
                                               : element_of_atom(atom.name, residue.name);
            frame.positions.push_back(
                core::convert<float>(core::Vec3d(atom.at[0], atom.at[1], atom.at[2])));
            frame.kinds.push_back(static_cast<std::uint16_t>(kinds.index_of(
                data_of(element).symbol, [&](std::string_view) { return element; })));
            frame.properties[0].values.push_back(atom.b_factor);
            frame.properties[1].values.push_back(atom.occupancy);
            frame.names.push_back(atom.name);
            if (atom.has_u) {
                const auto& u = atom.u;
                frame.anisotropies.push_back({at, {u[0], u[1], u[2], u[3], u[4], u[5]}});
            }
            if (is_small) continue;
            frame.residues.push_back(index);
            atom_of.emplace(atom.serial, at);
        }
    }

    std::string file_;
    std::vector<gemmi_files::Model> models_;
    Orders bonds_;
    std::size_t number_ = 0;
};

bool is_atom(std::string_view line) {
    return line.starts_with("ATOM") || line.starts_with("HETATM");
}

/// A field of a record, without blanks. Columns count from 1, as in the PDB format.
std::string_view field(std::string_view line, std::size_t column, std::size_t width) {
    return line.size() < column ? std::string_view() : trimmed(line.substr(column - 1, width));
}

/// True where names begin in column 13 throughout, which only symbols of two letters and names of
/// four are to do: AMBER, CHARMM and older tools write so.
bool is_shifted(const InputFile& file, std::string_view text) {
    bool any = false;
    InputFile again(file.name(), text);
    for (Lines lines(again); lines.next();) {
        const std::string_view line = lines.text();
        if (!is_atom(line) || line.size() < 16 || !is_polymer_residue(field(line, 18, 3))) continue;
        if (line[12] == ' ') return false;
        any = any || field(line, 13, 4).size() < 4;
    }
    return any;
}

/// The element of an atom of a PDB file that does not say it: by columns, and where these are of no
/// use, by the name and its residue.
Element element_of_record(std::string_view line, bool is_shifted) {
    const std::string_view name = field(line, 13, 4), residue = field(line, 18, 3);
    const bool begins_early = line.size() > 13 && line[12] != ' ' && name.size() < 4;
    if (begins_early && !is_shifted && !is_polymer_residue(residue))
        if (const Element element = element_of(field(line, 13, 2))) return element;
    if (line.size() > 13 && line[12] == ' ' && !is_shifted)
        if (const Element element = element_of(field(line, 14, 1))) return element;
    return element_of_atom(name, residue);
}

/// Refuses what gemmi takes without a word: coordinates that are none. Says the elements that the
/// file does not. Takes charges away, which gemmi is strict about and nobody asks for; and reads
/// CONECT, which it leaves out.
std::string checked(const InputFile& file, std::string_view text, Orders& bonds) {
    constexpr std::size_t symbol = 76, charge = 78;
    const bool names_are_shifted = is_shifted(file, text);
    InputFile again(file.name(), text);
    std::string result;
    result.reserve(text.size());
    std::map<std::pair<int, int>, int> directed;
    std::string with_element;
    for (Lines lines(again); lines.next();) {
        std::string_view line = lines.text();
        if (is_atom(line)) {
            for (std::size_t column = 31; column < 55; column += 8)
                if (const std::string_view x = field(line, column, 8); !number_in(x))
                    lines.fail("a coordinate must be a number, got \"" + printable(x) + "\"",
                               column);
            line = line.substr(0, charge);
            if (element_of(field(line, symbol + 1, 2)) == 0) {
                const Element element = element_of_record(line, names_are_shifted);
                const std::string_view said = element != 0 ? data_of(element).symbol : "X";
                with_element = line.substr(0, symbol);
                with_element.resize(charge - said.size(), ' ');
                with_element += said;
                line = with_element;
            }
        } else if (line.starts_with("CONECT")) {
            const auto serial = [&](std::size_t at) {
                const double number =
                    line.size() > at ? number_in(trimmed(line.substr(at, 5))).value_or(0.0) : 0.0;
                return number > 0.0 && number < 1e6 ? static_cast<int>(number) : 0;
            };
            const int from = serial(6);
            for (std::size_t at = 11; at < 31; at += 5)
                if (const int to = serial(at); to != 0 && to != from) ++directed[{from, to}];
        }
        // Of other records nothing is drawn, and gemmi reads beyond the end of some (LINK, "NaN").
        constexpr std::string_view records[] = {"HEADER", "TITLE",  "CRYST1", "MODEL", "ENDMDL",
                                                "ATOM",   "HETATM", "ANISOU", "TER",   "END"};
        if (std::none_of(std::begin(records), std::end(records),
                         [&](std::string_view record) { return line.starts_with(record); }))
            line = {};
        // No PDB has others, and gemmi shifts their bits into signs.
        for (const char c : line)
            result.push_back(static_cast<unsigned char>(c) > 127 ? '?' : c);
        result.push_back('\n');
    }
    // Each bond is there from both of its ends, a double one twice from each.
    for (const auto& [serials, times] : directed) {
        int& order = bonds[std::minmax(serials.first, serials.second)];
        order = std::max(order, times);
    }
    return result;
}

} // namespace

std::unique_ptr<FrameReader> open_pdb(InputFile& file) {
    Orders bonds;
    const std::string text = checked(file, file.read_all(), bonds);
    try {
        std::vector<gemmi_files::Model> models = gemmi_files::read_pdb(text, file.name());
        if (models.empty())
            throw BadInput(file.name(), "", "must have ATOM or HETATM records, got none");
        return std::make_unique<ModelReader>(file.name(), std::move(models), std::move(bonds));
    } catch (const gemmi_files::Refused& refused) {
        fail(file.name(), refused.what());
    }
}

std::unique_ptr<FrameReader> open_cif(InputFile& file) {
    const std::string text = file.read_all();
    try {
        std::vector<gemmi_files::Model> models = gemmi_files::read_cif(text, file.name());
        if (models.empty())
            throw BadInput(file.name(), "", "must have a table _atom_site, got none");
        return std::make_unique<ModelReader>(file.name(), std::move(models), Orders());
    } catch (const gemmi_files::Refused& refused) {
        fail(file.name(), refused.what());
    }
}

} // namespace raylane::scenes

#else

namespace raylane::scenes {

namespace {

[[noreturn]] void fail(const InputFile& file, const char* format) {
    throw BadInput(
        file.name(), "",
        std::string("cannot be read: raylane was built without gemmi-dev, which reads ") + format);
}

} // namespace

std::unique_ptr<FrameReader> open_pdb(InputFile& file) {
    fail(file, "PDB");
}
std::unique_ptr<FrameReader> open_cif(InputFile& file) {
    fail(file, "mmCIF and CIF");
}

} // namespace raylane::scenes

#endif
