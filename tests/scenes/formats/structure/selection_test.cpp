#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/selection.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/formats/structure/structures.hpp"
#include "tests/support/catch.hpp"

#include <string>

/// Tests of the words of PyMOL and VMD in selections.
using namespace raylane::scenes;

namespace {

/// Returns ALA 1 and SEP 2 (modified), a ligand, an ion, water and a nucleotide, one letter for
/// each atom of NCS P LLL Z O R.
Structure complex() {
    Structure structure = raylane::tests::of_atoms({{"N", {0, 0, 0}},
                                                    {"C", {1, 0, 0}},
                                                    {"C", {1, 1, 0}},
                                                    {"C", {3, 0, 0}},
                                                    {"P", {4, 0, 0}},
                                                    {"C", {10, 0, 0}},
                                                    {"O", {11, 0, 0}},
                                                    {"H", {12, 0, 0}},
                                                    {"Zn", {20, 0, 0}},
                                                    {"O", {30, 0, 0}},
                                                    {"P", {40, 0, 0}}});
    structure.names = {"N", "CA", "CB", "CA", "P", "CA", "O1", "H1", "ZN", "O", "P"};
    structure.chains = {"A"};
    structure.of_residue = {{"ALA", 1, ' ', 0, false},  {"SEP", 2, ' ', 0, true},
                            {"XK2", 300, ' ', 0, true}, {"ZN", 400, ' ', 0, true},
                            {"HOH", 500, ' ', 0, true}, {"DA", 600, ' ', 0, false}};
    structure.residues = {0, 0, 0, 1, 1, 2, 2, 2, 3, 4, 5};
    structure.properties = {{"b_factor", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}}};
    return structure;
}

std::string selected(const std::string& expression) {
    std::string result;
    std::vector<std::string> unmatched;
    const Structure structure = complex();
    for (const char is_selected : select_atoms(structure, expression, unmatched))
        result.push_back(is_selected != 0 ? '1' : '0');
    return result;
}

} // namespace

TEST_CASE("ligands are residues with carbon outside of polymers") {
    CHECK(selected("ligand") == "00000111000");
    CHECK(selected("organic") == selected("ligand"));
    CHECK(selected("ion") == "00000000100");
    CHECK(selected("metal") == "00000000100");
    CHECK(selected("sidechain") == "00100000000");
    CHECK(selected("noh") == "11111110111");
}

TEST_CASE("words of PyMOL and VMD select the same atoms as raylane's") {
    const std::pair<const char*, const char*> same[] = {
        {"solvent", "water"},
        {"hetatm", "hetero"},
        {"resn ALA+XK2", "residue ALA XK2"},
        {"resname ALA XK2", "residue ALA XK2"},
        {"resi 1-2+300", "residue 1 2 300"},
        {"resid 1 to 300", "residue 1-300"},
        {"resi 1:300", "residue 1-300"},
        {"name CA+CB", "name CA CB"},
        {"elem C", "element C"},
        {"polymer.protein", "protein"},
        {"polymer", "protein or nucleic"},
        {"serial 2", "index 2"},
        {"b < 5", "b_factor < 5"},
        {"beta >= 5", "b_factor >= 5"},
        {"b == 5", "b_factor = 5"},
        {"!water & !ligand", "not water and not ligand"},
        {"water | ion", "water or ion"},
        {"(water||ion)&&x<25", "ion"},
        {"byres (element Zn or name CB)", "ion or residue 1"},
        {"same residue as name CB", "byres name CB"},
        {"br. name CB", "byres name CB"},
        {"byres protein within 0.5 of name CB", "residue 1"},
        {"byres element Zn around 9", "ligand and byres (element Zn around 9)"},
        {"protein within 1.5 of element N", "protein and within 1.5 of element N"},
        {"exwithin 1.5 of element N", "within 1.5 of element N and not element N"},
        {"element N around 1.5", "exwithin 1.5 of element N"},
        {"element N expand 1.5", "within 1.5 of element N"},
        {"chain A and x > 10 and y = 0", "index 7-11"},
        {"*", "all"},
    };
    for (const auto& [elsewhere, here] : same) {
        CAPTURE(elsewhere);
        CHECK(selected(elsewhere) == selected(here));
        CHECK(selected(here).find('1') != std::string::npos);
    }
}

TEST_CASE("a comparison is about a number of the file, also if that has the name of a selection") {
    Structure structure = complex();
    structure.properties.push_back({"helix", std::vector<float>(structure.size(), 0.5F)});
    structure.properties.back().values[2] = 1.0F;
    std::vector<std::string> unmatched;
    const std::vector<char> selected = select_atoms(structure, "helix > 0.6", unmatched);
    CHECK(std::count(selected.begin(), selected.end(), 1) == 1);
    CHECK(selected[2] == 1);
}

TEST_CASE("resn takes names and resi takes numbers") {
    const auto complaint = [](const char* expression) {
        return raylane::tests::message_of<BadInput>([&] { selected(expression); });
    };
    CHECK(complaint("resi ALA") ==
          "--select: column 6: must be a number or a range such as 20-30, got \"ALA\"");
    CHECK(selected("resn 300") == selected("none"));
    CHECK(complaint("same chain as water") ==
          "--select: column 6: must be \"residue\", got \"chain\"");
    CHECK(complaint("ligan").find("did you mean \"ligand\"?") != std::string::npos);
    CHECK(complaint("O").ends_with("got \"O\", did you mean \"element O\"?"));
}
