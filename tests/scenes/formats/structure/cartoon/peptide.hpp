#pragma once

#include "scenes/formats/structure/structure.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

/// Proteins for tests.
namespace raylane::tests {

using core::Vec3d;

/// The places of a residue's N, CA, C and O.
using BackbonePlaces = std::array<Vec3d, 4>;

/// Returns the place of an atom that is bonded to `c`, by its distance, angle and torsion, in
/// degrees.
inline Vec3d bonded_to(const Vec3d& a, const Vec3d& b, const Vec3d& c, double distance,
                       double angle, double torsion) {
    constexpr double degree = 3.14159265358979323846 / 180.0;
    const Vec3d along = core::normalized(Vec3d(c - b));
    const Vec3d normal = core::normalized(core::cross(Vec3d(b - a), along));
    const Vec3d aside = core::cross(normal, along);
    const double sine = std::sin(angle * degree);
    return c + distance *
                   (-std::cos(angle * degree) * along + sine * std::cos(torsion * degree) * aside +
                    sine * std::sin(torsion * degree) * normal);
}

/// Returns a chain with the bond lengths and angles of Engh and Huber, by the torsions phi and psi
/// of its residues in degrees.
inline std::vector<BackbonePlaces>
chain_of(const std::vector<std::pair<double, double>>& torsions) {
    std::vector<BackbonePlaces> chain;
    for (std::size_t i = 0; i < torsions.size(); ++i) {
        BackbonePlaces at{Vec3d(0, 0, 0), Vec3d(1.458, 0, 0), Vec3d(2.0045, 1.4237, 0)};
        if (i > 0) {
            const auto& [n, ca, c, o] = chain.back();
            at[0] = bonded_to(n, ca, c, 1.329, 117.2, torsions[i - 1].second);
            at[1] = bonded_to(ca, c, at[0], 1.458, 121.7, 180);
            at[2] = bonded_to(c, at[0], at[1], 1.525, 111, torsions[i].first);
        }
        at[3] = bonded_to(at[0], at[1], at[2], 1.231, 120.1, torsions[i].second + 180);
        chain.push_back(at);
    }
    return chain;
}

/// Appends a chain of alanine to a structure, with numbers from 1.
inline void append_chain(scenes::Structure& structure, const std::vector<BackbonePlaces>& places,
                         const std::string& name = "A") {
    using namespace scenes;
    structure.of_kind = {{"N", 7}, {"C", 6}, {"O", 8}};
    structure.chains.push_back(name);
    for (const BackbonePlaces& places_of_residue : places) {
        const auto number = static_cast<int>(structure.of_residue.size()) + 1;
        structure.of_residue.push_back(
            {.name = "ALA",
             .number = number,
             .chain = static_cast<std::uint32_t>(structure.chains.size() - 1)});
        constexpr const char* names[] = {"N", "CA", "C", "O"};
        constexpr std::uint16_t kinds[] = {0, 1, 1, 2};
        for (std::size_t k = 0; k < 4; ++k) {
            structure.positions.push_back(core::convert<float>(places_of_residue[k]));
            structure.kinds.push_back(kinds[k]);
            structure.names.emplace_back(names[k]);
            structure.residues.push_back(
                static_cast<std::uint32_t>(structure.of_residue.size() - 1));
        }
    }
}

inline scenes::Structure peptide_of(const std::vector<BackbonePlaces>& places) {
    scenes::Structure structure;
    append_chain(structure, places);
    return structure;
}

/// Removes the atoms for which `test` (name, number of the residue) is true.
template <class Test>
void remove_atoms(scenes::Structure& structure, const Test& test) {
    scenes::Structure kept = structure;
    kept.positions.clear();
    kept.kinds.clear();
    kept.names.clear();
    kept.residues.clear();
    for (std::size_t i = 0; i < structure.size(); ++i) {
        const std::uint32_t residue = structure.residues[i];
        if (test(structure.names[i], structure.of_residue[residue].number)) continue;
        kept.positions.push_back(structure.positions[i]);
        kept.kinds.push_back(structure.kinds[i]);
        kept.names.push_back(structure.names[i]);
        kept.residues.push_back(residue);
    }
    structure = kept;
}

using Torsions = std::vector<std::pair<double, double>>;
inline Torsions alpha(std::size_t count) {
    return Torsions(count, {-57, -47});
}
inline Torsions extended(std::size_t count) {
    return Torsions(count, {-120, 130});
}

/// Residues 43 to 58 of chain A of 1HVR, a hairpin.
inline const std::vector<BackbonePlaces>& hairpin() {
    static const std::vector<BackbonePlaces> places = {
        {{Vec3d(-3.225, 13.315, 48.716), Vec3d(-3.765, 11.962, 48.572),
          Vec3d(-3.549, 11.473, 47.134), Vec3d(-3.679, 12.249, 46.201)}},
        {{Vec3d(-3.179, 10.194, 46.943), Vec3d(-3.154, 9.629, 45.568), Vec3d(-4.54, 9.488, 44.965),
          Vec3d(-5.488, 9.108, 45.639)}},
        {{Vec3d(-4.636, 9.799, 43.69), Vec3d(-5.922, 9.717, 43.025), Vec3d(-5.553, 9.277, 41.644),
          Vec3d(-4.431, 9.51, 41.222)}},
        {{Vec3d(-6.468, 8.636, 40.938), Vec3d(-6.245, 8.475, 39.498), Vec3d(-7.324, 9.162, 38.733),
          Vec3d(-8.465, 9.196, 39.162)}},
        {{Vec3d(-6.965, 9.699, 37.597), Vec3d(-8.033, 10.262, 36.809), Vec3d(-7.951, 9.7, 35.432),
          Vec3d(-6.893, 9.252, 35.015)}},
        {{Vec3d(-9.078, 9.709, 34.737), Vec3d(-9.052, 9.165, 33.383), Vec3d(-9.348, 10.198, 32.305),
          Vec3d(-10.179, 11.083, 32.453)}},
        {{Vec3d(-8.65, 10.06, 31.218), Vec3d(-8.789, 11.026, 30.14), Vec3d(-8.981, 10.298, 28.866),
          Vec3d(-9.414, 9.158, 28.849)}},
        {{Vec3d(-8.616, 10.95, 27.786), Vec3d(-8.884, 10.28, 26.531), Vec3d(-8.205, 8.951, 26.379),
          Vec3d(-8.806, 7.963, 25.958)}},
        {{Vec3d(-6.921, 8.946, 26.736), Vec3d(-6.227, 7.694, 26.433), Vec3d(-6.049, 6.734, 27.617),
          Vec3d(-5.392, 5.715, 27.5)}},
        {{Vec3d(-6.592, 7.067, 28.772), Vec3d(-6.361, 6.126, 29.843), Vec3d(-6.294, 6.85, 31.139),
          Vec3d(-6.822, 7.94, 31.254)}},
        {{Vec3d(-5.667, 6.219, 32.104), Vec3d(-5.666, 6.761, 33.458), Vec3d(-4.315, 7.291, 33.811),
          Vec3d(-3.295, 6.719, 33.459)}},
        {{Vec3d(-4.311, 8.386, 34.547), Vec3d(-3.046, 8.779, 35.168), Vec3d(-3.246, 8.81, 36.687),
          Vec3d(-4.358, 8.988, 37.181)}},
        {{Vec3d(-2.117, 8.639, 37.393), Vec3d(-2.083, 8.793, 38.852), Vec3d(-1.566, 10.161, 39.27),
          Vec3d(-0.51, 10.626, 38.865)}},
        {{Vec3d(-2.381, 10.814, 40.077), Vec3d(-2.069, 12.175, 40.493),
          Vec3d(-2.082, 12.284, 42.022), Vec3d(-2.613, 11.424, 42.716)}},
        {{Vec3d(-1.507, 13.368, 42.535), Vec3d(-1.664, 13.688, 43.964),
          Vec3d(-2.664, 14.805, 44.157), Vec3d(-2.518, 15.858, 43.574)}},
        {{Vec3d(-3.665, 14.561, 44.954), Vec3d(-4.652, 15.551, 45.304),
          Vec3d(-4.147, 16.352, 46.465), Vec3d(-3.863, 15.794, 47.514)}},
    };
    return places;
}

} // namespace raylane::tests
