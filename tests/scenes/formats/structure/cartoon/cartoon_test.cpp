#include "core/shapes/triangle.hpp"
#include "scenes/formats/polygon.hpp"
#include "scenes/formats/structure/cartoon/cartoon.hpp"
#include "scenes/formats/structure/cartoon/path.hpp"
#include "scenes/formats/structure/cartoon/shapes.hpp"
#include "tests/scenes/formats/structure/cartoon/peptide.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"

#include <algorithm>
#include <map>
#include <tuple>

using namespace raylane::scenes;
using namespace raylane::tests;
using raylane::core::Box;
using raylane::core::CappedCylinder;
using raylane::core::SmoothTriangle;
using raylane::core::Sphere;
using raylane::core::Vec3d;
using raylane::core::Vec3f;
using raylane::ray_sets::Random;

namespace {

/// The shapes of a drawing, by type.
struct Shapes {
    std::vector<SmoothTriangle> triangles;
    std::vector<Sphere> spheres;
    std::vector<CappedCylinder> cylinders;
    std::vector<Box> boxes;
    std::vector<AtomIndex> atoms; ///< of all

    void add(const CartoonShape& shape, AtomIndex atom) {
        atoms.push_back(atom);
        if (const auto* piece = std::get_if<RibbonPiece>(&shape))
            triangles.insert(triangles.end(), piece->begin(), piece->end());
        if (const auto* sphere = std::get_if<Sphere>(&shape)) spheres.push_back(*sphere);
        if (const auto* cylinder = std::get_if<CappedCylinder>(&shape))
            cylinders.push_back(*cylinder);
        if (const auto* box = std::get_if<Box>(&shape)) boxes.push_back(*box);
    }
    std::size_t count() const { return atoms.size(); }
};

bool everything(AtomIndex) {
    return true;
}

Shapes drawn(const Structure& structure, const ChainLook& look = {},
             const IsDrawn& is_drawn = everything, ChainRemainder* rest = nullptr) {
    Shapes shapes;
    const ChainRemainder remainder =
        add_chains(structure, look, is_drawn,
                   [&](const CartoonShape& shape, AtomIndex atom) { shapes.add(shape, atom); });
    if (rest != nullptr) *rest = remainder;
    return shapes;
}

using Key = std::tuple<float, float, float>;
Key key_of(const Vec3f& at) {
    return {at.x + 0.0F, at.y + 0.0F, at.z + 0.0F};
}

/// Returns the number of edges that are not edges of another triangle in the opposite direction.
std::size_t open_edges(const std::vector<SmoothTriangle>& triangles) {
    std::map<std::pair<Key, Key>, int> balance;
    for (const SmoothTriangle& t : triangles)
        for (const auto& [from, to] : {std::pair(t.a, t.b), {t.b, t.c}, {t.c, t.a}}) {
            const Key a = key_of(from), b = key_of(to);
            if (a < b)
                ++balance[{a, b}];
            else
                --balance[{b, a}];
        }
    return static_cast<std::size_t>(std::count_if(
        balance.begin(), balance.end(), [](const auto& entry) { return entry.second != 0; }));
}

/// Returns a chain with random torsions of all secondary structures.
Torsions random_torsions(Random& random, std::size_t count) {
    Torsions torsions;
    while (torsions.size() < count) {
        const int kind = random.integer(0, 2);
        for (int k = random.integer(2, 9); k > 0; --k)
            torsions.emplace_back(
                kind == 0   ? std::pair(-57.0, -47.0)
                : kind == 1 ? std::pair(-120.0, 130.0)
                            : std::pair(random.uniform(-160, -50), random.uniform(-60, 170)));
    }
    return torsions;
}

Structure with_random_classes(Random& random) {
    Structure structure = peptide_of(chain_of(random_torsions(random, 40)));
    structure.has_secondary = true;
    for (std::size_t i = 0; i < structure.of_residue.size();) {
        const auto kind = static_cast<Secondary>(random.integer(0, 2));
        for (int k = random.integer(1, 9); k > 0 && i < structure.of_residue.size(); --k)
            structure.of_residue[i++].secondary = kind;
    }
    return structure;
}

void set_all(Structure& structure, Secondary secondary) {
    structure.has_secondary = true;
    for (Residue& residue : structure.of_residue)
        residue.secondary = secondary;
}

} // namespace

TEST_CASE("ribbons have no gaps and no flipped normals") {
    Random random(7);
    for (int round = 0; round < 20; ++round) {
        const Shapes of_any_class = drawn(with_random_classes(random));
        REQUIRE(!of_any_class.triangles.empty());
        // A tube that ends with a ball is open there: its profile has at most 48 edges.
        CHECK(open_edges(of_any_class.triangles) <= 48 * of_any_class.spheres.size());
        const Shapes shapes = drawn(peptide_of(chain_of(random_torsions(random, 40))));
        std::size_t flipped = 0;
        for (const SmoothTriangle& t : shapes.triangles) {
            const Vec3f flat = raylane::core::triangle_normal<float>(t);
            for (const Vec3f& normal : {t.normal_a, t.normal_b, t.normal_c})
                flipped += raylane::core::dot(flat, normal) < 0.0F ? 1 : 0;
        }
        CHECK(flipped * 200 <= shapes.triangles.size()); // in turns sharper than a ribbon is thick
    }
}

TEST_CASE("ribbons that planes cut are closed by faces") {
    Random random(11);
    for (int round = 0; round < 20; ++round) {
        const Structure structure = with_random_classes(random);
        std::vector<std::pair<Vec3d, double>> planes;
        for (int k = random.integer(1, 2); k > 0; --k) {
            const Vec3d normal(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            const auto& at = structure.positions[structure.positions.size() / 2];
            planes.emplace_back(normal,
                                raylane::core::dot(normal, raylane::core::convert<double>(at)));
        }
        std::vector<SmoothTriangle> triangles;
        std::size_t balls = 0, faces = 0;
        add_chains(structure, {}, everything, [&](const CartoonShape& shape, AtomIndex) {
            const auto* piece = std::get_if<RibbonPiece>(&shape);
            if (piece == nullptr) return static_cast<void>(++balls);
            std::vector<Polygon> body;
            for (const SmoothTriangle& triangle : *piece)
                body.push_back(polygon_of(triangle));
            for (const auto& [normal, offset] : planes) {
                body = clipped(body, normal, offset);
                for (const Polygon& polygon : body)
                    faces += polygon.front().normal == normal ? 1 : 0;
            }
            for (const SmoothTriangle& t : smooth_triangles_of(body))
                triangles.push_back(t);
        });
        CAPTURE(round, planes.size());
        CHECK(faces > 1);
        // A tube that ends with a ball is open there. Pieces in turns that are sharper than a
        // ribbon is wide are not convex.
        CHECK(open_edges(triangles) <= 48 * balls + 12);
    }
}

TEST_CASE("a helix at both ends of a chain is a closed surface") {
    Structure structure = peptide_of(chain_of(alpha(15)));
    set_all(structure, Secondary::helix);
    const Shapes shapes = drawn(structure);
    CHECK(shapes.spheres.empty());
    CHECK(open_edges(shapes.triangles) == 0);
    set_all(structure, Secondary::strand);
    CHECK(open_edges(drawn(structure).triangles) == 0);
}

TEST_CASE("normals of a round tube point away from its path") {
    Path path;
    for (int i = 0; i < 8; ++i)
        path.push_back({Vec3d(3.8 * i, 0, 0), Vec3d(0, 1, 0), 0});
    Shapes shapes;
    add_ribbon(path, {}, 0.01, everything,
               [&](const CartoonShape& shape, AtomIndex atom) { shapes.add(shape, atom); });
    REQUIRE(shapes.triangles.size() > 100);
    for (const SmoothTriangle& t : shapes.triangles)
        for (const auto& [at, normal] :
             {std::pair(t.a, t.normal_a), {t.b, t.normal_b}, {t.c, t.normal_c}}) {
            const Vec3f outward(0.0F, at.y / 0.22F, at.z / 0.22F);
            CHECK(raylane::core::length(Vec3f(outward - normal)) < 1e-6F);
        }
}

TEST_CASE("triangles are as near to a bent tube as asked for") {
    // A circle of the radius of a sharp turn.
    Path path;
    for (int i = 0; i < 12; ++i)
        path.push_back(
            {Vec3d(2.3 * std::cos(1.6 * i), 2.3 * std::sin(1.6 * i), 1.5 * i), Vec3d(0, 0, 1), 0});
    const Curve curve(path);
    for (const double max_error : {0.02, 0.005}) {
        Shapes shapes;
        add_ribbon(path, {}, max_error, everything,
                   [&](const CartoonShape& shape, AtomIndex atom) { shapes.add(shape, atom); });
        double worst = 0.0;
        for (std::size_t k = 0; k < shapes.triangles.size(); k += 3) {
            const SmoothTriangle& t = shapes.triangles[k];
            const auto middle = raylane::core::convert<double>(Vec3f(t.a + t.b + t.c)) / 3.0;
            double nearest = 1e9;
            for (double s = 0.0; s <= curve.end(); s += 0.002)
                nearest = std::min(nearest, raylane::core::length(Vec3d(curve.point(s) - middle)));
            worst = std::max(worst, std::abs(nearest - 0.22));
        }
        CHECK(worst < 2.0 * max_error); // both directions add up
        CHECK(worst > 0.1 * max_error);
    }
}

TEST_CASE("normals are those of the surface, from its derivatives") {
    Structure structure = peptide_of(chain_of(alpha(12)));
    set_all(structure, Secondary::helix);
    Path path = path_of_peptide(structure, backbone_of(structure).segments[0],
                                std::vector<Secondary>(12, Secondary::helix));
    smooth(path);
    const Curve curve(path);
    for (double s = 0.1; s < curve.end(); s += 0.37) {
        constexpr double step = 1e-5;
        const Frame frame = curve(s), before = curve(s - step), behind = curve(s + step);
        const auto slope = [&](Vec3d Frame::*member) {
            return Vec3d((behind.*member - before.*member) / (2.0 * step));
        };
        CHECK(raylane::core::length(Vec3d(slope(&Frame::at) - frame.by_at)) < 1e-6);
        CHECK(raylane::core::length(Vec3d(slope(&Frame::across) - frame.by_across)) < 1e-6);
        CHECK(raylane::core::length(Vec3d(slope(&Frame::up) - frame.by_up)) < 1e-6);
        CHECK(raylane::core::length(
                  Vec3d(raylane::core::cross(frame.along, frame.across) - frame.up)) < 1e-12);
    }
}

TEST_CASE("the ribbon of a helix is wide along the axis, and does not twist") {
    Structure structure = peptide_of(chain_of(alpha(22)));
    Path path = path_of_peptide(structure, backbone_of(structure).segments[0],
                                std::vector<Secondary>(22, Secondary::helix));
    smooth(path);
    // 18 residues are five turns.
    const Vec3d axis = raylane::core::normalized(Vec3d(path[19].at - path[1].at));
    const Curve curve(path);
    for (double s = 3.0; s < 18.0; s += 0.25)
        CHECK(std::abs(raylane::core::dot(curve(s).across, axis)) > 0.88);
}

TEST_CASE("half of a chain has the shape that it has in the whole chain") {
    Random random(3);
    const Structure structure = with_random_classes(random);
    const Shapes shapes = drawn(structure);
    const Shapes first = drawn(structure, {}, [](AtomIndex atom) { return atom < 80; });
    const Shapes second = drawn(structure, {}, [](AtomIndex atom) { return atom >= 80; });
    CHECK(std::all_of(first.atoms.begin(), first.atoms.end(), [](AtomIndex i) { return i < 80; }));
    // Only the faces at the cut are new.
    CHECK(first.count() + second.count() >= shapes.count());
    CHECK(first.count() + second.count() <= shapes.count() + 200);
    CHECK(open_edges(first.triangles) <= 48 * first.spheres.size());
}

TEST_CASE("residues that cannot be rendered are counted and named") {
    Structure structure = peptide_of(chain_of(alpha(12)));
    remove_atoms(structure, [](const std::string& name, int number) {
        return (number == 5 || number == 3) && name == "CA";
    });
    ChainRemainder rest;
    drawn(structure, {}, everything, &rest);
    CHECK(rest.drawn == 9);
    CHECK(rest.remark(structure) ==
          "3 residues could not be drawn, because CA, P or neighbours are missing: "
          "ALA 3 in chain A, ALA 4 in chain A, ALA 5 in chain A");
    CHECK(drawn(peptide_of(chain_of(alpha(5))), {}, everything, &rest).count() > 0);
    CHECK(rest.remark(structure).empty());
}

TEST_CASE("residues that are not in chains are named, except water") {
    Structure structure = peptide_of(chain_of(alpha(5)));
    for (const char* const name : {"LIG", "HOH"}) {
        structure.of_residue.push_back({.name = name, .number = 900, .is_hetero = true});
        structure.residues.push_back(static_cast<std::uint32_t>(structure.of_residue.size() - 1));
        structure.positions.emplace_back(30.0F);
        structure.kinds.push_back(0);
        structure.names.emplace_back("C1");
    }
    ChainRemainder rest;
    drawn(structure, {}, everything, &rest);
    CHECK(rest.remark(structure) ==
          "1 residue is not part of a chain, and is not drawn: LIG 900 in chain A");
    CHECK(rest.remark(structure, false).empty());
    drawn(
        structure, {}, [&](AtomIndex i) { return i + 2 < structure.size(); }, &rest);
    CHECK(rest.remark(structure).empty());
}

TEST_CASE("a break in a chain is a gap in each style") {
    Structure structure = peptide_of(chain_of(extended(20)));
    remove_atoms(structure, [](const std::string&, int number) { return number == 10; });
    const auto gap = raylane::core::convert<double>(structure.positions[35]); // O of residue 9
    for (const ChainStyle style : {ChainStyle::cartoon, ChainStyle::tube, ChainStyle::trace}) {
        const Shapes shapes = drawn(structure, {.style = style});
        const Vec3d middle = 0.5 * (raylane::core::convert<double>(structure.positions[33]) +
                                    raylane::core::convert<double>(structure.positions[37]));
        double nearest = 1e9;
        const auto meet = [&](const Vec3f& at) {
            nearest = std::min(
                nearest, raylane::core::length(Vec3d(raylane::core::convert<double>(at) - middle)));
        };
        for (const SmoothTriangle& t : shapes.triangles)
            meet(t.a);
        for (const Sphere& sphere : shapes.spheres)
            meet(sphere.center);
        CHECK(nearest > 2.5);
        CHECK(raylane::core::length(gap) > 0.0);
    }
}

TEST_CASE("tubes bend by less than five degrees at a time, and traces are straight") {
    const Structure structure = peptide_of(chain_of(alpha(12)));
    const Shapes tube = drawn(structure, {.style = ChainStyle::tube, .radius = 0.7F});
    CHECK(tube.triangles.empty());
    CHECK(tube.spheres.size() == tube.cylinders.size() + 1);
    for (std::size_t k = 1; k < tube.cylinders.size(); ++k) {
        const auto a =
            raylane::core::normalized(raylane::core::convert<double>(tube.cylinders[k - 1].axis));
        const auto b =
            raylane::core::normalized(raylane::core::convert<double>(tube.cylinders[k].axis));
        CHECK(raylane::core::dot(a, b) > 0.996);
        CHECK(tube.cylinders[k].radius == 0.7F);
    }
    const Shapes trace = drawn(structure, {.style = ChainStyle::trace});
    CHECK(trace.cylinders.size() == 2 * 11);
    CHECK(trace.spheres.size() == 2 * 11 + 1);
}

TEST_CASE("cylinders stand for helices, bent ones for several") {
    Structure structure = peptide_of(chain_of(alpha(16)));
    set_all(structure, Secondary::helix);
    const Shapes shapes = drawn(structure, {.cylinders = true});
    CHECK(shapes.triangles.empty());
    REQUIRE(!shapes.cylinders.empty());
    double length = 0.0;
    for (const CappedCylinder& cylinder : shapes.cylinders)
        length += raylane::core::length(raylane::core::convert<double>(cylinder.axis));
    CHECK(length > 15 * 1.4);
    CHECK(length < 15 * 1.6);                     // 1.5 angstrom per residue
    for (const Vec3f& at : structure.positions) { // all around the axis
        const CappedCylinder& first = shapes.cylinders.front();
        const auto axis = raylane::core::normalized(raylane::core::convert<double>(first.axis));
        const auto way = raylane::core::convert<double>(Vec3f(at - first.base));
        CHECK(raylane::core::length(Vec3d(way - raylane::core::dot(way, axis) * axis)) < 4.0);
    }
}

TEST_CASE("cartoons take coinciding atoms and coordinates far away") {
    for (const float far : {0.0F, 1e6F, 1e20F, 1e30F}) {
        Structure structure = peptide_of(chain_of(alpha(12)));
        for (Vec3f& at : structure.positions)
            at.x = far == 0.0F ? 0.0F : at.x + far;
        for (const ChainLook& look :
             {ChainLook{}, ChainLook{.cylinders = true}, ChainLook{.style = ChainStyle::tube}}) {
            set_all(structure, Secondary::helix);
            for (const SmoothTriangle& t : drawn(structure, look).triangles)
                CHECK(raylane::core::length(t.normal_a) > 0.5F);
        }
    }
    Structure point = peptide_of(std::vector<BackbonePlaces>(6, BackbonePlaces{}));
    for (const SmoothTriangle& t : drawn(point).triangles)
        CHECK(raylane::core::length(t.normal_a) > 0.5F);
    CHECK(drawn(point, {.style = ChainStyle::tube}).cylinders.empty());
}
