#include "scenes/formats/structure/atom_layer.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/displacement.hpp"
#include "scenes/formats/structure/hydrogen_bond_layer.hpp"
#include "scenes/formats/structure/ortep.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace raylane::scenes {

namespace {

using core::MaterialIndex;
using core::Vec3d;
using core::Vec3f;

constexpr double sticks_apart = 0.13;   // distance of a double bond's sticks from its line
constexpr float share_of_stick = 0.55F; // of each of several

class LayerShapes {
  public:
    LayerShapes(const DrawnAtoms& atoms, const AtomLayer& layer, const std::string& file,
                DrawnShapes& shapes)
        : atoms_(atoms), structure_(atoms.structure), layer_(layer), file_(file), shapes_(shapes),
          palette_(shapes.builder(), *layer.look.opacity, layer.look.finish) {}

    void add_all() {
        add_atoms();
        if (has_sticks(*layer_.look.style)) add_bonds();
    }

  private:
    bool has(AtomIndex atom) const { return layer_.has(atoms_, atom); }
    MaterialIndex material_of(AtomIndex atom) {
        return palette_.of(layer_.colors.of(atom), [&] { return layer_.colors.meaning_of(atom); });
    }

    template <class Shape>
    void add(const Shape& shape, MaterialIndex material, const AtomPair& atoms) {
        shapes_.add(shape, material, *layer_.look.style, *layer_.look.opacity, atoms);
    }

    void add_atoms() {
        const Style style = *layer_.look.style;
        if (atoms_.ellipsoids != Ellipsoids::none)
            find_displacements();
        else if (style == Style::spheres || style == Style::balls)
            find_shapes();
        atoms_.for_each([&](AtomIndex atom, const Vec3f& at) {
            if (!has(atom)) return;
            if (const auto* const axes = axes_of_atom(atom))
                add_ellipsoid(atom, at, *axes);
            else
                add(core::Sphere{at, displaced_radius(atom).value_or(radius_of_ball(atom))},
                    material_of(atom), {atom, atom});
        });
    }

    /// Returns the semi-axes of an atom that is an ellipsoid, or null.
    const std::array<Vec3d, 3>* axes_of_atom(AtomIndex atom) const {
        return ellipsoid_of_.empty() || ellipsoid_of_[atom] == 0 ? nullptr
                                                                 : &axes_[ellipsoid_of_[atom] - 1];
    }
    void set_axes(AtomIndex atom, const std::array<Vec3d, 3>& axes) {
        ellipsoid_of_.resize(structure_.size());
        axes_.push_back(axes);
        ellipsoid_of_[atom] = axes_.size();
    }

    /// Beside ellipsoids with ellipses, atoms without displacements, such as hydrogen, are small.
    float radius_of_ball(AtomIndex atom) const {
        constexpr float share = 0.6F;
        const bool is_small = atoms_.ellipsoids > Ellipsoids::plain;
        return (is_small ? share : 1.0F) * layer_.radii.of(atom);
    }

    /// Returns the radius of an isotropic displacement that is rendered.
    std::optional<float> displaced_radius(AtomIndex atom) const {
        if (atoms_.ellipsoids == Ellipsoids::none || structure_.isotropies.empty() ||
            !(structure_.isotropies[atom] > 0.0F))
            return std::nullopt;
        return static_cast<float>(atoms_.deviations *
                                  std::sqrt(static_cast<double>(structure_.isotropies[atom])));
    }

    void find_displacements() {
        if (structure_.anisotropies.empty())
            throw BadInput(option_of(atoms_.ellipsoids), "",
                           file_ + " has no anisotropic displacements");
        for (const Anisotropy& anisotropy : structure_.anisotropies)
            if (has(anisotropy.atom))
                if (const auto axes = axes_of(anisotropy, atoms_.deviations))
                    set_axes(anisotropy.atom, *axes);
    }

    /// Finds the atoms that are not balls, in the same proportion to their size as balls.
    void find_shapes() {
        for (const auto& [atom, axes] : structure_.shapes) {
            if (!has(atom)) continue;
            const float size = layer_.radii.share_of_shape(atom);
            set_axes(atom,
                     {core::convert<double>(size * axes[0]), core::convert<double>(size * axes[1]),
                      core::convert<double>(size * axes[2])});
        }
    }

    void add_ellipsoid(AtomIndex atom, const Vec3f& at, const std::array<Vec3d, 3>& axes) {
        const MaterialIndex material = material_of(atom);
        const core::Ellipsoid ellipsoid = ellipsoid_at(at, axes);
        const bool has_ellipses =
            *layer_.look.opacity == 1.0F &&
            (atoms_.ellipsoids == Ellipsoids::ellipses || atoms_.ellipsoids == Ellipsoids::octants);
        if (has_ellipses && atoms_.ellipsoids == Ellipsoids::octants) {
            add_without_octant(atom, ellipsoid, material);
            return;
        }
        add(ellipsoid, material, {atom, atom});
        if (!has_ellipses) return;
        for (const core::Ellipsoid& rim : principal_ellipses(ellipsoid))
            add(rim, ellipse_material(), {atom, atom});
    }

    void add_without_octant(AtomIndex atom, const core::Ellipsoid& ellipsoid,
                            MaterialIndex material) {
        const auto through = planes_through(core::bounds_of(ellipsoid), shapes_.cuts());
        if (!through) return;
        const std::uint32_t color = layer_.colors.of(atom);
        const MaterialIndex of_cut =
            palette_.of(darker(color), [&] { return layer_.colors.meaning_of(atom) + ", octant"; });
        const core::Solid solid =
            without_octant(ellipsoid, atoms_.to_camera, material, ellipse_material(), of_cut);
        shapes_.add_whole(through->empty() ? solid : cut_by(solid, *through), material,
                          {atom, atom});
    }

    MaterialIndex ellipse_material() {
        return palette_.of(0x303030, [] { return std::string("ellipse"); });
    }

    void add_bonds() {
        const Structure& structure = atoms_.all();
        if (*layer_.look.style != Style::licorice) find_neighbours(structure);
        for (const Bond& bond : atoms_.bonds) {
            const AtomIndex of_a = atoms_.original(bond.a), of_b = atoms_.original(bond.b);
            if (!(has(of_a) && atoms_.shows_bonds_of(of_b)) &&
                !(has(of_b) && atoms_.shows_bonds_of(of_a)))
                continue;
            const Vec3d a = core::convert<double>(structure.positions[bond.a]);
            const Vec3d b = core::convert<double>(structure.positions[bond.b]);
            if (a == b || (*layer_.look.style == Style::touching && is_inside(of_a, of_b, a, b)))
                continue;
            const int sticks = *layer_.look.style == Style::licorice ? 1 : bond.order;
            if (sticks == 1) {
                const Vec3d way = 1.0 / core::length(b - a) * (b - a);
                add_stick(bond, a + hidden_length(of_a, way) * way,
                          b - hidden_length(of_b, way) * way, 1.0F);
                continue;
            }
            const Vec3d side = beside(structure, bond, a, b);
            if (sticks == Bond::aromatic) {
                add_stick(bond, a - sticks_apart * side, b - sticks_apart * side, share_of_stick);
                add_dashes(bond, a + sticks_apart * side, b + sticks_apart * side);
                continue;
            }
            for (int k = 0; k < sticks; ++k) {
                const double by = (k - 0.5 * (sticks - 1)) * 2.0 * sticks_apart / (sticks - 1);
                add_stick(bond, a + by * side, b + by * side, share_of_stick);
            }
        }
    }

    /// Returns true if the balls of two atoms meet, so that they hide the stick between them.
    bool is_inside(AtomIndex of_a, AtomIndex of_b, const Vec3d& a, const Vec3d& b) const {
        return core::length(b - a) <=
               static_cast<double>(layer_.radii.of(of_a) + layer_.radii.of(of_b));
    }

    /// Returns the distance from an ellipsoid's centre to its surface along a direction of length
    /// 1, if its octant is cut out, where a stick would be visible; otherwise 0.
    double hidden_length(AtomIndex atom, const Vec3d& way) const {
        const auto* const axes = axes_of_atom(atom);
        if (axes == nullptr || atoms_.ellipsoids != Ellipsoids::octants) return 0.0;
        double sum = 0.0;
        for (const Vec3d& axis : *axes) {
            const double part = core::dot(way, axis) / core::dot(axis, axis);
            sum += part * part;
        }
        return 0.98 / std::sqrt(sum);
    }

    /// Adds a stick in the colours of both atoms, which meet in the middle of its visible part.
    /// Omits the half of an atom of another representation. `share`: factor for the radius.
    void add_stick(const Bond& bond, const Vec3d& a, const Vec3d& b, float share) {
        const AtomPair atoms = {atoms_.original(bond.a), atoms_.original(bond.b)};
        const auto add_part = [&](const Vec3d& from, const Vec3d& to, AtomIndex atom) {
            add(core::CappedCylinder{core::convert<float>(from), core::convert<float>(to - from),
                                     share * layer_.radii.stick_of(atom)},
                material_of(atom), atoms);
        };
        const bool is_whole = has(atoms[0]) && has(atoms[1]) &&
                              material_of(atoms[0]) == material_of(atoms[1]) &&
                              layer_.radii.stick_of(atoms[0]) == layer_.radii.stick_of(atoms[1]);
        if (is_whole) {
            add_part(a, b, atoms[0]);
            return;
        }
        const Vec3d middle = a + share_of_first(atoms, core::length(b - a)) * (b - a);
        if (has(atoms[0])) add_part(a, middle, atoms[0]);
        if (has(atoms[1])) add_part(middle, b, atoms[1]);
    }

    /// Adds dashes along the middle of a bond, on the inside of a ring.
    void add_dashes(const Bond& bond, const Vec3d& a, const Vec3d& b) {
        const AtomPair atoms = {atoms_.original(bond.a), atoms_.original(bond.b)};
        for (const auto& [from, to] : dashes_of(a, b)) {
            const Vec3d middle = 0.5 * (from + to);
            const bool is_first = core::dot(middle - a, b - a) < 0.5 * core::dot(b - a, b - a);
            const AtomIndex atom = atoms[is_first ? 0 : 1];
            if (!has(atom)) continue;
            add(core::CappedCylinder{core::convert<float>(from), core::convert<float>(to - from),
                                     share_of_stick * layer_.radii.stick_of(atom)},
                material_of(atom), atoms);
        }
    }

    double share_of_first(const AtomPair& atoms, double distance) const {
        if (!has(atoms[0]) || !has(atoms[1])) return 0.5; // another layer has the other half
        const auto larger =
            static_cast<double>(layer_.radii.of(atoms[0]) - layer_.radii.of(atoms[1]));
        return std::clamp(0.5 + 0.5 * larger / distance, 0.1, 0.9);
    }

    /// Finds up to two neighbours that each atom is bonded to. The atom itself stands for a missing
    /// one.
    void find_neighbours(const Structure& structure) {
        one_.resize(structure.size());
        another_.resize(structure.size());
        for (AtomIndex i = 0; i < one_.size(); ++i)
            one_[i] = another_[i] = i;
        const auto note = [&](AtomIndex atom, AtomIndex other) {
            if (one_[atom] == atom)
                one_[atom] = other;
            else if (another_[atom] == atom)
                another_[atom] = other;
        };
        // In a ring, the neighbours are those of the ring.
        for (const bool is_aromatic : {true, false})
            for (const Bond& bond : atoms_.bonds) {
                if ((bond.order == Bond::aromatic) != is_aromatic) continue;
                note(bond.a, bond.b);
                note(bond.b, bond.a);
            }
    }

    /// Returns a direction across a bond, of length 1, in the plane of an adjacent bond.
    Vec3d beside(const Structure& structure, const Bond& bond, const Vec3d& a,
                 const Vec3d& b) const {
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
                const Vec3d way = core::convert<double>(structure.positions[next]) -
                                  core::convert<double>(structure.positions[end]);
                if (const Vec3d side = across(way); side != Vec3d(0.0)) return side;
            }
        const Vec3d side = across({1, 0, 0});
        return side != Vec3d(0.0) ? side : across({0, 1, 0});
    }

    const DrawnAtoms& atoms_;
    const Structure& structure_;
    const AtomLayer& layer_;
    const std::string& file_;
    DrawnShapes& shapes_;
    Palette palette_;
    std::vector<AtomIndex> one_, another_;
    std::vector<std::size_t> ellipsoid_of_; // by atom: one above the index of its axes; 0: a ball
    std::vector<std::array<Vec3d, 3>> axes_;
};

} // namespace

bool AtomLayer::has(const DrawnAtoms& atoms, AtomIndex atom) const {
    return atoms.representations[atom] == representation &&
           (has_kind.empty() || has_kind[atoms.structure.kinds[atom]] != 0);
}

void add_layer(const DrawnAtoms& atoms, const AtomLayer& layer, const std::string& file,
               DrawnShapes& shapes) {
    LayerShapes(atoms, layer, file, shapes).add_all();
}

} // namespace raylane::scenes
