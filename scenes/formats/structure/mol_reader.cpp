#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/kind_table.hpp"
#include "scenes/formats/structure/lines.hpp"
#include "scenes/formats/structure/readers.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <unordered_map>

/// MOL and SDF: "CTfile Formats", BIOVIA (2020).
namespace raylane::scenes {

namespace {

/// Returns the order of a type of bond; nothing for types that are not drawn. Types of queries
/// count as single.
std::optional<std::uint8_t> order_of(long long type) {
    constexpr long long hydrogen = 10;
    if (type == hydrogen) return std::nullopt;
    return type >= 1 && type <= Bond::aromatic ? static_cast<std::uint8_t>(type) : std::uint8_t{1};
}

class MolReader : public FrameReader {
  public:
    explicit MolReader(InputFile& file) : lines_(file) {}

    bool next(Structure& frame) override {
        frame = {};
        if (!read_head(frame)) return false;
        frame.properties = {{"charge", {}}};
        index_of_.clear();
        KindTable kinds(frame.of_kind);
        if (lines_.text().find("V3000") != std::string_view::npos)
            read_v3000(frame, kinds);
        else
            read_v2000(frame, kinds);
        frame.has_all_bonds = !frame.bonds.empty();
        ++frames_;
        return true;
    }

  private:
    /// Reads the head of the next record, up to its counts. Returns false at the end of the file.
    bool read_head(Structure& frame) {
        while (frames_ > 0 && trimmed(lines_.text()) != "$$$$")
            if (!lines_.next()) return false;
        bool is_blank = frames_ > 0; // blank lines at the end are not a record
        for (int line = 0; line < 4; ++line) {
            if (!lines_.next()) {
                if (is_blank) return false;
                fail_at_end("the counts of atoms and bonds");
            }
            is_blank = is_blank && trimmed(lines_.text()).empty();
            if (line == 0) frame.title = trimmed(lines_.text());
        }
        while (is_blank && lines_.next())
            is_blank = trimmed(lines_.text()).empty();
        return !is_blank;
    }

    [[noreturn]] void fail_at_end(const char* what) const {
        lines_.fail(std::string("must be ") + what + ", got the end of the file");
    }
    void require_line(const char* what) {
        if (!lines_.next()) fail_at_end(what);
    }

    std::string_view field(std::size_t at, std::size_t width) const {
        const std::string_view line = lines_.text();
        return line.size() <= at ? std::string_view() : trimmed(line.substr(at, width));
    }
    long long whole(std::size_t at, const char* what, long long most) const {
        const std::optional<double> value = number_in(field(at, 3));
        if (!value || !(*value >= 0.0 && *value <= static_cast<double>(most)))
            lines_.fail(std::string(what) + " must be a number from 0 to " + std::to_string(most) +
                            ", got \"" + printable(field(at, 3)) + '"',
                        at + 1);
        return static_cast<long long>(*value);
    }

    void add_atom(Structure& frame, KindTable& kinds, std::string_view symbol,
                  const core::Vec3d& at) {
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(at[axis]) <= 1e30))
                lines_.fail("a coordinate must be a number from -1e30 to 1e30");
        const std::size_t kind = kinds.index_of(symbol, element_of);
        if (kind == Structure::max_kinds) lines_.fail("has too many kinds of atoms");
        frame.positions.push_back(core::convert<float>(at));
        frame.kinds.push_back(static_cast<std::uint16_t>(kind));
        frame.properties[0].values.push_back(0.0F);
    }

    void add_bond(Structure& frame, long long a, long long b, long long type) {
        const auto count = static_cast<long long>(frame.size());
        if (a < 1 || b < 1 || a > count || b > count || a == b)
            lines_.fail("a bond must be between two of " + std::to_string(count) + " atoms");
        if (const auto order = order_of(type))
            frame.bonds.push_back({static_cast<AtomIndex>(std::min(a, b) - 1),
                                   static_cast<AtomIndex>(std::max(a, b) - 1), *order});
    }

    void read_v2000(Structure& frame, KindTable& kinds) {
        const long long atoms = whole(0, "the number of atoms", 999);
        const long long bonds = whole(3, "the number of bonds", 999);
        for (long long i = 0; i < atoms; ++i) {
            require_line("an atom");
            core::Vec3d at;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::optional<double> value = number_in(field(10 * axis, 10));
                if (!value)
                    lines_.fail("a coordinate must be a number, got \"" +
                                    printable(field(10 * axis, 10)) + '"',
                                10 * axis + 1);
                at[static_cast<int>(axis)] = *value;
            }
            add_atom(frame, kinds, field(31, 3), at);
        }
        for (long long i = 0; i < bonds; ++i) {
            require_line("a bond");
            add_bond(frame, whole(0, "an atom", 999), whole(3, "an atom", 999),
                     whole(6, "the type of a bond", 99));
        }
        while (lines_.next()) {
            const std::string_view line = trimmed(lines_.text());
            if (line == "M  END" || line == "$$$$") return;
            if (line.starts_with("M  CHG")) read_charges(frame);
        }
    }

    /// Reads pairs of an atom and its charge. Ignores atoms that the record lacks.
    void read_charges(Structure& frame) {
        Words words(lines_);
        for (int i = 0; i < 3; ++i)
            words.next(); // M, CHG, count
        for (std::string_view word; !(word = words.next()).empty();) {
            const std::optional<double> atom = number_in(word), charge = number_in(words.next());
            if (atom && charge && *atom >= 1.0 && *atom <= static_cast<double>(frame.size()))
                frame.properties[0].values[static_cast<std::size_t>(*atom) - 1] =
                    static_cast<float>(*charge);
        }
    }

    /// Goes to the next line of V3000, without "M  V30". A line that ends with "-" is continued.
    bool next_v3000() {
        text_.clear();
        for (;;) {
            require_line(R"("M  END")");
            std::string_view line = trimmed(lines_.text());
            if (line == "M  END") return false;
            if (!line.starts_with("M  V30 "))
                lines_.fail(R"(must begin with "M  V30", got ")" + printable(line) + '"');
            text_ += trimmed(line.substr(7));
            if (!text_.ends_with('-')) return true;
            text_.back() = ' ';
            constexpr std::size_t longest = 1 << 20;
            if (text_.size() > longest) lines_.fail("is continued over too many lines");
        }
    }

    /// Returns the next word of the line, which may have blanks in quotation marks.
    std::string_view take_word(std::string_view& text) const {
        text = trimmed(text);
        const bool is_quoted = text.starts_with('"');
        const std::size_t end = is_quoted ? text.find('"', 1) : text.find_first_of(" \t");
        std::string_view word = text.substr(0, end);
        text.remove_prefix(std::min(end == std::string_view::npos ? end : end + 1, text.size()));
        if (is_quoted) word.remove_prefix(1);
        return word;
    }
    double take_number(std::string_view& text, const char* what) const {
        const std::string_view word = take_word(text);
        const std::optional<double> value = number_in(word);
        if (!value || !(std::abs(*value) <= 1e30))
            lines_.fail(std::string(what) + " must be a number, got \"" + printable(word) + '"');
        return *value;
    }
    long long take_index(std::string_view& text, const char* what) const {
        const double value = take_number(text, what);
        return std::abs(value) < 1e9 ? static_cast<long long>(value) : 0;
    }

    void read_v3000(Structure& frame, KindTable& kinds) {
        std::string block;
        while (next_v3000()) {
            std::string_view text = text_;
            const std::string_view word = take_word(text);
            if (word == "BEGIN")
                block = take_word(text);
            else if (word == "END")
                block.clear();
            else if (block == "ATOM")
                read_atom_v3000(frame, kinds, word, text);
            else if (block == "BOND")
                read_bond_v3000(frame, text);
        }
    }

    void read_atom_v3000(Structure& frame, KindTable& kinds, std::string_view number,
                         std::string_view text) {
        const std::string symbol(take_word(text));
        core::Vec3d at;
        for (int axis = 0; axis < 3; ++axis)
            at[axis] = take_number(text, "a coordinate");
        index_of_.emplace(std::string(number), static_cast<long long>(frame.size()) + 1);
        add_atom(frame, kinds, symbol, at);
        while (!trimmed(text).empty()) {
            const std::string_view word = take_word(text);
            if (!word.starts_with("CHG=")) continue;
            frame.properties[0].values.back() =
                static_cast<float>(number_in(word.substr(4)).value_or(0.0));
        }
    }

    void read_bond_v3000(Structure& frame, std::string_view text) {
        const long long type = take_index(text, "the type of a bond");
        long long ends[2];
        for (long long& end : ends) {
            const auto found = index_of_.find(std::string(take_word(text)));
            end = found == index_of_.end() ? 0 : found->second;
        }
        add_bond(frame, ends[0], ends[1], type);
    }

    Lines lines_;
    std::string text_;                                    // a line of V3000
    std::unordered_map<std::string, long long> index_of_; // atoms of V3000 by their numbers, from 1
    std::size_t frames_ = 0;
};

} // namespace

std::unique_ptr<FrameReader> open_mol(InputFile& file) {
    return std::make_unique<MolReader>(file);
}

} // namespace raylane::scenes
