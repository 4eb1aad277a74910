#include "core/shapes/ellipsoid.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/formats/structure/bonds.hpp"
#include "scenes/formats/structure/selection.hpp"
#include "scenes/formats/structure/structure_file.hpp"
#include "tests/places.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/scenes/formats/structure/frames.hpp"
#include "tests/scenes/formats/structure/structures.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <zlib.h>

using namespace raylane::scenes;
using raylane::core::Vec3f;
using raylane::ray_sets::Random;
using raylane::tests::of_atoms;
using raylane::tests::peptide;

namespace {

std::string selected(const Structure& structure, const std::string& expression) {
    std::string result;
    std::vector<std::string> unmatched;
    for (const char is_selected : select_atoms(structure, expression, unmatched))
        result.push_back(is_selected != 0 ? '1' : '0');
    return result;
}

std::string complaint(const Structure& structure, const std::string& expression) {
    return raylane::tests::message_of<BadInput>([&] { selected(structure, expression); });
}

std::string xyz_of(int count) {
    Random random(3);
    std::string text = std::to_string(count) + "\n\n";
    for (int i = 0; i < count; ++i)
        text += "C " + std::to_string(random.uniform(-9, 9)) + " " +
                std::to_string(random.uniform(-9, 9)) + " " +
                std::to_string(random.uniform(-9, 9)) + "\n";
    return text;
}

} // namespace

TEST_CASE("elements follow from symbols and masses") {
    CHECK(element_of("Fe") == 26);
    CHECK(element_of("CL") == 17);
    CHECK(element_of("D") == 1);
    CHECK(element_of("Q") == 0);
    CHECK(element_of("") == 0);
    CHECK(element_of_mass(15.9994) == 8);
    CHECK(element_of_mass(0.3) == 0);
    for (Element z = 1; z < element_count; ++z) {
        CHECK(element_of(data_of(z).symbol) == z);
        CHECK(data_of(z).mass >= data_of(static_cast<Element>(z > 1 ? z - 1 : 1)).mass - 3.0F);
    }
}

TEST_CASE("rounded masses and masses of isotopes and of old tables give elements") {
    const auto symbol = [](double mass) {
        return std::string(data_of(element_of_mass(mass)).symbol);
    };
    for (const double mass : {1.00794, 1.008, 1.01, 1.0, 2.014})
        CHECK(symbol(mass) == "H");
    for (const double mass : {12.0, 12.01, 12.011, 12.0107, 13.003})
        CHECK(symbol(mass) == "C");
    CHECK(symbol(14.0) == "N");
    CHECK(symbol(14.0067) == "N");
    CHECK(symbol(28.06) == "Si");
    CHECK(symbol(35.5) == "Cl");
    CHECK(symbol(56.0) == "Fe");
    CHECK(symbol(196.97) == "Au");
    CHECK(symbol(207.2) == "Pb");
    // CH to CH4, OH and H2O of united atoms, beads, whole numbers near two elements.
    for (const double mass : {13.019, 14.027, 14.03, 15.035, 15.0, 16.043, 16.04, 17.007, 18.015,
                              18.0, 72.0, 40.0, 59.0, 0.5, 1.5, 260.0})
        CHECK(symbol(mass) == "X");
}

TEST_CASE("masses in reduced units give no elements") {
    const auto symbols = [](const std::vector<double>& masses, MassUnits units) {
        std::string text;
        for (const Element element : elements_of_masses(masses, units))
            text.append(data_of(element).symbol).append(" ");
        return text;
    };
    using Masses = std::vector<double>;
    for (const Masses& masses :
         {Masses{1}, Masses{1, 1}, Masses{1, 2}, Masses{12, 12}, Masses{14, 14}, Masses{1, 4},
          Masses{1, 27}, Masses{14.027, 15.035}, Masses{12.011, 14.027}, Masses{1.00794, 1},
          Masses{1.01}, Masses{1.01, 1.01}, Masses{1, 1.008}, Masses{39.948, 39.948}}) {
        CAPTURE(masses);
        CHECK(symbols(masses, MassUnits::unknown).empty());
    }
    CHECK(symbols({63.546, 63.546}, MassUnits::daltons) == "Cu Cu ");
    CHECK(symbols({63.546}, MassUnits::unknown) == "Cu ");
    CHECK(symbols({1, 16}, MassUnits::unknown) == "H O ");
    CHECK(symbols({1, 12}, MassUnits::unknown) == "H C ");
    CHECK(symbols({1, 15.9994}, MassUnits::unknown) == "H O ");
    CHECK(symbols({1, 4}, MassUnits::daltons) == "H He ");
    CHECK(symbols({15.9994}, MassUnits::others).empty());
}

TEST_CASE("shipped atoms have their bonds and fill their cell") {
    const auto read = [](const std::string& name, const auto& open) {
        return raylane::tests::frames(
                   open, raylane::tests::content_of(RAYLANE_SOURCE_DIR "/scenes/" + name))
            .at(0);
    };
    const Structure fullerene = read("fullerene.xyz", open_xyz);
    CHECK(fullerene.size() == 60);
    CHECK(find_bonds(fullerene).size() == 90);
    if (raylane::tests::has_gemmi())
        CHECK(raylane::tests::elements_of(read("salt.cif", open_cif)) ==
              "Na Na Na Na Cl Cl Cl Cl ");
}

TEST_CASE("bonds are those of all pairs of atoms that are near enough") {
    Random random(20261125);
    for (const double size : {10.0, 20.0, 4000.0}) {
        std::vector<std::pair<const char*, Vec3f>> atoms;
        const char* const symbols[] = {"C", "H", "O", "Fe", "Cu", "Xx"};
        for (int i = 0; i < 400; ++i) {
            const char* const symbol = symbols[random.integer(0, 5)];
            const raylane::core::Vec3d place = random.cube(size);
            atoms.emplace_back(symbol, raylane::core::convert<float>(
                                           place * raylane::core::Vec3d(1, 1, i % 3 == 0 ? 0 : 1)));
        }
        // Atoms at the distance of a bond, and two at one point.
        atoms.emplace_back("O", Vec3f(0, 0, 0));
        atoms.emplace_back("H", Vec3f(0.96F, 0, 0));
        atoms.emplace_back("O", Vec3f(0, 0, 0));
        const Structure structure = of_atoms(atoms);
        std::vector<std::pair<AtomIndex, AtomIndex>> expected, found;
        for (AtomIndex a = 0; a < structure.size(); ++a)
            for (AtomIndex b = a + 1; b < structure.size(); ++b) {
                const float of_a = data_of(structure.element(a)).covalent_radius;
                const float of_b = data_of(structure.element(b)).covalent_radius;
                const Vec3f apart = structure.positions[a] - structure.positions[b];
                const float distance =
                    std::sqrt(apart.x * apart.x + apart.y * apart.y + apart.z * apart.z);
                const auto is_metal = [&](AtomIndex i) { return structure.element(i) > 20; };
                if (of_a == 0 || of_b == 0 || (is_metal(a) && is_metal(b))) continue;
                if (distance >= 0.4F && distance <= of_a + of_b + 0.4F) expected.emplace_back(a, b);
            }
        for (const Bond& bond : find_bonds(structure))
            found.emplace_back(bond.a, bond.b);
        CHECK(found == expected);
        CHECK_FALSE(found.empty());
    }
}

TEST_CASE("bonds of a file keep their orders") {
    Structure structure = of_atoms({{"C", {0, 0, 0}}, {"O", {1.2F, 0, 0}}, {"C", {9, 0, 0}}});
    structure.bonds = {{0, 2, 1}, {0, 1, 2}};
    std::vector<Bond> bonds = find_bonds(structure);
    REQUIRE(bonds.size() == 2);
    CHECK(bonds[0].order == 2);
    CHECK(bonds[1].b == 2);
    structure.bonds = {};
    structure.has_all_bonds = true;
    CHECK(find_bonds(structure).empty());
}

TEST_CASE("atoms can be selected by words") {
    const Structure structure = peptide();
    CHECK(selected(structure, "all") == "11111");
    CHECK(selected(structure, "none") == "00000");
    CHECK(selected(structure, "protein") == "11110");
    CHECK(selected(structure, "water") == "00001");
    CHECK(selected(structure, "hetero") == "00001");
    CHECK(selected(structure, "HYDROGEN") == "00100");
    CHECK(selected(structure, "backbone") == "11000");
    CHECK(selected(structure, "chain A") == "11110");
    CHECK(selected(structure, "chain a B") == "00000"); // chains may differ in case alone
    CHECK(selected(structure, "chain A b") == "11111");
    CHECK(selected(structure, "residue ala 300-302") == "11101");
    CHECK(selected(structure, "residue -1") == "11100");
    CHECK(selected(structure, "residue -5--1,20") == "11110");
    CHECK(selected(structure, "element c N") == "11010");
    CHECK(selected(structure, "name cb o") == "00011");
    CHECK(selected(structure, "type C") == "01010");
    CHECK(selected(structure, "index 2-3 5") == "01101");
    CHECK(selected(structure, "b_factor >= 30") == "00111");
    CHECK(selected(structure, "b_factor=20") == "01000");
    CHECK(selected(structure, "not element C and chain A") == "10100");
    CHECK(selected(structure, "not (element C and chain A)") == "10101");
    CHECK(selected(structure, "element N or element C and residue 20") == "10010");
    CHECK(selected(structure, "within 1.2 of element N") == "10100");
    CHECK(selected(structure, "within 2 of water and not water") == "00010");
    CHECK(selected(structure, "within 0 of name N") == "10000");
    CHECK(selected(structure, "within 5 of none") == "00000");
}

TEST_CASE("an invalid selection is refused with its column") {
    const Structure structure = peptide();
    CHECK(complaint(structure, "") == "--select: column 1: must be a selection, got nothing");
    CHECK(complaint(structure, "foo").starts_with("--select: column 1: must be one of "));
    CHECK(complaint(structure, "within 5 of foo")
              .starts_with("--select: column 13: must be one of "));
    CHECK(complaint(structure, "within -5 of all").starts_with("--select: column 8: a distance "));
    CHECK(complaint(structure, "b_factor 30") ==
          "--select: column 10: must have <, <=, >, >= or = behind it, got \"30\"");
    CHECK(complaint(structure, "b_factor < x all")
              .starts_with("--select: column 12: must be a number"));
    CHECK(complaint(structure, "element C Q N")
              .starts_with("--select: column 11: must be an element"));
    CHECK(
        complaint(structure, "index 1 x 2").starts_with("--select: column 9: must be a number or"));
    CHECK(complaint(structure, "chane A").find("did you mean \"chain\"?") != std::string::npos);
    CHECK(complaint(structure, "element C and") ==
          "--select: column 14: must be a selection, got nothing");
    CHECK(complaint(structure, "(all") == "--select: column 5: must be \")\", got nothing");
    CHECK(complaint(structure, "all all") ==
          "--select: column 5: must be \"and\", \"or\" or the end, got \"all\"");
    CHECK(complaint(structure, "within near of all").find("must be a distance, got \"near\"") !=
          std::string::npos);
    CHECK(complaint(structure, "b_factor 3").find("must have <, <=, >, >= or = behind it") !=
          std::string::npos);
    CHECK(complaint(structure, "element Q").find("must be an element, got \"Q\"") !=
          std::string::npos);
    CHECK(complaint(structure, std::string(1000, '(')).find("deeper than 100") !=
          std::string::npos);
}

TEST_CASE("a remark has the column of a name in a list that matches nothing") {
    const Structure structure = peptide();
    const auto unmatched = [&](const std::string& expression) {
        std::vector<std::string> messages;
        select_atoms(structure, expression, messages);
        return messages;
    };
    using Messages = std::vector<std::string>;
    CHECK(unmatched("chain A foo") == Messages{"--select: column 9: \"foo\" matches no chain"});
    CHECK(unmatched("residue ALA 301 FOO 900-901") ==
          Messages{"--select: column 17: \"FOO\" matches no residue",
                   "--select: column 21: \"900-901\" matches no residue"});
    CHECK(unmatched("element C Fe or name CA XY") ==
          Messages{"--select: column 11: \"Fe\" matches no element",
                   "--select: column 25: \"XY\" matches no atom"});
    CHECK(unmatched("type C 7") == Messages{"--select: column 8: \"7\" matches no type"});
    CHECK(unmatched("chain A b and residue ala -5--1").empty());
    const Drawing drawing{.select = "chain A foo"};
    Messages told;
    draw_structure(structure, drawing, "a", nullptr, nullptr,
                   [&](const std::string& remark) { told.push_back(remark); });
    CHECK(told == unmatched("chain A foo"));
}

TEST_CASE("remarks name selections to hide and bonds that no atom has") {
    const auto told = [](const Drawing& drawing) {
        std::string text;
        draw_structure(peptide(), drawing, "a", nullptr, nullptr,
                       [&](const std::string& remark) { text += remark + "\n"; });
        return text;
    };
    CHECK(told({.hide = {"ion"}}) == "--hide: \"ion\" selects none of 5 atoms\n");
    CHECK(told({.hide = {"element Fe"}}) == "--hide: column 9: \"Fe\" matches no element\n");
    CHECK(told({.hydrogen_bonds = true}) ==
          "a: hydrogen bonds are missing: no atoms that are shown have one\n");
    CHECK(told({.hide = {"hydrogen"}}).empty());
}

TEST_CASE("within finds the same atoms as the distances of all pairs") {
    Random random(7);
    std::vector<std::pair<const char*, Vec3f>> atoms;
    for (int i = 0; i < 500; ++i)
        atoms.emplace_back(
            i % 50 == 0 ? "O" : "C",
            raylane::core::convert<float>(random.cube(9) * raylane::core::Vec3d(1, 1, 5)));
    const Structure structure = of_atoms(atoms);
    for (const float reach : {0.5F, 3.0F, 20.0F, 500.0F}) {
        std::string expected;
        for (const Vec3f& at : structure.positions)
            expected.push_back(std::any_of(atoms.begin(), atoms.end(),
                                           [&](const auto& atom) {
                                               const Vec3f apart = at - atom.second;
                                               return atom.first[0] == 'O' &&
                                                      raylane::core::dot(apart, apart) <=
                                                          reach * reach;
                                           })
                                   ? '1'
                                   : '0');
        CHECK(selected(structure, "within " + std::to_string(reach) + " of element O") == expected);
    }
}

TEST_CASE("within takes no pairs of two dense crowds") {
    std::vector<std::pair<const char*, Vec3f>> atoms;
    Random random(8);
    for (const char* const element : {"O", "C"})
        for (int i = 0; i < 30'000; ++i)
            atoms.emplace_back(element, raylane::core::convert<float>(
                                            random.cube(0.01) +
                                            raylane::core::Vec3d(element[0] == 'O' ? 0 : 3, 0, 0)));
    const Structure structure = of_atoms(atoms);
    CHECK(selected(structure, "within 2.9 of element O") ==
          std::string(30'000, '1') + std::string(30'000, '0'));
}

TEST_CASE("lists of a selection end at the next word of the language") {
    const Structure structure = peptide();
    CHECK(complaint(structure, "chain A an water") ==
          "--select: column 12: must be \"and\", \"or\" or the end, got \"water\"");
    CHECK(complaint(structure, "chain and water") ==
          "--select: column 7: must be the name of a chain, got \"and\"");
    CHECK(complaint(structure, "(chain A") == "--select: column 9: must be \")\", got nothing");
    CHECK(complaint(structure, "name") ==
          "--select: column 5: must be the name of an atom, got nothing");
    CHECK(selected(structure, "not residue ALA HOH") == "00010");
}

TEST_CASE("transparent atoms have the camera of opaque ones") {
    const auto camera_of = [](float opacity) {
        LoadOptions options;
        options.drawing.style = Style::balls;
        options.drawing.opacity = opacity;
        options.drawing.fit_camera.direction = {-1, -0.5F, 0.3F};
        return parse_scene("a.xyz", "3\n\nC 0 0 0\nO 1.2 0 0\nN 0 1.3 0.2\n", options).camera();
    };
    CHECK(camera_of(0.5F).from == camera_of(1.0F).from);
}

TEST_CASE("a file of atoms is a scene with a camera that sees them all") {
    LoadOptions options;
    options.drawing.width = 320;
    options.drawing.height = 200;
    const auto projection =
        GENERATE(raylane::core::Projection::perspective, raylane::core::Projection::orthographic);
    options.drawing.fit_camera.projection = projection;
    options.drawing.fit_camera.direction = {-1, -0.5F, 0.3F};
    const raylane::core::Scene scene = parse_scene("a.xyz", xyz_of(30), options);
    CHECK(scene.settings().width == 320);
    CHECK(scene.camera().projection == projection);
    CHECK(scene.lights().size() == 2);
    CHECK(scene.background().x == 1.0F);
    CHECK(std::get<raylane::core::Table<raylane::core::Sphere>>(scene.shapes()).size() == 30);
}

TEST_CASE("styles have the shapes that they are named after") {
    const std::string acetylene = "4\n\nH 0 0 0\nC 1.06 0 0\nC 2.26 0 0\nH 3.32 0 0\n";
    const auto counts = [&](Style style) {
        LoadOptions options;
        options.drawing.style = style;
        const raylane::core::Scene scene = parse_scene("a.xyz", acetylene, options);
        return std::pair(
            std::get<raylane::core::Table<raylane::core::Sphere>>(scene.shapes()).size(),
            std::get<raylane::core::Table<raylane::core::CappedCylinder>>(scene.shapes()).size());
    };
    CHECK(counts(Style::spheres) == std::pair<std::size_t, std::size_t>(4, 0));
    CHECK(counts(Style::points) == std::pair<std::size_t, std::size_t>(4, 0));
    CHECK(counts(Style::automatic) == std::pair<std::size_t, std::size_t>(4, 5));
    CHECK(counts(Style::sticks) == std::pair<std::size_t, std::size_t>(4, 5)); // C-C of one colour
    CHECK(counts(Style::licorice) == std::pair<std::size_t, std::size_t>(4, 5));
}

TEST_CASE("atoms that are not balls are ellipsoids in the proportions of the style") {
    using raylane::core::Ellipsoid, raylane::core::Sphere, raylane::core::Table;
    Structure structure = of_atoms({{"Xx", {0, 0, 0}}, {"Xx", {9, 0, 0}}});
    structure.radii = {4.0F, 1.0F};
    structure.shapes = {{0, {Vec3f(2, 0, 0), Vec3f(0, 0, 4), Vec3f(0, -1, 0)}}};
    const auto drawn = [&](Style style) {
        const Drawing drawing{.style = style};
        return draw_structure(structure, drawing, "a");
    };
    for (const auto& drawing : {std::pair(Style::automatic, 1.0F), {Style::balls, 0.5F}}) {
        const float size = drawing.second;
        const raylane::core::Scene scene = drawn(drawing.first);
        const auto& ellipsoids = std::get<Table<Ellipsoid>>(scene.shapes());
        REQUIRE(ellipsoids.size() == 1);
        CHECK(std::get<Table<Sphere>>(scene.shapes()).size() == 1);
        raylane::core::for_each_shape(ellipsoids, [&](const auto& shape, raylane::core::ShapeId) {
            const auto bounds = raylane::core::bounds_of(shape);
            CHECK(bounds.upper.x == Approx(2.0F * size));
            CHECK(bounds.upper.y == Approx(1.0F * size));
            CHECK(bounds.upper.z == Approx(4.0F * size));
        });
    }
    CHECK(std::get<Table<Ellipsoid>>(drawn(Style::points).shapes()).size() == 0);
}

TEST_CASE("a frame of a file is read by its number") {
    const std::string text = "1\n\nC 0 0 0\n1\n\nN 1 0 0\n1\n\nO 2 0 0\n";
    const auto x_in = [&](const std::string& frame) {
        raylane::scenes::Legend legend;
        LoadOptions options;
        options.set_drawing({{"frame", frame}});
        options.legend = &legend;
        static_cast<void>(parse_scene("a.xyz", text, options));
        return legend.structure.positions.at(0).x;
    };
    for (const int number : {0, 1, 2})
        for (const int frame : {number, number - 3})
            CHECK(x_in(std::to_string(frame)) == static_cast<float>(number));
    const auto error = [&](const std::string& frame) {
        return raylane::tests::message_of<BadInput>([&] { x_in(frame); });
    };
    for (const std::string outside : {"3", "-4"})
        CHECK(error(outside) ==
              "--frames: must select some of the 3 frames that a.xyz has, numbered from 0, got "
              "none");
    CHECK(x_in("1:") == 1.0F);
    CHECK(x_in("-9:") == 0.0F);
    CHECK(error("1:1") == "--frames: must select at least one frame, got none");
    CHECK(error("last") ==
          "frame: must be a number or START:STOP:STEP, such as 0:100:2, with a step from 1, got "
          "\"last\"");
}

TEST_CASE("options that cannot be rendered give an error of one line") {
    const auto error = [](const std::string& name, const std::string& text, const auto& change) {
        LoadOptions options;
        change(options);
        return raylane::tests::message_of<BadInput>([&] { parse_scene(name, text, options); });
    };
    const std::string one = "1\n\nC 0 0 0\n";
    CHECK(error("a.xyz", one, [](LoadOptions& o) { o.drawing.select = "element N"; }) ==
          "--select: \"element N\" selects none of 1 atoms");
    CHECK(error("a.xyz", one, [](LoadOptions& o) { o.drawing.color = "chain"; }) ==
          "--color: must not be chain here: the atoms have no residues");
    CHECK(error("a.xyz", one, [](LoadOptions& o) { o.drawing.color = "elment"; }) ==
          "--color: must be element or a colour such as red or #ff8000, got \"elment\", did you "
          "mean \"element\"?");
    CHECK(error("a.xyz", one, [](LoadOptions& o) { o.drawing.show_cell = true; }) ==
          "--cell: must have a cell to show, but a.xyz has none");
    CHECK(error("a.xyz", one, [](LoadOptions& o) {
              o.drawing.repeat = {1, 2, 1};
          }) == "--repeat: must have a cell to repeat, but a.xyz has none");
    CHECK(error("a.xyz", one, [](LoadOptions& o) { o.drawing.ellipsoids = Ellipsoids::plain; }) ==
          "--ellipsoids: a.xyz has no anisotropic displacements");
    CHECK(error("a.xyz", one, [](LoadOptions& o) { o.drawing.ellipsoids = Ellipsoids::octants; }) ==
          "--octants: a.xyz has no anisotropic displacements");
    CHECK(error("a.xyz", "0\n\n", [](LoadOptions&) {}) ==
          "a.xyz: has no atoms in frame 0; \"--frames 1\" selects the next one, if any");
    CHECK(error("a.dump",
                "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 1e40\n0 1\n0 1\n"
                "ITEM: ATOMS xs ys zs\n0.5 0 0\n",
                [](LoadOptions&) {}) == "a.dump: atom 1 must have coordinates from -1e30 to 1e30");
    CHECK(error("a.json", "{}", [](LoadOptions& o) { o.option_for_atoms = "--style"; }) ==
          "--style: goes with a file of atoms, but a.json is a scene");
}

TEST_CASE("one atom and atoms at one point can be rendered") {
    for (const char* text : {"1\n\nC 5 5 5\n", "2\n\nC 1e4 0 0\nN 1e4 0 0\n", "1\n\nXx 0 0 0\n"})
        for (const auto projection :
             {raylane::core::Projection::perspective, raylane::core::Projection::orthographic}) {
            LoadOptions options;
            options.drawing.fit_camera.projection = projection;
            CHECK_NOTHROW(parse_scene("a.xyz", text, options));
        }
}

TEST_CASE("files that gzip has compressed are read") {
    const std::string text = xyz_of(20'000);
    const raylane::tests::TemporaryDirectory directory;
    const std::filesystem::path path = directory.path() / "a.xyz.gz";
    // In two pieces, as programs write that compress in blocks.
    for (const auto& part : {text.substr(0, 30'000), text.substr(30'000)}) {
        gzFile file = ::gzopen(path.c_str(), "ab");
        REQUIRE(::gzwrite(file, part.data(), static_cast<unsigned>(part.size())) > 0);
        ::gzclose(file);
    }
    CHECK(load_scene(path).shape_count() == 20'000);
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1000);
    CHECK(raylane::tests::message_of<BadInput>([&] { load_scene(path); }) ==
          path.string() + ": must be complete, got truncated gzip data");
}

TEST_CASE("Atoms on top of each other are rendered without bonds and quickly") {
    Structure structure = of_atoms({{"C", {0, 0, 0}}, {"O", {1.2F, 0, 0}}});
    constexpr int crowd = 300'000;
    for (int i = 0; i < crowd; ++i) {
        structure.positions.emplace_back(20.0F + 1e-7F * static_cast<float>(i % 997), 0.0F, 0.0F);
        structure.kinds.push_back(structure.kinds[0]);
    }
    std::size_t crowded = 0;
    const std::vector<Bond> bonds = find_bonds(structure, &crowded);
    CHECK(crowded == crowd);
    REQUIRE(bonds.size() == 1);
    CHECK(bonds[0].b == 1);
    std::vector<std::string> remarks;
    const Drawing drawing{.style = Style::balls};
    const raylane::core::Scene scene =
        draw_structure(structure, drawing, "a.xyz", nullptr, nullptr,
                       [&](const std::string& remark) { remarks.push_back(remark); });
    CHECK(scene.shape_count() >= crowd + 2);
    CHECK(remarks == std::vector<std::string>{"a.xyz: 300000 atoms have more than 24 others within "
                                              "the length of a bond: they have no bonds"});
}

TEST_CASE("An atom with 24 neighbours has bonds and one with 25 has none") {
    std::vector<std::pair<const char*, Vec3f>> atoms = {{"U", {0, 0, 0}}};
    for (int i = 0; i < 24; ++i) {
        const float z = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / 24.0F;
        const float r = std::sqrt(1.0F - z * z), turn = 2.4F * static_cast<float>(i);
        atoms.emplace_back("C", 2.6F * Vec3f(r * std::cos(turn), r * std::sin(turn), z));
    }
    // A lattice of helium is far too wide for bonds.
    for (int i = 0; i < 64'000; ++i)
        atoms.emplace_back("He", 3.0F * Vec3f(static_cast<float>(i % 40 + 9),
                                              static_cast<float>(i / 40 % 40),
                                              static_cast<float>(i / 1600)));
    atoms.emplace_back("He", Vec3f(1e9F, 0, 0));
    const auto bonds_of_uranium = [&] {
        const std::vector<Bond> bonds = find_bonds(of_atoms(atoms));
        return std::count_if(bonds.begin(), bonds.end(), [](const Bond& b) { return b.a == 0; });
    };
    CHECK(bonds_of_uranium() == 24);
    atoms[25] = {"C", {0, 0, 2.6F}};
    CHECK(bonds_of_uranium() == 0);
}
