#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/kind_table.hpp"
#include "scenes/formats/structure/labels.hpp"
#include "scenes/formats/structure/lines.hpp"
#include "scenes/formats/structure/readers.hpp"

#include <charconv>
#include <cmath>
#include <string>
#include <vector>

/// PQR, as PDB2PQR writes it and APBS reads it: Dolinsky et al., Nucleic Acids Res. 32, W665
/// (2004).
namespace raylane::scenes {

namespace {

class PqrReader : public FrameReader {
  public:
    explicit PqrReader(InputFile& file) : lines_(file) {}

    /// A model, or the whole file if it has none, is a frame.
    bool next(Structure& frame) override {
        frame = {};
        frame.properties = {{"charge", {}}};
        KindTable kinds(frame.of_kind);
        bool is_open = true;
        while (is_open && lines_.next()) {
            const std::string_view line = lines_.text();
            if (line.starts_with("ATOM") || line.starts_with("HETATM"))
                read_atom(frame, kinds);
            else if (line.starts_with("TITLE") && frame.title.empty())
                frame.title = trimmed(line.substr(5));
            else if (line.starts_with("END"))
                is_open = frame.size() == 0;
        }
        if (frame.size() == 0 && frames_ == 0)
            lines_.fail("must have ATOM or HETATM records, got none");
        ++frames_;
        return frame.size() > 0;
    }

  private:
    /// Reads: record, number, name, residue, perhaps chain, number, x, y, z, charge, radius. Fields
    /// are separated by blanks, except that coordinates may fill their columns of a PDB file.
    void read_atom(Structure& frame, KindTable& kinds) {
        std::vector<std::string_view> words;
        Words columns(lines_);
        for (std::string_view word; !(word = columns.next()).empty();)
            words.push_back(word);
        constexpr std::size_t numbers = 5, min_words = 8; // also record, number and name
        if (words.size() < 4)
            lines_.fail("must have a charge and a radius behind the coordinates, got less");
        const double charge = number(words[words.size() - 2], "a charge");
        const double radius = number(words.back(), "a radius");
        if (!(radius >= 0.0 && radius <= 1e6))
            lines_.fail("a radius must be from 0 to 1e6, got \"" + printable(words.back()) + '"');
        core::Vec3f at;
        const std::string_view line = lines_.text();
        std::size_t rest = words.size() < min_words ? 0 : words.size() - numbers;
        constexpr std::size_t end_of_columns = 54;
        bool is_separate = rest > 0;
        for (std::size_t axis = 0; axis < 3 && line.size() >= end_of_columns; ++axis)
            is_separate = is_separate && number_in(words[rest + axis]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t column = 30 + 8 * axis;
            const std::string_view word =
                is_separate ? words[rest + axis]
                            : trimmed(line.substr(std::min(column, line.size()), 8));
            const double value = number(word, "a coordinate");
            if (!(std::abs(value) <= 1e29)) lines_.fail("a coordinate must be from -1e29 to 1e29");
            at[static_cast<int>(axis)] = static_cast<float>(value);
        }
        if (!is_separate) { // the words in front of the columns of coordinates
            words.clear();
            std::string_view front = line.substr(0, 30);
            while (!(front = trimmed(front)).empty()) {
                words.push_back(front.substr(0, front.find(' ')));
                front.remove_prefix(words.back().size());
            }
            rest = words.size();
            if (rest < 3) lines_.fail("must have a name and a residue in front of the coordinates");
        }
        add(frame, kinds, {words.begin(), words.begin() + static_cast<std::ptrdiff_t>(rest)}, at);
        frame.properties[0].values.push_back(static_cast<float>(charge));
        frame.radii.push_back(static_cast<float>(radius));
    }

    double number(std::string_view word, const char* what) const {
        const std::optional<double> value = number_in(word);
        if (!value)
            lines_.fail(std::string(what) + " must be a number, got \"" + printable(word) + '"');
        return *value;
    }

    /// `words`: record, number, name, residue, and perhaps chain and number.
    static void add(Structure& frame, KindTable& kinds, const std::vector<std::string_view>& words,
                    const core::Vec3f& at) {
        const std::string_view name = words[2], residue = words.size() > 3 ? words[3] : "";
        std::string_view place = words.size() > 4 ? words.back() : "";
        std::string chain(words.size() > 5 ? words[4] : "");
        if (words.size() == 5 && is_letter(place.front())) { // "A1000"
            chain = place.substr(0, 1);
            place.remove_prefix(1);
        }
        Residue parsed{.name = std::string(residue), .is_hetero = words[0].starts_with("HETATM")};
        std::from_chars(place.data(), place.data() + place.size(), parsed.number);
        if (!place.empty() && is_letter(place.back())) parsed.insertion = place.back();
        if (frame.chains.empty() || frame.chains.back() != chain) frame.chains.push_back(chain);
        parsed.chain = static_cast<std::uint32_t>(frame.chains.size() - 1);
        const auto is_same = [&](const Residue& other) {
            return other.number == parsed.number && other.insertion == parsed.insertion &&
                   other.name == parsed.name && other.chain == parsed.chain;
        };
        if (frame.of_residue.empty() || !is_same(frame.of_residue.back()))
            frame.of_residue.push_back(std::move(parsed));
        const Element element = element_of_atom(name, residue);
        frame.kinds.push_back(static_cast<std::uint16_t>(
            kinds.index_of(data_of(element).symbol, [&](std::string_view) { return element; })));
        frame.positions.push_back(at);
        frame.names.emplace_back(name);
        frame.residues.push_back(static_cast<std::uint32_t>(frame.of_residue.size() - 1));
    }

    Lines lines_;
    std::size_t frames_ = 0;
};

} // namespace

std::unique_ptr<FrameReader> open_pqr(InputFile& file) {
    return std::make_unique<PqrReader>(file);
}

} // namespace raylane::scenes
