#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/structure/kind_table.hpp"
#include "scenes/formats/structure/labels.hpp"
#include "scenes/formats/structure/lines.hpp"
#include "scenes/formats/structure/readers.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace raylane::scenes {

namespace {

/// The meaning of a column, or of several adjacent ones.
struct Column {
    enum class Is {
        species,
        position,
        radius,
        name,
        residue_name,
        residue_number,
        chain,
        property,
        other
    };
    Is is;
    int count;
    std::string name;
};

/// Columns of one word that have names and residues, in the words of ASE and others.
constexpr std::pair<std::string_view, Column::Is> named_columns[] = {
    {"species", Column::Is::species},
    {"element", Column::Is::species},
    {"z", Column::Is::species},
    {"name", Column::Is::name},
    {"atomtypes", Column::Is::name},
    {"resname", Column::Is::residue_name},
    {"residuenames", Column::Is::residue_name},
    {"resid", Column::Is::residue_number},
    {"residuenumbers", Column::Is::residue_number},
    {"chain", Column::Is::chain},
};

std::vector<Column> usual_columns() {
    return {{Column::Is::species, 1, "species"}, {Column::Is::position, 3, "pos"}};
}

/// The key=value pairs of a comment, perhaps with blanks around "=". Values may be in quotes, or in
/// braces as in old files.
class Pairs {
  public:
    explicit Pairs(std::string_view text) : text_(text) {}

    bool next(std::string_view& key, std::string_view& value) {
        text_ = trimmed(text_);
        if (text_.empty()) return false;
        const std::size_t stop = text_.find_first_of("= \t");
        key = text_.substr(0, stop);
        text_.remove_prefix(std::min(stop, text_.size()));
        value = {};
        text_ = trimmed(text_);
        if (!text_.starts_with('=')) return true; // a word by itself
        text_.remove_prefix(1);
        const std::string_view behind = trimmed(text_);
        const std::size_t end_of_word = behind.find_first_of("= \t");
        if (behind.size() != text_.size() && end_of_word != std::string_view::npos &&
            behind[end_of_word] == '=')
            return true; // the value is empty, and another key follows
        text_ = behind;
        const char open = text_.empty() ? ' ' : text_.front();
        if (open == '"' || open == '\'' || open == '{' || open == '[') {
            const char close = open == '{' ? '}' : open == '[' ? ']' : open;
            text_.remove_prefix(1);
            const std::size_t end = open == '[' ? end_of_brackets() : text_.find(close);
            value = text_.substr(0, end);
            text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
        } else {
            const std::size_t end = std::min(text_.find_first_of(" \t"), text_.size());
            value = text_.substr(0, end);
            text_.remove_prefix(end);
        }
        return true;
    }

  private:
    /// Returns the place of the closing bracket. Rows may be in brackets, too.
    std::size_t end_of_brackets() const {
        std::size_t depth = 1;
        for (std::size_t i = 0; i < text_.size(); ++i) {
            if (text_[i] == '[') ++depth;
            if (text_[i] == ']' && --depth == 0) return i;
        }
        return std::string_view::npos;
    }

    std::string_view text_;
};

/// An atomic number is its element, unless numbers are types.
Element element_of_species(std::string_view label, bool has_types) {
    int number = 0;
    const auto [stop, error] = std::from_chars(label.data(), label.data() + label.size(), number);
    if (error == std::errc() && stop == label.data() + label.size())
        return number > 0 && number < element_count && !has_types ? static_cast<Element>(number)
                                                                  : Element{0};
    return element_of_label(label);
}

class XyzReader : public FrameReader {
  public:
    explicit XyzReader(InputFile& file) : file_(file), lines_(file) {}

    bool next(Structure& frame) override {
        frame = {};
        do {
            if (!lines_.next()) {
                if (frames_ == 0)
                    lines_.fail("must be the number of atoms, got the end of the file");
                return false;
            }
        } while (trimmed(lines_.text()).empty());
        ++frames_;
        Words words(lines_);
        const auto count = static_cast<std::size_t>(
            words.whole("the number of atoms", 0, static_cast<long long>(Structure::max_atoms)));
        if (!trimmed(words.rest()).empty())
            words.fail("must be only the number of atoms, got more on the line");
        if (!lines_.next()) lines_.fail("must be a comment, got the end of the file");
        read_remark(frame);
        reserve(frame, count);
        KindTable kinds(frame.of_kind);
        for (std::size_t atom = 0; atom < count; ++atom) {
            lines_.next_atom(atom + 1, count);
            read_atom(frame, kinds);
        }
        // Larger ones are simulations.
        constexpr std::size_t max_in_crystal = 500;
        const auto& periodic = frame.cell.periodic;
        frame.is_crystal = frame.cell.any() && count <= max_in_crystal &&
                           std::count(periodic.begin(), periodic.end(), true) >= 2;
        return true;
    }

  private:
    bool has(Column::Is what) const {
        return std::any_of(columns_.begin(), columns_.end(),
                           [&](const Column& column) { return column.is == what; });
    }

    /// Reserves no more than the file can hold, as the number of atoms may be wrong.
    void reserve(Structure& frame, std::size_t count) const {
        constexpr std::size_t min_bytes = 8; // "C 0 0 0\n"
        if (file_.size() != 0)
            count = std::min(count, static_cast<std::size_t>(file_.size()) / min_bytes);
        else
            count = std::min(count, std::size_t{1} << 20);
        frame.positions.reserve(count);
        frame.kinds.reserve(count);
    }

    void read_remark(Structure& frame) {
        columns_ = usual_columns();
        const std::string_view text = trimmed(lines_.text());
        frame.title = text;
        has_types_ = text.starts_with("Atoms. Timestep:"); // LAMMPS' dump xyz
        std::string_view key, value;
        for (Pairs pairs(text); pairs.next(key, value);) {
            const std::string name = in_lower_case(key);
            if (name == "properties" && !value.empty()) read_properties(value);
            if (name == "lattice" && !value.empty()) read_lattice(frame, value);
            if (name == "origin") read_numbers(value, 3, "Origin", &frame.cell.origin.x);
            if (name == "pbc") read_periodic(frame, value);
        }
        has_radius_ = has(Column::Is::radius);
        has_residues_ = has(Column::Is::residue_name) || has(Column::Is::residue_number) ||
                        has(Column::Is::chain);
        of_column_.assign(columns_.size(), 0);
        for (std::size_t k = 0; k < columns_.size(); ++k) {
            if (columns_[k].is != Column::Is::property) continue;
            of_column_[k] = frame.properties.size();
            frame.properties.push_back({columns_[k].name, {}});
        }
    }

    void read_properties(std::string_view text) {
        columns_.clear();
        bool has_position = false;
        const auto part = [&] {
            const std::size_t end = std::min(text.find(':'), text.size());
            const std::string_view result = text.substr(0, end);
            text.remove_prefix(std::min(end + 1, text.size()));
            return result;
        };
        while (!text.empty()) {
            const std::string_view name = part(), type = part(), number = part();
            int count = 0;
            std::from_chars(number.data(), number.data() + number.size(), count);
            if (name.empty() || type.size() != 1 ||
                std::string_view("SRIL").find(type[0]) == std::string_view::npos || count < 1 ||
                count > 1000)
                lines_.fail(
                    "Properties must be a list of NAME:TYPE:COUNT with type S, R, I or L, got \"" +
                    printable(lines_.text()) + "\"");
            Column column{Column::Is::other, count, std::string(name)};
            const std::string known = in_lower_case(name);
            const auto* const named =
                std::find_if(std::begin(named_columns), std::end(named_columns),
                             [&](const auto& pair) { return pair.first == known; });
            if (count == 1 && named != std::end(named_columns) &&
                (named->second != Column::Is::residue_number || type[0] == 'I') &&
                !has(named->second))
                column.is = named->second;
            else if (count == 3 && known == "pos")
                column.is = Column::Is::position;
            else if (count == 1 && (known == "radius" || known == "radii") && type[0] == 'R')
                column.is = Column::Is::radius;
            else if (type[0] == 'R' || type[0] == 'I')
                column.is = Column::Is::property;
            has_position = has_position || column.is == Column::Is::position;
            columns_.push_back(std::move(column));
        }
        if (!has_position) lines_.fail("Properties must have pos:R:3, got none");
    }

    void read_numbers(std::string_view text, int count, const char* what, double* to) {
        constexpr std::string_view separators = " \t,[]";
        for (int k = 0; k < count; ++k) {
            text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
            const std::size_t end = std::min(text.find_first_of(separators), text.size());
            const std::optional<double> value = number_in(text.substr(0, end));
            if (!value)
                lines_.fail(std::string(what) + " must have " + std::to_string(count) +
                            " numbers, got \"" + printable(text) + "\"");
            to[k] = *value;
            text.remove_prefix(std::min(end + 1, text.size()));
        }
    }

    void read_lattice(Structure& frame, std::string_view text) {
        double numbers[9];
        read_numbers(text, 9, "Lattice", numbers);
        for (std::size_t edge = 0; edge < 3; ++edge)
            frame.cell.edges[edge] = {numbers[3 * edge], numbers[3 * edge + 1],
                                      numbers[3 * edge + 2]};
    }

    static void read_periodic(Structure& frame, std::string_view text) {
        std::size_t axis = 0;
        for (const char c : text) {
            if (c != 'T' && c != 'F' && c != '1' && c != '0') continue;
            if (axis < 3) frame.cell.periodic[axis++] = c == 'T' || c == '1';
        }
    }

    /// Takes NaN and infinity, too: programs write them for a property that was not computed.
    static double property_of(Words& words, const std::string& name) {
        const std::string_view word = words.get(name);
        if (const std::optional<double> value = number_in(word)) return *value;
        std::string text = in_lower_case(word);
        if (text.starts_with('-') || text.starts_with('+')) text.erase(0, 1);
        if (text == "nan" || text == "inf" || text == "infinity") return std::nan("");
        words.fail(name + " must be a number, got \"" + printable(word) + "\"");
    }

    void read_atom(Structure& frame, KindTable& kinds) {
        Words words(lines_);
        std::string_view species = "X";
        core::Vec3f position(0.0F);
        float radius = 0.0F;
        Residue residue;
        std::string_view chain;
        for (std::size_t k = 0; k < columns_.size(); ++k) {
            const Column& column = columns_[k];
            switch (column.is) {
            case Column::Is::species:
                species = words.get("an element");
                break;
            case Column::Is::position:
                for (int axis = 0; axis < 3; ++axis)
                    position[axis] = words.coordinate("a coordinate");
                break;
            case Column::Is::radius:
                radius = words.coordinate("a radius");
                break;
            case Column::Is::name:
                frame.names.emplace_back(words.get("a name"));
                break;
            case Column::Is::residue_name:
                residue.name = words.get("a residue");
                break;
            case Column::Is::residue_number:
                residue.number = static_cast<int>(
                    words.whole("the number of a residue", -999'999'999, 999'999'999));
                break;
            case Column::Is::chain:
                chain = words.get("a chain");
                break;
            case Column::Is::property: {
                double sum = 0.0, value = 0.0;
                for (int i = 0; i < column.count; ++i) {
                    value = property_of(words, column.name);
                    sum += value * value;
                }
                // Several columns, such as a force, are replaced by their length.
                frame.properties[of_column_[k]].values.push_back(
                    static_cast<float>(column.count == 1 ? value : std::sqrt(sum)));
                break;
            }
            case Column::Is::other:
                for (int i = 0; i < column.count; ++i)
                    words.get(column.name);
            }
        }
        const std::size_t kind = kinds.index_of(
            species, [&](std::string_view label) { return element_of_species(label, has_types_); });
        if (kind == Structure::max_kinds) lines_.fail("must be of one of at most 65535 elements");
        if (has_radius_) frame.radii.push_back(radius);
        if (has_residues_) add_residue(frame, std::move(residue), chain);
        frame.positions.push_back(position);
        frame.kinds.push_back(static_cast<std::uint16_t>(kind));
    }

    /// Puts the last atom into a residue: the last one, or a new one.
    static void add_residue(Structure& frame, Residue residue, std::string_view chain) {
        if (frame.chains.empty() || frame.chains.back() != chain) frame.chains.emplace_back(chain);
        residue.chain = static_cast<std::uint32_t>(frame.chains.size() - 1);
        residue.is_hetero = !is_polymer_residue(residue.name);
        const auto is_same = [&](const Residue& last) {
            return last.chain == residue.chain && last.number == residue.number &&
                   last.name == residue.name;
        };
        if (frame.of_residue.empty() || !is_same(frame.of_residue.back()))
            frame.of_residue.push_back(std::move(residue));
        frame.residues.push_back(static_cast<std::uint32_t>(frame.of_residue.size() - 1));
    }

    InputFile& file_;
    Lines lines_;
    std::vector<Column> columns_;
    std::vector<std::size_t> of_column_; // index of the property
    bool has_radius_ = false, has_residues_ = false, has_types_ = false;
    std::size_t frames_ = 0;
};

} // namespace

std::unique_ptr<FrameReader> open_xyz(InputFile& file) {
    return std::make_unique<XyzReader>(file);
}

} // namespace raylane::scenes
