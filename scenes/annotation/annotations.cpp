#include "scenes/annotation/annotations.hpp"

#include "core/scene/field_of_view.hpp"
#include "core/scene/transfer.hpp"
#include "scenes/annotation/atom_visibility.hpp"
#include "scenes/annotation/projector.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/colors.hpp"
#include "scenes/formats/structure/lines.hpp"
#include "scenes/formats/structure/selection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

namespace raylane::scenes {

namespace {

using core::Vec3d;

constexpr double rise = 0.36; // half of a capital letter's height, relative to the font's size

/// Returns a number with this many decimals, and with U+2212 as its minus sign.
std::string decimal_text(double number, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(number));
    return (number < 0.0 ? "\u2212" : "") + std::string(text);
}

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

/// Elements come before other names: carbon, hydrogen, then by symbol, as in formulas.
void sort_entries(std::vector<std::pair<std::string, std::uint32_t>>& entries) {
    const auto rank = [](const std::string& name) {
        return name == "C" ? 0 : name == "H" ? 1 : element_of(name) != 0 ? 2 : 3;
    };
    std::stable_sort(entries.begin(), entries.end(), [&](const auto& a, const auto& b) {
        return std::pair(rank(a.first), a.first) < std::pair(rank(b.first), b.first);
    });
}

/// Returns a text with an atom's values in place of its {words}.
std::string text_of_atom(std::string text, const Structure& structure, AtomIndex atom) {
    const AtomKind& kind = structure.of_kind[structure.kinds[atom]];
    const Residue* const residue =
        structure.residues.empty() ? nullptr : &structure.of_residue[structure.residues[atom]];
    const std::pair<const char*, std::string> values[] = {
        {"{element}", kind.element != 0 ? std::string(data_of(kind.element).symbol) : kind.label},
        {"{name}", structure.names.empty() ? kind.label : structure.names[atom]},
        {"{resn}", residue != nullptr ? residue->name : ""},
        {"{resi}", residue != nullptr ? std::to_string(residue->number) : ""},
        {"{chain}", residue != nullptr ? structure.chains[residue->chain] : ""},
        {"{index}", std::to_string(atom + 1)}};
    for (const auto& [word, value] : values)
        for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at)) {
            text.replace(at, std::string(word).size(), value);
            at += value.size();
        }
    return text;
}

bool has_field(const std::string& text, std::initializer_list<const char*> fields) {
    return std::any_of(fields.begin(), fields.end(),
                       [&](const char* field) { return text.find(field) != std::string::npos; });
}

/// Returns a name as an id of XML, without blanks.
std::string id_of(const std::string& name) {
    std::string id = name;
    for (char& c : id) {
        const bool is_ascii = static_cast<unsigned char>(c) < 0x80;
        if (is_ascii && !is_letter(c) && !(c >= '0' && c <= '9') && c != '_') c = '-';
    }
    return id;
}

/// Composes the sheet of an image.
class Composer {
  public:
    Composer(const Annotations& annotations, const Legend& legend, const AnnotatedView& view,
             const OnRemark& on_remark)
        : annotations_(annotations), legend_(legend), view_(view), on_remark_(on_remark),
          projector_(view.camera, view.width, view.height), visibility_(legend, view),
          size_(annotations.font_size > 0.0 ? annotations.font_size : view.height / 32.0) {
        const core::Color& color = view.background;
        const bool is_dark = 0.2126F * color.x + 0.7152F * color.y + 0.0722F * color.z < 0.18F;
        if (is_dark) std::swap(ink_, paper_);
        sheet_.width = view.width;
        sheet_.height = view.height;
        sheet_.dpi = annotations.dpi;
        sheet_.font = annotations.font;
    }

    Sheet compose() {
        check_size();
        for (std::size_t i = 0; i < annotations_.distances.size(); ++i)
            add_distance(i);
        for (std::size_t i = 0; i < annotations_.labels.size(); ++i)
            add_labels(i);
        if (annotations_.legend) add_legend();
        if (annotations_.axes) add_axes();
        if (annotations_.scale_bar) add_scale_bar();
        for (auto message = remarks_.begin(); message != remarks_.end(); ++message)
            if (on_remark_ && std::find(remarks_.begin(), message, *message) == message)
                on_remark_(*message);
        return std::move(sheet_);
    }

  private:
    /// Reports texts that are too small to read, or too large for the image.
    void check_size() {
        constexpr double least = 5.0; // pixels
        const bool is_small = size_ < least;
        if (!is_small && size_ <= 0.2 * view_.height) return;
        char height[32];
        std::snprintf(height, sizeof height, "%.3g", size_);
        remarks_.push_back("--font-size: texts are " + std::string(height) +
                           " pixels high in an image of " + std::to_string(view_.width) + " x " +
                           std::to_string(view_.height) + ": " +
                           (is_small ? "too small to read" : "too large for it"));
    }

    /// Adds a group with an id that no other group has.
    void add_group(MarkGroup group) {
        const std::string name = id_of(group.name);
        group.name = name;
        for (int number = 2; std::any_of(sheet_.groups.begin(), sheet_.groups.end(),
                                         [&](const auto& of) { return of.name == group.name; });
             ++number)
            group.name = name + "-" + std::to_string(number);
        sheet_.groups.push_back(std::move(group));
    }

    SheetText text(const Point& at, const std::string& words, Anchor anchor) const {
        return {at, size_, printable(words, 4096), anchor, ink_, paper_};
    }
    double margin() const { return size_; }

    std::vector<AtomIndex> selected(const std::string& option, const std::string& select) {
        const Structure& structure = legend_.structure;
        if (structure.size() == 0)
            throw BadInput(option, "", "goes with a file of atoms, not with a scene");
        const std::vector<char> chosen = select_atoms(structure, select, remarks_, option);
        std::vector<AtomIndex> atoms;
        for (AtomIndex atom = 0; atom < chosen.size(); ++atom)
            if (chosen[atom] != 0) atoms.push_back(atom);
        if (atoms.empty())
            throw BadInput(option, "",
                           "\"" + printable(select) + "\" selects none of " +
                               std::to_string(structure.size()) + " atoms");
        return atoms;
    }
    /// Returns the place of an atom's first copy.
    Vec3d place_of(AtomIndex atom) const { return visibility_.places_of(atom).front(); }
    Vec3d middle_of(const std::vector<AtomIndex>& atoms) const {
        Vec3d sum(0.0);
        for (const AtomIndex atom : atoms)
            sum = sum + place_of(atom);
        return 1.0 / static_cast<double>(atoms.size()) * sum;
    }

    bool is_in_image(const Point& point) const {
        return point.x >= 0.0 && point.x <= view_.width && point.y >= 0.0 &&
               point.y <= view_.height;
    }

    /// Adds a label, or counts it among those left out.
    void add_label(MarkGroup& group, const Vec3d& place, std::string words, bool is_visible) {
        ++labels_;
        const auto at = projector_.point_of(place);
        if (!is_visible || !at || !is_in_image(*at)) return;
        ++labels_shown_;
        group.marks.emplace_back(
            text({at->x, at->y + rise * size_}, std::move(words), Anchor::middle));
    }

    void add_labels(std::size_t number) {
        const LabelWords& words = annotations_.labels[number];
        const std::vector<AtomIndex> atoms = selected("--label", words.select);
        MarkGroup group{"label-" + std::to_string(number + 1), {}};
        labels_ = labels_shown_ = 0;
        if (has_field(words.text, {"{element}", "{name}", "{index}"}))
            add_labels_of_atoms(group, atoms, words.text);
        else if (words.text.find('{') != std::string::npos)
            add_labels_of_residues(group, atoms, words.text);
        else
            add_label(group, place_of_all(atoms), words.text, true);
        if (labels_shown_ < labels_)
            remarks_.push_back("--label \"" + printable(words.select) +
                               "\": " + std::to_string(labels_ - labels_shown_) + " of " +
                               std::to_string(labels_) +
                               " labels are left out, as other atoms hide their places, or as "
                               "these are outside of the image");
        add_group(std::move(group));
    }

    /// Returns the middle of atoms, or of a single atom the first copy that is not hidden.
    Vec3d place_of_all(const std::vector<AtomIndex>& atoms) {
        if (atoms.size() == 1)
            for (const Vec3d& place : visibility_.places_of(atoms[0]))
                if (visibility_.is_visible(atoms, place)) return place;
        return middle_of(atoms);
    }

    void add_labels_of_atoms(MarkGroup& group, const std::vector<AtomIndex>& atoms,
                             const std::string& words) {
        for (const AtomIndex atom : atoms)
            for (const Vec3d& place : visibility_.places_of(atom))
                add_label(group, place, text_of_atom(words, legend_.structure, atom),
                          visibility_.is_visible({atom}, place));
    }

    /// Adds a label to each residue, or to each chain if the words do not name residues.
    void add_labels_of_residues(MarkGroup& group, const std::vector<AtomIndex>& atoms,
                                const std::string& words) {
        const Structure& structure = legend_.structure;
        if (structure.residues.empty())
            throw BadInput("--label", "",
                           "must have {element}, {name} or {index} here, got \"" +
                               printable(words) + "\": the atoms have no residues");
        const bool names_residues = has_field(words, {"{resn}", "{resi}"});
        std::map<std::uint32_t, std::vector<AtomIndex>> parts;
        for (const AtomIndex atom : atoms) {
            const std::uint32_t residue = structure.residues[atom];
            parts[names_residues ? residue : structure.of_residue[residue].chain].push_back(atom);
        }
        for (const auto& part : parts) {
            const std::vector<AtomIndex>& members = part.second;
            const auto alpha = std::find_if(members.begin(), members.end(), [&](AtomIndex atom) {
                return names_residues && !structure.names.empty() &&
                       structure.names[atom] == "CA" && structure.element(atom) == 6;
            });
            const Vec3d place = alpha != members.end() ? place_of(*alpha) : middle_of(members);
            add_label(group, place, text_of_atom(words, structure, members.front()),
                      !names_residues || visibility_.is_visible(members, place));
        }
    }

    void add_distance(std::size_t number) {
        const DistanceWords& words = annotations_.distances[number];
        const Vec3d a = middle_of(selected("--distance", words.from));
        const std::vector<AtomIndex> others = selected("--distance", words.to);
        Vec3d b = middle_of(others);
        if (others.size() == 1)
            for (const Vec3d& place : visibility_.places_of(others[0]))
                if (core::length(place - a) < core::length(b - a)) b = place;
        const auto from = projector_.point_of(a), to = projector_.point_of(b);
        if (!from || !to || !(is_in_image(*from) || is_in_image(*to))) {
            remarks_.push_back("--distance \"" + printable(words.from + ": " + words.to) +
                               "\" is left out, as it is outside of the image");
            return;
        }
        MarkGroup group{"distance-" + std::to_string(number + 1), {}};
        const double width = 0.11 * size_, dash = 0.35 * size_;
        group.marks.emplace_back(SheetLine{*from, *to, 2.2 * width, 0.0, paper_});
        group.marks.emplace_back(SheetLine{*from, *to, width, dash, ink_});
        const Point middle = {0.5 * (from->x + to->x), 0.5 * (from->y + to->y)};
        // Beside the line, on its upper side.
        Point aside = {from->y - to->y, to->x - from->x};
        const double length = std::max(1e-9, std::sqrt(aside.x * aside.x + aside.y * aside.y));
        const double sign = aside.y > 0.0 || (aside.y == 0.0 && aside.x < 0.0) ? -1.0 : 1.0;
        aside = {sign * aside.x / length, sign * aside.y / length};
        group.marks.emplace_back(text({middle.x + (0.8 + 1.2 * std::abs(aside.x)) * size_ * aside.x,
                                       middle.y + 0.8 * size_ * aside.y + rise * size_},
                                      decimal_text(core::length(b - a), 2) + " \u00c5",
                                      Anchor::middle));
        add_group(std::move(group));
    }

    void add_legend() {
        const std::size_t before = sheet_.groups.size();
        for (const ColorKey& key : legend_.colors)
            if (key.property.empty())
                add_entries(key);
            else
                add_ramp(key);
        if (sheet_.groups.size() == before)
            throw BadInput("--legend", "",
                           "must have colours of elements, chains or numbers to explain");
        if (!annotations_.legend_title.empty() && ramps_ == 0)
            remarks_.push_back("--legend-title is ignored, because no colour stands for a number");
    }

    /// Adds names with their colours, in the upper left corner.
    void add_entries(const ColorKey& key) {
        auto entries = key.entries;
        std::erase_if(entries, [](const auto& entry) { return color_named(entry.first); });
        if (entries.empty()) return;
        sort_entries(entries);
        MarkGroup group{"legend-colors", {}};
        double y = margin() + 0.5 * size_;
        for (const auto& [name, color] : entries) {
            const Point at = {margin() + 0.4 * size_, y};
            group.marks.emplace_back(SheetBall{at, 0.42 * size_, ink_});
            group.marks.emplace_back(SheetBall{at, 0.37 * size_, color});
            group.marks.emplace_back(
                text({at.x + 0.8 * size_, y + rise * size_}, name, Anchor::start));
            y += 1.3 * size_;
        }
        add_group(std::move(group));
    }

    /// Adds a bar of colours along the right side, with its labels on the left.
    void add_ramp(const ColorKey& key) {
        const auto [least, most] = key.range;
        MarkGroup group{"legend-" + key.property, {}};
        const double width = 0.9 * size_, height = 0.4 * view_.height;
        const Point corner = {view_.width - margin() - width - ramps_ * 6.0 * size_,
                              margin() + 1.6 * size_};
        group.marks.emplace_back(text({corner.x + width, margin() + 0.8 * size_},
                                      annotations_.legend_title.empty() ? usual_title(key.property)
                                                                        : annotations_.legend_title,
                                      Anchor::end));
        SheetRamp ramp{corner, width, height, {}, ink_};
        constexpr int colors = 32;
        for (int i = 0; i <= colors; ++i)
            ramp.colors.push_back(ramp_at(static_cast<double>(i) / colors, key.palette));
        group.marks.emplace_back(std::move(ramp));
        const std::vector<double> ticks = round_numbers_in(least, most);
        const int decimals = ticks.size() > 1 ? decimals_of(ticks[1] - ticks[0]) : 3;
        for (const double tick : ticks) {
            const double share = most > least ? (tick - least) / (most - least) : 0.5;
            const double y = corner.y + (1.0 - share) * height;
            group.marks.emplace_back(
                SheetLine{{corner.x - 0.3 * size_, y}, {corner.x, y}, 0.08 * size_, 0.0, ink_});
            group.marks.emplace_back(text({corner.x - 0.5 * size_, y + rise * size_},
                                          decimal_text(tick, decimals), Anchor::end));
        }
        ++ramps_;
        add_group(std::move(group));
    }

    /// Adds an arrow of a length from a point, and its name.
    void add_arrow(MarkGroup& group, const Point& from, const Point& way, std::uint32_t color,
                   const std::string& name) const {
        const double length = std::sqrt(way.x * way.x + way.y * way.y);
        if (length > 0.3 * size_) {
            const Point along = {way.x / length, way.y / length};
            const double head = std::min(0.7 * size_, length);
            const Point end = {from.x + way.x, from.y + way.y};
            const Point base = {end.x - head * along.x, end.y - head * along.y};
            group.marks.emplace_back(
                SheetLine{from, {base.x + along.x, base.y + along.y}, 0.18 * size_, 0.0, color});
            group.marks.emplace_back(
                SheetPolygon{{end,
                              {base.x - 0.3 * head * along.y, base.y + 0.3 * head * along.x},
                              {base.x + 0.3 * head * along.y, base.y - 0.3 * head * along.x}},
                             color});
            group.marks.emplace_back(text(
                {end.x + 0.65 * size_ * along.x, end.y + 0.65 * size_ * along.y + rise * size_},
                name, Anchor::middle));
        } else { // towards the viewer or away
            group.marks.emplace_back(SheetBall{from, 0.25 * size_, color});
            group.marks.emplace_back(
                text({from.x - 0.7 * size_, from.y + 1.1 * size_}, name, Anchor::middle));
        }
    }

    /// Adds the directions of axes in a lower corner, the nearest one on top.
    void add_axes() {
        struct Axis {
            Vec3d direction;
            const char* name;
            std::uint32_t color;
        };
        std::vector<Axis> axes = {
            {{1, 0, 0}, "x", 0xC0392B}, {{0, 1, 0}, "y", 0x1E8449}, {{0, 0, 1}, "z", 0x1F5FBF}};
        if (*annotations_.axes == Axes::of_cell) {
            const Cell& cell = legend_.structure.cell;
            if (!cell.any()) throw BadInput("--triad", "", "must be xyz: the atoms have no cell");
            for (std::size_t k = 0; k < 3; ++k) {
                const double length = core::length(cell.edges[k]);
                axes[k].direction = length > 0.0 ? 1.0 / length * cell.edges[k] : Vec3d(0.0);
                axes[k].name = std::array{"a", "b", "c"}[k];
            }
        }
        std::stable_sort(axes.begin(), axes.end(), [&](const Axis& a, const Axis& b) {
            return core::dot(a.direction, projector_.forward()) >
                   core::dot(b.direction, projector_.forward());
        });
        const double length = 2.6 * size_;
        // The arrows keep off the margins, wherever they point.
        Point low = {0.0, 0.0};
        double high = 0.0;
        for (const Axis& axis : axes) {
            low.x = std::min(low.x, core::dot(axis.direction, projector_.right()));
            low.y = std::min(low.y, core::dot(axis.direction, projector_.up()));
            high = std::max(high, core::dot(axis.direction, projector_.right()));
        }
        Point from = {margin() + 0.9 * size_ - length * low.x,
                      view_.height - margin() - 0.9 * size_ + length * low.y};
        if (annotations_.axes_on_right) { // above a scale bar
            from.x = view_.width - margin() - 0.9 * size_ - length * high;
            if (annotations_.scale_bar) from.y -= 2.2 * size_;
        }
        MarkGroup group{"axes", {}};
        for (const Axis& axis : axes)
            add_arrow(group, from,
                      {length * core::dot(axis.direction, projector_.right()),
                       -length * core::dot(axis.direction, projector_.up())},
                      axis.color, axis.name);
        add_group(std::move(group));
    }

    /// Throws BadInput for a bar that is wider than the image, or too short to be seen. `most`: a
    /// quarter of the image.
    void require_scale_bar(double pixels, double length, double most) const {
        constexpr double least = 3.0; // pixels
        if (pixels >= least && pixels <= view_.width - margin()) return;
        char text[128];
        std::snprintf(text, sizeof text,
                      "must be auto or in the image, which is %.3g%s wide, got %.6g", 4.0 * most,
                      legend_.structure.size() != 0 ? " angstrom" : "", length);
        throw BadInput("--scale-bar", "", text);
    }

    /// Adds a bar with its length in the lower right corner.
    void add_scale_bar() {
        const double scale = projector_.pixels_per_length(); // at the point looked at
        const double most = 0.25 * view_.width / scale;
        const bool is_auto = *annotations_.scale_bar == 0.0;
        const double length = is_auto ? round_below(most) : *annotations_.scale_bar;
        const double pixels = length * scale;
        if (!is_auto) require_scale_bar(pixels, length, most);
        const double right = view_.width - margin(), y = view_.height - margin();
        MarkGroup group{"scale-bar", {}};
        group.marks.emplace_back(
            SheetLine{{right - pixels, y}, {right, y}, 0.25 * size_, 0.0, ink_});
        const bool has_unit = legend_.structure.size() != 0; // of atoms
        const bool is_long = has_unit && length >= 100.0;    // angstrom
        const double shown = is_long ? 0.1 * length : length;
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.6g", shown);
        group.marks.emplace_back(text({right - 0.5 * pixels, y - 0.5 * size_},
                                      digits + std::string(is_long    ? " nm"
                                                           : has_unit ? " \u00c5"
                                                                      : ""),
                                      Anchor::middle));
        add_group(std::move(group));
        if (view_.camera.projection == core::Projection::perspective)
            remarks_.push_back("--scale-bar holds at the depth of the point that the camera looks "
                               "at; --orthographic makes it hold everywhere");
    }

    const Annotations& annotations_;
    const Legend& legend_;
    const AnnotatedView& view_;
    const OnRemark& on_remark_;
    Projector projector_;
    AtomVisibility visibility_;
    double size_; // of the font
    std::uint32_t ink_ = 0x111111, paper_ = 0xFFFFFF;
    int ramps_ = 0;
    std::size_t labels_ = 0, labels_shown_ = 0; // of one option
    std::vector<std::string> remarks_;
    Sheet sheet_;
};

/// Returns the texts on both sides of a colon. Throws BadInput.
std::pair<std::string, std::string> two_parts(const std::string& option, const std::string& text,
                                              std::size_t colon, const char* must) {
    if (colon != std::string::npos) {
        std::pair<std::string, std::string> parts = {
            std::string(trimmed(std::string_view(text).substr(0, colon))),
            std::string(trimmed(std::string_view(text).substr(colon + 1)))};
        if (!parts.first.empty() && !parts.second.empty()) return parts;
    }
    throw BadInput(option, "", std::string("must be ") + must + ", got \"" + printable(text) + '"');
}

} // namespace

LabelWords label_words_of(const std::string& option, const std::string& text) {
    // A colon with a blank separates, as ranges such as 20:30 may come before it.
    const std::size_t colon = text.find(": ");
    auto [select, words] =
        two_parts(option, text, colon, "SELECTION: TEXT, such as \"residue 25: Asp 25\"");
    const std::vector<std::string_view> fields = {"{element}", "{name}",  "{resn}",
                                                  "{resi}",    "{chain}", "{index}"};
    for (std::size_t at = words.find('{'); at != std::string::npos; at = words.find('{', at + 1)) {
        const std::string field = words.substr(at, words.find('}', at) + 1 - at);
        if (std::find(fields.begin(), fields.end(), field) == fields.end())
            throw BadInput(option, "",
                           "must have fields such as {element} or {index}, got \"" +
                               printable(field) + '"' + suggestion(field, fields));
    }
    return {std::move(select), std::move(words)};
}

DistanceWords distance_words_of(const std::string& option, const std::string& text) {
    auto [from, to] = two_parts(option, text, text.find(": "),
                                "SELECTION: SELECTION, such as \"index 1: index 5\"");
    return {std::move(from), std::move(to)};
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

Sheet sheet_of(const Annotations& annotations, const Legend& legend, const AnnotatedView& view,
               const OnRemark& on_remark) {
    return Composer(annotations, legend, view, on_remark).compose();
}

} // namespace raylane::scenes
