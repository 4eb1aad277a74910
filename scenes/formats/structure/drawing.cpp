#include "scenes/formats/structure/drawing.hpp"

#include "core/numbers/elementary.hpp"
#include "core/shapes/checks.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/bonds.hpp"
#include "scenes/formats/structure/colors.hpp"
#include "scenes/formats/structure/displacement.hpp"
#include "scenes/formats/structure/images.hpp"
#include "scenes/formats/structure/selection.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace raylane::scenes {

namespace {

using core::MaterialIndex;
using core::Vec3d;
using core::Vec3f;

constexpr std::size_t max_for_balls = 500;
constexpr float part_of_radius = 0.25F; // of van der Waals', for balls with sticks
constexpr float stick_with_balls = 0.12F, stick = 0.16F, licorice_stick = 0.3F, dot_size = 0.2F;
constexpr double apart = 0.13; // distance of a double bond's sticks from its line
constexpr float cell_stick = 0.06F;

class SceneFromAtoms {
  public:
    SceneFromAtoms(const Structure& structure, const Drawing& drawing, const std::string& file,
                   core::SceneBuilder& builder, std::vector<AtomPair>* atoms_of_shape,
                   const OnRemark& on_remark)
        : structure_(structure), drawing_(drawing), file_(file), builder_(builder),
          palette_(builder, drawing.opacity), atoms_of_shape_(atoms_of_shape),
          on_remark_(on_remark) {}

    DrawingScale draw() {
        if (structure_.size() == 0) throw BadInput(file_, "", "has no atoms");
        require_places();
        if (drawing_.select != "all") {
            std::vector<std::string> unmatched;
            selected_ = select_atoms(structure_, drawing_.select, unmatched);
            count_ = static_cast<std::size_t>(std::count(selected_.begin(), selected_.end(), 1));
            if (count_ == 0)
                throw BadInput("--select", "",
                               "\"" + printable(drawing_.select) + "\" selects none of " +
                                   std::to_string(structure_.size()) + " atoms");
            if (on_remark_ && !drawing_.scale) // once for all frames
                for (const std::string& message : unmatched)
                    on_remark_(message);
        } else {
            count_ = structure_.size();
        }
        find_scale();
        find_colors();
        find_images();
        add_atoms();
        if (scale_.style != Style::spheres && scale_.style != Style::points) add_bonds();
        add_transparent();
        if (drawing_.show_cell) add_cell();
        set_up_view();
        return scale_;
    }

  private:
    bool is_selected(AtomIndex atom) const { return selected_.empty() || selected_[atom] != 0; }

    /// Readers check the coordinates that they read, but not those that follow from the cell.
    void require_places() const {
        for (AtomIndex atom = 0; atom < structure_.size(); ++atom)
            for (int axis = 0; axis < 3; ++axis)
                if (!(std::abs(structure_.positions[atom][axis]) <= core::coordinate_limit))
                    throw BadInput(file_, "",
                                   "atom " + std::to_string(atom + 1) +
                                       " must have coordinates from -1e30 to 1e30");
    }

    void find_scale() {
        if (drawing_.scale) {
            scale_ = *drawing_.scale;
            return;
        }
        find_usual_radius();
        scale_.style = drawing_.style != Style::automatic                    ? drawing_.style
                       : count_ > max_for_balls || !structure_.radii.empty() ? Style::spheres
                                                                             : Style::balls;
    }

    void find_colors() {
        const std::string& by = drawing_.color;
        if (by == "element") {
            // Types that are not elements have colours by number.
            std::size_t unknown = 0;
            for (const AtomKind& kind : structure_.of_kind)
                of_kind_.push_back(kind.element != 0 ? data_of(kind.element).color
                                                     : color_of_type(unknown++));
            color_of_ = [this](AtomIndex i) { return of_kind_[structure_.kinds[i]]; };
        } else if (by == "chain" || by == "residue") {
            if (structure_.residues.empty())
                throw BadInput("--color", "",
                               "must not be " + by + " here: " + file_ + " has no residues");
            std::vector<std::string> names;
            for (const Residue& residue : structure_.of_residue)
                names.push_back(by == "chain" ? structure_.chains[residue.chain] : residue.name);
            std::vector<std::string> distinct = names;
            std::sort(distinct.begin(), distinct.end());
            distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
            for (const std::string& name : names) {
                const auto place = static_cast<std::size_t>(
                    std::lower_bound(distinct.begin(), distinct.end(), name) - distinct.begin());
                of_kind_.push_back(color_of_one(place, distinct.size()));
            }
            color_of_ = [this](AtomIndex i) { return of_kind_[structure_.residues[i]]; };
        } else {
            color_by_property(by);
        }
    }

    void color_by_property(const std::string& name) {
        std::vector<std::string> names = {"element"};
        if (!structure_.residues.empty()) names.insert(names.end(), {"chain", "residue"});
        for (const AtomProperty& property : structure_.properties)
            names.push_back(property.name);
        const auto found =
            std::find_if(structure_.properties.begin(), structure_.properties.end(),
                         [&](const AtomProperty& property) { return property.name == name; });
        if (found == structure_.properties.end())
            throw BadInput("--color", "",
                           "must be " + alternatives(names) + ", got \"" + printable(name) + "\"" +
                               suggestion(name, {names.begin(), names.end()}));
        const std::vector<float>* values = &found->values;
        if (!drawing_.scale) find_range(*values);
        const double least = scale_.least, most = scale_.most;
        color_of_ = [=](AtomIndex i) {
            const auto value = static_cast<double>((*values)[i]);
            if (!std::isfinite(value)) return data_of(0).color;
            return ramp_at(most > least ? (value - least) / (most - least) : 0.5);
        };
    }

    void find_range(const std::vector<float>& values) {
        scale_.least = std::numeric_limits<double>::infinity();
        scale_.most = -scale_.least;
        for (AtomIndex i = 0; i < structure_.size(); ++i) {
            const auto value = static_cast<double>(values[i]);
            if (!is_selected(i) || !std::isfinite(value)) continue;
            scale_.least = std::min(scale_.least, value);
            scale_.most = std::max(scale_.most, value);
        }
    }

    /// Sets the radius of atoms of unknown elements: they nearly touch if they fill their bounds.
    void find_usual_radius() {
        scale_.usual_radius = 1.5F;
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
            images_.push_back(core::convert<float>(offset));
        }
    }

    float full_radius(AtomIndex atom) const {
        if (!structure_.radii.empty() && structure_.radii[atom] > 0.0F)
            return structure_.radii[atom];
        const Element element = structure_.element(atom);
        if (element == 0) return scale_.usual_radius;
        const float radius = data_of(element).van_der_waals_radius;
        return radius > 0.0F ? radius : 2.0F;
    }

    float radius_of(AtomIndex atom) const {
        switch (scale_.style) {
        case Style::automatic:
        case Style::spheres:
            return full_radius(atom);
        case Style::balls:
            return (structure_.element(atom) == 0 ? 0.5F : part_of_radius) * full_radius(atom);
        case Style::sticks:
            return stick;
        case Style::licorice:
            return licorice_stick;
        case Style::points:
            return std::min(dot_size, 0.5F * full_radius(atom));
        }
        return 0.0F;
    }

    /// Adds transparent shapes to one solid, as a molecule has no walls inside.
    template <class Shape>
    void add(const Shape& shape, MaterialIndex material, const AtomPair& atoms) {
        if (drawing_.opacity < 1.0F && atoms != no_atoms)
            transparent_.parts.push_back({.shape = core::to_doubles(shape), .material = material});
        else
            builder_.add(shape, material);
        if (atoms_of_shape_ != nullptr) atoms_of_shape_->push_back(atoms);
    }
    void add_transparent() {
        if (transparent_.parts.empty()) return;
        if (transparent_.parts.size() == 1) transparent_ = core::Solid(transparent_.parts[0]);
        builder_.add_solid(transparent_, transparent_.material);
        transparent_ = {};
    }

    void add_atoms() {
        builder_.reserve(count_ * images_.size());
        std::vector<char> has_ellipsoid;
        if (drawing_.ellipsoids)
            has_ellipsoid = add_displacements();
        else if (scale_.style == Style::spheres || scale_.style == Style::balls)
            has_ellipsoid = add_shapes();
        for (AtomIndex atom = 0; atom < structure_.size(); ++atom) {
            if (!is_selected(atom) || (!has_ellipsoid.empty() && has_ellipsoid[atom] != 0))
                continue;
            const MaterialIndex material = palette_.of(color_of_(atom));
            const float radius = displaced_radius(atom).value_or(radius_of(atom));
            for (const Vec3f& image : images_)
                add(core::Sphere{structure_.positions[atom] + image, radius}, material,
                    {atom, atom});
        }
    }

    /// Returns the radius of an isotropic displacement that is rendered.
    std::optional<float> displaced_radius(AtomIndex atom) const {
        if (!drawing_.ellipsoids || structure_.isotropies.empty() ||
            !(structure_.isotropies[atom] > 0.0F))
            return std::nullopt;
        return static_cast<float>(
            radius_of_displacement(static_cast<double>(structure_.isotropies[atom])));
    }

    std::vector<char> add_displacements() {
        if (structure_.anisotropies.empty())
            throw BadInput("--ellipsoids", "", file_ + " has no anisotropic displacements");
        std::vector<char> done(structure_.size());
        for (const Anisotropy& of : structure_.anisotropies) {
            if (!is_selected(of.atom)) continue;
            const auto axes = axes_of(of);
            if (!axes) continue;
            add_ellipsoid(of.atom,
                          {core::convert<float>((*axes)[0]), core::convert<float>((*axes)[1]),
                           core::convert<float>((*axes)[2])});
            done[of.atom] = 1;
        }
        return done;
    }

    /// Adds the atoms that are not balls, in the same proportion to their size as balls.
    std::vector<char> add_shapes() {
        std::vector<char> done(structure_.shapes.empty() ? 0 : structure_.size());
        for (const auto& [atom, axes] : structure_.shapes) {
            if (!is_selected(atom)) continue;
            const float size = radius_of(atom) / full_radius(atom);
            add_ellipsoid(atom, {size * axes[0], size * axes[1], size * axes[2]});
            done[atom] = 1;
        }
        return done;
    }

    void add_ellipsoid(AtomIndex atom, const std::array<Vec3f, 3>& axes) {
        const MaterialIndex material = palette_.of(color_of_(atom));
        for (const Vec3f& image : images_)
            add(core::Ellipsoid{structure_.positions[atom] + image, axes[0], axes[1], axes[2]},
                material, {atom, atom});
    }

    void add_bonds() {
        if (images_.size() == 1 && structure_.bonds.empty()) {
            add_bonds_of(structure_);
            return;
        }
        add_bonds_of(with_images(structure_, drawing_.repeat));
    }

    /// Adds the bonds of the structure, or of its images side by side: `all` then repeats its
    /// atoms.
    void add_bonds_of(const Structure& all) {
        std::size_t crowded = 0;
        const std::vector<Bond> bonds = find_bonds(all, &crowded);
        if (crowded != 0 && on_remark_)
            on_remark_(printable(file_, 4096) + ": " + std::to_string(crowded) +
                       " atoms have more than " + std::to_string(max_bonds) +
                       " others within the length of a bond: they have no bonds");
        if (scale_.style != Style::licorice) find_neighbours(all, bonds);
        for (const Bond& bond : bonds) {
            if (!is_selected(original(bond.a)) || !is_selected(original(bond.b))) continue;
            const Vec3d a = core::convert<double>(all.positions[bond.a]);
            const Vec3d b = core::convert<double>(all.positions[bond.b]);
            if (a == b) continue;
            const int sticks = scale_.style == Style::licorice ? 1 : bond.order;
            const float radius = (scale_.style == Style::licorice ? licorice_stick
                                  : scale_.style == Style::balls  ? stick_with_balls
                                                                  : stick) *
                                 (sticks == 1 ? 1.0F : 0.55F);
            if (sticks == 1) {
                add_stick(bond, a, b, radius);
                continue;
            }
            const Vec3d side = beside(all, bond, a, b);
            for (int k = 0; k < sticks; ++k) {
                const double by = (k - 0.5 * (sticks - 1)) * 2.0 * apart / (sticks - 1);
                add_stick(bond, a + by * side, b + by * side, radius);
            }
        }
    }

    AtomIndex original(AtomIndex atom) const {
        return atom % static_cast<AtomIndex>(structure_.size());
    }

    /// Adds a stick in the colours of both atoms, which meet in the middle of its visible part.
    void add_stick(const Bond& bond, const Vec3d& a, const Vec3d& b, float radius) {
        const AtomPair atoms = {original(bond.a), original(bond.b)};
        const MaterialIndex of_a = palette_.of(color_of_(atoms[0]));
        const MaterialIndex of_b = palette_.of(color_of_(atoms[1]));
        const double distance = core::length(b - a);
        const auto larger = static_cast<double>(radius_of(atoms[0]) - radius_of(atoms[1]));
        const double share = std::clamp(0.5 + 0.5 * larger / distance, 0.1, 0.9);
        const auto add_part = [&](const Vec3d& from, const Vec3d& to, MaterialIndex material) {
            add(core::CappedCylinder{core::convert<float>(from), core::convert<float>(to - from),
                                     radius},
                material, atoms);
        };
        if (of_a == of_b) {
            add_part(a, b, of_a);
        } else {
            const Vec3d middle = a + share * (b - a);
            add_part(a, middle, of_a);
            add_part(b, middle, of_b);
        }
    }

    /// Finds up to two neighbours that each atom is bonded to. The atom itself stands for a missing
    /// one.
    void find_neighbours(const Structure& all, const std::vector<Bond>& bonds) {
        one_.resize(all.size());
        another_.resize(all.size());
        for (AtomIndex i = 0; i < one_.size(); ++i)
            one_[i] = another_[i] = i;
        const auto note = [&](AtomIndex of, AtomIndex other) {
            (one_[of] == of ? one_ : another_)[of] = other;
        };
        for (const Bond& bond : bonds) {
            note(bond.a, bond.b);
            note(bond.b, bond.a);
        }
    }

    /// Returns a direction across a bond, of length 1, in the plane of an adjacent bond.
    Vec3d beside(const Structure& all, const Bond& bond, const Vec3d& a, const Vec3d& b) const {
        const Vec3d along = 1.0 / core::length(b - a) * (b - a);
        const auto across = [&](const Vec3d& way) {
            const Vec3d part = way - core::dot(way, along) * along;
            const double size = core::length(part);
            return size > 0.1 ? 1.0 / size * part : Vec3d(0.0);
        };
        const std::pair<AtomIndex, AtomIndex> ends[] = {{bond.a, bond.b}, {bond.b, bond.a}};
        for (const auto& [end, other] : ends)
            for (const AtomIndex next : {one_[end], another_[end]}) {
                if (next == end || next == other) continue;
                const Vec3d way = core::convert<double>(all.positions[next]) -
                                  core::convert<double>(all.positions[end]);
                if (const Vec3d side = across(way); side != Vec3d(0.0)) return side;
            }
        const Vec3d side = across({1, 0, 0});
        return side != Vec3d(0.0) ? side : across({0, 1, 0});
    }

    void add_cell() {
        if (!structure_.cell.any())
            throw BadInput("--cell", "", "must have a cell to show, but " + file_ + " has none");
        const MaterialIndex gray = Palette(builder_).of(0x808080);
        std::array<Vec3f, 3> edges;
        int flat = 0; // bits of edges without a length, as of a slab or a chain
        for (std::size_t k = 0; k < 3; ++k) {
            edges[k] = core::convert<float>(structure_.cell.edges[k]);
            if (edges[k] == Vec3f(0.0F)) flat |= 1 << k;
        }
        for (const Vec3f& image : images_)
            for (int corner = 0; corner < 8; ++corner) {
                if ((corner & flat) != 0) continue;
                Vec3d at = structure_.cell.origin + core::convert<double>(image);
                for (int k = 0; k < 3; ++k)
                    if ((corner >> k & 1) != 0)
                        at = at + structure_.cell.edges[static_cast<std::size_t>(k)];
                const auto from = core::convert<float>(at);
                add(core::Sphere{from, cell_stick}, gray, no_atoms);
                for (int k = 0; k < 3; ++k)
                    if (((corner | flat) >> k & 1) == 0)
                        add(core::CappedCylinder{from, edges[static_cast<std::size_t>(k)],
                                                 cell_stick},
                            gray, no_atoms);
            }
    }

    void set_up_view() {
        builder_.settings.width = drawing_.width;
        builder_.settings.height = drawing_.height;
        // An image of balls and sticks is mostly white, and white has no error.
        const bool is_filled = scale_.style == Style::spheres || scale_.style == Style::points;
        builder_.settings.quality = is_filled ? 40.0F : 46.0F;
        builder_.background = core::Color(1.0F);
        builder_.auto_camera = {
            .fit_camera = drawing_.fit_camera, .lights = true, .depth_cue = drawing_.depth_cue};
    }

    const Structure& structure_;
    const Drawing& drawing_;
    const std::string& file_;
    core::SceneBuilder& builder_;
    Palette palette_;
    std::vector<AtomPair>* atoms_of_shape_;
    const OnRemark& on_remark_;
    core::Solid transparent_{.made = core::Made::by_union};
    std::vector<char> selected_; // empty: all
    std::size_t count_ = 0;
    DrawingScale scale_;
    std::vector<std::uint32_t> of_kind_;
    std::function<std::uint32_t(AtomIndex)> color_of_;
    std::vector<Vec3f> images_;
    std::vector<AtomIndex> one_, another_;
};

} // namespace

DrawingScale draw(const Structure& structure, const Drawing& drawing, const std::string& file,
                  core::SceneBuilder& builder, std::vector<AtomPair>* atoms_of_shape,
                  const OnRemark& on_remark) {
    return SceneFromAtoms(structure, drawing, file, builder, atoms_of_shape, on_remark).draw();
}

} // namespace raylane::scenes
