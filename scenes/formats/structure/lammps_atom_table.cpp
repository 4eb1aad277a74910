#include "scenes/formats/structure/lammps_atom_table.hpp"

#include "core/shapes/checks.hpp"
#include "scenes/files/number.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace raylane::scenes {

namespace {

constexpr std::size_t image_flags = 3;
constexpr std::size_t last_of_types = 4; // template has its type here
constexpr float largest_whole = 0x1p24F; // a float distinguishes it from its neighbours
constexpr float above_zero = std::numeric_limits<float>::denorm_min();
constexpr float infinite = std::numeric_limits<float>::infinity();

/// The values that a column may have. LAMMPS refuses fractions where `is_whole`. The bounds follow
/// from the meaning of the column.
struct ColumnRule {
    std::string_view column;
    bool is_whole;
    float least, most;
    std::string_view count_of_ones; ///< the count of the header for flags, or empty
};
constexpr ColumnRule rules[] = {
    {"molecule", true, 0.0F, infinite, {}},
    {"ellipsoidflag", true, 0.0F, 1.0F, "ellipsoids"},
    {"bodyflag", true, 0.0F, 1.0F, "bodies"},
    {"lineflag", true, 0.0F, 1.0F, "lines"},
    {"triangleflag", true, 0.0F, 1.0F, "triangles"},
    {"espin", true, -1.0F, 3.0F, {}},
    {"etag", true, 0.0F, infinite, {}},
    {"bond_nt", true, 0.0F, infinite, {}},
    {"status", true, 0.0F, infinite, {}},
    {"template_index", true, 0.0F, infinite, {}},
    {"template_atom", true, 0.0F, infinite, {}},
    {"diameter", false, 0.0F, infinite, {}},
    {"density", false, above_zero, infinite, {}},
    {"mass", false, above_zero, infinite, {}},
    {"volume", false, above_zero, infinite, {}},
    {"rho", false, above_zero, infinite, {}},
    {"cv", false, above_zero, infinite, {}},
    {"kradius", false, above_zero, infinite, {}},
    {"cradius", false, above_zero, infinite, {}},
    {"eradius", false, 0.0F, infinite, {}},
    {"theta", false, 0.0F, infinite, {}},
    {"edpd_temp", false, 0.0F, infinite, {}},
    {"edpd_cv", false, above_zero, infinite, {}},
    {"spx", false, -1.0F, 1.0F, {}},
    {"spy", false, -1.0F, 1.0F, {}},
    {"spz", false, -1.0F, 1.0F, {}},
};

/// Returns nothing for a text. Returns NaN for NaN, infinity and numbers too large for a float.
std::optional<float> value_of(std::string_view word) {
    if (const auto leading = leading_number(word); leading && leading->length == word.size())
        return leading->value;
    if (const std::optional<float> nearest = to_float(word)) return *nearest;
    if (const std::optional<double> value = number_in(word)) { // with a Fortran exponent, or large
        constexpr auto most = static_cast<double>(std::numeric_limits<float>::max());
        return static_cast<float>(std::abs(*value) <= most ? *value : std::nan(""));
    }
    std::string name = in_lower_case(word);
    if (name.starts_with('-') || name.starts_with('+')) name.erase(0, 1);
    if (name == "nan" || name == "inf" || name == "infinity") return std::nanf("");
    return std::nullopt;
}

bool is_whole_number(std::string_view word) {
    if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
    return !word.empty() &&
           std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Keeps only the layouts for which `speaks_for` is true, if there are any.
void prefer(std::vector<AtomLayout>& layouts, const auto& speaks_for) {
    std::vector<AtomLayout> preferred;
    std::copy_if(layouts.begin(), layouts.end(), std::back_inserter(preferred), speaks_for);
    if (!preferred.empty()) layouts = std::move(preferred);
}

/// Compares the values of a table with layouts.
class Evidence {
  public:
    Evidence(const AtomTable& table, const LammpsHeader& header) : table_(table), header_(header) {}

    /// Returns false if a value contradicts the meaning of its column, or a count of the header.
    bool allows(const AtomLayout& layout) const {
        const auto has = [&](std::string_view count) { return header_.count(count) > 0; };
        if ((has("bonds") || has("angles") || has("dihedrals") || has("impropers")) &&
            !layout.allows_bonds)
            return false;
        for (const ColumnRule& rule : rules) {
            const std::size_t index = layout.index_of(rule.column);
            if (!rule.count_of_ones.empty() && has(rule.count_of_ones) != (index != 0))
                return false;
            if (index == 0) continue;
            const AtomTable::Column& column = table_.column(index);
            if (!(column.least >= rule.least && column.most <= rule.most)) return false;
            if (!rule.count_of_ones.empty() && ones_in(column) != header_.count(rule.count_of_ones))
                return false;
        }
        const std::size_t spins = layout.index_of("spx");
        return spins == 0 || has_unit_spins(spins);
    }

    /// Returns true if all atoms are in the box or less than a box away from it, as the atoms of
    /// unbroken molecules are.
    bool is_in_box(const AtomLayout& layout) const {
        const auto& edges = header_.cell.edges;
        const std::array<core::Vec3d, 3> normals = {core::cross(edges[1], edges[2]),
                                                    core::cross(edges[2], edges[0]),
                                                    core::cross(edges[0], edges[1])};
        const double volume = core::dot(edges[0], normals[0]);
        if (volume == 0.0) return true;
        const auto [x, y, z] = coordinates(layout);
        for (std::size_t atom = 0; atom < table_.size(); ++atom) {
            const core::Vec3f position(x->values[atom], y->values[atom], z->values[atom]);
            const core::Vec3d at = core::convert<double>(position) - header_.cell.origin;
            for (const core::Vec3d& normal : normals)
                if (const double share = core::dot(at, normal) / volume;
                    !(share >= -1.0 && share <= 2.0))
                    return false;
        }
        return true;
    }

    /// Returns the number of axes whose coordinates have a property.
    template <class Has>
    int axes_where(const AtomLayout& layout, const Has& has) const {
        const auto columns = coordinates(layout);
        return static_cast<int>(
            std::count_if(columns.begin(), columns.end(),
                          [&](const AtomTable::Column* column) { return has(*column); }));
    }
    int dimensions(const AtomLayout& layout) const {
        return axes_where(layout, [](const auto& column) { return column.least < column.most; });
    }
    int decimals(const AtomLayout& layout) const {
        return axes_where(layout, [](const auto& column) { return column.not_whole.has_value(); });
    }

    /// Removes layouts without masses if masses are missing, and layouts with other masses. LAMMPS
    /// has masses of types or of atoms.
    void prefer_masses(std::vector<AtomLayout>& layouts) const {
        prefer(layouts, [&](const AtomLayout& layout) {
            return header_.has_masses ==
                   (layout.index_of("density") == 0 && layout.index_of("mass") == 0);
        });
    }

    /// Removes layouts that are less probable than others.
    void prefer_probable(std::vector<AtomLayout>& layouts) const {
        // Three columns do not form unit vectors by accident.
        prefer(layouts, [&](const AtomLayout& layout) {
            const std::size_t spins = layout.index_of("spx");
            return spins != 0 && has_unit_spins(spins);
        });
        prefer(layouts, [&](const AtomLayout& layout) { return is_in_box(layout); });
        int max_dimensions = 0, max_decimals = 0;
        for (const AtomLayout& layout : layouts) {
            max_dimensions = std::max(max_dimensions, dimensions(layout));
            max_decimals = std::max(max_decimals, decimals(layout));
        }
        prefer(layouts,
               [&](const AtomLayout& layout) { return dimensions(layout) > max_dimensions - 2; });
        // Programs write coordinates with decimals, and image flags without.
        if (max_decimals == 3)
            prefer(layouts, [&](const AtomLayout& layout) { return decimals(layout) > 0; });
    }

    /// Returns true if two layouts put atoms of the same types at the same positions.
    bool same_atoms(const AtomLayout& a, const AtomLayout& b) const {
        if (a.index_of("x") != b.index_of("x")) return false;
        const std::size_t of_a = a.index_of("type"), of_b = b.index_of("type");
        return of_a == of_b || table_.column(of_a).values == table_.column(of_b).values;
    }

  private:
    static std::size_t ones_in(const AtomTable::Column& column) {
        return static_cast<std::size_t>(
            std::count(column.values.begin(), column.values.end(), 1.0F));
    }

    /// Returns true if there are spins, all of unit length or zero.
    bool has_unit_spins(std::size_t first) const {
        bool has_some = false;
        for (std::size_t atom = 0; atom < table_.size(); ++atom) {
            float square = 0.0F;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const float part = table_.column(first + axis).values[atom];
                square += part * part;
            }
            if (square == 0.0F) continue;
            if (!(std::abs(square - 1.0F) < 0.01F)) return false;
            has_some = true;
        }
        return has_some;
    }

    std::array<const AtomTable::Column*, 3> coordinates(const AtomLayout& layout) const {
        const std::size_t x = layout.index_of("x");
        return {&table_.column(x), &table_.column(x + 1), &table_.column(x + 2)};
    }

    const AtomTable& table_;
    const LammpsHeader& header_;
};

} // namespace

void AtomTable::add(const Lines& lines) {
    Words words(lines);
    ids_.push_back(words.whole("an atom's number", 0, std::int64_t{1} << 53));
    std::size_t width = 1;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const std::size_t hash = word.find('#');
        word = word.substr(0, hash);
        if (!word.empty()) add_word(lines, words, word, width++);
        if (hash != std::string_view::npos) break;
    }
    min_width_ = std::min(min_width_, width);
    max_width_ = std::max(max_width_, width);
}

void AtomTable::add_word(const Lines& lines, const Words& words, std::string_view word,
                         std::size_t index) {
    if (index >= max_columns) return;
    if (index >= columns_.size()) columns_.resize(index + 1);
    Column& column = columns_[index];
    const TextPosition place = {static_cast<std::size_t>(lines.number()), words.column()};
    const auto note = [&](std::optional<Word>& first) {
        if (!first) first = Word{place, std::string(word)};
    };
    const std::optional<float> number = value_of(word);
    const float value = number.value_or(std::nanf(""));
    column.values.push_back(value);
    if (!column.labels.empty()) column.labels.push_back(0);
    if (std::isnan(value)) note(column.not_finite);
    if (number && !is_whole_number(word)) note(column.not_whole);
    if (!number) {
        note(column.text);
        if (index <= last_of_types) {
            const std::size_t text =
                text_table_.index_of(word, [](std::string_view) { return Element{0}; });
            if (text == Structure::max_kinds) words.fail("must be of one of at most 65535 types");
            column.labels.resize(column.values.size());
            column.labels.back() = static_cast<std::uint16_t>(text + 1);
        }
    }
    if (value < column.least) {
        column.least = value;
        column.min_position = place;
    }
    if (value > column.most) {
        column.most = value;
        column.max_position = place;
    }
}

namespace {

Misfit misfit(const AtomTable::Word& word, const std::string& rule) {
    return {word.place, rule + ", got \"" + printable(word.text) + "\""};
}

std::optional<Misfit> misfit_of_types(const AtomTable::Column& column, const LammpsHeader& header) {
    const std::size_t types = header.count("atom types");
    const float most =
        types == 0 ? largest_whole : std::min(static_cast<float>(types), largest_whole);
    const std::string rule = "an atom type must be a label or a whole number from 1 to " +
                             std::to_string(static_cast<long long>(most));
    if (column.not_whole) return misfit(*column.not_whole, rule);
    if (column.least < 1.0F)
        return Misfit{column.min_position, rule + ", got " + to_text(column.least)};
    if (column.most > most)
        return Misfit{column.max_position, rule + ", got " + to_text(column.most)};
    return std::nullopt;
}

std::optional<Misfit> misfit_of_column(const AtomTable::Column& column, std::string_view name) {
    const bool is_coordinate = name == "x" || name == "y" || name == "z";
    const std::string named = is_coordinate ? "a coordinate" : std::string(name);
    if (column.text) return misfit(*column.text, named + " must be a number");
    if (is_coordinate) {
        constexpr float limit = core::coordinate_limit;
        if (column.not_finite) return misfit(*column.not_finite, named + " must be a number");
        if (column.least < -limit || column.most > limit)
            return Misfit{column.least < -limit ? column.min_position : column.max_position,
                          named + " must be from -1e30 to 1e30"};
    }
    const auto* const rule =
        std::find_if(std::begin(rules), std::end(rules),
                     [&](const auto& alternative) { return alternative.column == name; });
    if (rule != std::end(rules) && rule->is_whole && column.not_whole)
        return misfit(*column.not_whole, named + " must be a whole number");
    return std::nullopt;
}

} // namespace

std::optional<Misfit> misfit_of(const AtomTable& table, const AtomLayout& layout,
                                const LammpsHeader& header) {
    const std::size_t width = layout.columns.size() + 1;
    const bool has_images = table.max_width() == width + image_flags && !layout.is_open;
    if (table.min_width() < width ||
        (table.max_width() != width && !has_images && !layout.is_open)) {
        const std::size_t got = table.min_width() < width ? table.min_width() : table.max_width();
        return Misfit{{},
                      "atom style " + layout.style + " has " + std::to_string(width) + " columns" +
                          (layout.is_open ? " or more"
                                          : ", or " + std::to_string(width + image_flags) +
                                                " with image flags") +
                          ", got " + std::to_string(got)};
    }
    for (std::size_t i = 1; i < width; ++i) {
        const std::string_view name = layout.columns[i - 1];
        auto found = name == "type" ? misfit_of_types(table.column(i), header)
                                    : misfit_of_column(table.column(i), name);
        if (found) return found;
    }
    for (std::size_t i = width; has_images && i < width + image_flags; ++i)
        for (const auto* word : {&table.column(i).text, &table.column(i).not_whole})
            if (*word) return misfit(**word, "an image flag must be a whole number");
    return std::nullopt;
}

std::optional<AtomLayout> probable_layout(std::vector<AtomLayout> layouts, const AtomTable& table,
                                          const LammpsHeader& header) {
    const Evidence evidence(table, header);
    layouts.erase(std::remove_if(layouts.begin(), layouts.end(),
                                 [&](const AtomLayout& layout) {
                                     return misfit_of(table, layout, header).has_value();
                                 }),
                  layouts.end());
    if (layouts.empty()) return std::nullopt;
    if (layouts.size() > 1) evidence.prefer_probable(layouts);
    return *std::max_element(layouts.begin(), layouts.end(),
                             [&](const AtomLayout& a, const AtomLayout& b) {
                                 return evidence.dimensions(a) < evidence.dimensions(b);
                             });
}

std::vector<AtomLayout> layouts_that_fit(const AtomTable& table, const LammpsHeader& header) {
    const Evidence evidence(table, header);
    std::vector<AtomLayout> layouts;
    for (AtomLayout& layout : fixed_layouts())
        if (!misfit_of(table, layout, header) && evidence.allows(layout))
            layouts.push_back(std::move(layout));
    evidence.prefer_masses(layouts);

    // Hybrid styles fit most tables, and are not guessed. They prevent a guess that would put all
    // atoms on a line.
    const AtomLayout hybrid = layouts_of("hybrid")[0];
    const auto in_box = [&](const AtomLayout& layout) { return evidence.is_in_box(layout); };
    if (!misfit_of(table, hybrid, header) && in_box(hybrid) &&
        std::any_of(layouts.begin(), layouts.end(), in_box) && evidence.dimensions(hybrid) == 3 &&
        evidence.decimals(hybrid) == 3)
        layouts.push_back(hybrid);
    evidence.prefer_probable(layouts);

    std::vector<AtomLayout> different;
    for (AtomLayout& layout : layouts)
        if (!layout.is_open &&
            std::none_of(different.begin(), different.end(), [&](const AtomLayout& other) {
                return evidence.same_atoms(layout, other);
            }))
            different.push_back(std::move(layout));
    return different;
}

} // namespace raylane::scenes
