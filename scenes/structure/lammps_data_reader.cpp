#include "scenes/errors.hpp"
#include "scenes/structure/kind_table.hpp"
#include "scenes/structure/lines.hpp"
#include "scenes/structure/readers.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <unordered_map>

namespace raylane::scenes {

namespace {

/// Where the columns of an atom style are, counted from 0; -1: it has none.
struct AtomStyle {
    std::string_view name;
    int type, x, molecule, charge, diameter;
};
constexpr std::array<AtomStyle, 7> styles = {{
    {"angle", 2, 3, 1, -1, -1},
    {"atomic", 1, 2, -1, -1, -1},
    {"bond", 2, 3, 1, -1, -1},
    {"charge", 1, 3, -1, 2, -1},
    {"full", 2, 4, 1, 3, -1},
    {"molecular", 2, 3, 1, -1, -1},
    {"sphere", 1, 4, -1, -1, 2},
}};

constexpr std::array<std::string_view, 7> sections = {"Masses", "Atoms",     "Velocities", "Bonds",
                                                      "Angles", "Dihedrals", "Impropers"};

class DataReader : public FrameReader {
  public:
    explicit DataReader(InputFile& file) : lines_(file) {}

    bool next(Structure& frame) override {
        if (was_read_) return false;
        was_read_ = true;
        frame = {};
        lines_.next(); // a remark, whatever it says
        frame.title = trimmed(lines_.text());
        read_header(frame.cell);
        do
            read_section(frame);
        while (next_of_text());
        if (frame.size() != counts_["atoms"])
            lines_.fail("must have " + std::to_string(counts_["atoms"]) + " atoms, got " +
                        std::to_string(frame.size()));
        name_kinds(frame);
        return true;
    }

  private:
    static std::string_view without_remark(std::string_view line) {
        return trimmed(line.substr(0, line.find('#')));
    }

    /// The next line that is not blank.
    bool next_of_text() {
        while (lines_.next())
            if (!without_remark(lines_.text()).empty()) return true;
        return false;
    }

    /// "10 atoms", "0 50 xlo xhi", "0 0 0 xy xz yz", up to the first section, whose line is there
    /// then.
    void read_header(Cell& cell) {
        double lower[3] = {-0.5, -0.5, -0.5}, upper[3] = {0.5, 0.5, 0.5}, lean[3] = {};
        bool has_box = false;
        for (;;) {
            if (!next_of_text()) lines_.fail("must have a section Atoms, and the file ends");
            const std::string_view line = without_remark(lines_.text());
            if (line[0] >= 'A' && line[0] <= 'Z') break;
            const auto ends_with = [&](std::string_view words) { return line.ends_with(words); };
            Words words(lines_);
            if (ends_with("xhi") || ends_with("yhi") || ends_with("zhi")) {
                const auto axis = static_cast<std::size_t>(line[line.size() - 3] - 'x');
                lower[axis] = words.number("a lower bound");
                upper[axis] = words.number("an upper bound");
                has_box = true;
            } else if (ends_with("xy xz yz")) {
                for (double& by : lean)
                    by = words.number("a tilt");
            } else {
                const long long count =
                    words.whole("a count", 0, static_cast<long long>(Structure::most_atoms));
                remember_count(line, static_cast<std::size_t>(count));
            }
        }
        if (!has_box) return;
        cell.origin = {lower[0], lower[1], lower[2]};
        cell.edges = {core::Vec3d(upper[0] - lower[0], 0.0, 0.0),
                      core::Vec3d(lean[0], upper[1] - lower[1], 0.0),
                      core::Vec3d(lean[1], lean[2], upper[2] - lower[2])};
    }

    void remember_count(std::string_view line, std::size_t count) {
        const std::size_t blank = line.find_first_of(" \t");
        if (blank != std::string_view::npos)
            counts_[std::string(trimmed(line.substr(blank)))] = count;
    }

    void read_section(Structure& frame) {
        const std::string name(without_remark(lines_.text()));
        const std::size_t hash = lines_.text().find('#');
        const std::string remark(
            hash == std::string_view::npos ? "" : trimmed(lines_.text().substr(hash + 1)));
        if (name == "Masses")
            read_masses();
        else if (name == "Atoms")
            read_atoms(frame, remark);
        else if (name == "Bonds")
            read_bonds(frame);
        else if (name[0] >= 'A' && name[0] <= 'Z')
            skip_section();
        else
            lines_.fail("must be a section's name, such as Atoms, got \"" + printable(name) + "\"" +
                        suggestion(name, {sections.begin(), sections.end()}));
    }

    /// True while there are lines of a section: those of the next begin with a letter.
    bool next_of_section() {
        if (!next_of_text()) return false;
        const char first = without_remark(lines_.text())[0];
        if (first >= 'A' && first <= 'Z') {
            lines_.put_back();
            return false;
        }
        return true;
    }

    void skip_section() {
        while (next_of_section()) {
        }
    }

    void read_masses() {
        while (next_of_section()) {
            Words words(lines_);
            const std::string type(words.get("a type"));
            masses_[type] = words.number("a mass");
        }
    }

    const AtomStyle& style_of(const std::string& remark, std::string_view line) {
        for (const AtomStyle& style : styles)
            if (style.name == remark) return style;
        if (!remark.empty()) {
            std::vector<std::string_view> names(styles.size());
            std::transform(styles.begin(), styles.end(), names.begin(),
                           [](const AtomStyle& style) { return style.name; });
            lines_.fail(
                "the atom style must be one of angle, atomic, bond, charge, full, molecular "
                "and sphere, got \"" +
                printable(remark) + "\"" + suggestion(remark, names));
        }
        int columns = 0;
        while (!line.empty()) {
            line = trimmed(line.substr(std::min(line.find_first_of(" \t"), line.size())));
            ++columns;
        }
        // With or without the images that atoms are in.
        const bool bonds = counts_["bonds"] > 0;
        const std::string_view guessed = columns == 5 || columns == 8    ? "atomic"
                                         : columns == 7 || columns == 10 ? "full"
                                         : bonds                         ? "molecular"
                                                                         : "charge";
        return *std::find_if(styles.begin(), styles.end(),
                             [&](const AtomStyle& style) { return style.name == guessed; });
    }

    void read_atoms(Structure& frame, const std::string& remark) {
        if (frame.size() != 0) lines_.fail("must not be a second section Atoms");
        KindTable kinds(frame.of_kind);
        const AtomStyle* style = nullptr;
        while (next_of_section()) {
            const std::string_view line = without_remark(lines_.text());
            if (style == nullptr) {
                style = &style_of(remark, line);
                if (style->charge >= 0) frame.properties.push_back({"charge", {}});
                if (style->molecule >= 0) frame.properties.push_back({"molecule", {}});
            }
            Words words(lines_);
            const long long id = words.whole("an atom's number", 1, std::int64_t{1} << 53);
            std::string_view type;
            core::Vec3f position;
            float radius = 0.0F, charge = 0.0F, molecule = 0.0F;
            for (int column = 1; column < style->x; ++column) {
                if (column == style->type)
                    type = words.get("a type");
                else if (column == style->charge)
                    charge = words.coordinate("a charge");
                else if (column == style->molecule)
                    molecule = words.coordinate("a molecule's number");
                else if (column == style->diameter)
                    radius = 0.5F * words.coordinate("a diameter");
                else
                    words.get("a value");
            }
            for (int axis = 0; axis < 3; ++axis)
                position[axis] = words.coordinate("a coordinate");
            const std::size_t kind =
                kinds.index_of(type, [](std::string_view) { return Element{0}; });
            if (kind == Structure::most_kinds) lines_.fail("must be of one of at most 65535 types");
            if (style->diameter >= 0) frame.radii.push_back(radius);
            atom_of_[id] = static_cast<AtomIndex>(frame.size());
            frame.positions.push_back(position);
            frame.kinds.push_back(static_cast<std::uint16_t>(kind));
            std::size_t property = 0;
            if (style->charge >= 0) frame.properties[property++].values.push_back(charge);
            if (style->molecule >= 0) frame.properties[property++].values.push_back(molecule);
        }
    }

    void read_bonds(Structure& frame) {
        while (next_of_section()) {
            Words words(lines_);
            words.get("a bond's number");
            words.get("a bond's type");
            AtomIndex ends[2];
            for (AtomIndex& end : ends) {
                const long long id = words.whole("an atom's number", 1, std::int64_t{1} << 53);
                const auto found = atom_of_.find(id);
                if (found == atom_of_.end())
                    words.fail("must be the number of an atom, and there is no " +
                               std::to_string(id));
                end = found->second;
            }
            if (ends[0] == ends[1]) words.fail("must be two atoms, got one twice");
            frame.bonds.push_back({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
        }
        frame.has_all_bonds = true;
    }

    /// Finds the elements of types by their masses.
    void name_kinds(Structure& frame) {
        std::vector<double> masses;
        for (const AtomKind& kind : frame.of_kind) {
            const auto found = masses_.find(kind.label);
            if (found == masses_.end()) return;
            masses.push_back(found->second);
        }
        const std::vector<Element> elements = elements_of_masses(masses, units_of(frame.title));
        for (std::size_t kind = 0; kind < elements.size(); ++kind)
            frame.of_kind[kind].element = elements[kind];
    }

    /// LAMMPS itself writes "units = real" at the end of the first line.
    static MassUnits units_of(std::string_view title) {
        constexpr std::string_view key = "units = ";
        const std::size_t at = title.rfind(key);
        if (at == std::string_view::npos) return MassUnits::unknown;
        const std::string_view units = trimmed(title.substr(at + key.size()));
        return units == "real" || units == "metal" || units == "electron" ? MassUnits::daltons
                                                                          : MassUnits::others;
    }

    Lines lines_;
    std::map<std::string, std::size_t> counts_;
    std::map<std::string, double> masses_; // by type
    std::unordered_map<long long, AtomIndex> atom_of_;
    bool was_read_ = false;
};

} // namespace

std::unique_ptr<FrameReader> open_lammps_data(InputFile& file) {
    return std::make_unique<DataReader>(file);
}

} // namespace raylane::scenes
