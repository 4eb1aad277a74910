#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/structure/kind_table.hpp"
#include "scenes/formats/structure/labels.hpp"
#include "scenes/formats/structure/lines.hpp"
#include "scenes/formats/structure/readers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace raylane::scenes {

namespace {

constexpr std::string_view item = "ITEM: ";

class DumpReader : public FrameReader {
  public:
    explicit DumpReader(InputFile& file) : file_(file), lines_(file) {}

    bool next(Structure& frame) override {
        frame = {};
        std::size_t count = 0;
        bool has_count = false;
        while (next_item()) {
            const std::string_view what = trimmed(lines_.text().substr(item.size()));
            if (what == "TIMESTEP") {
                next_line("the time step");
                frame.title = "timestep " + std::string(trimmed(lines_.text()));
            } else if (what == "NUMBER OF ATOMS") {
                next_line("the number of atoms");
                Words words(lines_);
                count = static_cast<std::size_t>(words.whole(
                    "the number of atoms", 0, static_cast<long long>(Structure::max_atoms)));
                has_count = true;
            } else if (what.starts_with("BOX BOUNDS")) {
                read_box(frame.cell, what.substr(10));
            } else if (what.starts_with("ATOMS")) {
                if (!has_count) lines_.fail("must come after ITEM: NUMBER OF ATOMS");
                read_atoms(frame, what.substr(5), count);
                ++frames_;
                return true;
            } else if (!lines_.next()) { // units, time: one line each
                break;
            }
        }
        if (frames_ == 0) lines_.fail("must have ITEM: ATOMS, got the end of the file");
        return false;
    }

  private:
    bool next_item() {
        do
            if (!lines_.next()) return false;
        while (trimmed(lines_.text()).empty());
        if (!lines_.text().starts_with(item))
            lines_.fail(R"(must begin with "ITEM: ", got ")" + printable(lines_.text()) + "\"");
        return true;
    }

    void next_line(const char* what) {
        if (!lines_.next())
            lines_.fail(std::string("must be ") + what + ", got the end of the file");
    }

    /// Reads the bounds of the box. A tilted box has those of its bounding box.
    void read_box(Cell& cell, std::string_view flags) {
        double lower[3], upper[3], lean[3] = {}; // xy, xz, yz
        const bool is_tilted = flags.find("xy") != std::string_view::npos;
        if (flags.find("abc") != std::string_view::npos) return read_general_box(cell);
        for (int axis = 0; axis < 3; ++axis) {
            next_line("the bounds of the box");
            Words words(lines_);
            lower[axis] = words.number("a lower bound");
            upper[axis] = words.number("an upper bound");
            if (is_tilted) lean[axis] = words.number("a tilt");
        }
        const auto [min_x, max_x] = std::minmax({0.0, lean[0], lean[1], lean[0] + lean[1]});
        lower[0] -= min_x;
        upper[0] -= max_x;
        const auto [min_y, max_y] = std::minmax({0.0, lean[2]});
        lower[1] -= min_y;
        upper[1] -= max_y;
        cell.origin = {lower[0], lower[1], lower[2]};
        cell.edges = {core::Vec3d(upper[0] - lower[0], 0.0, 0.0),
                      core::Vec3d(lean[0], upper[1] - lower[1], 0.0),
                      core::Vec3d(lean[1], lean[2], upper[2] - lower[2])};
        read_periodic(cell, flags);
    }

    /// Reads three edges. Each line ends with a coordinate of the origin.
    void read_general_box(Cell& cell) {
        for (std::size_t edge = 0; edge < 3; ++edge) {
            next_line("an edge of the box");
            Words words(lines_);
            for (int axis = 0; axis < 3; ++axis)
                cell.edges[edge][axis] = words.number("a component of an edge");
            cell.origin[static_cast<int>(edge)] = words.number("a coordinate of the origin");
        }
    }

    /// Reads the periodicity: "pp" is periodic on both sides of an axis.
    static void read_periodic(Cell& cell, std::string_view flags) {
        std::size_t axis = 0;
        while (axis < 3) {
            flags = trimmed(flags);
            if (flags.empty()) return;
            const std::size_t end = std::min(flags.find(' '), flags.size());
            const std::string_view word = flags.substr(0, end);
            if (word.size() == 2 && word != "xy" && word != "xz" && word != "yz")
                cell.periodic[axis++] = word == "pp";
            flags.remove_prefix(end);
        }
    }

    enum class Is { x, y, z, element, type, radius, property, other };
    struct Column {
        Is is;
        std::size_t property; ///< index
    };

    void read_columns(Structure& frame, std::string_view names) {
        columns_.clear();
        is_scaled_ = false;
        bool seen[3] = {};
        has_element_ = has_radius_ = false;
        for (;;) {
            names = trimmed(names);
            if (names.empty()) break;
            const std::size_t end = std::min(names.find(' '), names.size());
            const std::string_view name = names.substr(0, end);
            names.remove_prefix(end);
            const std::size_t axis = name[0] >= 'x' && name[0] <= 'z'
                                         ? static_cast<std::size_t>(name[0] - 'x')
                                         : std::size_t{3};
            const std::string_view rest = name.substr(1);
            const bool is_scaled = rest == "s" || rest == "su"; // if one is scaled, all are
            if (axis < 3 && (rest.empty() || rest == "u" || is_scaled) && !seen[axis]) {
                seen[axis] = true;
                is_scaled_ = is_scaled_ || is_scaled;
                columns_.push_back({static_cast<Is>(axis), 0});
            } else if (name == "element") {
                has_element_ = true;
                columns_.push_back({Is::element, 0});
            } else if (name == "type") {
                columns_.push_back({Is::type, 0});
            } else if (name == "radius") {
                has_radius_ = true;
                columns_.push_back({Is::radius, 0});
            } else if (name == "id" || name == "ix" || name == "iy" || name == "iz" || axis < 3) {
                columns_.push_back({Is::other, 0});
            } else {
                columns_.push_back({Is::property, frame.properties.size()});
                frame.properties.push_back({std::string(name), {}});
            }
        }
        if (!seen[0] || !seen[1] || !seen[2])
            lines_.fail("must have x, y and z (or xs, xu, xsu), got \"" +
                        printable(lines_.text(), 200) + "\"");
        if (is_scaled_ && !frame.cell.any())
            lines_.fail("must come after ITEM: BOX BOUNDS, because its coordinates are fractions "
                        "of the box");
    }

    void read_atoms(Structure& frame, std::string_view names, std::size_t count) {
        read_columns(frame, names);
        // Reserves no more than the file can hold: each number takes a byte and a blank.
        const std::size_t bytes =
            file_.size() != 0 ? static_cast<std::size_t>(file_.size()) : std::size_t{1} << 23;
        const std::size_t room = bytes / (2 * columns_.size());
        frame.positions.reserve(std::min(count, room));
        frame.kinds.reserve(std::min(count, room));
        for (AtomProperty& property : frame.properties)
            property.values.reserve(std::min(count, room));
        KindTable kinds(frame.of_kind);
        for (std::size_t atom = 0; atom < count; ++atom) {
            lines_.next_atom(atom + 1, count);
            read_atom(frame, kinds);
        }
    }

    void read_atom(Structure& frame, KindTable& kinds) {
        Words words(lines_);
        core::Vec3f at(0.0F);
        std::string_view label = "1";
        float radius = 0.0F;
        for (const Column& column : columns_) {
            switch (column.is) {
            case Is::x:
            case Is::y:
            case Is::z:
                at[static_cast<int>(column.is)] = words.coordinate("a coordinate");
                break;
            case Is::element:
                label = words.get("an element");
                break;
            case Is::type:
                if (has_element_)
                    words.get("a type");
                else
                    label = words.get("a type");
                break;
            case Is::radius:
                radius = words.coordinate("a radius");
                break;
            case Is::property:
                frame.properties[column.property].values.push_back(value_of(words.get("a value")));
                break;
            case Is::other:
                words.get("a value");
            }
        }
        if (is_scaled_) {
            const auto part = core::convert<double>(at);
            at = core::convert<float>(frame.cell.origin + part.x * frame.cell.edges[0] +
                                      part.y * frame.cell.edges[1] + part.z * frame.cell.edges[2]);
        }
        const std::size_t kind = kinds.index_of(label, [&](std::string_view name) {
            return has_element_ ? element_of_label(name) : Element{0};
        });
        if (kind == Structure::max_kinds) lines_.fail("must be of one of at most 65535 types");
        if (has_radius_) frame.radii.push_back(radius);
        frame.positions.push_back(at);
        frame.kinds.push_back(static_cast<std::uint16_t>(kind));
    }

    /// Returns NaN for a word that is not a number, such as a molecule's name.
    static float value_of(std::string_view word) {
        if (const std::optional<float> nearest = to_float(word)) return *nearest;
        const double value = number_in(word).value_or(std::nan("")); // Fortran exponent, or text
        constexpr auto most = static_cast<double>(std::numeric_limits<float>::max());
        return static_cast<float>(std::abs(value) <= most ? value : std::nan(""));
    }

    InputFile& file_;
    Lines lines_;
    std::vector<Column> columns_;
    bool is_scaled_ = false, has_element_ = false, has_radius_ = false;
    std::size_t frames_ = 0;
};

} // namespace

std::unique_ptr<FrameReader> open_lammps_dump(InputFile& file) {
    return std::make_unique<DumpReader>(file);
}

} // namespace raylane::scenes
