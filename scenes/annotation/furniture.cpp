#include "scenes/annotation/furniture.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/colors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace raylane::scenes {

namespace {

using core::Vec3d;

/// Returns a power of ten times 1, 2 or 5 that is at most `most`.
double round_below(double most) {
    double power = 1.0;
    while (power * 10.0 <= most)
        power *= 10.0;
    while (power > most)
        power *= 0.1;
    for (const double times : {5.0, 2.0})
        if (times * power <= most) return times * power;
    return power;
}

int decimals_of(double step) {
    int decimals = 0;
    for (double power = 1.0; power > step * 1.0001 && decimals < 12; power *= 0.1)
        ++decimals;
    return decimals;
}

std::string usual_title(const std::string& property) {
    constexpr std::pair<const char*, const char*> known[] = {
        {"b_factor", "B factor (\u00c5\u00b2)"},
        {"occupancy", "Occupancy"},
        {"charge", "Charge (e)"},
        {"mass", "Mass (u)"}};
    for (const auto& [name, title] : known)
        if (property == name) return title;
    return property;
}

using Entries = std::vector<std::pair<std::string, std::uint32_t>>;

/// Returns the entries of a key that are not colours by name. Elements come before other names:
/// carbon, hydrogen, then by symbol, as in formulas.
Entries entries_of(const ColorKey& key) {
    Entries entries = key.entries;
    std::erase_if(entries, [](const auto& entry) { return color_named(entry.first).has_value(); });
    const auto rank = [](const std::string& name) {
        return name == "C" ? 0 : name == "H" ? 1 : element_of(name) != 0 ? 2 : 3;
    };
    std::stable_sort(entries.begin(), entries.end(), [&](const auto& a, const auto& b) {
        return std::pair(rank(a.first), a.first) < std::pair(rank(b.first), b.first);
    });
    return entries;
}

bool has_ramp(const Legend& legend) {
    return std::any_of(legend.colors.begin(), legend.colors.end(),
                       [](const ColorKey& key) { return !key.property.empty(); });
}

} // namespace

void require_contents(const Annotations& annotations, const Legend& legend) {
    if (annotations.axes == Axes::of_cell && !legend.structure.cell.any())
        throw BadInput(annotations.option("triad"), "", "must be xyz: the atoms have no cell");
    if (!annotations.legend) return;
    const std::string option =
        annotations.option(annotations.is_legend_implied ? "legend-title" : "legend");
    if (legend.structure.size() == 0)
        throw BadInput(option, "", "goes with a file of atoms, not with a scene");
    const bool has_any =
        std::any_of(legend.colors.begin(), legend.colors.end(), [](const ColorKey& key) {
            return !key.property.empty() || !entries_of(key).empty();
        });
    if (has_any) return;
    if (legend.has_too_many_colors)
        throw BadInput(option, "",
                       "must have at most " + std::to_string(max_key_entries) +
                           " colours to explain, got more: colours of residues have no legend");
    throw BadInput(option, "",
                   "must have colours of elements, chains or numbers to explain, but the atoms "
                   "have colours by name");
}

Furniture::Furniture(const Annotations& annotations, const Legend& legend,
                     const Projector& projector, int width, int height, Inks inks)
    : annotations_(annotations), legend_(legend), projector_(projector), width_(width),
      height_(height), inks_(inks) {}

/// Makes blocks with texts of one size. Their positions are arbitrary.
struct Furniture::Maker {
    const Furniture& furniture;
    double size;
    std::vector<Block> blocks = {};

    SheetText text(const Point& at, const std::string& words, Anchor anchor) const {
        return {
            at, size, printable(words, 4096), anchor, furniture.inks_.ink, furniture.inks_.paper};
    }
    void add(std::string_view option, MarkGroup group, const std::array<Corner, 4>& corners,
             const std::optional<Box>& box = std::nullopt) {
        blocks.push_back({furniture.annotations_.option(option), std::move(group), corners, box});
    }

    void add_legend() {
        for (const ColorKey& key : furniture.legend_.colors)
            if (key.property.empty())
                add_entries(entries_of(key));
            else
                add_ramp(key);
    }

    /// Adds names with their colours, in columns.
    void add_entries(const Entries& entries) {
        if (entries.empty()) return;
        const double line = 1.3 * size;
        MarkGroup group{"legend-colors", {}};
        const std::string& title = furniture.annotations_.legend_title;
        const bool has_title = !title.empty() && !has_ramp(furniture.legend_);
        if (has_title) group.marks.emplace_back(text({0.0, rise * size}, title, Anchor::start));
        const double room = furniture.height_ - 2.0 * size - (has_title ? line : 0.0);
        const auto rows = static_cast<std::size_t>(std::max(1.0, std::floor(room / line)));
        double x = 0.0, next = 0.0;
        for (std::size_t i = 0; i < entries.size(); ++i) {
            if (i % rows == 0) x = next;
            const auto row = static_cast<double>(i % rows + (has_title ? 1 : 0));
            const Point at = {x + 0.42 * size, row * line};
            group.marks.emplace_back(SheetBall{at, 0.42 * size, furniture.inks_.ink});
            group.marks.emplace_back(SheetBall{at, 0.37 * size, entries[i].second});
            group.marks.emplace_back(
                text({at.x + 0.8 * size, at.y + rise * size}, entries[i].first, Anchor::start));
            next = std::max(next, box_of(group.marks.back()).right + 0.6 * size);
        }
        add("legend", std::move(group),
            {Corner::upper_left, Corner::upper_right, Corner::lower_left, Corner::lower_right});
    }

    /// Adds a bar of colours, with its labels on the left.
    void add_ramp(const ColorKey& key) {
        const auto [least, most] = key.range;
        MarkGroup group{"legend-" + key.property, {}};
        const double width = 0.9 * size, height = 0.4 * furniture.height_;
        const std::string& title = furniture.annotations_.legend_title;
        group.marks.emplace_back(text(
            {width, -0.8 * size}, title.empty() ? usual_title(key.property) : title, Anchor::end));
        SheetRamp ramp{{0.0, 0.0}, width, height, {}, furniture.inks_.ink};
        constexpr int colors = 32;
        for (int i = 0; i <= colors; ++i)
            ramp.colors.push_back(ramp_at(static_cast<double>(i) / colors, key.palette));
        group.marks.emplace_back(std::move(ramp));
        const std::vector<double> ticks = round_numbers_in(least, most);
        const int decimals = ticks.size() > 1 ? decimals_of(ticks[1] - ticks[0]) : 3;
        for (const double tick : ticks) {
            const double share = most > least ? (tick - least) / (most - least) : 0.5;
            const double y = (1.0 - share) * height;
            group.marks.emplace_back(
                SheetLine{{-0.3 * size, y}, {0.0, y}, 0.08 * size, 0.0, furniture.inks_.ink});
            group.marks.emplace_back(
                text({-0.5 * size, y + rise * size}, decimal_text(tick, decimals), Anchor::end));
        }
        add("legend", std::move(group),
            {Corner::upper_right, Corner::upper_left, Corner::lower_right, Corner::lower_left});
    }

    /// Adds an arrow from the origin, and its name.
    void add_arrow(MarkGroup& group, const Point& way, std::uint32_t color,
                   const std::string& name) const {
        const double length = std::sqrt(way.x * way.x + way.y * way.y);
        if (length > 0.3 * size) {
            const Point along = {way.x / length, way.y / length};
            const double head = std::min(0.7 * size, length);
            const Point base = {way.x - head * along.x, way.y - head * along.y};
            group.marks.emplace_back(SheetLine{
                {0.0, 0.0}, {base.x + along.x, base.y + along.y}, 0.18 * size, 0.0, color});
            group.marks.emplace_back(
                SheetPolygon{{way,
                              {base.x - 0.3 * head * along.y, base.y + 0.3 * head * along.x},
                              {base.x + 0.3 * head * along.y, base.y - 0.3 * head * along.x}},
                             color});
            group.marks.emplace_back(
                text({way.x + 0.65 * size * along.x, way.y + 0.65 * size * along.y + rise * size},
                     name, Anchor::middle));
        } else { // towards the viewer or away
            group.marks.emplace_back(SheetBall{{0.0, 0.0}, 0.25 * size, color});
            group.marks.emplace_back(text({-0.7 * size, 1.1 * size}, name, Anchor::middle));
        }
    }

    /// Adds the directions of axes, the nearest one on top.
    void add_axes() {
        struct Axis {
            Vec3d direction;
            const char* name;
            std::uint32_t color;
        };
        std::vector<Axis> axes = {
            {{1, 0, 0}, "x", 0xC0392B}, {{0, 1, 0}, "y", 0x1E8449}, {{0, 0, 1}, "z", 0x1F5FBF}};
        const Cell& cell = furniture.legend_.structure.cell;
        if (*furniture.annotations_.axes != Axes::of_space && cell.any())
            for (std::size_t k = 0; k < 3; ++k) {
                const double length = core::length(cell.edges[k]);
                axes[k].direction = length > 0.0 ? 1.0 / length * cell.edges[k] : Vec3d(0.0);
                axes[k].name = std::array{"a", "b", "c"}[k];
            }
        std::stable_sort(axes.begin(), axes.end(), [&](const Axis& a, const Axis& b) {
            return core::dot(a.direction, furniture.projector_.forward()) >
                   core::dot(b.direction, furniture.projector_.forward());
        });
        const double length = 2.6 * size;
        MarkGroup group{"axes", {}};
        for (const Axis& axis : axes)
            add_arrow(group,
                      {length * core::dot(axis.direction, furniture.projector_.right()),
                       -length * core::dot(axis.direction, furniture.projector_.up())},
                      axis.color, axis.name);
        // Then the origin stays where it is while the axes turn.
        const double reach = length + 0.7 * size; // into the margin and the gap
        const std::optional<Box> box = furniture.annotations_.is_steady
                                           ? std::optional(Box{-reach, -reach, reach, reach})
                                           : std::nullopt;
        if (furniture.annotations_.axes_on_right)
            add("triad", std::move(group),
                {Corner::lower_right, Corner::upper_right, Corner::upper_left, Corner::lower_left},
                box);
        else
            add("triad", std::move(group),
                {Corner::lower_left, Corner::upper_left, Corner::lower_right, Corner::upper_right},
                box);
    }

    /// Returns false for a bar that is wider than the image, or too short to be seen.
    bool fits(double pixels) const {
        constexpr double least = 3.0; // pixels
        return pixels >= least && pixels <= furniture.width_ - size;
    }

    /// Throws BadInput for a bar that does not fit. `most`: a quarter of the image.
    [[noreturn]] void refuse_scale_bar(double length, double most) const {
        char text[128];
        std::snprintf(text, sizeof text,
                      "must be auto or in the image, which is %.3g%s wide, got %.6g", 4.0 * most,
                      furniture.legend_.structure.size() != 0 ? " angstrom" : "", length);
        throw BadInput(furniture.annotations_.option("scale-bar"), "", text);
    }

    /// Adds a bar with its length.
    void add_scale_bar() {
        const double scale = furniture.projector_.pixels_per_length(); // at the point looked at
        const double most = 0.25 * furniture.width_ / scale;
        const bool is_auto = *furniture.annotations_.scale_bar == 0.0;
        const double length = is_auto ? round_below(most) : *furniture.annotations_.scale_bar;
        const double pixels = length * scale;
        if (!is_auto && !fits(pixels)) {
            if (furniture.annotations_.is_steady) return; // other frames or views may have it
            refuse_scale_bar(length, most);
        }
        MarkGroup group{"scale-bar", {}};
        group.marks.emplace_back(
            SheetLine{{0.0, 0.0}, {pixels, 0.0}, 0.25 * size, 0.0, furniture.inks_.ink});
        const bool has_unit = furniture.legend_.structure.size() != 0; // of atoms
        const bool is_long = has_unit && length >= 100.0;              // angstrom
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.6g", is_long ? 0.1 * length : length);
        const char* const unit = is_long ? " nm" : has_unit ? " \u00c5" : "";
        group.marks.emplace_back(
            text({0.5 * pixels, -0.5 * size}, std::string(digits) + unit, Anchor::middle));
        add("scale-bar", std::move(group),
            {Corner::lower_right, Corner::lower_left, Corner::upper_right, Corner::upper_left});
    }
};

std::vector<Block> Furniture::blocks(double size) const {
    Maker maker{*this, size};
    if (annotations_.legend) maker.add_legend();
    // Beside arrows of the cell, the axes are above the scale bar.
    if (annotations_.scale_bar && annotations_.axes_on_right) maker.add_scale_bar();
    if (annotations_.axes) maker.add_axes();
    if (annotations_.scale_bar && !annotations_.axes_on_right) maker.add_scale_bar();
    return std::move(maker.blocks);
}

std::string decimal_text(double number, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(number));
    return (number < 0.0 ? "\u2212" : "") + std::string(text);
}

std::vector<double> round_numbers_in(double least, double most) {
    if (!(most > least)) return {least};
    // Round numbers do not help if both ends differ only in their last digits. If their difference
    // overflows, no step can be computed.
    if (!(most - least < std::numeric_limits<double>::max()) ||
        most - least < 1e-12 * std::max(std::abs(least), std::abs(most)))
        return {least, most};
    const double step = round_below((most - least) / 3.0);
    std::vector<double> numbers;
    const double first = std::ceil(least / step - 1e-9);
    for (double k = first; k * step <= most + 1e-9 * step; k += 1.0)
        numbers.push_back(k * step);
    return numbers;
}

} // namespace raylane::scenes
