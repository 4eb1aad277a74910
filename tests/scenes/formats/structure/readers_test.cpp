#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/readers.hpp"
#include "tests/scenes/formats/structure/frames.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <string>
#include <vector>

using namespace raylane::scenes;
using namespace raylane::tests;
using raylane::core::Vec3d;
using raylane::core::Vec3f;

namespace {

std::string pdb_atom(const char* record, int serial, const char* name, const char* residue,
                     char chain, int number, double x, double y, double z, const char* element) {
    char text[96];
    std::snprintf(text, sizeof text, "%-6s%5d %-4s %3s %c%4d    %8.3f%8.3f%8.3f%6.2f%6.2f%12s\n",
                  record, serial, name, residue, chain, number, x, y, z, 1.0, 20.0, element);
    return text;
}

} // namespace

TEST_CASE("columns of an extended XYZ file have names and residues") {
    for (const std::string columns :
         {"name:S:1:resname:S:1:resid:I:1", "atomtypes:S:1:residuenames:S:1:residuenumbers:I:1"}) {
        const Structure structure =
            frames(open_xyz, "4\nProperties=species:S:1:pos:R:3:" + columns +
                                 ":chain:S:1\nC 0 0 0 CA ALA 7 A\nN 1 0 0 N ALA 7 A\n"
                                 "O 2 0 0 OW HOH 7 A\nC 3 0 0 C1 LIG -8 B\n")
                .at(0);
        CHECK(structure.names == std::vector<std::string>{"CA", "N", "OW", "C1"});
        CHECK(structure.residues == std::vector<std::uint32_t>{0, 0, 1, 2});
        CHECK(structure.chains == std::vector<std::string>{"A", "B"});
        REQUIRE(structure.of_residue.size() == 3);
        CHECK(structure.of_residue[0].name == "ALA");
        CHECK(structure.of_residue[2].number == -8);
        CHECK(structure.of_residue[2].chain == 1);
        CHECK_FALSE(structure.of_residue[0].is_hetero);
        CHECK(structure.of_residue[2].is_hetero);
    }
    CHECK(complaint(open_xyz, "1\nProperties=pos:R:3:resid:I:1\n0 0 0 x\n")
              .find("the number of a residue") != std::string::npos);
    // Numbers that are not whole are a property, and a second column of names is ignored.
    const Structure other = frames(open_xyz, "1\nProperties=pos:R:3:resid:R:1:name:S:1:atomtypes:"
                                             "S:1\n0 0 0 1.5 A B\n")
                                .at(0);
    CHECK(other.properties.at(0).name == "resid");
    CHECK(other.names == std::vector<std::string>{"A"});
    CHECK(other.residues.empty());
}

TEST_CASE("XYZ is read frame by frame") {
    const std::vector<Structure> structures =
        frames(open_xyz, "2\nwater, part of it\nO 0.1 0 -1.5e0\n"
                         "h  +1 2.D0 3  extra\n\n"
                         "1\n\nFe2+ 4 5 6");
    REQUIRE(structures.size() == 2);
    CHECK(structures[0].title == "water, part of it");
    CHECK(elements_of(structures[0]) == "O H ");
    CHECK(structures[0].positions == std::vector{Vec3f(0.1F, 0, -1.5F), Vec3f(1, 2, 3)});
    CHECK_FALSE(structures[0].cell.any());
    CHECK(elements_of(structures[1]) == "Fe ");
}

TEST_CASE("extended XYZ has columns and a cell") {
    const std::vector<Structure> structures =
        frames(open_xyz, "2\nLattice=\"4 0 0 1 5 0 0 0 6\" Origin=\"1 2 3\" pbc='T F T' title "
                         "Properties=id:I:1:pos:R:3:species:S:1:forces:R:3:radius:R:1 energy=-3\n"
                         "7 0 0 0 Na 3 4 0 1.5\n8 1 1 1 Cl 0 0 2 0.5\n");
    REQUIRE(structures.size() == 1);
    const Structure& frame = structures[0];
    CHECK(elements_of(frame) == "Na Cl ");
    CHECK(frame.radii == std::vector{1.5F, 0.5F});
    CHECK(frame.cell.edges[1] == Vec3d(1, 5, 0));
    CHECK(frame.cell.origin == Vec3d(1, 2, 3));
    CHECK(frame.cell.periodic == std::array{true, false, true});
    REQUIRE(frame.properties.size() == 2);
    CHECK(frame.properties[0].name == "id");
    CHECK(frame.properties[0].values == std::vector{7.0F, 8.0F});
    CHECK(frame.properties[1].values == std::vector{5.0F, 2.0F}); // lengths of the forces
}

TEST_CASE("an error in XYZ has its line") {
    CHECK(complaint(open_xyz, "x\n") ==
          "a:1:1: the number of atoms must be a whole number from 0 to 2147483647, got \"x\"");
    CHECK(complaint(open_xyz, "3\n\nC 0 0 0\nC 0 0 1\n") ==
          "a:5: must be atom 3 of 3, got the end of the file");
    CHECK(complaint(open_xyz, "1\n\nC 0 zero 0\n") ==
          "a:3:5: a coordinate must be a number, got \"zero\"");
    CHECK(complaint(open_xyz, "1\n\nC 0 0\n") ==
          "a:3:6: must have a coordinate, got the end of the line");
    CHECK(
        complaint(open_xyz, "1\nLattice=\"1 2\"\nC 0 0 0\n").starts_with("a:2: Lattice must have"));
    CHECK(
        complaint(open_xyz, "1\nProperties=pos:R\nC 0 0 0\n").starts_with("a:2: Properties must"));
    CHECK(complaint(open_xyz, "1\n\nC 0 0 2e30\n") ==
          "a:3:7: a coordinate must be from -1e30 to 1e30");
    CHECK(complaint(open_xyz, "1\n\nC nan 0 0\n").find("must be a number") != std::string::npos);
    CHECK(complaint(open_xyz, "") == "a:1: must be the number of atoms, got the end of the file");
}

TEST_CASE("GRO is read in columns of any width") {
    const std::string text = "water t= 0.0\n    4\n"
                             "    1SOL     OW    1   0.126   1.624   1.679  0.1 0.2 0.3\n"
                             "    1SOL    HW1    2   0.190   1.661   1.747\n"
                             "    2LYS     CA    3   1.275   0.053   0.622\n"
                             "    3CA      CA    4  -1.000   0.000   0.000\n"
                             "   1.82060   1.82060   1.82060\n"
                             "next\n    1\n"
                             "    1ALA     CB    1   0.12345   1.62345   1.67945\n"
                             " 1 2 3 0 0 0.5 0 0.25 0.125\n\n";
    const std::vector<Structure> structures = frames(open_gro, text);
    REQUIRE(structures.size() == 2);
    CHECK(elements_of(structures[0]) == "O H C Ca ");
    CHECK(structures[0].positions[0] == Vec3f(1.26F, 16.24F, 16.79F));
    CHECK(structures[0].positions[3].x == -10.0F);
    CHECK(structures[0].names[1] == "HW1");
    CHECK(structures[0].of_residue.size() == 3);
    CHECK(structures[0].of_residue[structures[0].residues[2]].name == "LYS");
    CHECK(structures[0].cell.edges[0].x == Approx(18.206));
    CHECK(structures[1].positions[0] == Vec3f(1.2345F, 16.2345F, 16.7945F));
    CHECK(structures[1].cell.edges[1] == Vec3d(5, 20, 0));
    CHECK(structures[1].cell.edges[2] == Vec3d(2.5, 1.25, 30));
    CHECK(complaint(open_gro, "a\n1\n    1SOL     OW    1   0.126   1.x24   1.679\n1 1 1\n") ==
          "a:3:29: a coordinate must be a number, got \"   1.x24\"");
    CHECK(complaint(open_gro, "a\n1\n    1SOL     OW    1\n1 1 1\n")
              .starts_with("a:3: must be an atom"));
    CHECK(complaint(open_gro, "a\n0\n1 1\n") == "a:3: must be the box, of 3 or 9 numbers, got 2");
}

TEST_CASE("LAMMPS' dumps have columns in any order and scaled coordinates") {
    const std::string head = "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n2\n";
    const std::vector<Structure> structures =
        frames(open_lammps_dump, head +
                                     "ITEM: BOX BOUNDS pp ff pp\n0 10\n-5 5\n0 2e1\n"
                                     "ITEM: ATOMS z type id y x vx\n3 2 1 2 1 0.5\n6 1 2 5 4 -1\n" +
                                     head +
                                     "ITEM: BOX BOUNDS xy xz yz pp pp pp\n0 12 2\n0 10 0\n0 10 0\n"
                                     "ITEM: ATOMS id element xs ys zs radius\n"
                                     "1 Si 0.5 0.5 0.5 1\n2 O 0 1 0 2\n");
    REQUIRE(structures.size() == 2);
    CHECK(structures[0].positions == std::vector{Vec3f(1, 2, 3), Vec3f(4, 5, 6)});
    CHECK(structures[0].of_kind[structures[0].kinds[0]].label == "2");
    CHECK(structures[0].cell.periodic == std::array{true, false, true});
    CHECK(structures[0].cell.origin == Vec3d(0, -5, 0));
    REQUIRE(structures[0].properties.size() == 1);
    CHECK(structures[0].properties[0].values == std::vector{0.5F, -1.0F});
    // The bounds enclose a box of edges (10, 0, 0), (2, 10, 0), (0, 0, 10).
    CHECK(elements_of(structures[1]) == "Si O ");
    CHECK(structures[1].cell.edges[0] == Vec3d(10, 0, 0));
    CHECK(structures[1].positions == std::vector{Vec3f(6, 5, 5), Vec3f(2, 10, 0)});
    CHECK(structures[1].radii == std::vector{1.0F, 2.0F});
    CHECK(complaint(open_lammps_dump, head + "ITEM: ATOMS id x y\n") ==
          "a:5: must have x, y and z (or xs, xu, xsu), got \"ITEM: ATOMS id x y\"");
    CHECK(complaint(open_lammps_dump, head + "ITEM: ATOMS x y z\n1 2 3\n") ==
          "a:7: must be atom 2 of 2, got the end of the file");
    CHECK(complaint(open_lammps_dump, "ITEM: TIMESTEP\n1\n") ==
          "a:3: must have ITEM: ATOMS, got the end of the file");
    CHECK(complaint(open_lammps_dump, "3\n").starts_with("a:1: must begin with \"ITEM: \""));
}

TEST_CASE("extended XYZ may have a cell in brackets and properties that were not computed") {
    for (const std::string cell :
         {"\"5 0 0 0 6 0 0 0 7\"", "[[5,0,0],[0,6,0],[0,0,7]]", "[[5, 0, 0], [0, 6, 0], [0, 0, 7]]",
          "[5 0 0 0 6 0 0 0 7]", "[ [5, 0, 0], [0, 6, 0], [0, 0, 7] ]"}) {
        const Structure frame =
            frames(open_xyz, "1\nLattice=" + cell +
                                 " Properties=species:S:1:pos:R:3:q:R:1:f:R:3 energy=NaN\n"
                                 "Si 1 2 3 nan 0 -Inf 1\n")
                .at(0);
        CAPTURE(cell);
        CHECK(frame.cell.edges[2].z == 7.0);
        CHECK(frame.cell.edges[1].y == 6.0);
        REQUIRE(frame.properties.size() == 2);
        CHECK(std::isnan(frame.properties[0].values.at(0)));
        CHECK(std::isnan(frame.properties[1].values.at(0)));
    }
    // The cell may come behind a list in brackets and behind an empty value.
    for (const std::string before :
         {"name=\"\" ", "name='' ", "a=[[1,2],[3,4]] ", "a=[] ", "a= ", "a = b "}) {
        CAPTURE(before);
        CHECK(frames(open_xyz, "1\n" + before + "Lattice=\"5 0 0 0 6 0 0 0 7\"\nSi 1 2 3\n")
                  .at(0)
                  .cell.edges[2]
                  .z == 7.0);
    }
    CHECK(complaint(open_xyz, "1\nLattice=[[5,0,0],[0,6]]\nSi 0 0 0\n")
              .find("Lattice must have 9 numbers") != std::string::npos);
    CHECK(complaint(open_xyz, "1\nProperties=species:S:1:pos:R:3:q:R:1\nSi 1 2 3 none\n") ==
          "a:3:10: q must be a number, got \"none\"");
}

TEST_CASE("extended XYZ may have blanks around the equals sign") {
    const Structure frame =
        frames(open_xyz, "1\nLattice = \"5 0 0 0 6 0 0 0 7\" pbc= \"T F T\" Properties "
                         "\t=species:S:1:id:I:1:pos:R:3\nSi 9 1 2 3\n")
            .at(0);
    CHECK(frame.cell.edges[2].z == 7.0);
    CHECK(frame.cell.periodic == std::array{true, false, true});
    CHECK(frame.positions.at(0) == Vec3f(1, 2, 3));
}

TEST_CASE("LAMMPS' XYZ has types or elements") {
    const std::string remark = "2\nAtoms. Timestep: 7\n";
    CHECK(elements_of(frames(open_xyz, remark + "1 0 0 0\n2 0 0 5\n").at(0)) == "X X ");
    CHECK(elements_of(frames(open_xyz, remark + "C 0 0 0\nO 0 0 5\n").at(0)) == "C O ");
    CHECK(elements_of(frames(open_xyz, "2\n\n1 0 0 0\n8 0 0 5\n").at(0)) == "H O ");
}

TEST_CASE("PDB has residues and bonds and models") {
    if (!has_gemmi()) return;
    const std::string text = "TITLE     SMALL\n"
                             "CRYST1   10.000   20.000   30.000  90.00  90.00  90.00 P 1\n"
                             "MODEL        1\n" +
                             pdb_atom("ATOM", 1, " N", "ALA", 'A', 5, 1, 2, 3, "N") +
                             pdb_atom("ATOM", 2, " CA", "ALA", 'A', 5, 2, 2, 3, "C") +
                             pdb_atom("HETATM", 3, "ZN", " ZN", 'B', 9, -1.5, 0, 0, "ZN") +
                             "ENDMDL\nMODEL        2\n" +
                             pdb_atom("ATOM", 1, " N", "ALA", 'A', 5, 4, 2, 3, "N") +
                             "ENDMDL\nCONECT    1    2    2\nCONECT    2    1    1\nEND\n";
    const std::vector<Structure> structures = frames(open_pdb, text);
    REQUIRE(structures.size() == 2);
    CHECK(structures[0].title == "SMALL");
    CHECK(elements_of(structures[0]) == "N C Zn ");
    CHECK(structures[0].positions[2] == Vec3f(-1.5F, 0, 0));
    CHECK(structures[0].names[1] == "CA");
    CHECK(structures[0].chains == std::vector<std::string>{"A", "B"});
    CHECK(structures[0].of_residue[1].is_hetero);
    CHECK(structures[0].cell.edges[2].z == 30.0);
    REQUIRE(structures[0].bonds.size() == 1);
    CHECK(structures[0].bonds[0].order == 2);
    CHECK(structures[1].positions == std::vector{Vec3f(4, 2, 3)});
    CHECK(complaint(open_pdb, pdb_atom("ATOM", 1, " N", "ALA", 'A', 5, 1, 2, 3, "N") +
                                  "ATOM      2  CA  ALA A   5       1.0.0   2.000   3.000\n") ==
          "a:2:31: a coordinate must be a number, got \"1.0.0\"");
    CHECK(complaint(open_pdb, "REMARK\n") == "a: must have ATOM or HETATM records, got none");
}

TEST_CASE("alternative places of an atom are read as one atom") {
    if (!has_gemmi()) return;
    std::string first = pdb_atom("ATOM", 1, " CB", "SER", 'A', 5, 1, 2, 3, "C"), second = first;
    first[16] = 'A';
    second[16] = 'B';
    CHECK(frames(open_pdb, first + second)[0].size() == 1);
}

TEST_CASE("alternative residues of one number are read as one residue") {
    if (!has_gemmi()) return;
    std::string serine = pdb_atom("ATOM", 1, " CB", "SER", 'A', 5, 1, 2, 3, "C"),
                proline = pdb_atom("ATOM", 2, " CB", "PRO", 'A', 5, 1, 2, 4, "C");
    serine[16] = 'A';
    proline[16] = 'B';
    const std::string next = pdb_atom("ATOM", 3, " CB", "ALA", 'A', 6, 5, 2, 3, "C");
    CHECK(frames(open_pdb, serine + proline + next)[0].names ==
          std::vector<std::string>{"CB", "CB"});
}

TEST_CASE("models of a PDB file may have the same number and different bonds") {
    if (!has_gemmi()) return;
    const auto model = [](double x) {
        return "MODEL        1\n" + pdb_atom("ATOM", 1, " N", "ALA", 'A', 5, x, 2, 3, "N") +
               pdb_atom("ATOM", 2, " CA", "ALA", 'A', 5, x + 1, 2, 3, "C");
    };
    const std::string bond = "CONECT    1    2\nCONECT    2    1\n", end = "ENDMDL\n";
    const std::vector<Structure> structures =
        frames(open_pdb, model(1) + bond + end + model(2) + bond + end + model(3) + end);
    REQUIRE(structures.size() == 3);
    CHECK(structures[1].positions[0].x == 2.0F);
    REQUIRE(structures[0].bonds.size() == 1);
    CHECK(structures[0].bonds[0].order == 1);
    CHECK(structures[1].bonds.size() == 1);
    CHECK(structures[2].bonds.empty());
}

TEST_CASE("bonds belong to the models that END separates from others") {
    if (!has_gemmi()) return;
    const auto atoms = [](double x) {
        return pdb_atom("HETATM", 1, " C1", "LIG", 'A', 1, x, 2, 3, "C") +
               pdb_atom("HETATM", 2, " C2", "LIG", 'A', 1, x + 1, 2, 3, "C");
    };
    const std::string bond = "CONECT    1    2\nCONECT    2    1\n", end = "END   \n";
    const auto orders = [](const std::string& text) {
        std::string joined;
        for (const Structure& frame : frames(open_pdb, text)) {
            REQUIRE(frame.bonds.size() < 2);
            joined += frame.bonds.empty() ? "-" : std::to_string(frame.bonds[0].order);
        }
        return joined;
    };
    CHECK(orders(atoms(1) + bond + end + atoms(2) + bond + end + atoms(3) + end) == "11-");
    CHECK(orders(atoms(1) + bond + end + atoms(2) + bond) == "11");
    CHECK(orders(atoms(1) + end + atoms(2) + end + bond + end) == "11");
    const std::string models = "MODEL\n" + atoms(1) + "ENDMDL\nMODEL\n" + atoms(2) + "ENDMDL\n";
    CHECK(orders(models + bond + end + models + end) == "11--");
}

TEST_CASE("an entry behind END keeps the previous title unless it has one") {
    if (!has_gemmi()) return;
    const std::string atom = pdb_atom("ATOM", 1, " N", "ALA", 'A', 5, 1, 2, 3, "N") + "END\n";
    std::string titles;
    for (const Structure& frame :
         frames(open_pdb, "TITLE     ONE\n" + atom + atom + "TITLE     TWO\n" + atom))
        titles += frame.title + " ";
    CHECK(titles == "ONE ONE TWO ");
}

TEST_CASE("ENDROOT of PDBQT does not end a model") {
    if (!has_gemmi()) return;
    const std::string atom = pdb_atom("HETATM", 1, " C1", "LIG", 'A', 1, 1, 2, 3, "C");
    const std::vector<Structure> structures =
        frames(open_pdb, "ROOT\n" + atom + "ENDROOT\nBRANCH   1   2\n" + atom +
                             "ENDBRANCH   1   2\nTORSDOF 1\n");
    REQUIRE(structures.size() == 1);
    CHECK(structures[0].size() == 2);
}

TEST_CASE("a long title is not kept whole for each of many models") {
    if (!has_gemmi()) return;
    std::string text;
    for (int i = 0; i < 10'000; ++i)
        text += "TITLE     " + std::string(60, 'A') + "\nMODEL\n";
    for (int i = 0; i < 100; ++i)
        text += "MODEL\n" + pdb_atom("ATOM", 1, " N", "ALA", 'A', 5, i, 2, 3, "N");
    const std::vector<Structure> structures = frames(open_pdb, text);
    REQUIRE(structures.size() == 100);
    CHECK(structures[99].positions[0].x == 99.0F);
    CHECK(structures[99].title.size() < 4096);
}

TEST_CASE("elements that a PDB file omits follow from its columns or its names") {
    if (!has_gemmi()) return;
    const auto elements = [](const std::string& text) {
        return elements_of(frames(open_pdb, text).at(0));
    };
    const auto atom = [](const std::string& name, const std::string& residue) {
        return pdb_atom("HETATM", 1, name.c_str(), residue.c_str(), 'A', 5, 1, 2, 3, "  ");
    };
    CHECK(elements(atom(" CA ", "ALA") + atom("HE21", "GLN") + atom(" 2HB", "ALA")) == "C H H ");
    CHECK(elements(atom("CA  ", "ALA") + atom("HG  ", "LEU") + atom("CD1 ", "LEU") +
                   atom("CA  ", " CA")) == "C H C Ca ");
    CHECK(elements(atom("CA  ", " CA") + atom(" CA ", "ALA") + atom("FE  ", "HEM") +
                   atom(" NA ", "HEM")) == "Ca C Fe N ");
    CHECK(elements(atom(" SOD", "SOD") + atom("POT ", "POT") + atom("CLA ", "CLA") +
                   atom(" NA ", "ION")) == "Na K Cl Na ");
}

TEST_CASE("names of a ligand give its elements if they all begin in column 13") {
    if (!has_gemmi()) return;
    const auto elements = [](const std::string& residue, const std::vector<const char*>& names) {
        std::string text = pdb_atom("ATOM", 1, " CA ", "ALA", 'A', 1, 1, 2, 3, "  ");
        for (const char* name : names)
            text += pdb_atom("HETATM", 1, name, residue.c_str(), 'A', 5, 1, 2, 3, "  ");
        return elements_of(frames(open_pdb, text).at(0));
    };
    CHECK(elements("LIG", {"HO1 ", "CD1 ", "O1  ", "H12A", "CL1 "}) == "C H C O H Cl ");
    CHECK(elements("LIG", {"HG  ", "CD1 ", " O1 "}) == "C Hg Cd O "); // one name begins later
    CHECK(elements("LIG", {"HG  ", "CD1 "}) == "C Hg Cd ");
    // A name of blanks decides nothing. Reading its first letter is an error in the sanitizers'
    // build.
    CHECK(elements("LIG", {"\t\t\t\t", " CD1"}) == "C X C ");
}

TEST_CASE("a table of a macromolecule's atoms needs coordinates alone") {
    if (!has_gemmi()) return;
    const std::vector<std::pair<std::string, std::string>> columns = {
        {"id", "1"},           {"type_symbol", "C"},     {"label_atom_id", "CA"},
        {"label_alt_id", "."}, {"label_comp_id", "ALA"}, {"label_asym_id", "A"},
        {"Cartn_x", "1"},      {"Cartn_y", "2"},         {"Cartn_z", "3"},
        {"occupancy", "1"},    {"B_iso_or_equiv", "9"},  {"auth_seq_id", "5"}};
    for (const char* missing :
         {"", "id", "type_symbol", "label_atom_id", "label_alt_id", "label_comp_id",
          "label_asym_id", "occupancy", "B_iso_or_equiv", "auth_seq_id"}) {
        CAPTURE(missing);
        std::string table = "data_a\nloop_\n", row, single = "data_a\n";
        for (const auto& [name, value] : columns)
            if (name != missing) {
                table += "_atom_site." + name + "\n";
                row += value + " ";
                single.append("_atom_site.").append(name).append(" ").append(value).append("\n");
            }
        for (const std::string& text : {table + row + "\n", single}) {
            const Structure frame = frames(open_cif, text).at(0);
            CHECK(elements_of(frame) == "C ");
            CHECK(frame.positions.at(0) == Vec3f(1, 2, 3));
        }
    }
    const std::string places = "data_a\nloop_\n_atom_site.type_symbol\n_atom_site.Cartn_x\n"
                               "_atom_site.Cartn_y\n_atom_site.Cartn_z\n";
    CHECK(elements_of(frames(open_cif, places + "N 0 0 0\nFE 5 0 0\n").at(0)) == "N Fe ");
    CHECK(complaint(open_cif, "data_I\n_a 1\ndata_I\n_a 1\n") == "a: duplicate block name: I");
}

TEST_CASE("a residue of mmCIF continues where its number recurs in the chain") {
    if (!has_gemmi()) return;
    const std::string columns =
        "data_a\n_struct.title 'a b'\n_cell.length_a 9\n_cell.length_b 8\n_cell.length_c 7\n"
        "_cell.angle_alpha 90\n_cell.angle_beta 90\n_cell.angle_gamma 90\nloop_\n"
        "_atom_site_anisotrop.id\n_atom_site_anisotrop.U[1][1]\n_atom_site_anisotrop.U[2][2]\n"
        "_atom_site_anisotrop.U[3][3]\n_atom_site_anisotrop.U[1][2]\n"
        "_atom_site_anisotrop.U[1][3]\n_atom_site_anisotrop.U[2][3]\n2 .1 .2 .3 .4 .5 .6\nloop_\n"
        "_atom_site.id\n_atom_site.group_PDB\n_atom_site.label_atom_id\n_atom_site.label_alt_id\n"
        "_atom_site.auth_comp_id\n_atom_site.label_asym_id\n_atom_site.auth_asym_id\n"
        "_atom_site.auth_seq_id\n_atom_site.pdbx_PDB_ins_code\n_atom_site.Cartn_x\n"
        "_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.B_iso_or_equiv\n"
        "_atom_site.pdbx_PDB_model_num\n";
    const std::vector<Structure> structures =
        frames(open_cif,
               columns + "1 ATOM N A GLY X ? 5 ? 1 0 0 7 1\n2 ATOM N . SER X . 5 B 2 0 0 7 1\n"
                         "3 ATOM CA B GLY X ? 5 ? 3 0 0 7 1\n4 HETATM O . HOH Y B 5 ? 4 0 0 7 1\n"
                         "5 ATOM C A GLY X ? 5 ? 5 0 0 7 1\n6 ATOM N . GLY X ? 5 ? 6 0 0 7 2\n");
    REQUIRE(structures.size() == 2);
    CHECK(structures[0].names == std::vector<std::string>{"N", "N", "O", "C"});
    CHECK(structures[0].chains == std::vector<std::string>{"X", "B", "X"});
    REQUIRE(structures[0].of_residue.size() == 4);
    CHECK(structures[0].of_residue[1].insertion == 'B');
    CHECK(structures[0].of_residue[2].is_hetero);
    CHECK(structures[0].cell.edges[1].y == Approx(8));
    REQUIRE(structures[0].anisotropies.size() == 1);
    CHECK(structures[0].anisotropies[0].atom == 1);
    CHECK(structures[0].anisotropies[0].u[5] == 0.6F);
    CHECK(structures[0].properties.at(0).values.at(0) == 7.0F);
    CHECK(structures[1].title == "a b");
}

TEST_CASE("coordinates are the floats nearest to the numbers of the file") {
    // Just below the middle of two floats. The double nearest to the number is the middle.
    const auto x = [](const std::string& number) {
        return frames(open_xyz, "1\n\nC " + number + " 0 0\n").at(0).positions.at(0).x;
    };
    CHECK(x("1.00000017881393432617187499") == 0x1.000002p0F);
    CHECK(x("+1.25D1") == 12.5F);
    CHECK(x("1e-400") == 0.0F);
    CHECK(x("-1e30") == -1e30F);
    CHECK(frames(open_lammps_dump, "ITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS x y z c\n1 2 3 1e300\n")
              .at(0)
              .properties.at(0)
              .values.at(0) != 0.0F);
}

TEST_CASE("inputs that fuzzers found are refused or ignored") {
    if (!has_gemmi()) return;
    CHECK(frames(open_pdb,
                 "LINK         O   GLY A  49                NA    NA A6001     1555   1555  n\n" +
                     pdb_atom("ATOM", 1, " N", "ALA", 'A', 5, 1, 2, 3, "N"))
              .size() == 1);
    CHECK(frames(open_pdb,
                 "CONECT 1e99    2\n" + pdb_atom("ATOM", 1, " N", "ALA", 'A', 5, 1, 2, 3, "N"))
              .at(0)
              .bonds.empty());
    CHECK(frames(open_pdb, "CR\xd7ST2\n" + pdb_atom("ATOM", 1, " N", "ALA", 'A', 5, 1, 2, 3, "N"))
              .size() == 1);
}
