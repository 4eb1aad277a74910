#include "scenes/formats/structure/cartoon/shapes.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace raylane::scenes {

namespace {

using core::Vec3d;

constexpr double half_thickness = 0.25, box_margin = 0.3;
constexpr float rod_radius = 0.22F;

/// The rings' atoms of a nucleotide. Six are in the ring that all bases have, in its order.
struct Rings {
    std::array<AtomIndex, 6> six;
    std::array<AtomIndex, 3> other; ///< of purines: N7, C8, N9
    AtomIndex link = no_atom;       ///< bonded to the sugar: N9, N1, or C5 of pseudouridine
};

std::optional<Rings> rings_of(const Structure& structure, const BackboneResidue& residue) {
    constexpr std::array<std::string_view, 9> names = {"N1", "C2", "N3", "C4", "C5",
                                                       "C6", "N7", "C8", "N9"};
    std::array<AtomIndex, 9> atoms{};
    atoms.fill(no_atom);
    for (AtomIndex atom = residue.first; atom <= residue.last; ++atom) {
        if (structure.residues[atom] != residue.residue) continue;
        const auto found = std::find(names.begin(), names.end(), structure.names[atom]);
        if (found != names.end()) atoms[static_cast<std::size_t>(found - names.begin())] = atom;
    }
    Rings rings{};
    std::copy_n(atoms.begin(), 6, rings.six.begin());
    std::copy_n(atoms.begin() + 6, 3, rings.other.begin());
    if (std::count(rings.six.begin(), rings.six.end(), no_atom) > 0) return std::nullopt;
    rings.link = rings.other[2] != no_atom                             ? rings.other[2]
                 : structure.of_residue[residue.residue].name == "PSU" ? rings.six[4]
                                                                       : rings.six[0];
    return rings;
}

class Bases {
  public:
    Bases(const Structure& structure, const Path& path, const AddShape& add)
        : structure_(structure), curve_(path), add_(add) {}

    /// Adds a base, and returns true, unless it lacks atoms. `index` is that of its residue in the
    /// path.
    bool add(const BackboneResidue& residue, std::size_t index) const {
        const std::optional<Rings> rings = rings_of(structure_, residue);
        const AtomIndex atom = residue.guide();
        if (rings) add_box(*rings, atom);
        if (!rings && !residue.has(BackboneAtom::c1)) return false;
        Vec3d from =
            place(residue.has(BackboneAtom::c1) ? residue.atom(BackboneAtom::c1) : rings->link);
        const Vec3d base = rings ? place(rings->link) : from;
        add_rod(nearest_on_path(from, index), from, atom);
        add_rod(from, base, atom);
        add_(core::Sphere{core::convert<float>(from), rod_radius}, atom);
        return rings.has_value();
    }

  private:
    Vec3d place(AtomIndex atom) const { return core::convert<double>(structure_.positions[atom]); }

    Vec3d nearest_on_path(const Vec3d& to, std::size_t index) const {
        constexpr int steps = 16;
        Vec3d nearest = curve_.point(static_cast<double>(index));
        for (int step = 1; step <= steps; ++step) {
            const double s = static_cast<double>(index) + static_cast<double>(step) / steps;
            if (s > curve_.end()) break;
            const Vec3d point = curve_.point(s);
            if (core::squared_length(point - to) < core::squared_length(nearest - to))
                nearest = point;
        }
        return nearest;
    }

    void add_rod(const Vec3d& from, const Vec3d& to, AtomIndex atom) const {
        const auto axis = core::convert<float>(to - from);
        if (axis != core::Vec3f(0.0F))
            add_(core::CappedCylinder{core::convert<float>(from), axis, rod_radius}, atom);
    }

    /// Adds the box in the plane of the ring of six, with one side along the bond to the sugar.
    void add_box(const Rings& rings, AtomIndex atom) const {
        Vec3d middle(0.0), normal(0.0);
        for (std::size_t k = 0; k < rings.six.size(); ++k) {
            const Vec3d from = place(rings.six[k]) - place(rings.six[0]);
            const Vec3d to = place(rings.six[(k + 1) % rings.six.size()]) - place(rings.six[0]);
            middle += 1.0 / 6.0 * place(rings.six[k]);
            normal += core::cross(from, to);
        }
        const double area = core::length(normal);
        if (!(area > 0.0)) return;
        normal = 1.0 / area * normal;
        const Vec3d link = place(rings.link);
        Vec3d along = middle - link;
        along -= core::dot(along, normal) * normal;
        const double size = core::length(along);
        if (!(size > 0.0)) return;
        along = 1.0 / size * along;
        const Vec3d aside = core::cross(normal, along);
        Vec3d least(0.0, 0.0, -half_thickness), most(0.0, 0.0, half_thickness);
        const auto include = [&](AtomIndex ring_atom) {
            if (ring_atom == no_atom) return;
            const Vec3d way = place(ring_atom) - middle;
            const double x = core::dot(way, along), y = core::dot(way, aside);
            least = {std::min(least.x, x), std::min(least.y, y), least.z};
            most = {std::max(most.x, x), std::max(most.y, y), most.z};
        };
        std::for_each(rings.six.begin(), rings.six.end(), include);
        std::for_each(rings.other.begin(), rings.other.end(), include);
        least -= Vec3d(box_margin, box_margin, 0.0);
        most += Vec3d(box_margin, box_margin, 0.0);
        const Vec3d corner = middle + least.x * along + least.y * aside + least.z * normal;
        add_(core::Box{core::convert<float>(corner),
                       core::convert<float>((most.x - least.x) * along),
                       core::convert<float>((most.y - least.y) * aside),
                       core::convert<float>((most.z - least.z) * normal)},
             atom);
    }

    const Structure& structure_;
    Curve curve_;
    const AddShape& add_;
};

} // namespace

std::size_t add_bases(const Structure& structure, const Segment& segment, const Path& path,
                      const IsDrawn& is_drawn, const AddShape& add) {
    const Bases bases(structure, path, add);
    std::size_t missing = 0;
    for (std::size_t i = 0; i < segment.size(); ++i)
        if (is_drawn(segment[i].guide()) && !bases.add(segment[i], i)) ++missing;
    return missing;
}

} // namespace raylane::scenes
