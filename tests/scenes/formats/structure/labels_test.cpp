#include "scenes/formats/structure/labels.hpp"
#include "tests/support/catch.hpp"

#include <string>
#include <utility>
#include <vector>

using namespace raylane::scenes;

namespace {

/// Returns the symbol, or "" for no element.
std::string symbol_of(Element element) {
    return element == 0 ? "" : std::string(data_of(element).symbol);
}

} // namespace

TEST_CASE("a label begins with the symbol of its element") {
    const std::vector<std::pair<std::string, std::string>> labels = {
        {"Fe2+", "Fe"}, {"C12", "C"},   {"CL1", "Cl"},  {"c1", "C"}, {"AlIV", "Al"}, {"SiT1", "Si"},
        {"C1'", "C"},   {"B-iso", "B"}, {"Zr1a", "Zr"}, {"OW", "O"}, {"OH1", "O"},   {"O-H", "O"},
        {"D", "H"},     {"1HB", "H"},   {"(Na)", "Na"}, {"PB", "Pb"}};
    for (const auto& [label, symbol] : labels) {
        CAPTURE(label);
        CHECK(symbol_of(element_of_label(label)) == symbol);
    }
}

TEST_CASE("labels of ghosts and dummies and vectors and vacancies give no element") {
    for (const char* label : {"Bq", "BQ1", "Du", "Tv", "X", "Xx", "Gh(O)", "Q1", "Vac", "UNK", "M1",
                              "T1", "", "12", "-"}) {
        CAPTURE(label);
        CHECK(element_of_label(label) == 0);
    }
}

TEST_CASE("labels of water in minerals give oxygen") {
    CHECK(symbol_of(element_of_label("Wat1")) == "O");
    CHECK(symbol_of(element_of_label("W1")) == "W");
}

TEST_CASE("labels in capitals do not give elements that no sample has") {
    CHECK(symbol_of(element_of_label("NH4")) == "N");
    CHECK(symbol_of(element_of_label("Nh")) == "Nh");
    CHECK(symbol_of(element_of_label("NO3")) == "N");
}

TEST_CASE("an atom that is named like its residue is an ion") {
    CHECK(symbol_of(element_of_atom("CA", "CA")) == "Ca");
    CHECK(symbol_of(element_of_atom("CA", "CA2+")) == "Ca");
    CHECK(symbol_of(element_of_atom("ZN", "ZN2")) == "Zn");
    CHECK(symbol_of(element_of_atom("NA", "NA")) == "Na");
    CHECK(symbol_of(element_of_atom("CD", "CDL")) == "C");
}

TEST_CASE("names of three letters give the ions of CHARMM") {
    for (const auto& [name, symbol] :
         std::vector<std::pair<std::string, std::string>>{{"BAR", "Ba"},
                                                          {"CAD", "Cd"},
                                                          {"CAL", "Ca"},
                                                          {"CES", "Cs"},
                                                          {"CLA", "Cl"},
                                                          {"LIT", "Li"},
                                                          {"POT", "K"},
                                                          {"RUB", "Rb"},
                                                          {"SOD", "Na"}}) {
        CAPTURE(name);
        CHECK(symbol_of(element_of_atom(name, name)) == symbol);
        CHECK(symbol_of(element_of_ion(name, "ION")) == symbol);
    }
    CHECK(symbol_of(element_of_atom("SOD", "LIG")) == "S");
    CHECK(element_of_ion("SOD", "LIG") == 0);
}

TEST_CASE("atoms of a residue ION are ions") {
    CHECK(symbol_of(element_of_atom("NA", "ION")) == "Na");
    CHECK(symbol_of(element_of_atom("CL", "ION")) == "Cl");
    CHECK(symbol_of(element_of_atom("K", "ION")) == "K");
    CHECK(symbol_of(element_of_atom("NA+", "ION")) == "Na");
    CHECK(symbol_of(element_of_atom("NA", "LIG")) == "N");
}

TEST_CASE("the first letter of a name is the symbol in amino acids and nucleotides") {
    for (const auto& [name, symbol] :
         std::vector<std::pair<std::string, std::string>>{{"CA", "C"},
                                                          {"HA", "H"},
                                                          {"1HB", "H"},
                                                          {"CD1", "C"},
                                                          {"HG", "H"},
                                                          {"NE2", "N"},
                                                          {"SE", "S"},
                                                          {"HE21", "H"},
                                                          {"OXT", "O"}}) {
        CAPTURE(name);
        CHECK(symbol_of(element_of_atom(name, "GLN")) == symbol);
    }
    CHECK(symbol_of(element_of_atom("SE", "MSE")) == "Se");
}

TEST_CASE("some symbols have two letters in other residues") {
    for (const auto& [name, symbol] :
         std::vector<std::pair<std::string, std::string>>{{"CL1", "Cl"},
                                                          {"BR1", "Br"},
                                                          {"SI1", "Si"},
                                                          {"FE", "Fe"},
                                                          {"NA", "N"},
                                                          {"CA1", "C"},
                                                          {"ZN", "Zn"},
                                                          {"MG1", "Mg"},
                                                          {"PB", "P"},
                                                          {"F1", "F"},
                                                          {"Co1", "Co"},
                                                          {"HO1", "H"}}) {
        CAPTURE(name);
        CHECK(symbol_of(element_of_atom(name, "LIG")) == symbol);
    }
    CHECK(element_of_atom("MW", "SOL") == 0); // in water models
    CHECK(element_of_atom("", "LIG") == 0);
}
