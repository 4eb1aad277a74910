#include "scenes/formats/structure/drawing.hpp"

#include "core/numbers/elementary.hpp"
#include "core/numbers/infinity.hpp"
#include "core/scene/best_view.hpp"
#include "core/shapes/checks.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/structure/atom_layer.hpp"
#include "scenes/formats/structure/bonds.hpp"
#include "scenes/formats/structure/cartoon/chain_colors.hpp"
#include "scenes/formats/structure/cell_layer.hpp"
#include "scenes/formats/structure/chain_layer.hpp"
#include "scenes/formats/structure/colors.hpp"
#include "scenes/formats/structure/crystal.hpp"
#include "scenes/formats/structure/displacement.hpp"
#include "scenes/formats/structure/hydrogen_bond_layer.hpp"
#include "scenes/formats/structure/images.hpp"
#include "scenes/formats/structure/kind_table.hpp"
#include "scenes/formats/structure/polyhedra_layer.hpp"
#include "scenes/formats/structure/selection.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace raylane::scenes {

namespace {

using core::Vec3d;
using core::Vec3f;

constexpr std::size_t max_for_balls = 500;
constexpr float small_ball = 0.25F; // of van der Waals' radius

bool has_ramp(const ColorWords& words) {
    return !words.palette.empty() || words.range.has_value();
}

/// Returns a look whose unset members are those of another one.
Look completed(Look look, const Look& usual) {
    if (!look.style) look.style = usual.style;
    if (look.color.by.empty()) {
        look.color.option = usual.color.option;
        look.color.by = usual.color.by;
        look.color.carbons = usual.color.carbons;
    }
    if (look.color.of_kinds.empty()) look.color.of_kinds = usual.color.of_kinds;
    if (look.color.palette.empty()) look.color.palette = usual.color.palette;
    if (!look.color.range) look.color.range = usual.color.range;
    if (!look.opacity) look.opacity = usual.opacity;
    const auto complete = [](SizeWords& words, const SizeWords& by) {
        if (!words.of_all && words.of_kinds.empty()) words = by;
    };
    look.finish = usual.finish;
    complete(look.radius, usual.radius);
    complete(look.scale, usual.scale);
    return look;
}

/// Returns the look that the options ask for.
Look usual_look(const Drawing& drawing) {
    Look look{.style = drawing.style,
              .color = color_words_of("--color", drawing.color),
              .opacity = drawing.opacity,
              .radius = {},
              .scale = {}};
    if (!drawing.palette.empty()) look.color.palette = drawing.palette;
    if (drawing.range) look.color.range = drawing.range;
    look.finish = drawing.finish;
    if (!drawing.radius.empty()) look.radius = size_words_of("--radius", drawing.radius);
    if (!drawing.scale_radii.empty()) look.scale = size_words_of("--scale", drawing.scale_radii);
    return look;
}

class SceneFromAtoms {
  public:
    SceneFromAtoms(const Structure& structure, const Drawing& drawing, const std::string& file,
                   core::SceneBuilder& builder, std::vector<AtomPair>* atoms_of_shape,
                   const OnRemark& on_remark)
        : structure_(structure), drawing_(drawing), file_(file), builder_(builder),
          atoms_of_shape_(atoms_of_shape), on_remark_(on_remark), atoms_{structure} {}

    DrawingScale draw() {
        if (structure_.size() == 0) throw BadInput(file_, "", "has no atoms");
        require_places();
        find_representations();
        select();
        find_usual_radius();
        find_images();
        find_styles();
        find_camera();
        if (!fill_crystal()) find_bonds();
        make_layers();
        report_unused_ramps();
        find_ranges();
        find_keys();
        find_cuts();
        report_unmatched();
        builder_.reserve(count_ * atoms_.images.size());
        DrawnShapes shapes(builder_, atoms_.cuts, atoms_of_shape_);
        add_layers(shapes);
        if (!atoms_.cuts.empty() && builder_.shape_count() == 0)
            throw BadInput(emptying_option(), "",
                           "must leave a part of the atoms, got none: they have " + extent());
        find_places();
        find_atoms_in_chains();
        if (drawing_.show_cell) {
            require_cell("--cell", "to show");
            add_cell_edges(atoms_, shapes);
        }
        if (drawing_.show_axes) {
            require_cell("--axes", "whose edges they show");
            add_axes(atoms_, camera_, largest_radius(), shapes);
        }
        set_up_view();
        return scale_;
    }

  private:
    void add_layers(DrawnShapes& shapes) {
        for (const AtomLayer& layer : layers_) {
            if (!has_atoms(layer.representation)) continue;
            if (layer.look.style == Style::polyhedra) {
                if (add_polyhedra_layer(atoms_, layer, shapes) == 0 && layer.matches_kinds())
                    report_no_polyhedra(layer.option);
            } else if (shows_chains(*layer.look.style)) {
                remark(add_chain_layer(atoms_, layer, shapes, !shows_atoms(layer.representation)));
            } else {
                if (atoms_.ellipsoids > Ellipsoids::plain && *layer.look.opacity < 1.0F)
                    remark(std::string(option_of(atoms_.ellipsoids)) +
                           " is ignored for atoms whose opacity is below 1");
                add_layer(atoms_, layer, file_, shapes);
            }
        }
        if (drawing_.hydrogen_bonds && add_hydrogen_bonds(atoms_, shapes) == 0)
            remark("hydrogen bonds are missing: no atoms that are shown have one");
        shapes.finish();
    }

    void report_no_polyhedra(const std::string& option) {
        const std::string text =
            "polyhedra are missing: they need an atom that is shown and has 4 to 64 bonds";
        if (layers_.size() == 1) throw BadInput(option, "", text);
        remark(text);
    }

    /// Returns the option whose planes leave nothing, or both if neither does so alone.
    std::string emptying_option() const {
        if (!drawing_.slab) return "--cut";
        const std::span<const CutPlane> cuts = atoms_.cuts;
        const auto empties = [&](std::span<const CutPlane> planes) {
            bool is_empty = true;
            for (const AtomLayer& layer : layers_)
                atoms_.for_each([&](AtomIndex atom, const Vec3f& at) {
                    if (is_empty && layer.has(atoms_, atom))
                        is_empty = !planes_through(
                            core::bounds_of(core::Sphere{at, layer.radii.of(atom)}), planes);
                });
            return is_empty;
        };
        if (empties(cuts.last(2))) return "--slab";
        return empties(cuts.first(drawing_.cuts.size())) ? "--cut" : "--cut and --slab";
    }

    /// Returns the range of dot(axis, p) over the atoms' balls. `axis` is a unit vector.
    std::pair<double, double> range_of_atoms(const Vec3d& axis) const {
        std::pair<double, double> range(core::infinity<double>, -core::infinity<double>);
        for (const AtomLayer& layer : layers_)
            atoms_.for_each([&](AtomIndex atom, const Vec3f& at) {
                if (!layer.has(atoms_, atom)) return;
                const double middle = core::dot(axis, core::convert<double>(at));
                const auto radius = static_cast<double>(layer.radii.of(atom));
                range = {std::min(range.first, middle - radius),
                         std::max(range.second, middle + radius)};
            });
        return range;
    }

    /// Returns the atoms' coordinates and depths, for a message.
    std::string extent() const {
        const auto range_text = [&](const char* name, const Vec3d& axis, double origin) {
            const auto [least, most] = range_of_atoms(axis);
            const auto in_hundredths = [&](double number) {
                return to_text(static_cast<float>(std::round(100.0 * (number - origin)) / 100.0));
            };
            return std::string(name) + " from " + in_hundredths(least) + " to " +
                   in_hundredths(most);
        };
        std::string text;
        if (!drawing_.cuts.empty())
            text = range_text("x", {1.0, 0.0, 0.0}, 0.0) + ", " +
                   range_text("y", {0.0, 1.0, 0.0}, 0.0) + ", " +
                   range_text("z", {0.0, 0.0, 1.0}, 0.0);
        if (drawing_.slab)
            text += (text.empty() ? "" : ", ") +
                    range_text("depths", direction_to_viewer(),
                               core::dot(direction_to_viewer(), middle_of_atoms()));
        return text;
    }

    double largest_radius() const {
        float largest = 0.0F;
        for (const AtomLayer& layer : layers_)
            for (AtomIndex i = 0; i < structure_.size(); ++i)
                if (layer.has(atoms_, i)) largest = std::max(largest, layer.radii.of(i));
        return static_cast<double>(largest);
    }

    bool shows_atoms(std::size_t representation) const {
        return std::any_of(layers_.begin(), layers_.end(), [&](const AtomLayer& layer) {
            return layer.representation == representation && !shows_chains(*layer.look.style);
        });
    }

    /// Finds the places of the copies, unless the atoms are where the file has them.
    void find_places() {
        const bool are_in_file = atoms_.originals.empty() && atoms_.images.size() == 1;
        if (atoms_of_shape_ == nullptr || are_in_file) return;
        atoms_.for_each([&](AtomIndex atom, const Vec3f& at) {
            if (!is_cut_away(atom, at)) scale_.places.push_back({atom, at});
        });
        std::stable_sort(scale_.places.begin(), scale_.places.end(),
                         [](const auto& a, const auto& b) { return a.atom < b.atom; });
    }

    /// Returns true if planes leave nothing of an atom's ball.
    bool is_cut_away(AtomIndex atom, const Vec3f& at) const {
        if (atoms_.cuts.empty()) return false;
        double radius = 0.0;
        for (const AtomLayer& layer : layers_)
            if (layer.has(atoms_, atom))
                radius = std::max(radius, static_cast<double>(layer.radii.of(atom)));
        return std::any_of(atoms_.cuts.begin(), atoms_.cuts.end(), [&](const CutPlane& plane) {
            return core::dot(plane.normal, core::convert<double>(at)) >
                   plane.offset + radius * core::length(plane.normal);
        });
    }

    void find_atoms_in_chains() {
        if (atoms_of_shape_ == nullptr) return;
        for (const AtomLayer& layer : layers_) {
            if (!shows_chains(*layer.look.style)) continue;
            scale_.is_in_chain.resize(structure_.size());
            for (AtomIndex i = 0; i < structure_.size(); ++i)
                if (layer.has(atoms_, i)) scale_.is_in_chain[i] = 1;
        }
    }

    /// Reports a remark on the file, once for all frames.
    void remark(const std::string& text) {
        if (!text.empty() && on_remark_ && !drawing_.scale)
            on_remark_(printable(file_, 4096) + ": " + text);
    }

    void require_cell(const char* option, const char* what) const {
        if (!structure_.cell.any())
            throw BadInput(option, "",
                           std::string("must have a cell ") + what + ", but " + file_ +
                               " has none");
    }

    /// Reports each name that selects nothing, once for all frames.
    void report_unmatched() {
        if (!on_remark_ || drawing_.scale) return;
        for (auto message = unmatched_.begin(); message != unmatched_.end(); ++message)
            if (std::find(unmatched_.begin(), message, *message) == message) on_remark_(*message);
    }

    struct Shown {
        std::string option; ///< in messages
        Representation what;
        std::vector<char> has_ramp{}; ///< by look: it names a palette or a range itself
    };

    /// Without representations, all atoms have the look of the options.
    void find_representations() {
        const Look usual = usual_look(drawing_);
        for (const ShowWords& words : drawing_.show) {
            Shown shown{words.option, representation_of(words.option, words.text)};
            for (Look& look : shown.what.looks) {
                shown.has_ramp.push_back(has_ramp(look.color) ? 1 : 0);
                look = completed(std::move(look), usual);
            }
            shown_.push_back(std::move(shown));
        }
        if (shown_.empty()) shown_.push_back({"--style", {"all", {usual}}, {0}});
        for (const std::string& text : drawing_.polyhedra) {
            const Look look = completed(polyhedra_of("--polyhedra", text), usual);
            for (Shown& shown : shown_) {
                shown.what.looks.push_back(look);
                shown.has_ramp.push_back(0);
            }
        }
        if (shown_.size() >= DrawnAtoms::hidden)
            throw BadInput("--show", "", "must not be given more than 65534 times");
    }

    std::vector<char> selected(const std::string& option, const std::string& select,
                               bool may_be_empty) {
        std::vector<char> result = select_atoms(structure_, select, unmatched_, option);
        if (!may_be_empty && is_empty(result)) throw BadInput(option, "", selects_none(select));
        return result;
    }

    static bool is_empty(const std::vector<char>& selection) {
        return std::find(selection.begin(), selection.end(), 1) == selection.end();
    }

    std::string selects_none(const std::string& select) const {
        return "\"" + printable(select) + "\" selects none of " +
               std::to_string(structure_.size()) + " atoms";
    }

    /// Finds the last representation of each atom.
    void select() {
        const bool is_first_frame = !drawing_.scale;
        std::vector<std::uint16_t>& representations = atoms_.representations;
        representations.assign(structure_.size(), drawing_.show.empty() ? 0 : DrawnAtoms::hidden);
        for (std::size_t k = 0; k < drawing_.show.size(); ++k) {
            const std::vector<char> is_shown =
                selected(shown_[k].option, shown_[k].what.select, !is_first_frame);
            for (std::size_t i = 0; i < representations.size(); ++i)
                if (is_shown[i] != 0) representations[i] = static_cast<std::uint16_t>(k);
        }
        report_replaced();
        const auto hide_if = [&](const std::vector<char>& is_selected, char value) {
            for (std::size_t i = 0; i < representations.size(); ++i)
                if (is_selected[i] == value) representations[i] = DrawnAtoms::hidden;
        };
        if (drawing_.select != "all") hide_if(selected("--select", drawing_.select, false), 0);
        for (const std::string& hidden : drawing_.hide) {
            const std::size_t said = unmatched_.size();
            const std::vector<char> is_hidden = selected("--hide", hidden, true);
            hide_if(is_hidden, 1);
            if (said == unmatched_.size() && is_empty(is_hidden))
                unmatched_.push_back("--hide: " + selects_none(hidden));
        }
        count_ = representations.size() -
                 static_cast<std::size_t>(std::count(representations.begin(), representations.end(),
                                                     DrawnAtoms::hidden));
        if (count_ == 0)
            throw BadInput(drawing_.hide.empty() ? "--show" : "--hide", "",
                           "must leave an atom to show, got none of " +
                               std::to_string(structure_.size()));
    }

    /// Reports representations of which later ones leave no atom.
    void report_replaced() {
        for (std::size_t k = 0; k < drawing_.show.size(); ++k)
            if (!has_atoms(k))
                unmatched_.push_back(shown_[k].option + " \"" + printable(shown_[k].what.select) +
                                     "\" shows no atoms, because later ones replace it; two looks "
                                     "at once are joined by +");
    }

    bool has_atoms(std::size_t representation) const {
        return std::find(atoms_.representations.begin(), atoms_.representations.end(),
                         representation) != atoms_.representations.end();
    }

    /// Readers check the coordinates that they read, but not those that follow from the cell.
    void require_places() const {
        for (AtomIndex atom = 0; atom < structure_.size(); ++atom)
            for (int axis = 0; axis < 3; ++axis)
                if (!(std::abs(structure_.positions[atom][axis]) <= core::coordinate_limit))
                    throw BadInput(file_, "",
                                   "atom " + std::to_string(atom + 1) +
                                       " must have coordinates from -1e30 to 1e30");
    }

    /// Replaces automatic styles.
    void find_styles() {
        needs_bonds_ = drawing_.hydrogen_bonds;
        std::size_t place = 0;
        for (std::size_t k = 0; k < shown_.size(); ++k) {
            const auto count = static_cast<std::size_t>(
                std::count(atoms_.representations.begin(), atoms_.representations.end(), k));
            const Style usual =
                count > max_for_balls || !structure_.radii.empty() ? Style::spheres : Style::balls;
            atoms_.shows_bonds.push_back(0);
            for (Look& look : shown_[k].what.looks) {
                if (look.style == Style::automatic && !drawing_.polyhedra.empty())
                    make_small_balls(look);
                if (look.style == Style::automatic)
                    look.style = drawing_.scale ? drawing_.scale->styles[place] : usual;
                scale_.styles.push_back(*look.style);
                ++place;
                if (has_sticks(*look.style)) atoms_.shows_bonds.back() = 1;
                needs_bonds_ =
                    needs_bonds_ || has_sticks(*look.style) || look.style == Style::polyhedra;
            }
        }
    }

    /// Among polyhedra, atoms are balls without sticks.
    static void make_small_balls(Look& look) {
        look.style = Style::spheres;
        const auto is_unset = [](const SizeWords& words) {
            return !words.of_all && words.of_kinds.empty();
        };
        if (is_unset(look.radius) && is_unset(look.scale)) look.scale.of_all = small_ball;
    }

    /// Returns the view that the drawing names, or that of a crystal, in which the edges of the
    /// cell are visible.
    std::optional<core::NamedView> find_view(bool is_crystal) const {
        const std::optional<core::NamedView>& view = drawing_.view;
        if (!view) return is_crystal ? std::optional(view_of_cell(structure_.cell)) : std::nullopt;
        if (view->direction != Vec3f(0.0F)) return view;
        if (view->name != core::best_view_name) {
            require_cell("--view", "along whose edge it looks");
            const auto edge = static_cast<std::size_t>(view->name.front() - 'a');
            if (structure_.cell.edges[edge] == Vec3d(0.0))
                throw BadInput("--view", "",
                               "must not be " + std::string(view->name) +
                                   ": the cell has no length along it");
            return view_along_edge(structure_.cell, view->name);
        }
        if (is_crystal) return best_view_of_cell(structure_.cell, drawing_.repeat);
        return core::best_view([&](const auto& visit) {
            atoms_.for_each([&](AtomIndex atom, const Vec3f& at) {
                if (atoms_.representations[atom] != DrawnAtoms::hidden)
                    visit(core::convert<double>(at));
            });
        });
    }

    /// Crystals have parallel projection.
    void find_camera() {
        camera_ = drawing_.fit_camera;
        const bool is_crystal = structure_.is_crystal && reciprocal_edges(structure_.cell);
        scale_.view = drawing_.scale ? drawing_.scale->view : find_view(is_crystal);
        if (is_crystal && !drawing_.perspective)
            camera_.projection = core::Projection::orthographic;
        if (scale_.view) {
            camera_.direction = scale_.view->direction;
            camera_.up = scale_.view->up;
        }
        if (drawing_.up) {
            camera_.up = *drawing_.up;
            require_upward(camera_.up, camera_.direction);
        }
        atoms_.to_camera = -core::convert<double>(camera_.direction);
        atoms_.ellipsoids = drawing_.ellipsoids;
        atoms_.finish = drawing_.finish;
        atoms_.deviations = deviations_of(static_cast<double>(drawing_.probability));
    }

    /// Fills the cells of a crystal. Returns false if the atoms are drawn as in the file.
    bool fill_crystal() {
        const CrystalLook look{drawing_.repeat, drawing_.boundary.value_or(structure_.is_crystal),
                               drawing_.whole.value_or(structure_.is_crystal)};
        if (!look.boundary && !look.whole) return false;
        if (!structure_.is_crystal)
            require_cell(look.boundary ? "--boundary" : "--whole", "with faces");
        std::size_t crowded = 0;
        const std::optional<PeriodicBonds> bonds =
            periodic_bonds(structure_, &crowded, &is_metallic_);
        if (!bonds) return false;
        report_crowded(crowded);
        std::vector<AtomCopy> copies = fill_cells(structure_, *bonds, look);
        atoms_.complete = copies.size();
        add_neighbours(*bonds, centers(), copies);
        CrystalAtoms crystal = atoms_of(structure_, *bonds, copies);
        atoms_.repeated = std::move(crystal.structure);
        atoms_.originals = std::move(crystal.originals);
        atoms_.bonds = std::move(crystal.bonds);
        return true;
    }

    /// Returns 1 for the atoms in the middle of polyhedra.
    std::vector<char> centers() const {
        std::vector<char> is_center(structure_.size());
        for (std::size_t k = 0; k < shown_.size(); ++k)
            for (const Look& look : shown_[k].what.looks) {
                if (look.style != Style::polyhedra) continue;
                const std::vector<char> has_kind = kinds_of(look);
                for (AtomIndex i = 0; i < structure_.size(); ++i)
                    if (atoms_.representations[i] == k &&
                        (has_kind.empty() || has_kind[structure_.kinds[i]] != 0))
                        is_center[i] = 1;
            }
        return is_center;
    }

    /// Returns 1 for the kinds of atoms that a look is for; empty: all.
    std::vector<char> kinds_of(const Look& look) const {
        std::vector<char> has_kind(look.kinds.empty() ? 0 : structure_.of_kind.size());
        for (const std::string& kind : look.kinds)
            for (const std::size_t index : kinds_named(structure_.of_kind, kind))
                has_kind[index] = 1;
        return has_kind;
    }

    void report_crowded(std::size_t crowded) {
        if (crowded != 0 && on_remark_)
            on_remark_(printable(file_, 4096) + ": " + std::to_string(crowded) +
                       " atoms have more than " + std::to_string(max_bonds) +
                       " others within the length of a bond: they have no bonds");
    }

    void find_bonds() {
        if (!needs_bonds_) return;
        if (atoms_.images.size() > 1 || !structure_.bonds.empty())
            atoms_.repeated = with_images(structure_, drawing_.repeat);
        std::size_t crowded = 0;
        atoms_.bonds = scenes::find_bonds(atoms_.all(), &crowded, &is_metallic_);
        report_crowded(crowded);
        atoms_.complete = atoms_.all().size();
    }

    void make_layers() {
        for (std::size_t k = 0; k < shown_.size(); ++k)
            for (Look& look : shown_[k].what.looks) {
                if (look.color.by.empty() && shows_chains(*look.style) &&
                    !structure_.residues.empty())
                    look.color.by = usual_chain_color(structure_);
                for (const std::string& kind : look.kinds)
                    if (kinds_named(structure_.of_kind, kind).empty())
                        unmatched_.push_back(matches_no_kind("--polyhedra", kind));
                layers_.push_back(
                    {k, shown_[k].option, look, AtomColors(structure_, look.color, unmatched_),
                     AtomRadii(structure_, look, scale_.usual_radius, is_metallic_, unmatched_),
                     kinds_of(look)});
            }
    }

    /// Reports palettes and ranges without a number to which they apply.
    void report_unused_ramps() {
        const auto report = [&](const std::string& option) {
            unmatched_.push_back(option + " is ignored, because no colour stands for a number" +
                                 (structure_.properties.empty() ? ": the atoms have none" : ""));
        };
        bool any = false;
        std::size_t layer = 0;
        for (const Shown& shown : shown_)
            for (const char has_own : shown.has_ramp) {
                const bool is_used = layers_[layer++].colors.property() != nullptr;
                any = any || is_used;
                if (has_own != 0 && !is_used) report("the palette or range of " + shown.option);
            }
        if (!any && !drawing_.palette.empty()) report("--palette");
        if (!any && drawing_.range) report("--range");
    }

    /// Finds the ranges of properties over all atoms that show them.
    void find_ranges() {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        if (drawing_.scale) scale_.ranges = drawing_.scale->ranges;
        for (const AtomLayer& layer : layers_) {
            const AtomProperty* const property = layer.colors.property();
            if (property == nullptr || drawing_.scale) continue;
            ColorRange& range =
                scale_.ranges.try_emplace(property->name, infinity, -infinity).first->second;
            for (AtomIndex i = 0; i < structure_.size(); ++i) {
                const auto value = static_cast<double>(property->values[i]);
                if (atoms_.representations[i] != layer.representation || !std::isfinite(value))
                    continue;
                range = {std::min(range.first, value), std::max(range.second, value)};
            }
        }
        for (AtomLayer& layer : layers_)
            if (layer.colors.property() != nullptr)
                layer.colors.set_range(
                    layer.look.color.range.value_or(scale_.ranges[layer.colors.property()->name]));
    }

    /// Finds the meanings of the colours.
    void find_keys() {
        constexpr std::size_t most = max_key_entries;
        std::map<std::string, std::uint32_t> entries;
        std::unordered_set<std::uint32_t> known;
        for (const AtomLayer& layer : layers_) {
            if (const AtomProperty* const property = layer.colors.property())
                add_key({.property = property->name,
                         .range = layer.colors.range(),
                         .palette = layer.look.color.palette});
            known.clear();
            for (AtomIndex i = 0; i < structure_.size() && entries.size() <= most; ++i) {
                if (atoms_.representations[i] != layer.representation || !layer.colors.has_name(i))
                    continue;
                const std::uint32_t color = layer.colors.of(i);
                if (known.insert(color).second) entries.emplace(meaning_of(layer, i), color);
            }
        }
        scale_.has_too_many_colors = entries.size() > most;
        if (!entries.empty() && entries.size() <= most)
            scale_.keys.push_back({.entries = {entries.begin(), entries.end()}});
    }

    /// Returns the meaning of an atom's colour. A legend has no entry for a colour that an option
    /// gives to all atoms, but one for that of carbons beside other elements.
    std::string meaning_of(const AtomLayer& layer, AtomIndex atom) const {
        constexpr std::size_t longest = 24; // that has room in a legend
        std::string meaning = layer.colors.meaning_of(atom);
        if (!layer.look.color.carbons || !color_named(meaning)) return meaning;
        const std::string& select = shown_[layer.representation].what.select;
        return select.size() > longest ? "C, " + meaning : select == "all" ? "C" : "C of " + select;
    }

    void add_key(ColorKey key) {
        const auto is_known = [&](const ColorKey& other) {
            return other.property == key.property && other.range == key.range &&
                   other.palette == key.palette;
        };
        if (std::none_of(scale_.keys.begin(), scale_.keys.end(), is_known))
            scale_.keys.push_back(std::move(key));
    }

    /// Returns bounds of the centres of the atoms that are shown, in the file's cell.
    core::Bounds bounds_of_shown() const {
        core::Bounds bounds;
        for (AtomIndex i = 0; i < structure_.size(); ++i)
            if (atoms_.representations[i] != DrawnAtoms::hidden)
                bounds.include({structure_.positions[i], structure_.positions[i]});
        return bounds;
    }

    /// Returns the middle of the bounds of the centres of all atoms that are shown.
    Vec3d middle_of_atoms() const {
        core::Bounds bounds;
        atoms_.for_each([&](AtomIndex atom, const Vec3f& at) {
            if (atoms_.representations[atom] != DrawnAtoms::hidden) bounds.include({at, at});
        });
        return 0.5 * (core::convert<double>(bounds.lower) + core::convert<double>(bounds.upper));
    }

    Vec3d direction_to_viewer() const {
        return 1.0 / core::length(atoms_.to_camera) * atoms_.to_camera;
    }

    void find_cuts() {
        atoms_.cuts = drawing_.cuts;
        for (CutPlane& plane : atoms_.cuts)
            if (plane.from_middle) plane.offset += core::dot(plane.normal, middle_of_atoms());
        if (!drawing_.slab) return;
        const Vec3d back = direction_to_viewer();
        const double middle = core::dot(back, middle_of_atoms());
        atoms_.cuts.push_back({back, middle + drawing_.slab->second});
        atoms_.cuts.push_back({-1.0 * back, -(middle + drawing_.slab->first)});
    }

    /// Sets the radius of atoms of unknown elements: they nearly touch if they fill their bounds.
    void find_usual_radius() {
        if (drawing_.scale) {
            scale_.usual_radius = drawing_.scale->usual_radius;
            return;
        }
        const auto has_element = [](const AtomKind& kind) { return kind.element != 0; };
        if (std::any_of(structure_.of_kind.begin(), structure_.of_kind.end(), has_element)) return;
        core::Bounds bounds;
        for (const Vec3f& at : structure_.positions)
            bounds.include({at, at});
        double volume = 1.0;
        int dimensions = 0;
        const Vec3d size =
            core::convert<double>(bounds.upper) - core::convert<double>(bounds.lower);
        const double largest = std::max({size.x, size.y, size.z});
        for (int axis = 0; axis < 3; ++axis)
            if (size[axis] > 0x1p-6 * largest) {
                volume *= size[axis];
                ++dimensions;
            }
        if (dimensions > 0)
            scale_.usual_radius = static_cast<float>(
                0.5 * core::pow(volume / static_cast<double>(structure_.size()), 1.0 / dimensions));
    }

    void find_images() {
        const std::array<int, 3>& repeat = drawing_.repeat;
        if (repeat != std::array{1, 1, 1} && !structure_.cell.any())
            throw BadInput("--repeat", "",
                           "must have a cell to repeat, but " + file_ + " has none");
        for (const Vec3d& offset : offsets_of_images(structure_.cell, repeat)) {
            for (int axis = 0; axis < 3; ++axis)
                if (!(std::abs(offset[axis]) <= static_cast<double>(core::coordinate_limit)))
                    throw BadInput(file_, "", "its cell must have edges from -1e30 to 1e30");
            atoms_.images.push_back(core::convert<float>(offset));
        }
    }

    /// Returns true if there is an atom for every eight pixels, and the mean atom is narrower than
    /// two pixels. Such an image is noise: 40 dB would take ten times the samples of other images.
    bool is_fine() const {
        double radii = 0.0, count = 0.0;
        for (const AtomLayer& layer : layers_)
            for (AtomIndex i = 0; i < structure_.size(); ++i)
                if (layer.has(atoms_, i)) {
                    radii += static_cast<double>(layer.radii.of(i));
                    ++count;
                }
        const core::Bounds of_one = bounds_of_shown();
        core::Bounds bounds = of_one;
        for (const Vec3f& offset : atoms_.images)
            bounds.include({of_one.lower + offset, of_one.upper + offset});
        const Vec3d size =
            core::convert<double>(bounds.upper) - core::convert<double>(bounds.lower);
        const double extent = std::max({size.x, size.y, size.z});
        return 8.0 * count * static_cast<double>(atoms_.images.size()) >=
                   double(drawing_.width) * double(drawing_.height) &&
               2.0 * radii / count * double(drawing_.height) < 2.0 * extent;
    }

    void set_up_view() {
        builder_.settings.width = drawing_.width;
        builder_.settings.height = drawing_.height;
        // An image of balls and sticks is mostly white, and white has no error.
        const bool is_filled = std::all_of(layers_.begin(), layers_.end(), [](const auto& layer) {
            const Style style = *layer.look.style;
            return style == Style::touching || !(has_sticks(style) || shows_chains(style));
        });
        if (is_filled && is_fine())
            builder_.settings.grid = 3;
        else
            builder_.settings.quality = is_filled ? 40.0F : 46.0F;
        builder_.background = drawing_.background;
        const bool is_print = drawing_.finish == Finish::print,
                   is_flat = drawing_.finish == Finish::flat;
        if (is_print) builder_.settings.quality = 50.0F;
        if (is_print || is_flat)
            builder_.settings.outline = {.width = is_print ? 1.5F : 2.0F,
                                         .color = core::Color(is_print ? 0.02F : 0.0F),
                                         .creases = is_print ? 180.0F : 60.0F};
        // Paler atoms would have the colours of other values.
        const bool shows_values =
            std::any_of(layers_.begin(), layers_.end(),
                        [](const auto& layer) { return layer.colors.property() != nullptr; });
        builder_.auto_camera = {.fit_camera = camera_,
                                .lights = true,
                                .depth_cue = drawing_.depth_cue.value_or(
                                    shows_values || is_print || is_flat ? 0.0F : 0.3F)};
    }

    const Structure& structure_;
    const Drawing& drawing_;
    const std::string& file_;
    core::SceneBuilder& builder_;
    std::vector<AtomPair>* atoms_of_shape_;
    const OnRemark& on_remark_;
    std::vector<Shown> shown_; // at least one
    std::vector<std::string> unmatched_;
    std::size_t count_ = 0; // of atoms that are shown
    DrawingScale scale_;
    DrawnAtoms atoms_;
    std::vector<char> is_metallic_; // by element
    std::vector<AtomLayer> layers_;
    core::FitCamera camera_;
    bool needs_bonds_ = false;
};

} // namespace

void require_upward(const core::Vec3f& up, const core::Vec3f& direction) {
    const auto wide_up = core::convert<double>(up), forward = core::convert<double>(direction);
    constexpr double min_sine = 1e-5;
    if (core::length(core::cross(wide_up, forward)) <=
        min_sine * core::length(wide_up) * core::length(forward))
        throw BadInput("--up", "", "must not be parallel to the direction of view");
}

void DrawingScale::include(const DrawingScale& other) {
    for (const auto& [name, range] : other.ranges) {
        ColorRange& own = ranges.try_emplace(name, range).first->second;
        own = {std::min(own.first, range.first), std::max(own.second, range.second)};
    }
}

DrawingScale draw(const Structure& structure, const Drawing& drawing, const std::string& file,
                  core::SceneBuilder& builder, std::vector<AtomPair>* atoms_of_shape,
                  const OnRemark& on_remark) {
    return SceneFromAtoms(structure, drawing, file, builder, atoms_of_shape, on_remark).draw();
}

} // namespace raylane::scenes
