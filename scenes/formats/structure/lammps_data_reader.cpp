#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/kind_table.hpp"
#include "scenes/formats/structure/lammps_atom_table.hpp"
#include "scenes/formats/structure/lines.hpp"
#include "scenes/formats/structure/readers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace raylane::scenes {

namespace {

constexpr std::string_view sections[] = {"Angle Coeffs",
                                         "Angle Type Labels",
                                         "AngleAngle Coeffs",
                                         "AngleAngleTorsion Coeffs",
                                         "AngleTorsion Coeffs",
                                         "Angles",
                                         "Atom Type Labels",
                                         "Atoms",
                                         "Bodies",
                                         "Bond Coeffs",
                                         "Bond Type Labels",
                                         "BondAngle Coeffs",
                                         "BondBond Coeffs",
                                         "BondBond13 Coeffs",
                                         "Bonds",
                                         "Dihedral Coeffs",
                                         "Dihedral Type Labels",
                                         "Dihedrals",
                                         "Ellipsoids",
                                         "EndBondTorsion Coeffs",
                                         "Improper Coeffs",
                                         "Improper Type Labels",
                                         "Impropers",
                                         "Lines",
                                         "Masses",
                                         "MiddleBondTorsion Coeffs",
                                         "Pair Coeffs",
                                         "PairIJ Coeffs",
                                         "Triangles",
                                         "Velocities"};

bool is_known_section(std::string_view name) {
    return std::find(std::begin(sections), std::end(sections), name) != std::end(sections);
}

class DataReader : public FrameReader {
  public:
    DataReader(InputFile& file, const ReaderOptions& options)
        : file_(file), lines_(file), options_(options) {
        if (!options.atom_style.empty() && layouts_of(options.atom_style).empty())
            throw BadInput("--atom-style", "",
                           "must be an atom style of LAMMPS, such as atomic, charge, molecular, "
                           "full, sphere, or hybrid with its sub-styles, got \"" +
                               printable(options.atom_style) + "\"" +
                               suggestion(options.atom_style, atom_style_names()));
    }

    bool next(Structure& frame) override {
        if (was_read_) return false;
        was_read_ = true;
        frame = {};
        lines_.next(); // a comment with any content
        frame.title = trimmed(lines_.text());
        read_header();
        frame.cell = header_.cell;
        do
            read_section(frame);
        while (next_of_text());
        if (const std::size_t atoms = header_.count("atoms"); frame.size() != atoms)
            lines_.fail("must have " + std::to_string(atoms) + " atoms, got " +
                        std::to_string(frame.size()));
        name_kinds(frame);
        for (const char* particles : {"lines", "triangles", "bodies"})
            if (const std::size_t count = header_.count(particles); count > 0)
                tell(0, std::to_string(count) + " " + particles + " are rendered as balls");
        return true;
    }

  private:
    static std::string_view without_remark(std::string_view line) {
        return trimmed(line.substr(0, line.find('#')));
    }

    /// Returns the line without its comment, and with one blank between words.
    std::string words_of_line() const {
        std::string names;
        Words words(lines_);
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            const std::size_t hash = word.find('#');
            if (hash != 0) names.append(names.empty() ? "" : " ").append(word.substr(0, hash));
            if (hash != std::string_view::npos) break;
        }
        return names;
    }

    void tell(std::size_t line, const std::string& message) const {
        if (options_.on_remark)
            options_.on_remark(text_of({file_.name(), {.line = line}, {}, message}));
    }

    /// Goes to the next line that is not blank. Returns false at the end of the file.
    bool next_of_text() {
        is_after_blank_ = false;
        while (lines_.next()) {
            if (!without_remark(lines_.text()).empty()) return true;
            is_after_blank_ = true;
        }
        return false;
    }

    /// Reads "10 atoms", "0 50 xlo xhi", "0 0 0 xy xz yz", "1 0 0 avec", up to the line of the
    /// first section.
    void read_header() {
        double lower[3] = {-0.5, -0.5, -0.5}, upper[3] = {0.5, 0.5, 0.5}, lean[3] = {};
        Cell general{.edges = {core::Vec3d(1, 0, 0), core::Vec3d(0, 1, 0), core::Vec3d(0, 0, 1)}};
        bool has_box = false, is_general = false;
        for (;;) {
            if (!next_of_text()) lines_.fail("must have a section Atoms, got the end of the file");
            const std::string line = words_of_line();
            if (is_letter(line[0])) break;
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
            } else if (ends_with("avec") || ends_with("bvec") || ends_with("cvec")) {
                const auto edge = static_cast<std::size_t>(line[line.size() - 4] - 'a');
                for (int axis = 0; axis < 3; ++axis)
                    general.edges[edge][axis] = words.number("a component of an edge");
                is_general = true;
            } else if (ends_with("abc origin")) {
                for (int axis = 0; axis < 3; ++axis)
                    general.origin[axis] = words.number("a coordinate of the origin");
                is_general = true;
            } else {
                const long long count =
                    words.whole("a count", 0, static_cast<long long>(Structure::max_atoms));
                header_.counts[line.substr(std::min(line.find(' '), line.size() - 1) + 1)] =
                    static_cast<std::size_t>(count);
            }
        }
        if (is_general) header_.cell = general;
        if (is_general || !has_box) return;
        header_.cell.origin = {lower[0], lower[1], lower[2]};
        header_.cell.edges = {core::Vec3d(upper[0] - lower[0], 0.0, 0.0),
                              core::Vec3d(lean[0], upper[1] - lower[1], 0.0),
                              core::Vec3d(lean[1], lean[2], upper[2] - lower[2])};
    }

    /// Returns true if the line begins with a letter and has no number.
    bool has_words_alone() const {
        if (!is_letter(without_remark(lines_.text())[0])) return false;
        Words words(lines_);
        for (std::string_view word = words.next(); !word.empty() && word[0] != '#';
             word = words.next())
            if (number_in(word)) return false;
        return true;
    }

    /// Returns true at the line of a section. Other lines may begin with the label of a type, and
    /// then have a number. After a blank line, names of fixes are sections, too.
    bool at_section() const {
        const std::string_view line = without_remark(lines_.text());
        return is_letter(line[0]) &&
               (is_known_section(words_of_line()) || (is_after_blank_ && has_words_alone()));
    }

    /// Skips the names of columns directly after a section's name, where LAMMPS skips any line.
    void skip_column_names() {
        if (!lines_.next()) return;
        const std::string_view line = without_remark(lines_.text());
        if (line.empty() || is_known_section(words_of_line()) || !has_words_alone())
            lines_.put_back();
    }

    void read_section(Structure& frame) {
        const std::string name = words_of_line();
        const std::size_t hash = lines_.text().find('#');
        const std::string remark(
            hash == std::string_view::npos ? "" : trimmed(lines_.text().substr(hash + 1)));
        const auto line = static_cast<std::size_t>(lines_.number());
        if (name[0] < 'A' || name[0] > 'Z')
            lines_.fail("must be a section's name, such as Atoms, got \"" + printable(name) + "\"" +
                        suggestion(name, {std::begin(sections), std::end(sections)}));
        if (name == "Atoms" && frame.size() != 0) lines_.fail("must not be a second section Atoms");
        skip_column_names();
        if (name == "Masses")
            read_masses();
        else if (name == "Atom Type Labels")
            read_type_labels();
        else if (name == "Atoms")
            read_atoms(frame, line, remark);
        else if (name == "Bonds")
            read_bonds(frame);
        else if (name == "Ellipsoids")
            read_ellipsoids(frame);
        else
            skip_section();
    }

    /// Goes to the next line of a section. Returns false at the section's end.
    bool next_of_section() {
        if (!next_of_text()) return false;
        if (at_section()) {
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
        header_.has_masses = true;
        while (next_of_section()) {
            Words words(lines_);
            const std::string type(words.get("a type"));
            masses_.emplace_back(type, words.number("a mass"));
        }
    }

    void read_type_labels() {
        while (next_of_section()) {
            Words words(lines_);
            const std::string type(words.get("a type"));
            labels_[type] = words.get("a label");
        }
    }

    /// Returns the label of a type, which a line gives by its label or by its number.
    const std::string& label_of(const std::string& type) const {
        const auto found = labels_.find(type);
        return found == labels_.end() ? type : found->second;
    }

    void read_atoms(Structure& frame, std::size_t line, const std::string& remark) {
        AtomTable table;
        while (next_of_section()) {
            table.add(lines_);
            const long long id = table.ids().back();
            if (id != 0 && !atom_of_.emplace(id, table.size() - 1).second)
                lines_.fail("must be an atom with a new number, got " + std::to_string(id) +
                            " again");
        }
        if (table.size() == 0) return;
        const AtomLayout layout = layout_of(table, line, remark);
        has_electrons_ = layout.index_of("espin") != 0;
        fill(frame, table, layout);
    }

    AtomLayout layout_of(const AtomTable& table, std::size_t line,
                         const std::string& remark) const {
        const auto fail = [&](TextPosition place, const std::string& message) {
            throw BadInput({{file_.name(),
                             place.line == 0 ? TextPosition{.line = line} : place,
                             {},
                             message}});
        };
        const auto named = layouts_of(options_.atom_style.empty() ? remark : options_.atom_style);
        if (const auto layout = probable_layout(named, table, header_)) {
            if (layout->style == "hybrid")
                tell(line, "hybrid without sub-styles: only positions and types are read");
            return *layout;
        }
        const std::string must_name =
            "must name its atom style, as in \"Atoms # full\" or by --atom-style: ";
        if (!named.empty()) {
            const Misfit misfit = *misfit_of(table, named[0], header_);
            fail(misfit.place, (misfit.place.line == 0 ? must_name : "") + misfit.message);
        }
        const std::vector<AtomLayout> fitting = layouts_that_fit(table, header_);
        if (fitting.size() != 1) {
            std::vector<std::string> styles;
            styles.reserve(fitting.size());
            for (const AtomLayout& layout : fitting)
                styles.push_back(layout.style);
            fail({},
                 must_name + (fitting.empty() ? "no style without sub-styles fits its " +
                                                    std::to_string(table.max_width()) + " columns"
                                              : "it can be " + alternatives(styles)));
        }
        if (!remark.empty())
            tell(line, "\"" + printable(remark) +
                           "\" is not an atom style: the atoms are read as " + fitting[0].style);
        return fitting[0];
    }

    void fill(Structure& frame, AtomTable& table, const AtomLayout& layout) const {
        const std::size_t x = layout.index_of("x");
        frame.positions.reserve(table.size());
        for (std::size_t atom = 0; atom < table.size(); ++atom)
            frame.positions.emplace_back(table.column(x).values[atom],
                                         table.column(x + 1).values[atom],
                                         table.column(x + 2).values[atom]);
        fill_kinds(frame, table, table.column(layout.index_of("type")));
        for (std::size_t i = 0; i < layout.columns.size(); ++i) {
            const std::string_view column = layout.columns[i];
            std::vector<float>& values = table.column(i + 1).values;
            if (column == "diameter" || column == "cradius") {
                const float half = column == "diameter" ? 0.5F : 1.0F;
                for (float& value : values)
                    value = std::isfinite(value) ? half * std::abs(value) : 0.0F;
                frame.radii = std::move(values);
            } else if (column != "type" && (i + 1 < x || i + 1 > x + 2) &&
                       !column.ends_with("flag")) {
                frame.properties.push_back({std::string(column), std::move(values)});
            }
        }
    }

    void fill_kinds(Structure& frame, const AtomTable& table,
                    const AtomTable::Column& types) const {
        KindTable kinds(frame.of_kind);
        const auto kind_of = [&](const std::string& type) {
            const std::size_t kind =
                kinds.index_of(label_of(type), [](std::string_view) { return Element{0}; });
            if (kind == Structure::max_kinds)
                throw BadInput(file_.name(), "", "must have at most 65535 types of atoms");
            return static_cast<std::uint16_t>(kind);
        };
        std::vector<std::optional<std::uint16_t>> of_text(table.texts().size());
        std::unordered_map<long long, std::uint16_t> of_number;
        frame.kinds.reserve(table.size());
        for (std::size_t atom = 0; atom < table.size(); ++atom) {
            if (const std::uint16_t label =
                    types.labels.empty() ? std::uint16_t{0} : types.labels[atom];
                label != 0) {
                auto& kind = of_text[label - 1U];
                if (!kind) kind = kind_of(table.texts()[label - 1U].label);
                frame.kinds.push_back(*kind);
                continue;
            }
            const auto number = static_cast<long long>(types.values[atom]);
            auto found = of_number.find(number);
            if (found == of_number.end())
                found = of_number.emplace(number, kind_of(std::to_string(number))).first;
            frame.kinds.push_back(found->second);
        }
    }

    AtomIndex atom(Words& words) const {
        const long long id = words.whole("an atom's number", 1, std::int64_t{1} << 53);
        const auto found = atom_of_.find(id);
        if (found == atom_of_.end())
            words.fail("must be the number of an atom, got unknown " + std::to_string(id));
        return found->second;
    }

    void read_bonds(Structure& frame) {
        while (next_of_section()) {
            Words words(lines_);
            words.get("a bond's number");
            words.get("a bond's type");
            const AtomIndex first = atom(words), second = atom(words);
            if (first == second) words.fail("must be two atoms, got one twice");
            frame.bonds.push_back({std::min(first, second), std::max(first, second)});
        }
        frame.has_all_bonds = true;
    }

    /// Reads three diameters and a quaternion for each ellipsoid. Three diameters of zero are a
    /// point's.
    void read_ellipsoids(Structure& frame) {
        frame.radii.resize(frame.size());
        while (next_of_section()) {
            Words words(lines_);
            AtomShape shape{atom(words), {}};
            double half[3], q[4];
            for (double& axis : half) {
                axis = 0.5 * words.number("a diameter");
                if (!(axis >= 0.0)) words.fail("a diameter must not be negative");
            }
            double norm = 0.0;
            for (double& part : q) {
                part = words.number("a part of a quaternion");
                norm += part * part;
            }
            norm = std::sqrt(norm);
            if (!(norm > 0.0 && std::isfinite(norm)))
                words.fail("must be a quaternion of a length above zero");
            if (half[0] == 0.0 && half[1] == 0.0 && half[2] == 0.0) continue;
            for (double& part : q)
                part /= norm;
            const auto [w, i, j, k] = q;
            // The columns of the rotation.
            const core::Vec3d axes[3] = {
                {w * w + i * i - j * j - k * k, 2.0 * (i * j + w * k), 2.0 * (i * k - w * j)},
                {2.0 * (i * j - w * k), w * w - i * i + j * j - k * k, 2.0 * (j * k + w * i)},
                {2.0 * (i * k + w * j), 2.0 * (j * k - w * i), w * w - i * i - j * j + k * k}};
            for (std::size_t axis = 0; axis < 3; ++axis)
                shape.axes[axis] = core::convert<float>(half[axis] * axes[axis]);
            frame.radii[shape.atom] = static_cast<float>(std::max({half[0], half[1], half[2]}));
            frame.shapes.push_back(shape);
        }
    }

    /// Finds the elements of types by their masses.
    void name_kinds(Structure& frame) const {
        std::map<std::string_view, double> mass_of;
        for (const auto& [type, mass] : masses_)
            mass_of[label_of(type)] = mass;
        std::vector<double> masses;
        for (const AtomKind& kind : frame.of_kind) {
            const auto found = mass_of.find(kind.label);
            if (found == mass_of.end()) return;
            if (is_electron(found->second)) continue;
            masses.push_back(found->second);
        }
        const std::vector<Element> of_types = elements_of_masses(masses, units_of(frame.title));
        auto element = of_types.begin();
        for (AtomKind& kind : frame.of_kind)
            if (element != of_types.end() && !is_electron(mass_of[kind.label]))
                kind.element = *element++;
    }

    /// Files for the electron force field give electrons a mass of 1, or the real one.
    bool is_electron(double mass) const { return has_electrons_ && (mass == 1.0 || mass < 0.001); }

    /// LAMMPS itself writes "units = real" at the end of the first line.
    static MassUnits units_of(std::string_view title) {
        constexpr std::string_view key = "units = ";
        const std::size_t at = title.rfind(key);
        if (at == std::string_view::npos) return MassUnits::unknown;
        const std::string_view units = trimmed(title.substr(at + key.size()));
        return units == "real" || units == "metal" || units == "electron" ? MassUnits::daltons
                                                                          : MassUnits::others;
    }

    InputFile& file_;
    Lines lines_;
    ReaderOptions options_;
    LammpsHeader header_;
    std::map<std::string, std::string> labels_; // by type
    std::vector<std::pair<std::string, double>> masses_;
    std::unordered_map<long long, AtomIndex> atom_of_;
    bool was_read_ = false, is_after_blank_ = false, has_electrons_ = false;
};

} // namespace

std::unique_ptr<FrameReader> open_lammps_data(InputFile& file, const ReaderOptions& options) {
    return std::make_unique<DataReader>(file, options);
}

} // namespace raylane::scenes
