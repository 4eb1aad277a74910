#include "core/reference/search.hpp"
#include "core/scene/transfer.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/formats/structure/cell_layer.hpp"
#include "scenes/formats/structure/crystal.hpp"
#include "scenes/formats/structure/displacement.hpp"
#include "scenes/formats/structure/drawing_options.hpp"
#include "scenes/formats/structure/ortep.hpp"
#include "scenes/formats/structure/polyhedra_layer.hpp"
#include "tests/places.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/formats/structure/frames.hpp"
#include "tests/scenes/formats/structure/structures.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

/// Tests of crystals as they are drawn: their cells, polyhedra, axes and ellipsoids.
using namespace raylane::scenes;
using namespace raylane::tests;
using raylane::core::Vec3d;
using raylane::core::Vec3f;

namespace {

/// Returns extended XYZ of atoms in a cubic cell.
std::string cubic(const std::string& edge, const std::string& atoms, const char* pbc = "T T T") {
    std::string text =
        std::to_string(std::count(atoms.begin(), atoms.end(), '\n')) + "\nLattice=\"";
    text += edge + " 0 0 0 " + edge + " 0 0 0 " + edge + "\" pbc=\"" + pbc + "\"\n";
    return text + atoms;
}

const std::string salt =
    cubic("5.64", "Na 0 0 0\nNa 0 2.82 2.82\nNa 2.82 0 2.82\nNa 2.82 2.82 0\n"
                  "Cl 2.82 0 0\nCl 0 2.82 0\nCl 0 0 2.82\nCl 2.82 2.82 2.82\n");
const std::string perovskite =
    cubic("3.9", "Sr 0 0 0\nTi 1.95 1.95 1.95\nO 1.95 1.95 0\nO 1.95 0 1.95\nO 0 1.95 1.95\n");
const std::string dioxide = cubic("6", "O 5.5 3 3\nC 0.2 3 3\nO 1.4 3 3\nXe 0 0 0\n");

struct Drawn {
    raylane::core::Scene scene;
    Legend legend;
    std::vector<std::string> remarks;

    /// Returns the shapes of a kind whose legend begins with a text.
    template <class Shape>
    auto all(const std::string& begin = "") const {
        std::vector<raylane::core::InDouble<Shape>> found;
        raylane::core::for_each_shape(std::get<raylane::core::Table<Shape>>(scene.shapes()),
                                      [&](const auto& shape, raylane::core::ShapeId id) {
                                          if (legend.of(id).starts_with(begin))
                                              found.push_back(shape);
                                      });
        return found;
    }
    /// Returns how many balls each element has.
    std::string balls() const {
        std::map<std::string, int> counts;
        raylane::core::for_each_shape(
            std::get<raylane::core::Table<raylane::core::Sphere>>(scene.shapes()),
            [&](const auto& sphere, raylane::core::ShapeId id) {
                const std::string text = legend.of(id);
                if (text.starts_with("atom") && sphere.radius > 0.03) // no corners of polyhedra
                    ++counts[text.substr(text.find('(') + 1, 2)];
            });
        std::string result;
        for (const auto& [name, count] : counts)
            result += name.substr(0, name.find(')')) + std::to_string(count) + " ";
        return result;
    }
};

Drawn drawn(const std::string& text, const std::function<void(Drawing&)>& change = {}) {
    Drawn result{raylane::core::SceneBuilder().build(), {}, {}};
    LoadOptions options;
    options.legend = &result.legend;
    options.on_remark = [&](const std::string& remark) { result.remarks.push_back(remark); };
    options.drawing.style = Style::spheres;
    if (change) change(options.drawing);
    result.scene = parse_scene("a.xyz", text, options);
    return result;
}

/// Returns the volume inside of faces, by the divergence theorem: positive if all of them are
/// counter-clockwise from outside.
double volume_of(const std::vector<Vec3d>& points,
                 const std::vector<std::vector<std::size_t>>& faces) {
    double volume = 0.0;
    for (const auto& face : faces)
        for (std::size_t k = 1; k + 1 < face.size(); ++k)
            volume +=
                raylane::core::dot(points[face[0]],
                                   raylane::core::cross(points[face[k]], points[face[k + 1]])) /
                6.0;
    return volume;
}

} // namespace

TEST_CASE("atoms on faces, edges and corners of a crystal's cell are on all of them") {
    CHECK(drawn(salt).balls() == "Cl13 Na14 ");
    CHECK(drawn(salt, [](Drawing& d) { d.boundary = false; }).balls() == "Cl4 Na4 ");
    CHECK(drawn(salt, [](Drawing& d) { d.repeat = {2, 1, 1}; }).balls() == "Cl22 Na23 ");
    CHECK(drawn(salt, [](Drawing& d) { d.boundary = d.whole = false; }).balls() == "Cl4 Na4 ");
    CHECK(drawn(cubic("5", "Na 4.99 2 2\n")).balls() == "Na2 "); // within 0.05 of a face
    CHECK(drawn(cubic("5", "Na 4.9 2 2\n")).balls() == "Na1 ");
    CHECK(drawn(cubic("5", "Na 5 -5 -2.5\n")).balls() == "Na4 "); // atoms beyond the cell
    CHECK(drawn(cubic("5", "Na 0 0 0\n", "T T F")).balls() == "Na4 ");
    CHECK(drawn(cubic("5", "Na 0 0 0\n", "T F F")).balls() == "Na1 "); // a chain is no crystal
    CHECK(drawn(cubic("5", "Na 0 0 0\n", "T F F"), [](Drawing& d) { d.boundary = true; }).balls() ==
          "Na2 ");
}

TEST_CASE("a crystal's molecules are whole, and its networks are cut at the faces") {
    const Drawn molecule = drawn(dioxide, [](Drawing& d) { d.style = Style::balls; });
    CHECK(molecule.balls() == "C1 O2 Xe8 ");
    const Drawn inside = drawn(cubic("6", "O 5.6 3 3\nC 0.8 3 3\nO 2 3 3\n"),
                               [](Drawing& d) { d.style = Style::balls; });
    CHECK(inside.balls() == "C1 O2 ");
    std::vector<double> x;
    for (const auto& ball : inside.all<raylane::core::Sphere>("atom"))
        x.push_back(ball.center.x);
    std::sort(x.begin(), x.end());
    REQUIRE(x.size() == 3);
    CHECK(x[0] == Approx(-0.4));
    CHECK(x[1] == Approx(0.8));
    CHECK(inside.all<raylane::core::CappedCylinder>("bond").size() == 4);
    CHECK(drawn(cubic("6", "O 5.6 3 3\nC 0.8 3 3\nO 2 3 3\n"),
                [](Drawing& d) {
                    d.style = Style::balls;
                    d.whole = false;
                })
              .all<raylane::core::CappedCylinder>("bond")
              .size() == 2);
    // A chain of carbon along x has no end.
    CHECK(drawn(cubic("1.4", "C 0.7 0.7 0.7\n", "T F F"), [](Drawing& d) {
              d.boundary = d.whole = true;
          }).balls() == "C1 ");
}

TEST_CASE("bonds to other cells are those of a block of cells") {
    raylane::ray_sets::Random random(20261129);
    for (int round = 0; round < 20; ++round) {
        Structure one = of_atoms({});
        const double edge = round % 2 == 0 ? 3.0 : 9.0;
        const int count = round % 2 == 0 ? 3 : 40;
        const char* const symbols[] = {"C", "H", "O", "N"};
        std::vector<std::pair<const char*, Vec3f>> atoms;
        for (int i = 0; i < count; ++i)
            atoms.emplace_back(symbols[random.integer(0, 3)],
                               raylane::core::convert<float>(random.cube(1.5 * edge)));
        one = of_atoms(atoms);
        one.cell.edges = {Vec3d(edge, 0, 0), Vec3d(0.3 * edge, edge, 0),
                          Vec3d(-0.2 * edge, 0.4 * edge, edge)};
        one.cell.periodic[2] = round % 3 != 0;
        const auto bonds = periodic_bonds(one);
        REQUIRE(bonds);
        for (AtomIndex a = 0; a < one.size(); ++a) {
            std::vector<std::array<int, 4>> expected, found;
            for (const PeriodicBond& bond : bonds->of(a))
                found.push_back(
                    {static_cast<int>(bond.b), bond.cell[0], bond.cell[1], bond.cell[2]});
            for (AtomIndex b = 0; b < one.size(); ++b)
                for (int u = -9; u <= 9; ++u)
                    for (int v = -9; v <= 9; ++v)
                        for (int w = one.cell.periodic[2] ? -9 : 0;
                             w <= (one.cell.periodic[2] ? 9 : 0); ++w) {
                            const Element p = one.element(a), q = one.element(b);
                            const Vec3d way = raylane::core::convert<double>(one.positions[b]) -
                                              raylane::core::convert<double>(one.positions[a]) +
                                              static_cast<double>(u) * one.cell.edges[0] +
                                              static_cast<double>(v) * one.cell.edges[1] +
                                              static_cast<double>(w) * one.cell.edges[2];
                            const auto reach = static_cast<double>(
                                data_of(p).covalent_radius + data_of(q).covalent_radius + 0.4F);
                            const double distance = raylane::core::length(way);
                            if (distance > 0.4 && distance < reach)
                                expected.push_back({static_cast<int>(b), u, v, w});
                        }
            std::sort(expected.begin(), expected.end());
            std::sort(found.begin(), found.end());
            if (expected.size() < 24) CHECK(found == expected);
        }
    }
}

TEST_CASE("a cell too small for its bonds is rendered as it is") {
    CHECK(drawn(cubic("0.01", "Na 0 0 0\n")).balls() == "Na1 ");
    CHECK(drawn(cubic("1e-30", "Na 0 0 0\n")).balls() == "Na1 ");
}

TEST_CASE("crystals have parallel projection, unless perspective is wanted") {
    using raylane::core::Projection;
    const auto projection = [](const std::string& text, bool perspective) {
        return drawn(text, [&](Drawing& d) { d.perspective = perspective; })
            .scene.auto_camera()
            .fit_camera->projection;
    };
    CHECK(projection(salt, false) == Projection::orthographic);
    CHECK(projection(salt, true) == Projection::perspective);
    CHECK(projection("1\n\nNa 0 0 0\n", false) == Projection::perspective);
}

TEST_CASE("the default view of a crystal shows c upward, a towards the viewer, b to the right") {
    Cell cell;
    cell.edges = {Vec3d(5, 0, 0), Vec3d(-2, 6, 0), Vec3d(1, 1, 7)};
    const auto view = view_of_cell(cell);
    const Vec3d forward = raylane::core::convert<double>(view.direction);
    const Vec3d up = raylane::core::convert<double>(view.up);
    const Vec3d right = raylane::core::cross(forward, up);
    CHECK(raylane::core::dot(forward, cell.edges[0]) < 0.0);
    CHECK(raylane::core::dot(right, cell.edges[1]) > 0.0);
    CHECK(raylane::core::dot(up, cell.edges[2]) > 0.0);
    CHECK(raylane::core::dot(forward, up) < 0.0); // from above
}

TEST_CASE("hulls of points are their faces, counter-clockwise from outside") {
    const double h = 1.0;
    const std::vector<Vec3d> octahedron = {Vec3d(h, 0, 0),  Vec3d(-h, 0, 0), Vec3d(0, h, 0),
                                           Vec3d(0, -h, 0), Vec3d(0, 0, h),  Vec3d(0, 0, -h)};
    CHECK(hull_of(octahedron).size() == 8);
    CHECK(volume_of(octahedron, hull_of(octahedron)) == Approx(4.0 / 3.0));
    std::vector<Vec3d> cube;
    for (int i = 0; i < 8; ++i)
        cube.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
    const auto faces = hull_of(cube);
    CHECK(faces.size() == 6);
    CHECK(std::all_of(faces.begin(), faces.end(), [](const auto& f) { return f.size() == 4; }));
    CHECK(volume_of(cube, faces) == Approx(1.0));
    cube.emplace_back(0.5, 0.5, 0.5); // inside
    cube.emplace_back(0.5, 0.5, 1.0); // in the middle of a face
    cube.emplace_back(0.5, 0.0, 1.0); // in the middle of an edge
    CHECK(volume_of(cube, hull_of(cube)) == Approx(1.0));
    CHECK(hull_of(cube).size() == 6);
    const std::vector<Vec3d> square(cube.begin(), cube.begin() + 4);
    CHECK(hull_of(square).size() == 1);
    CHECK(hull_of(std::vector<Vec3d>{Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(3, 0, 0)}).empty());
    CHECK(hull_of({}).empty());
}

TEST_CASE("faces whose corners lose their plane by rounding are left out") {
    const std::vector<Vec3d> far = {{1.1e16, 2.3e15, 3.7e16},
                                    {-4.3e16, 5.9e15, 1.3e15},
                                    {2.9e15, -7.7e16, 3.1e16},
                                    {-6.1e15, 1.9e16, -8.3e16}};
    for (const auto& face : hull_of(far))
        CHECK(face.size() >= 3);
}

TEST_CASE("a hull contains its points, and each of its edges belongs to two faces") {
    raylane::ray_sets::Random random(7);
    for (int round = 0; round < 100; ++round) {
        std::vector<Vec3d> points;
        for (int i = random.integer(4, 12); i > 0; --i)
            points.push_back(random.cube(3.0));
        const auto faces = hull_of(points);
        std::map<std::pair<std::size_t, std::size_t>, int> edges;
        for (const auto& face : faces) {
            if (face.size() == 3) {
                const Vec3d normal = raylane::core::cross(points[face[1]] - points[face[0]],
                                                          points[face[2]] - points[face[0]]);
                for (const Vec3d& point : points)
                    CHECK(raylane::core::dot(point - points[face[0]], normal) <=
                          0.0501 * raylane::core::length(normal));
            }
            for (std::size_t k = 0; k < face.size(); ++k)
                ++edges[std::minmax(face[k], face[(k + 1) % face.size()])];
        }
        if (std::all_of(faces.begin(), faces.end(), [](const auto& f) { return f.size() == 3; }))
            for (const auto& [edge, count] : edges)
                CHECK(count == 2);
    }
}

TEST_CASE("ions of a salt are not bonded, even if their bonds to the others are not found") {
    // Cs has Cl at 3.93 angstrom, above 2.44 + 1.02 + 0.4, and Cs at 5.56.
    const std::string chloride =
        cubic("5.56", "Cs 0 0 0\nSn 2.78 2.78 2.78\nCl 2.78 2.78 0\nCl 2.78 0 2.78\nCl 0 2.78 "
                      "2.78\n");
    const Drawn salt_of_cesium = drawn(chloride, [](Drawing& d) { d.style = Style::balls; });
    CHECK(salt_of_cesium.balls() == "Cl6 Cs8 Sn1 ");
    CHECK(salt_of_cesium.all<raylane::core::CappedCylinder>("bond of atom 1,").empty());
    CHECK(salt_of_cesium.all<raylane::core::CappedCylinder>("bond of atom 2,").size() == 2 * 6);
    const Drawn cesium = drawn(cubic("6.14", "Cs 0 0 0\nCs 3.07 3.07 3.07\n"),
                               [](Drawing& d) { d.style = Style::balls; });
    CHECK(cesium.all<raylane::core::CappedCylinder>("bond").size() == 8); // half diagonals
}

TEST_CASE("views along the edges of a cell have them towards the viewer") {
    const std::string skew = "1\nLattice=\"5 0 0 -2 6 0 1 1 7\"\nNa 0 0 0\n";
    const Vec3d edges[] = {Vec3d(5, 0, 0), Vec3d(-2, 6, 0), Vec3d(1, 1, 7)};
    const auto view_of = [](const std::string& text, const std::string& name) {
        return *drawn(text, [&](Drawing& d) { d.view = view_named("--view", name); })
                    .scene.auto_camera()
                    .fit_camera;
    };
    const auto is_along = [](const Vec3f& a, const Vec3d& b) {
        const auto wide = raylane::core::convert<double>(a);
        return raylane::core::length(raylane::core::cross(wide, b)) < 1e-5 &&
               raylane::core::dot(wide, b) > 0.0;
    };
    for (std::size_t k = 0; k < 3; ++k) {
        const auto camera = view_of(skew, std::string(1, static_cast<char>('a' + k)));
        CHECK(is_along(camera.direction, -edges[k]));
        CHECK(is_along(camera.up, edges[k == 2 ? 1 : 2]));
    }
    // The best view is along the shortest edge, and along c if all are equal.
    CHECK(is_along(view_of(skew, "best").direction, -edges[0]));
    CHECK(is_along(view_of(salt, "best").direction, Vec3d(0, 0, -1)));
    CHECK(is_along(view_of(salt, "best").up, Vec3d(0, 1, 0)));
    CHECK(message_of<BadInput>([&] { view_of("1\n\nNa 0 0 0\n", "b"); }) ==
          "--view: must have a cell along whose edge it looks, but a.xyz has none");
    CHECK(message_of<BadInput>([&] {
              view_of("1\nLattice=\"5 0 0 0 5 0 0 0 0\"\nNa 0 0 0\n", "c");
          }) == "--view: must not be c: the cell has no length along it");
}

TEST_CASE("the best view of atoms has their largest extent across") {
    const auto camera = drawn("4\n\nHe 0 0 0\nHe 0 0 9\nHe 0 4 0\nHe 0 4 9\n",
                              [](Drawing& d) { d.view = view_named("--view", "best"); })
                            .scene.auto_camera()
                            .fit_camera;
    CHECK(std::abs(std::abs(camera->direction.x) - 1.0F) < 1e-6F);
    CHECK(std::abs(camera->up.y - 1.0F) < 1e-6F);
}

TEST_CASE("flat looks have no shading, of polyhedra, cells and arrows either") {
    const Drawn flat = drawn(perovskite, [](Drawing& d) {
        d.finish = Finish::flat;
        d.polyhedra = {"Ti"};
        d.show_cell = d.show_axes = true;
    });
    for (const auto& material : flat.scene.materials())
        CHECK(material.diffuse == 0.0F);
    CHECK(flat.scene.auto_camera().depth_cue == 0.0F);
}

TEST_CASE("very many atoms that are narrower than two pixels have nine samples a pixel") {
    // A sheet in an image of 120 x 90 pixels, in which `apart` is the distance of atoms.
    const auto settings_of = [](int side, double apart, Style style) {
        std::string text = std::to_string(side * side) + "\n\n";
        for (int x = 0; x < side; ++x)
            for (int y = 0; y < side; ++y)
                text += "C " + std::to_string(apart * x) + ' ' + std::to_string(apart * y) + " 0\n";
        return drawn(text,
                     [&](Drawing& d) {
                         d.style = style;
                         d.width = 120;
                         d.height = 90;
                     })
            .scene.settings();
    };
    constexpr double radius = 1.7; // of carbon; 1.9 and 2.1 pixels
    const auto apart = [](double pixels) { return 2.0 * radius * 90.0 / pixels / 36.0; };
    CHECK(settings_of(37, apart(1.9), Style::spheres).quality == 0.0F);
    CHECK(settings_of(37, apart(1.9), Style::spheres).grid == 3);
    CHECK(settings_of(37, apart(2.1), Style::spheres).quality == 40.0F);
    CHECK(settings_of(36, 2.0 * apart(1.9), Style::spheres).quality == 40.0F); // few
    CHECK(settings_of(37, apart(1.9), Style::sticks).quality == 46.0F);
}

TEST_CASE("the edges of the cell are visible in the examples of the pages") {
    if (!has_gemmi()) return;
    const auto share_of_edges = [](const std::string& name, const auto& change) {
        Legend legend;
        LoadOptions options;
        options.legend = &legend;
        options.drawing.show_cell = true;
        change(options.drawing);
        const auto scene = load_scene(RAYLANE_SOURCE_DIR "/scenes/" + name, options);
        const raylane::core::FitCamera camera = *scene.auto_camera().fit_camera;
        const Vec3d back =
            -raylane::core::normalized(raylane::core::convert<double>(camera.direction));
        raylane::core::Searcher<double> searcher(scene, raylane::core::Search::hierarchy);
        int count = 0, visible = 0;
        const Cell& cell = legend.structure.cell;
        for (std::size_t k = 0; k < 3; ++k)
            for (int corner = 0; corner < 4; ++corner)
                for (double share = 0.025; share < 1.0; share += 0.05) {
                    Vec3d at = share * cell.edges[k];
                    if ((corner & 1) != 0) at = at + cell.edges[(k + 1) % 3];
                    if ((corner & 2) != 0) at = at + cell.edges[(k + 2) % 3];
                    const auto hit = searcher.nearest({at + 100.0 * back, -back}, {},
                                                      [](const auto&) { return true; });
                    ++count;
                    visible += legend.atoms_of_shape[hit.hit.shape] == no_atoms ? 1 : 0;
                }
        return static_cast<double>(visible) / count;
    };
    CHECK(share_of_edges("perovskite.cif", [](Drawing& d) { d.polyhedra = {"Ti"}; }) > 0.5);
    CHECK(share_of_edges("salt.cif", [](Drawing& d) {
              d.style = Style::spheres;
              d.scale_radii = "0.4";
          }) > 0.25);
}

TEST_CASE("polyhedra are complete, also those of atoms on faces of the cell") {
    const auto show = [](const char* text) {
        return [=](Drawing& d) {
            d.style = Style::automatic;
            d.polyhedra = {text};
        };
    };
    const Drawn inside = drawn(perovskite, show("Ti"));
    CHECK(inside.all<raylane::core::Triangle>().size() == 8);
    CHECK(inside.balls() == "O6 Sr8 Ti1 ");
    CHECK(inside.all<raylane::core::CappedCylinder>("bond").empty());
    const std::string moved =
        cubic("3.9", "Sr 1.95 1.95 1.95\nTi 0 0 0\nO 0 0 1.95\nO 0 1.95 0\nO 1.95 0 0\n");
    const Drawn corners = drawn(moved, show("Ti opacity 0.5"));
    CHECK(corners.all<raylane::core::Triangle>().size() == 8 * 8);
    CHECK(corners.balls() == "O36 Sr1 Ti8 ");
    CHECK(drawn(moved).balls() == "O12 Sr1 Ti8 ");
    const Drawn strontium = drawn(perovskite, show("Sr")); // cuboctahedra
    CHECK(strontium.all<raylane::core::Triangle>().size() == 8 * (8 + 2 * 6));
    const Drawn none = drawn(perovskite, show("Zr"));
    REQUIRE(none.remarks.size() == 1);
    CHECK(none.remarks[0] == "--polyhedra: \"Zr\" matches no element or type");
}

TEST_CASE("polyhedra have the colour of their centre, and the opacity of their look") {
    const Drawn crystal = drawn(perovskite, [](Drawing& d) { d.polyhedra = {"Ti opacity 0.5"}; });
    const auto& table =
        std::get<raylane::core::Table<raylane::core::Triangle>>(crystal.scene.shapes());
    raylane::core::for_each_shape(table, [&](const auto&, raylane::core::ShapeId id) {
        CHECK(crystal.scene.material_of(id).opacity == 0.5F);
        CHECK(crystal.scene.material_of(id).pattern.colors[0] ==
              raylane::core::color_from_srgb(data_of(22).color));
        CHECK(crystal.legend.of(id) == "atom 2, Ti (Ti)");
    });
    CHECK(message_of<BadInput>([] { polyhedra_of("--polyhedra", ""); }) ==
          "--polyhedra: column 1: must be an element or type, got nothing");
    CHECK(message_of<BadInput>([] { polyhedra_of("--polyhedra", "Ti balls"); }) ==
          "--polyhedra: must have no style, got \"Ti balls\"");
    CHECK(polyhedra_of("--polyhedra", "Ti Zr orange").kinds.size() == 2);
}

/// Returns the volume that the triangles of polyhedra enclose, from their orientation.
double volume_of(const Drawn& crystal) {
    double volume = 0.0;
    for (const auto& triangle : crystal.all<raylane::core::Triangle>()) {
        CHECK(triangle.a.z <= 2.0);
        volume +=
            raylane::core::dot(triangle.a, raylane::core::cross(triangle.b, triangle.c)) / 6.0;
    }
    return volume;
}

TEST_CASE("planes cut polyhedra, with closed faces") {
    const auto cut = [](const std::vector<std::string>& planes) {
        return drawn(perovskite, [&](Drawing& d) {
            d.polyhedra = {"Ti"};
            for (const std::string& plane : planes)
                d.cuts.push_back(cut_plane_of("--cut", plane));
        });
    };
    // An octahedron with corners 1.95 from its centre at (1.95, 1.95, 1.95).
    const double whole = 4.0 / 3.0 * 1.95 * 1.95 * 1.95;
    CHECK(volume_of(cut({"z<2", "z<1.95"})) == Approx(0.5 * whole)); // through four corners
    CHECK(volume_of(cut({"z<1.95", "x<1.95"})) == Approx(0.25 * whole));
    const double tip = 1.9 / 1.95; // of the part above z = 2, which is like one half
    CHECK(volume_of(cut({"z<2"})) == Approx(whole * (1.0 - 0.5 * tip * tip * tip)));
    CHECK(volume_of(cut({"z<0"})) == 0.0); // touches a corner
}

TEST_CASE("a cut polyhedron in a plane stays in it") {
    const std::string square = "5\n\nPt 0 0 0\nCl 2.3 0 0\nCl -2.3 0 0\nCl 0 2.3 0\nCl 0 -2.3 0\n";
    const Drawn half = drawn(square, [](Drawing& d) {
        d.polyhedra = {"Pt"};
        d.cuts = {cut_plane_of("--cut", "1,1,0,0.2")};
    });
    CHECK_FALSE(half.all<raylane::core::Triangle>().empty());
    for (const auto& triangle : half.all<raylane::core::Triangle>())
        for (const auto& corner : {triangle.a, triangle.b, triangle.c}) {
            CHECK(corner.z == 0.0);
            CHECK(corner.x + corner.y <= 0.2 + 1e-6);
        }
}

TEST_CASE("axes are arrows along the edges, left of the atoms") {
    const Drawn crystal = drawn(salt, [](Drawing& d) { d.show_axes = true; });
    const auto arrows = crystal.all<raylane::core::CappedCone>();
    REQUIRE(arrows.size() == 3);
    const Vec3d forward =
        raylane::core::convert<double>(crystal.scene.auto_camera().fit_camera->direction);
    const Vec3d right = raylane::core::cross(
        forward, raylane::core::convert<double>(crystal.scene.auto_camera().fit_camera->up));
    int directions = 0; // bits of x, y and z
    for (const auto& arrow : arrows) {
        for (int k = 0; k < 3; ++k)
            if (arrow.axis[k] > 0.0) directions |= 1 << k;
        CHECK(arrow.axis.x + arrow.axis.y + arrow.axis.z ==
              Approx(raylane::core::length(arrow.axis)));
        const Vec3d origin = arrow.base - 0.68 / 0.32 * arrow.axis;
        for (const auto& ball : crystal.all<raylane::core::Sphere>("atom")) {
            CHECK(raylane::core::dot(right, arrow.base + arrow.axis) <
                  raylane::core::dot(right, ball.center) -
                      ball.radius * raylane::core::length(right));
            // In front of the atoms, which the depth cue makes paler.
            CHECK(raylane::core::dot(forward, origin) <
                  raylane::core::dot(forward, ball.center) -
                      0.9 * ball.radius * raylane::core::length(forward));
        }
    }
    CHECK(directions == 7);
    CHECK(message_of<BadInput>([] {
              drawn("1\n\nNa 0 0 0\n", [](Drawing& d) { d.show_axes = true; });
          }) == "--axes: must have a cell whose edges they show, but a.xyz has none");
}

TEST_CASE("a share of a displacement is within its ellipsoid") {
    // Chi distribution with three degrees of freedom.
    CHECK(deviations_of(0.5) == Approx(1.538172).epsilon(1e-6));
    CHECK(deviations_of(0.9) == Approx(2.500278).epsilon(1e-6));
    CHECK(deviations_of(0.99) == Approx(3.368214).epsilon(1e-6));
    CHECK(deviations_of(0.01) == Approx(0.338868).epsilon(1e-5));
}

TEST_CASE("principal ellipses stand out of an ellipsoid along its principal planes") {
    Structure atom = of_atoms({{"C", {1, 2, 3}}});
    atom.anisotropies = {{0, {0.09F, 0.04F, 0.01F, 0, 0, 0}}};
    Drawing drawing{.style = Style::balls, .ellipsoids = Ellipsoids::ellipses};
    const auto scene = draw_structure(atom, drawing, "a");
    CHECK(std::get<raylane::core::Table<raylane::core::Ellipsoid>>(scene.shapes()).size() == 4);
    const auto ellipsoid =
        ellipsoid_at(Vec3f(0.0F), {Vec3d(3, 0, 0), Vec3d(0, 2, 0), Vec3d(0, 0, 1)});
    const auto height_in = [](const raylane::core::Ellipsoid& surface, double x, double y) {
        // of the surface above a point of the plane of x and y; -1 beside it
        const double u = x / static_cast<double>(surface.axis_u.x),
                     v = y / static_cast<double>(surface.axis_v.y);
        const double rest = 1.0 - u * u - v * v;
        return rest < 0.0 ? -1.0 : std::sqrt(rest) * static_cast<double>(surface.axis_w.z);
    };
    const auto rims = principal_ellipses(ellipsoid);
    for (double angle = 0.0; angle < 6.28; angle += 0.1) {
        const double c = std::cos(angle), s = std::sin(angle);
        // Just inside of the rim, the flat ellipsoid is higher; further inside, it is hidden.
        CHECK(height_in(rims[2], 2.9976 * c, 1.9984 * s) >
              height_in(ellipsoid, 2.9976 * c, 1.9984 * s));
        CHECK(height_in(rims[2], 2.9 * c, 1.93 * s) < height_in(ellipsoid, 2.9 * c, 1.93 * s));
    }
}

TEST_CASE("the octant that faces the camera is cut out") {
    const auto ellipsoid =
        ellipsoid_at(Vec3f(0.0F), {Vec3d(3, 0, 0), Vec3d(0, 2, 0), Vec3d(0, 0, 1)});
    const auto solid = without_octant(ellipsoid, Vec3d(1, -2, 3), 0, 0, 0);
    REQUIRE(solid.parts.size() == 2);
    CHECK(solid.parts[0].parts.size() == 4);
    const auto is_cut = [&](const Vec3d& point) {
        return std::all_of(
            solid.parts[1].parts.begin(), solid.parts[1].parts.end(), [&](const auto& part) {
                const auto& plane = std::get<raylane::core::PlaneOf<double>>(part.shape);
                return raylane::core::dot(point - plane.point, plane.normal) < 0.0;
            });
    };
    for (int octant = 0; octant < 8; ++octant) {
        const Vec3d point(octant & 1 ? 0.1 : -0.1, octant & 2 ? 0.1 : -0.1,
                          octant & 4 ? 0.1 : -0.1);
        CHECK(is_cut(point) == (octant == 5));
    }
    Structure atom = of_atoms({{"C", {1, 2, 3}}});
    atom.anisotropies = {{0, {0.09F, 0.04F, 0.01F, 0, 0, 0}}};
    Drawing drawing{.style = Style::balls, .ellipsoids = Ellipsoids::octants};
    const auto scene = draw_structure(atom, drawing, "a");
    CHECK(scene.solids().any());
    CHECK(scene.shape_count() == 7);
    drawing.opacity = 0.5F;
    std::string remark;
    CHECK(draw_structure(atom, drawing, "a", nullptr, nullptr, [&](const std::string& text) {
              remark = text;
          }).shape_count() == 1);
    CHECK(remark == "a: --octants is ignored for atoms whose opacity is below 1");
    drawing.opacity = 1.0F;
    drawing.cuts = {cut_plane_of("--cut", "x<1")};
    CHECK(draw_structure(atom, drawing, "a").shape_count() == 8);
    drawing.cuts = {cut_plane_of("--cut", "x<0")};
    CHECK(message_of<BadInput>([&] { draw_structure(atom, drawing, "a"); }) ==
          "--cut: must leave a part of the atoms, got none: they have x from 0.57 to 1.43, y from "
          "1.57 to 2.43, z from 2.57 to 3.43");
}
