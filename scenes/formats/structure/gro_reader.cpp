#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/kind_table.hpp"
#include "scenes/formats/structure/labels.hpp"
#include "scenes/formats/structure/lines.hpp"
#include "scenes/formats/structure/readers.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace raylane::scenes {

namespace {

constexpr double angstroms_per_nanometre = 10.0;

class GroReader : public FrameReader {
  public:
    explicit GroReader(InputFile& file) : lines_(file) {}

    bool next(Structure& frame) override {
        frame = {};
        // Blank lines at the end are not a frame.
        bool any = lines_.next();
        const std::string title(trimmed(any ? lines_.text() : std::string_view()));
        bool has_count = any && lines_.next();
        while (has_count && frames_ > 0 && title.empty() && trimmed(lines_.text()).empty())
            has_count = lines_.next();
        if (!has_count) {
            if (frames_ == 0 || !title.empty())
                lines_.fail("must be the number of atoms, got the end of the file");
            return false;
        }
        ++frames_;
        frame.title = title;
        Words words(lines_);
        const auto count = static_cast<std::size_t>(
            words.whole("the number of atoms", 0, static_cast<long long>(Structure::max_atoms)));
        frame.chains = {""};
        KindTable kinds(frame.of_kind);
        for (std::size_t atom = 0; atom < count; ++atom) {
            lines_.next_atom(atom + 1, count);
            read_atom(frame, kinds);
        }
        if (!lines_.next()) lines_.fail("must be the box, got the end of the file");
        read_box(frame);
        return true;
    }

  private:
    /// Reads fields at fixed columns. Fields of numbers are as wide as the distance of their
    /// decimal points.
    void read_atom(Structure& frame, KindTable& kinds) {
        const std::string_view line = lines_.text();
        constexpr std::size_t first = 20;
        const std::size_t point = line.find('.', std::min(first, line.size()));
        const std::size_t second =
            point == std::string_view::npos ? point : line.find('.', point + 1);
        if (second == std::string_view::npos || line.size() < first + 3 * (second - point))
            lines_.fail("must be an atom: residue, name, number and three coordinates in columns, "
                        "got \"" +
                        printable(line) + "\"");
        const std::size_t width = second - point;
        core::Vec3f position;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t at = first + axis * width;
            const std::optional<double> value = number_in(trimmed(line.substr(at, width)));
            if (!value || !(std::abs(*value) < 1e29))
                lines_.fail("a coordinate must be a number, got \"" +
                                printable(line.substr(at, width)) + "\"",
                            at + 1);
            position[static_cast<int>(axis)] = static_cast<float>(*value * angstroms_per_nanometre);
        }
        int number = 0;
        const std::string_view digits = trimmed(line.substr(0, 5));
        std::from_chars(digits.data(), digits.data() + digits.size(), number);
        const std::string_view residue = trimmed(line.substr(5, 5));
        const std::string_view name = trimmed(line.substr(10, 5));
        if (frame.of_residue.empty() || frame.of_residue.back().number != number ||
            frame.of_residue.back().name != residue)
            frame.of_residue.push_back({.name = std::string(residue), .number = number});
        const Element element = element_of_atom(name, residue);
        const std::size_t kind =
            kinds.index_of(data_of(element).symbol, [&](std::string_view) { return element; });
        frame.positions.push_back(position);
        frame.kinds.push_back(static_cast<std::uint16_t>(kind));
        frame.names.emplace_back(name);
        frame.residues.push_back(static_cast<std::uint32_t>(frame.of_residue.size() - 1));
    }

    /// Reads v1(x) v2(y) v3(z) v1(y) v1(z) v2(x) v2(z) v3(x) v3(y). The last six may be missing.
    void read_box(Structure& frame) {
        Words words(lines_);
        double box[9] = {};
        int count = 0;
        for (std::string_view word; count < 9 && !(word = words.next()).empty(); ++count) {
            const std::optional<double> value = number_in(word);
            if (!value)
                words.fail("a length of the box must be a number, got \"" + printable(word) + "\"");
            box[count] = *value * angstroms_per_nanometre;
        }
        if (count != 3 && count != 9)
            lines_.fail("must be the box, of 3 or 9 numbers, got " + std::to_string(count));
        frame.cell.edges = {core::Vec3d(box[0], box[3], box[4]),
                            core::Vec3d(box[5], box[1], box[6]),
                            core::Vec3d(box[7], box[8], box[2])};
    }

    Lines lines_;
    std::size_t frames_ = 0;
};

} // namespace

std::unique_ptr<FrameReader> open_gro(InputFile& file) {
    return std::make_unique<GroReader>(file);
}

} // namespace raylane::scenes
