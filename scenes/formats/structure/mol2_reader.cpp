#include "core/numbers/elementary.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/kind_table.hpp"
#include "scenes/formats/structure/lines.hpp"
#include "scenes/formats/structure/readers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <unordered_map>

/// "Tripos Mol2 File Format", Tripos (2007).
namespace raylane::scenes {

namespace {

constexpr std::string_view section_mark = "@<TRIPOS>";

/// Returns the element of a type such as "C.ar" or "Na"; 0 for dummies and patterns.
Element element_of_type(std::string_view type) {
    return element_of(type.substr(0, type.find('.')));
}

Cell cell_of(const double (&lengths)[3], const double (&angles)[3]) {
    double cosines[3];
    for (std::size_t k = 0; k < 3; ++k)
        cosines[k] = angles[k] == 90.0 ? 0.0 : core::cos(angles[k] * std::numbers::pi / 180.0);
    const double sine = std::sqrt(1.0 - cosines[2] * cosines[2]);
    const double x = cosines[1], y = (cosines[0] - cosines[1] * cosines[2]) / sine;
    Cell cell;
    cell.edges[0] = {lengths[0], 0.0, 0.0};
    cell.edges[1] = lengths[1] * core::Vec3d(cosines[2], sine, 0.0);
    cell.edges[2] = lengths[2] * core::Vec3d(x, y, std::sqrt(1.0 - x * x - y * y));
    return cell;
}

class Mol2Reader : public FrameReader {
  public:
    explicit Mol2Reader(InputFile& file) : lines_(file) {}

    bool next(Structure& frame) override {
        frame = {};
        if (!find_molecule()) return false;
        ++frames_;
        if (!lines_.next()) lines_.fail("must be the name of a molecule, got the end of the file");
        frame.title = trimmed(lines_.text());
        frame.properties = {{"charge", {}}};
        frame.chains = {""};
        index_of_.clear();
        KindTable kinds(frame.of_kind);
        std::string section;
        while (lines_.next()) {
            const std::string_view line = trimmed(lines_.text());
            if (line.starts_with(section_mark)) {
                section = line.substr(section_mark.size());
                if (section == "MOLECULE") {
                    lines_.put_back();
                    break;
                }
            } else if (line.empty() || line[0] == '#') {
                continue;
            } else if (section == "ATOM") {
                read_atom(frame, kinds);
            } else if (section == "BOND") {
                read_bond(frame);
            } else if (section == "CRYSIN") {
                read_cell(frame);
            }
        }
        frame.has_all_bonds = !frame.bonds.empty();
        return true;
    }

  private:
    bool find_molecule() {
        while (lines_.next())
            if (trimmed(lines_.text()) == "@<TRIPOS>MOLECULE") return true;
        if (frames_ == 0) lines_.fail("must be \"@<TRIPOS>MOLECULE\", got the end of the file");
        return false;
    }

    /// Reads: number, name, x, y, z, type; perhaps the number and name of a residue, and a charge.
    void read_atom(Structure& frame, KindTable& kinds) {
        Words words(lines_);
        const std::string number(words.get("the number of an atom"));
        frame.names.emplace_back(words.get("the name of an atom"));
        core::Vec3f at;
        for (int axis = 0; axis < 3; ++axis)
            at[axis] = words.coordinate("a coordinate");
        const std::string_view type = words.get("the type of an atom");
        const Element element = element_of_type(type);
        const std::size_t kind = kinds.index_of(element != 0 ? data_of(element).symbol : type,
                                                [&](std::string_view) { return element; });
        if (kind == Structure::max_kinds) lines_.fail("has too many kinds of atoms");
        index_of_.emplace(number, static_cast<AtomIndex>(frame.size()));
        frame.positions.push_back(at);
        frame.kinds.push_back(static_cast<std::uint16_t>(kind));
        const std::string_view residue = words.next(), name = words.next();
        take_residue(frame, residue, name);
        frame.properties[0].values.push_back(
            static_cast<float>(number_in(words.next()).value_or(0.0)));
    }

    /// The name of a residue may have its number behind it: "ALA12".
    static void take_residue(Structure& frame, std::string_view number, std::string_view name) {
        const std::size_t letters = name.find_last_not_of("0123456789") + 1;
        const std::optional<double> own = number_in(name.substr(letters)),
                                    other = number_in(number);
        const double value = letters > 0 && own ? *own : other.value_or(0.0);
        Residue residue{.name = std::string(letters > 0 ? name.substr(0, letters) : name),
                        .number = std::abs(value) < 1e9 ? static_cast<int>(value) : 0};
        if (frame.of_residue.empty() || frame.of_residue.back().number != residue.number ||
            frame.of_residue.back().name != residue.name)
            frame.of_residue.push_back(std::move(residue));
        frame.residues.push_back(static_cast<std::uint32_t>(frame.of_residue.size() - 1));
    }

    void read_bond(Structure& frame) {
        Words words(lines_);
        words.get("the number of a bond");
        AtomIndex ends[2];
        for (AtomIndex& end : ends) {
            const std::string_view word = words.get("an atom");
            const auto found = index_of_.find(std::string(word));
            if (found == index_of_.end())
                words.fail("must be the number of an atom, got \"" + printable(word) + '"');
            end = found->second;
        }
        const std::string_view type = words.get("the type of a bond");
        if (type == "nc" || ends[0] == ends[1]) return; // not connected
        std::uint8_t order = 1;                         // of amides ("am") and unknown types, too
        if (type == "2" || type == "3") order = static_cast<std::uint8_t>(type[0] - '0');
        if (type == "ar") order = Bond::aromatic;
        frame.bonds.push_back({std::min(ends[0], ends[1]), std::max(ends[0], ends[1]), order});
    }

    /// Reads the lengths and angles of a cell.
    void read_cell(Structure& frame) {
        Words words(lines_);
        double lengths[3], angles[3];
        for (double& length : lengths)
            length = words.number("a length of the cell");
        for (double& angle : angles)
            angle = words.number("an angle of the cell");
        frame.cell = cell_of(lengths, angles);
        for (const core::Vec3d& edge : frame.cell.edges)
            if (!(core::length(edge) <= 1e30))
                lines_.fail("must be the lengths and angles of a cell");
    }

    Lines lines_;
    std::unordered_map<std::string, AtomIndex> index_of_; // by the numbers of atoms
    std::size_t frames_ = 0;
};

} // namespace

std::unique_ptr<FrameReader> open_mol2(InputFile& file) {
    return std::make_unique<Mol2Reader>(file);
}

} // namespace raylane::scenes
