#include "scenes/annotation/composer.hpp"

#include "scenes/annotation/furniture.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/colors.hpp"
#include "scenes/formats/structure/lines.hpp"
#include "scenes/formats/structure/selection.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <map>
#include <utility>

namespace raylane::scenes {

namespace {

using core::Vec3d;

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

/// Reports each remark once.
void report(const std::vector<std::string>& remarks, const OnRemark& on_remark) {
    for (auto remark = remarks.begin(); remark != remarks.end(); ++remark)
        if (on_remark && std::find(remarks.begin(), remark, *remark) == remark) on_remark(*remark);
}

std::string quoted(const std::string& option, const std::string& words) {
    return option + " \"" + printable(words) + '"';
}
std::string quoted(const DistanceWords& words) {
    return quoted(words.option, words.from + ": " + words.to);
}

constexpr const char* undrawn = " is left out, as the image does not show its atoms";

} // namespace

SheetComposer::SheetComposer(const Annotations& annotations, const Legend& legend,
                             const OnRemark& on_remark)
    : annotations_(annotations), legend_(legend), shown_(legend) {
    require_contents(annotations, legend);
    std::vector<std::string> remarks;
    for (std::size_t i = 0; i < annotations.distances.size(); ++i)
        add_distance(i, remarks);
    for (std::size_t i = 0; i < annotations.labels.size(); ++i)
        add_label(i, remarks);
    report(remarks, on_remark);
}

std::vector<AtomIndex> SheetComposer::selected(const std::string& option, const std::string& select,
                                               std::vector<std::string>& remarks) const {
    const Structure& structure = legend_.structure;
    if (structure.size() == 0)
        throw BadInput(option, "", "goes with a file of atoms, not with a scene");
    const std::vector<char> chosen = select_atoms(structure, select, remarks, option);
    std::vector<AtomIndex> atoms;
    for (AtomIndex atom = 0; atom < chosen.size(); ++atom)
        if (chosen[atom] != 0) atoms.push_back(atom);
    if (atoms.empty())
        throw BadInput(option, "",
                       "\"" + printable(select) + "\" selects none of " +
                           std::to_string(structure.size()) + " atoms");
    return atoms;
}

Vec3d SheetComposer::middle_of(const std::vector<AtomIndex>& atoms) const {
    Vec3d sum(0.0);
    for (const AtomIndex atom : atoms)
        sum = sum + shown_.places_of(atom).front();
    return 1.0 / static_cast<double>(atoms.size()) * sum;
}

bool SheetComposer::shows_any(const std::vector<AtomIndex>& atoms) const {
    return std::any_of(atoms.begin(), atoms.end(),
                       [&](AtomIndex atom) { return shown_.has(atom); });
}

void SheetComposer::add_label(std::size_t number, std::vector<std::string>& remarks) {
    const LabelWords& words = annotations_.labels[number];
    Label& label = labels_.emplace_back(Label{words});
    std::vector<AtomIndex> atoms = selected(words.option, words.select, remarks);
    std::erase_if(atoms, [&](AtomIndex atom) { return !shown_.has(atom); });
    if (atoms.empty()) {
        remarks.push_back(quoted(words.option, words.select) + undrawn);
        return;
    }
    const bool names_atoms = has_field(words.text, {"{element}", "{name}", "{index}"});
    if (!names_atoms && words.text.find('{') != std::string::npos)
        return add_sites_of_residues(label, atoms);
    label.may_be_hidden = names_atoms;
    label.is_at_one_site = !names_atoms;
    if (!names_atoms && atoms.size() > 1) {
        label.sites.push_back({{}, middle_of(atoms), words.text});
        return;
    }
    for (const AtomIndex atom : atoms)
        for (const Vec3d& place : shown_.places_of(atom))
            label.sites.push_back(
                {{atom}, place, text_of_atom(words.text, legend_.structure, atom)});
}

/// Adds a label to each residue, or to each chain if the words do not name residues.
void SheetComposer::add_sites_of_residues(Label& label, const std::vector<AtomIndex>& atoms) const {
    const Structure& structure = legend_.structure;
    const std::string& words = label.words.text;
    if (structure.residues.empty())
        throw BadInput(label.words.option, "",
                       "must have {element}, {name} or {index} here, got \"" + printable(words) +
                           "\": the atoms have no residues");
    label.may_be_hidden = has_field(words, {"{resn}", "{resi}"});
    std::map<std::uint32_t, std::vector<AtomIndex>> parts;
    for (const AtomIndex atom : atoms) {
        const std::uint32_t residue = structure.residues[atom];
        parts[label.may_be_hidden ? residue : structure.of_residue[residue].chain].push_back(atom);
    }
    for (const auto& part : parts) {
        const std::vector<AtomIndex>& members = part.second;
        const auto alpha = std::find_if(members.begin(), members.end(), [&](AtomIndex atom) {
            return label.may_be_hidden && !structure.names.empty() &&
                   structure.names[atom] == "CA" && structure.element(atom) == 6;
        });
        label.sites.push_back({members,
                               alpha != members.end() ? middle_of({*alpha}) : middle_of(members),
                               text_of_atom(words, structure, members.front())});
    }
}

void SheetComposer::add_distance(std::size_t number, std::vector<std::string>& remarks) {
    const DistanceWords& words = annotations_.distances[number];
    const std::vector<AtomIndex> from = selected(words.option, words.from, remarks);
    const std::vector<AtomIndex> to = selected(words.option, words.to, remarks);
    if (!shows_any(from) || !shows_any(to)) {
        remarks.push_back(quoted(words) +
                          " is left out, as the image shows no atoms of one of its ends");
        return;
    }
    const Vec3d a = middle_of(from);
    Vec3d b = middle_of(to);
    if (to.size() == 1)
        for (const Vec3d& place : shown_.places_of(to[0]))
            if (core::length(place - a) < core::length(b - a)) b = place;
    distances_.push_back({words, a, b});
}

/// The annotations of one image.
struct SheetComposer::Image {
    const SheetComposer& composer;
    const AnnotatedView& view;
    Projector projector{view.camera, view.width, view.height};
    AtomVisibility visibility{composer.shown_, view.camera, view.scene};
    double size = composer.annotations_.font_size > 0.0 ? composer.annotations_.font_size
                                                        : usual_font_size(view.height);
    Inks inks{};
    std::vector<std::string> remarks = {};
    std::vector<MarkGroup> labels = {}, distances = {};
    std::vector<Block> blocks = {};
    std::vector<Box> taken = {}; // by marks of blocks and labels

    Sheet compose();
    void check_size();
    bool is_in_image(const Point& point) const {
        return point.x >= 0.0 && point.x <= view.width && point.y >= 0.0 && point.y <= view.height;
    }
    SheetText text_at(const Point& middle, const std::string& words) const {
        return {{middle.x, middle.y + rise * size},
                size,
                printable(words, 4096),
                Anchor::middle,
                inks.ink,
                inks.paper};
    }
    void add_labels(std::size_t number);
    void add_blocks();
    bool place_blocks(double font_size, std::string& missing);
    void leave_out_covered_labels();
    void add_distance(const Distance& distance);
    SheetText text_of(const Distance& distance, const Point& from, const Point& to) const;
    void add_to(Sheet& sheet, MarkGroup group) const;
};

Sheet SheetComposer::compose(const AnnotatedView& view, const OnRemark& on_remark) const {
    Image image{*this, view};
    Sheet sheet = image.compose();
    report(image.remarks, on_remark);
    return sheet;
}

Sheet SheetComposer::Image::compose() {
    const core::Color& color = view.background;
    const bool is_dark = 0.2126F * color.x + 0.7152F * color.y + 0.0722F * color.z < 0.18F;
    if (is_dark) std::swap(inks.ink, inks.paper);
    check_size();
    for (std::size_t i = 0; i < composer.labels_.size(); ++i)
        add_labels(i);
    add_blocks();
    leave_out_covered_labels();
    for (const Distance& distance : composer.distances_)
        add_distance(distance);
    Sheet sheet{view.width, view.height, composer.annotations_.dpi, composer.annotations_.font, {}};
    for (auto* const groups : {&distances, &labels})
        for (MarkGroup& group : *groups)
            add_to(sheet, std::move(group));
    for (Block& block : blocks)
        add_to(sheet, std::move(block.group));
    return sheet;
}

/// Adds a group with an id that no other group has.
void SheetComposer::Image::add_to(Sheet& sheet, MarkGroup group) const {
    const std::string name = id_of(group.name);
    group.name = name;
    for (int number = 2; std::any_of(sheet.groups.begin(), sheet.groups.end(),
                                     [&](const auto& other) { return other.name == group.name; });
         ++number)
        group.name = name + "-" + std::to_string(number);
    sheet.groups.push_back(std::move(group));
}

constexpr double readable = 8.0; // pixels: the least size of texts

/// Reports texts that are too small to read, or too large for the image.
void SheetComposer::Image::check_size() {
    const bool is_small = size < readable;
    if (!is_small && size <= 0.2 * view.height) return;
    char height[32];
    std::snprintf(height, sizeof height, "%.3g", size);
    remarks.push_back(composer.annotations_.option("font-size") + ": texts are " + height +
                      " pixels high in an image of " + std::to_string(view.width) + " x " +
                      std::to_string(view.height) + ": " +
                      (is_small ? "too small to read" : "too large for it"));
}

/// Adds the texts of a label, and counts those that are left out.
void SheetComposer::Image::add_labels(std::size_t number) {
    const Label& label = composer.labels_[number];
    MarkGroup group{"label-" + std::to_string(number + 1), {}};
    const auto is_visible = [&](const Site& site) {
        return visibility.is_visible(site.atoms, site.place);
    };
    const auto add = [&](const Site& site) {
        const auto at = projector.point_of(site.place);
        if (at && is_in_image(*at) && (!label.may_be_hidden || is_visible(site)))
            group.marks.emplace_back(text_at(*at, site.text));
    };
    if (label.is_at_one_site) {
        const auto visible = std::find_if(label.sites.begin(), label.sites.end(), is_visible);
        if (!label.sites.empty())
            add(visible != label.sites.end() ? *visible : label.sites.front());
    } else {
        std::for_each(label.sites.begin(), label.sites.end(), add);
    }
    const std::size_t count = label.is_at_one_site ? 1 : label.sites.size();
    if (!label.sites.empty() && group.marks.size() < count)
        remarks.push_back(quoted(label.words.option, label.words.select) + ": " +
                          std::to_string(count - group.marks.size()) + " of " +
                          std::to_string(count) +
                          " labels are left out, as other atoms hide their places, or as these "
                          "are outside of the image");
    labels.push_back(std::move(group));
}

/// Puts legend, axes and scale bar into the corners. Makes them smaller if they have no room, and
/// leaves out those that have none when their texts have the least size.
void SheetComposer::Image::add_blocks() {
    constexpr double factor = 0.92, least = 6.0; // pixels
    double font_size = size;
    std::string missing;
    while (!place_blocks(font_size, missing) && factor * font_size >= least)
        font_size *= factor;
    const std::string image =
        " in an image of " + std::to_string(view.width) + " x " + std::to_string(view.height);
    if (font_size < size && font_size < readable && !blocks.empty()) {
        char height[32];
        std::snprintf(height, sizeof height, "%.3g", font_size);
        remarks.push_back(blocks.front().option + ": texts are " + height + " pixels high" + image +
                          " for lack of space: too small to read");
    }
    if (!missing.empty()) remarks.push_back(missing + ": left out for lack of space" + image);
    if (composer.annotations_.scale_bar && view.camera.projection == core::Projection::perspective)
        remarks.push_back(composer.annotations_.option("scale-bar") +
                          " holds at the depth of the point that the camera looks at; " +
                          composer.annotations_.option("orthographic") +
                          " makes it hold everywhere");
}

/// Returns true if all blocks have room with texts of this size. `missing`: the options of others.
bool SheetComposer::Image::place_blocks(double font_size, std::string& missing) {
    blocks.clear();
    missing.clear();
    std::vector<Box> texts; // that blocks avoid
    if (!composer.annotations_.is_steady)
        for (const MarkGroup& group : labels)
            for (const Mark& mark : group.marks)
                texts.push_back(box_of(mark));
    BlockLayout layout(view.width, view.height, font_size, 0.4 * font_size);
    const Furniture furniture(composer.annotations_, composer.legend_, projector, view.width,
                              view.height, inks);
    for (Block& block : furniture.blocks(font_size)) {
        if (layout.place(block, texts))
            blocks.push_back(std::move(block));
        else
            missing.append(missing.empty() ? "" : ", ").append(block.option);
    }
    taken.clear();
    for (const Block& block : blocks)
        for (const Mark& mark : block.group.marks)
            taken.push_back(box_of(mark));
    return missing.empty();
}

void SheetComposer::Image::leave_out_covered_labels() {
    const std::vector<Box> boxes = taken;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        std::vector<Mark>& marks = labels[i].marks;
        const std::size_t count = marks.size();
        std::erase_if(marks, [&](const Mark& mark) {
            return std::any_of(boxes.begin(), boxes.end(),
                               [&](const Box& box) { return box.meets(box_of(mark)); });
        });
        for (const Mark& mark : marks)
            taken.push_back(box_of(mark));
        const LabelWords& words = composer.labels_[i].words;
        if (marks.size() < count)
            remarks.push_back(quoted(words.option, words.select) + ": " +
                              std::to_string(count - marks.size()) + " of " +
                              std::to_string(count) +
                              " labels are left out, as legend, axes or scale bar are at their "
                              "places");
    }
}

void SheetComposer::Image::add_distance(const Distance& distance) {
    const auto from = projector.point_of(distance.a), to = projector.point_of(distance.b);
    if (!from || !to || !(is_in_image(*from) || is_in_image(*to))) {
        remarks.push_back(quoted(distance.words) + " is left out, as it is outside of the image");
        return;
    }
    const auto number =
        static_cast<std::size_t>(&distance.words - composer.annotations_.distances.data());
    MarkGroup group{"distance-" + std::to_string(number + 1), {}};
    const double width = 0.11 * size, dash = 0.35 * size;
    group.marks.emplace_back(SheetLine{*from, *to, 2.2 * width, 0.0, inks.paper});
    group.marks.emplace_back(SheetLine{*from, *to, width, dash, inks.ink});
    SheetText text = text_of(distance, *from, *to);
    taken.push_back(box_of(text));
    group.marks.emplace_back(std::move(text));
    distances.push_back(std::move(group));
}

/// Returns the text beside the line of a distance: near its middle, on its upper side, if no other
/// text is there.
SheetText SheetComposer::Image::text_of(const Distance& distance, const Point& from,
                                        const Point& to) const {
    Point aside = {from.y - to.y, to.x - from.x};
    const double length = std::max(1e-9, std::sqrt(aside.x * aside.x + aside.y * aside.y));
    const double sign = aside.y > 0.0 || (aside.y == 0.0 && aside.x < 0.0) ? -1.0 : 1.0;
    aside = {sign * aside.x / length, sign * aside.y / length};
    const std::string words = decimal_text(core::length(distance.b - distance.a), 2) + " \u00c5";
    const Box box = box_of(text_at({0.0, 0.0}, words));
    const double clear = 0.5 * (std::abs(aside.x) * (box.right - box.left) +
                                std::abs(aside.y) * (box.bottom - box.top)) +
                         0.1 * size; // from the line to the text's middle
    const auto text = [&](double share, double side) {
        const Point at = {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
        return text_at({at.x + side * clear * aside.x, at.y + side * clear * aside.y}, words);
    };
    for (const double reach : {1.0, 1.8, 2.6}) // from the line
        for (const double share : {0.5, 0.35, 0.65, 0.2, 0.8, 0.0, 1.0})
            for (const double side : {1.0, -1.0}) {
                SheetText place = text(share, side * reach);
                const Box own = box_of(place);
                if (std::none_of(taken.begin(), taken.end(),
                                 [&](const Box& other) { return other.meets(own); }))
                    return place;
            }
    return text(0.5, 1.0);
}

} // namespace raylane::scenes
