#include "core/shapes/checks.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/kind_table.hpp"
#include "scenes/formats/structure/labels.hpp"
#include "scenes/formats/structure/lines.hpp"
#include "scenes/formats/structure/readers.hpp"

#ifdef RAYLANE_WITH_GEMMI

#include "scenes/formats/structure/gemmi_files.hpp"
#include "scenes/formats/structure/secondary_records.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

namespace raylane::scenes {

namespace {

/// Throws the message of "file:line:column(byte): message" and the like, with its position.
[[noreturn]] void fail(const std::string& name, std::string text) {
    TextPosition position;
    if (text.starts_with(name + ":")) {
        text.erase(0, name.size() + 1);
        const std::size_t end = text.find(": ");
        const bool has_place = end != std::string::npos &&
                               std::sscanf(text.c_str(), "%zu:%zu", &position.line, // NOLINT
                                           &position.column) >= 1;
        text.erase(0, has_place ? end + 2 : text.find_first_not_of(' '));
    }
    throw BadInput(
        {{.file = name, .position = position, .place = {}, .message = printable(text, 200)}});
}

using Directed = std::vector<std::pair<int, int>>; ///< CONECT's, from one serial to another
using Orders = std::map<std::pair<int, int>, int>; ///< of bonds, by serial numbers, ascending

/// Returns the order of each bond, which is the number of times that an end of the bond lists it.
/// CONECT lists each bond at both of its ends, a double bond twice at each end.
Orders orders_of(Directed directed) {
    Orders orders;
    std::sort(directed.begin(), directed.end());
    for (auto first = directed.begin(); first != directed.end();) {
        const auto end = std::upper_bound(first, directed.end(), *first);
        int& order = orders[std::minmax(first->first, first->second)];
        order = std::max(order, static_cast<int>(end - first));
        first = end;
    }
    return orders;
}

struct ModelAndBonds {
    gemmi_files::Model model;
    Directed bonds;        ///< besides those of its entry and of all models
    std::size_t entry = 0; ///< index
};

/// Records that several models share.
struct SharedRecords {
    Directed bonds;                       ///< of all models
    std::vector<Directed> bonds_of_entry; ///< of each part that END separates
    std::vector<std::vector<gemmi_files::SecondaryRange>> secondary_of_entry;
};

/// Returns models, one after the other.
class ModelReader : public FrameReader {
  public:
    ModelReader(std::string file, std::vector<ModelAndBonds> models, SharedRecords shared)
        : file_(std::move(file)), models_(std::move(models)), shared_(std::move(shared)) {}

    bool next(Structure& frame) override {
        if (number_ == models_.size()) return false;
        const auto& [model, own_bonds, entry] = models_[number_++];
        frame = {};
        if (!model.title.empty() || model.is_small) title_ = model.title;
        frame.title = title_;
        if (model.has_cell)
            for (std::size_t k = 0; k < 3; ++k)
                frame.cell.edges[k] = {model.edges[k][0], model.edges[k][1], model.edges[k][2]};
        frame.is_crystal = model.is_small && model.has_cell;
        frame.properties = {{"b_factor", {}}, {"occupancy", {}}};
        if (model.is_small) frame.properties.push_back({"symmetry", {}});
        KindTable kinds(frame.of_kind);
        std::unordered_map<int, AtomIndex> atom_of;
        for (const gemmi_files::Chain& chain : model.chains) {
            if (!model.is_small) frame.chains.push_back(chain.name);
            const gemmi_files::Residue* before = nullptr;
            char conformer = '\0';
            for (const gemmi_files::Residue& residue : chain.residues) {
                const bool is_same_place = before != nullptr && before->number == residue.number &&
                                           before->insertion == residue.insertion;
                if (!is_same_place) conformer = '\0';
                add(residue, model.is_small, conformer, frame, kinds, atom_of);
                before = &residue;
            }
        }
        if (!frame.anisotropies.empty()) add_isotropies(frame);
        assign_secondary(shared_.secondary_of_entry.at(entry), frame);
        if (model.is_small) frame.properties.erase(frame.properties.begin());
        Directed bonds = shared_.bonds;
        const Directed& of_entry = shared_.bonds_of_entry.at(entry);
        bonds.insert(bonds.end(), of_entry.begin(), of_entry.end());
        bonds.insert(bonds.end(), own_bonds.begin(), own_bonds.end());
        for (const auto& [serials, order] : orders_of(std::move(bonds))) {
            const auto a = atom_of.find(serials.first), b = atom_of.find(serials.second);
            if (a == atom_of.end() || b == atom_of.end()) continue;
            frame.bonds.push_back({std::min(a->second, b->second), std::max(a->second, b->second),
                                   static_cast<std::uint8_t>(std::clamp(order, 1, 3))});
        }
        return true;
    }

  private:
    /// Sets the isotropic displacements of atoms that have only a B factor.
    static void add_isotropies(Structure& frame) {
        constexpr float b_of_u = 78.956835F; // 8 pi^2
        for (const float b : frame.properties[0].values)
            frame.isotropies.push_back(b / b_of_u);
        for (const Anisotropy& anisotropy : frame.anisotropies)
            frame.isotropies[anisotropy.atom] = 0.0F;
    }

    /// Adds a residue's atoms. If atoms have alternative places, adds only those of the first
    /// conformer, which `conformer` keeps. Residues with the same number share `conformer` (1CBN
    /// has SER or PRO as residue 22).
    void add(const gemmi_files::Residue& residue, bool is_small, char& conformer, Structure& frame,
             KindTable& kinds, std::unordered_map<int, AtomIndex>& atom_of) const {
        const auto index = static_cast<std::uint32_t>(frame.of_residue.size());
        if (!is_small)
            frame.of_residue.push_back(
                {.name = residue.name,
                 .number = residue.number,
                 .insertion = residue.insertion,
                 .chain = static_cast<std::uint32_t>(frame.chains.size() - 1),
                 .is_hetero = residue.is_hetero});
        for (const gemmi_files::Atom& atom : residue.atoms) {
            if (conformer == '\0') conformer = atom.conformer;
            if (atom.conformer != '\0' && atom.conformer != conformer) continue;
            const auto at = static_cast<AtomIndex>(frame.size());
            for (const double coordinate : atom.at) // may be out of a float's range
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
            if (is_small) {
                frame.properties[2].values.push_back(static_cast<float>(atom.serial));
                continue;
            }
            frame.residues.push_back(index);
            atom_of.emplace(atom.serial, at);
        }
    }

    std::string file_;
    std::vector<ModelAndBonds> models_;
    SharedRecords shared_;
    std::string title_; // of the last model that has one
    std::size_t number_ = 0;
};

bool is_atom(std::string_view line) {
    return line.starts_with("ATOM") || line.starts_with("HETATM");
}

/// Returns a field of a record, without blanks. Columns count from 1, as in the PDB format.
std::string_view field(std::string_view line, std::size_t column, std::size_t width) {
    return line.size() < column ? std::string_view() : trimmed(line.substr(column - 1, width));
}

/// The residues of a PDB file whose atom names all begin in column 13. In the PDB format, only
/// names with an element symbol of two letters and names of four characters begin there. AMBER,
/// CHARMM and older tools write such residues.
class ShiftedResidues {
  public:
    ShiftedResidues(const InputFile& file, std::string_view text) {
        InputFile again(file.name(), text);
        for (Lines lines(again); lines.next();) {
            const std::string_view line = lines.text();
            if (!is_atom(line) || line.size() < 16) continue;
            const std::string_view name = field(line, 13, 4), residue = residue_of(line);
            auto found = columns_.find(residue);
            if (found == columns_.end()) found = columns_.emplace(residue, Columns()).first;
            if (line[12] == ' ')
                found->second.has_14 = true;
            else if (name.size() < 4 && (residue == polymers || is_one_letter(name)))
                found->second.has_early_13 = true;
        }
    }

    /// Returns true if the line's residue is shifted. If the names in the residue do not decide
    /// this, the names in all polymer residues do.
    bool has(std::string_view line) const {
        const auto residues = columns_.find(residue_of(line)),
                   of_polymers = columns_.find(polymers);
        if (residues != columns_.end() && residues->second.has_14) return false;
        return (residues != columns_.end() && residues->second.has_early_13) ||
               (of_polymers != columns_.end() && of_polymers->second.is_shifted());
    }

  private:
    struct Columns {
        bool has_14 = false, has_early_13 = false; ///< columns in which names begin
        bool is_shifted() const { return has_early_13 && !has_14; }
    };

    static constexpr std::string_view polymers = "polymers";
    /// Returns the name of the line's residue, or `polymers`.
    static std::string_view residue_of(std::string_view line) {
        const std::string_view residue = field(line, 18, 3);
        return is_polymer_residue(residue) ? polymers : residue;
    }
    /// Returns true for a name with a symbol of one letter: "C", "O1", "N1A".
    static bool is_one_letter(std::string_view name) {
        return !name.empty() && is_letter(name[0]) && (name.size() == 1 || !is_letter(name[1])) &&
               element_of(name.substr(0, 1)) != 0;
    }

    std::map<std::string, Columns, std::less<>> columns_;
};

/// Returns the element of an atom for which a PDB file has no element. It is that of an ion, or
/// follows from the columns in which the name stands. Otherwise it follows from the names of the
/// atom and its residue.
Element element_of_record(std::string_view line, bool is_shifted) {
    const std::string_view name = field(line, 13, 4), residue = field(line, 18, 3);
    if (const Element element = element_of_ion(name, residue)) return element;
    const bool begins_early = line.size() > 13 && line[12] != ' ' && name.size() < 4;
    if (begins_early && !is_shifted && !is_polymer_residue(residue))
        if (const Element element = element_of(field(line, 13, 2))) return element;
    if (line.size() > 13 && line[12] == ' ' && !is_shifted)
        if (const Element element = element_of(field(line, 14, 1))) return element;
    return element_of_atom(name, residue);
}

/// One model of a PDB file, as text for gemmi.
struct ModelText {
    std::string text;
    std::size_t lines_of_head = 0;
    std::uint64_t first_line = 0; ///< of the file, behind the head
    Directed bonds;
    std::size_t entry = 0;
};

/// Splits a PDB file into models. gemmi needs the numbers of the models to be unique, and ignores
/// CONECT. CONECT in a model applies to that model. Elsewhere, CONECT applies to all models of the
/// part of the file that END separates from others, as in joined files. If that part has no model,
/// CONECT applies to all models of the file.
class PdbModels {
  public:
    /// `text` must outlive this object.
    PdbModels(const InputFile& file, std::string_view text) : file_(file), text_(text) {
        InputFile again(file.name(), text);
        for (Lines lines(again); lines.next();)
            take(lines);
        end_entry();
    }

    const std::vector<ModelText>& models() const { return models_; }
    const SharedRecords& shared_records() const { return shared_; }

  private:
    void take(const Lines& lines) {
        const std::string_view line = lines.text();
        if (line.starts_with("MODEL")) {
            is_open_ = false; // the first atom opens it
            in_model_ = true;
        } else if (const std::string_view word = Words(lines).next();
                   word == "END" || word == "ENDMDL") { // not ENDROOT of PDBQT
            is_open_ = in_model_ = false;
            if (word == "END") end_entry();
        } else if (is_atom(line)) {
            if (!is_open_) open(lines.number());
            append_atom(lines);
            return;
        } else if (line.starts_with("HELIX") || line.starts_with("SHEET")) {
            read_secondary(line, shared_.secondary_of_entry.back());
        } else if (line.starts_with("CONECT")) {
            take_bonds(line, in_model_ && is_open_ ? models_.back().bonds
                                                   : shared_.bonds_of_entry.back());
        } else if (line.starts_with("HEADER") || line.starts_with("TITLE") ||
                   line.starts_with("CRYST1")) {
            if (is_open_)
                append(models_.back().text, line);
            else if (line.starts_with("CRYST1"))
                append(cell_ = std::string(), line.substr(0, longest_record));
            else
                add_to_title(line);
            return;
        } else if (is_open_ && (line.starts_with("ANISOU") || line.starts_with("TER"))) {
            append(models_.back().text, line);
            return;
        }
        // Other records are not rendered, and gemmi reads beyond the end of some (LINK, "NaN").
        if (is_open_) append(models_.back().text, {});
    }

    void end_entry() {
        const bool has_models =
            !models_.empty() && models_.back().entry + 1 == shared_.bonds_of_entry.size();
        if (!has_models) {
            Directed& bonds = shared_.bonds_of_entry.back();
            shared_.bonds.insert(shared_.bonds.end(), bonds.begin(), bonds.end());
            bonds.clear();
            return;
        }
        shared_.bonds_of_entry.emplace_back();
        shared_.secondary_of_entry.emplace_back();
        is_title_of_last_entry_ = true;
    }

    void add_to_title(std::string_view line) {
        if (is_title_of_last_entry_) title_.clear();
        is_title_of_last_entry_ = false;
        if (title_.size() + line.size() >= longest_title) return;
        append(title_, line);
        is_title_new_ = true;
    }

    void open(std::uint64_t line) {
        ModelText& model = models_.emplace_back();
        if (is_title_new_) model.text = title_; // the next models share it
        is_title_new_ = false;
        model.text += cell_;
        model.entry = shared_.bonds_of_entry.size() - 1;
        model.lines_of_head =
            static_cast<std::size_t>(std::count(model.text.begin(), model.text.end(), '\n'));
        model.first_line = line;
        is_open_ = true;
    }

    /// Replaces characters other than ASCII, which PDB does not have, and whose bits gemmi shifts
    /// into signs.
    static void append(std::string& text, std::string_view line) {
        for (const char c : line)
            text.push_back(static_cast<unsigned char>(c) > 127 ? '?' : c);
        text.push_back('\n');
    }

    /// Refuses coordinates that are not numbers, which gemmi accepts silently. Adds the element if
    /// the file lacks it. Omits the charge, about which gemmi is strict.
    void append_atom(const Lines& lines) {
        constexpr std::size_t symbol = 76, charge = 78;
        std::string_view line = lines.text();
        for (std::size_t column = 31; column < 55; column += 8)
            if (const std::string_view x = field(line, column, 8); !number_in(x))
                lines.fail("a coordinate must be a number, got \"" + printable(x) + "\"", column);
        line = line.substr(0, charge);
        std::string with_element;
        if (element_of(field(line, symbol + 1, 2)) == 0) {
            if (!shifted_) shifted_.emplace(file_, text_);
            const Element element = element_of_record(line, shifted_->has(line));
            const std::string_view said = element != 0 ? data_of(element).symbol : "X";
            with_element = line.substr(0, symbol);
            with_element.resize(charge - said.size(), ' ');
            with_element += said;
            line = with_element;
        }
        append(models_.back().text, line);
    }

    static void take_bonds(std::string_view line, Directed& bonds) {
        const auto serial = [&](std::size_t column) {
            const double number = number_in(field(line, column, 5)).value_or(0.0);
            return number > 0.0 && number < 1e6 ? static_cast<int>(number) : 0;
        };
        const int from = serial(7);
        for (std::size_t column = 12; column < 32; column += 5)
            if (const int to = serial(column); to != 0 && to != from) bonds.emplace_back(from, to);
    }

    /// Without these limits, titles and cells that many models share would take memory in
    /// proportion to the square of the file's size.
    static constexpr std::size_t longest_title = 4096, longest_record = 80;

    const InputFile& file_;
    std::string_view text_;
    std::optional<ShiftedResidues> shifted_; ///< set when an element is first missing
    bool is_open_ = false;                   ///< further atoms belong to the last model
    bool in_model_ = false;                  ///< between MODEL and ENDMDL
    bool is_title_new_ = false;              ///< no model has the title yet
    bool is_title_of_last_entry_ = false;
    std::string title_, cell_;
    std::vector<ModelText> models_;
    SharedRecords shared_{.bonds = {}, .bonds_of_entry = {{}}, .secondary_of_entry = {{}}};
};

/// Returns gemmi's message with the line in the file, not in the model's text.
std::string with_line_of(const ModelText& model, const std::string& file, std::string message) {
    std::size_t line = 0;
    if (std::sscanf(message.c_str(), "Problem in line %zu:", &line) != 1 || // NOLINT
        line <= model.lines_of_head)
        return message;
    return file + ":" + std::to_string(model.first_line + line - model.lines_of_head - 1) +
           message.substr(message.find(": "));
}

} // namespace

std::unique_ptr<FrameReader> open_pdb(InputFile& file) {
    const std::string text = file.read_all();
    const PdbModels texts(file, text);
    std::vector<ModelAndBonds> models;
    for (const ModelText& model_text : texts.models()) {
        try {
            for (gemmi_files::Model& model : gemmi_files::read_pdb(model_text.text, file.name()))
                models.push_back({std::move(model), model_text.bonds, model_text.entry});
        } catch (const gemmi_files::Refused& refused) {
            fail(file.name(), with_line_of(model_text, file.name(), refused.what()));
        }
    }
    if (models.empty())
        throw BadInput(file.name(), "", "must have ATOM or HETATM records, got none");
    return std::make_unique<ModelReader>(file.name(), std::move(models), texts.shared_records());
}

std::unique_ptr<FrameReader> open_cif(InputFile& file, const ReaderOptions& options) {
    const std::string text = file.read_all();
    try {
        std::vector<ModelAndBonds> models;
        std::vector<std::string> remarks;
        gemmi_files::Models read = gemmi_files::read_cif(text, file.name(), remarks);
        for (gemmi_files::Model& model : read.models) {
            const std::size_t entry = model.entry;
            models.push_back({std::move(model), {}, entry});
        }
        if (models.empty())
            throw BadInput(file.name(), "", "must have a table _atom_site, got none");
        for (const std::string& remark : remarks)
            if (options.on_remark)
                options.on_remark(text_of({file.name(), {}, {}, printable(remark, 400)}));
        return std::make_unique<ModelReader>(
            file.name(), std::move(models),
            SharedRecords{.bonds = {},
                          .bonds_of_entry = std::vector<Directed>(read.secondary_of_entry.size()),
                          .secondary_of_entry = std::move(read.secondary_of_entry)});
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
std::unique_ptr<FrameReader> open_cif(InputFile& file, const ReaderOptions&) {
    fail(file, "mmCIF and CIF");
}

} // namespace raylane::scenes

#endif
