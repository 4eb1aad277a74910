#include "scenes/formats/structure/cartoon/secondary_structure.hpp"

#include "core/numbers/elementary.hpp"
#include "scenes/formats/structure/cartoon/bridges.hpp"
#include "scenes/formats/structure/cartoon/hydrogen_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace raylane::scenes {

namespace {

using core::Vec3d;

bool is_complete(const BackboneResidue& residue) {
    using enum BackboneAtom;
    return residue.polymer == Polymer::peptide && residue.has(n) && residue.has(ca) &&
           residue.has(c) && residue.has(o);
}

bool is_mostly_complete(const Segment& segment) {
    return 2 * static_cast<std::size_t>(
                   std::count_if(segment.begin(), segment.end(), is_complete)) >=
           segment.size();
}

/// The residues of all segments that have the atoms of hydrogen bonds.
struct Peptides {
    std::vector<PeptideAtoms> atoms;
    std::vector<std::uint32_t> residues; ///< index
    std::vector<std::size_t> piece;      ///< number of the piece without a break
};

Peptides peptides_of(const Structure& structure, const Backbone& backbone) {
    Peptides peptides;
    const auto at = [&](AtomIndex atom) {
        return core::convert<double>(structure.positions[atom]);
    };
    std::size_t piece = 0;
    for (const Segment& segment : backbone.segments) {
        bool follows = false;
        for (const BackboneResidue& residue : segment) {
            if (!is_complete(residue)) {
                follows = false;
                continue;
            }
            using enum BackboneAtom;
            peptides.atoms.push_back({at(residue.atom(n)), at(residue.atom(ca)),
                                      at(residue.atom(c)), at(residue.atom(o)),
                                      structure.of_residue[residue.residue].name == "PRO",
                                      follows});
            peptides.residues.push_back(residue.residue);
            peptides.piece.push_back(follows ? piece : ++piece);
            follows = true;
        }
    }
    return peptides;
}

/// Assigns helices of three kinds to a list of residues.
class Helices {
  public:
    enum class Kind : std::uint8_t { none, bridge, strand, three_ten, alpha, pi };

    Helices(const HydrogenBonds& bonds, const std::vector<std::size_t>& piece,
            std::vector<Kind>& kinds)
        : bonds_(bonds), piece_(piece), kinds_(kinds) {}

    void assign() {
        add(Kind::alpha, 4, [](Kind) { return true; });
        add(Kind::three_ten, 3, [](Kind is) { return is == Kind::none || is == Kind::three_ten; });
        add(Kind::pi, 5,
            [](Kind is) { return is == Kind::none || is == Kind::pi || is == Kind::alpha; });
    }

  private:
    bool turns(std::size_t i, std::size_t length) const {
        return i + length < piece_.size() && piece_[i] == piece_[i + length] &&
               bonds_.has(i + length, i);
    }

    /// Two turns in sequence make a helix between their ends, where `may_replace` is true of all.
    template <class Test>
    void add(Kind kind, std::size_t length, const Test& may_replace) {
        for (std::size_t i = 1; i + length < piece_.size(); ++i) {
            if (!turns(i, length) || !turns(i - 1, length)) continue;
            const std::span range = std::span(kinds_).subspan(i, length);
            if (std::all_of(range.begin(), range.end(), may_replace))
                std::fill(range.begin(), range.end(), kind);
        }
    }

    const HydrogenBonds& bonds_;
    const std::vector<std::size_t>& piece_;
    std::vector<Kind>& kinds_;
};

void assign_by_hydrogen_bonds(const Structure& structure, const Backbone& backbone,
                              std::vector<Secondary>& secondary) {
    using Kind = Helices::Kind;
    const Peptides peptides = peptides_of(structure, backbone);
    if (peptides.atoms.empty()) return;
    const HydrogenBonds bonds(peptides.atoms);
    std::vector<Kind> kinds(peptides.atoms.size(), Kind::none);
    for (const Strand& strand : strands_of(bonds, peptides.piece))
        for (std::size_t i = strand.first; i <= strand.last; ++i)
            if (kinds[i] != Kind::strand) kinds[i] = strand.is_single ? Kind::bridge : Kind::strand;
    Helices(bonds, peptides.piece, kinds).assign();
    for (std::size_t i = 0; i < kinds.size(); ++i)
        secondary[peptides.residues[i]] = kinds[i] == Kind::strand      ? Secondary::strand
                                          : kinds[i] >= Kind::three_ten ? Secondary::helix
                                                                        : Secondary::coil;
}

/// Distances, angles and torsions of CA, in angstrom and degrees, as ranges around a middle.
struct AlphaCarbonRanges {
    double to_third, to_third_by;   ///< distance of the first to the third, and its tolerance
    double to_fourth, to_fourth_by; ///< to the fourth
    double to_fifth, to_fifth_by;   ///< to the fifth
    double angle, angle_by;
    double torsion, torsion_by;
};
/// Table 1 of P-SEA.
constexpr AlphaCarbonRanges of_helix = {5.5, 0.5, 5.3, 0.5, 6.4, 0.6, 89, 12, 50, 20};
constexpr AlphaCarbonRanges of_strand = {6.7, 0.6, 9.9, 0.9, 12.4, 1.1, 124, 14, -170, 45};

/// Assigns helices and strands to a chain of CA.
class AlphaCarbons {
  public:
    explicit AlphaCarbons(std::vector<Vec3d> points) : points_(std::move(points)) {}

    std::vector<Secondary> assign() {
        result_.assign(points_.size(), Secondary::coil);
        assign(Secondary::helix, of_helix, 5);
        assign(Secondary::strand, of_strand, 4);
        return result_;
    }

  private:
    static bool is_near(double value, double middle, double by) {
        return std::abs(value - middle) <= by;
    }
    double distance(std::size_t i, std::size_t j) const {
        return core::length(points_[j] - points_[i]);
    }

    /// Returns true if five residues from i on have the distances, or the angles, of a kind.
    bool fits(std::size_t i, const AlphaCarbonRanges& ranges) const {
        const bool are_near = is_near(distance(i, i + 2), ranges.to_third, ranges.to_third_by) &&
                              is_near(distance(i, i + 3), ranges.to_fourth, ranges.to_fourth_by);
        const bool is_last = i + 4 >= points_.size();
        return (are_near &&
                (is_last || is_near(distance(i, i + 4), ranges.to_fifth, ranges.to_fifth_by))) ||
               (is_turned(i, ranges) && (is_last || is_turned(i + 1, ranges)));
    }

    /// Compares the angle of three CA and the torsion of four.
    bool is_turned(std::size_t i, const AlphaCarbonRanges& ranges) const {
        const Vec3d u = points_[i + 1] - points_[i], v = points_[i + 2] - points_[i + 1],
                    w = points_[i + 3] - points_[i + 2];
        const Vec3d a = core::cross(u, v), b = core::cross(v, w);
        const double sizes = core::length(a) * core::length(b);
        const double sides = core::length(u) * core::length(v);
        if (!(sizes > 0.0) || !(sides > 0.0)) return false;
        constexpr double degree = 0x1.1df46a2529d39p-6;
        // The cosine of a difference from the middle is large where the difference is small.
        const double cosine = core::dot(a, b) / sizes;
        const double sine = core::dot(core::cross(a, b), v) / (sizes * core::length(v));
        const double torsion_fits =
            cosine * core::cos(ranges.torsion * degree) + sine * core::sin(ranges.torsion * degree);
        const double angle = -core::dot(u, v) / sides;
        return torsion_fits >= core::cos(ranges.torsion_by * degree) &&
               angle <= core::cos((ranges.angle - ranges.angle_by) * degree) &&
               angle >= core::cos((ranges.angle + ranges.angle_by) * degree);
    }

    /// Assigns a kind to runs of at least `least` residues.
    void assign(Secondary kind, const AlphaCarbonRanges& ranges, std::size_t least) {
        for (std::size_t i = 0; i + 3 < points_.size();) {
            std::size_t end = i;
            while (end + 3 < points_.size() && fits(end, ranges))
                ++end;
            const std::size_t count = end == i ? 0 : end + 3 - i;
            if (count >= least)
                for (std::size_t k = i; k < i + count; ++k)
                    if (result_[k] == Secondary::coil) result_[k] = kind;
            i = end + 1;
        }
    }

    std::vector<Vec3d> points_;
    std::vector<Secondary> result_;
};

} // namespace

std::vector<Secondary> secondary_structure(const Structure& structure, const Backbone& backbone) {
    std::vector<Secondary> secondary(structure.of_residue.size(), Secondary::coil);
    if (structure.has_secondary) {
        for (const Segment& segment : backbone.segments)
            for (const BackboneResidue& residue : segment)
                if (residue.polymer == Polymer::peptide)
                    secondary[residue.residue] = structure.of_residue[residue.residue].secondary;
        return secondary;
    }
    assign_by_hydrogen_bonds(structure, backbone, secondary);
    for (const Segment& segment : backbone.segments) {
        if (segment[0].polymer != Polymer::peptide || is_mostly_complete(segment)) continue;
        std::vector<Vec3d> points;
        for (const BackboneResidue& residue : segment)
            points.push_back(core::convert<double>(structure.positions[residue.guide()]));
        const std::vector<Secondary> of_points = AlphaCarbons(std::move(points)).assign();
        for (std::size_t i = 0; i < segment.size(); ++i)
            secondary[segment[i].residue] = of_points[i];
    }
    return secondary;
}

} // namespace raylane::scenes
