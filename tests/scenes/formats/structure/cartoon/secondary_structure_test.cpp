#include "scenes/formats/structure/cartoon/secondary_structure.hpp"
#include "scenes/formats/structure/readers.hpp"
#include "scenes/formats/structure/selection.hpp"
#include "tests/scenes/formats/structure/cartoon/peptide.hpp"
#include "tests/scenes/formats/structure/frames.hpp"
#include "tests/support/catch.hpp"

using namespace raylane::scenes;
using namespace raylane::tests;

namespace {

/// Returns H, E or - for each residue.
std::string classes_of(const Structure& structure) {
    std::string text;
    for (const Secondary secondary : secondary_structure(structure, backbone_of(structure)))
        text.push_back("-HE"[static_cast<std::size_t>(secondary)]);
    return text;
}

Torsions joined(Torsions a, const Torsions& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

std::string atom_record(int serial, const std::string& name, const std::string& residue,
                        const std::string& number, const Vec3d& at,
                        const std::string& group = "ATOM  ") {
    char line[400];
    std::snprintf(line, sizeof line, "%s%5d  %-3s %3s A%s   %8.3f%8.3f%8.3f  1.00  0.00",
                  group.c_str(), serial, name.c_str(), residue.c_str(), number.c_str(), at.x, at.y,
                  at.z);
    return std::string(line) + "           " + name[0] + "\n";
}

/// Returns a chain's CA as a PDB file. `numbers`: number and insertion code, five columns each.
std::string pdb_of(const std::vector<std::string>& numbers) {
    std::string text;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        text += atom_record(static_cast<int>(i) + 1, "CA", "ALA", numbers[i],
                            {3.8 * static_cast<double>(i), 0, 0});
    return text;
}

} // namespace

// The classes that DSSP 4.2.2 gives: H, G and I are helices, E are strands.
TEST_CASE("hydrogen bonds give the helices and strands of DSSP") {
    CHECK(classes_of(peptide_of(chain_of(alpha(12)))) == "-HHHHHHHHHH-");
    CHECK(classes_of(peptide_of(chain_of(Torsions(12, {-49, -26})))) == "-HHHHHHHHHH-");
    CHECK(classes_of(peptide_of(chain_of(Torsions(14, {-57, -70})))) == "-HHHHHHHHHHHH-");
    CHECK(classes_of(peptide_of(chain_of(extended(10)))) == "----------");
    CHECK(classes_of(peptide_of(chain_of(joined(joined(alpha(7), extended(3)), alpha(8))))) ==
          "-HHHHHH---HHHHHHH-");
    CHECK(classes_of(peptide_of(hairpin())) == "-EEEEE----EEEEE-");
}

TEST_CASE("selections find the residues of helices and strands") {
    for (const Structure& structure : {peptide_of(chain_of(alpha(12))), peptide_of(hairpin())}) {
        std::string found(structure.of_residue.size(), '-');
        std::vector<std::string> unmatched;
        for (const auto& [word, letter] : {std::pair("helix", 'H'), {"sheet", 'E'}}) {
            const std::vector<char> selected = select_atoms(structure, word, unmatched);
            for (std::size_t atom = 0; atom < selected.size(); ++atom)
                if (selected[atom] != 0) found[structure.residues[atom]] = letter;
        }
        CHECK(found == classes_of(structure));
    }
}

TEST_CASE("a break in a chain ends a helix") {
    // The second half is the continuation of the first one, but one residue further.
    Structure structure = peptide_of(chain_of(alpha(20)));
    remove_atoms(structure, [](const std::string&, int number) { return number == 10; });
    const Backbone backbone = backbone_of(structure);
    REQUIRE(backbone.segments.size() == 2);
    CHECK(backbone.segments[0].size() == 9);
    CHECK(backbone.segments[1].size() == 10);
    CHECK(classes_of(structure) == "-HHHHHHH---HHHHHHHH-");
}

TEST_CASE("residues without CA are reported and break a chain") {
    Structure structure = peptide_of(chain_of(alpha(12)));
    remove_atoms(structure,
                 [](const std::string& name, int number) { return number == 5 && name == "CA"; });
    const Backbone backbone = backbone_of(structure);
    CHECK(backbone.segments.size() == 2);
    REQUIRE(backbone.without_path.size() == 1);
    CHECK(backbone.without_path[0].residue == 4);
}

TEST_CASE("CA alone give helices and strands") {
    const auto only_ca = [](const std::string& name, int) { return name != "CA"; };
    Structure helix = peptide_of(chain_of(alpha(12)));
    remove_atoms(helix, only_ca);
    CHECK(classes_of(helix) == "HHHHHHHHHHHH");
    Structure strand = peptide_of(chain_of(extended(8)));
    remove_atoms(strand, only_ca);
    CHECK(classes_of(strand) == "EEEEEEEE");
}

TEST_CASE("the time for crowded residues is not quadratic") {
    Structure structure = peptide_of(std::vector<BackbonePlaces>(100'000, BackbonePlaces{}));
    CHECK(classes_of(structure) == std::string(100'000, '-')); // 5e9 pairs
}

TEST_CASE("ions of calcium and free amino acids are not chains") {
    Structure structure = peptide_of(chain_of(alpha(1)));
    structure.of_residue[0].is_hetero = true;
    CHECK(backbone_of(structure).segments.empty());
    structure = peptide_of(chain_of(alpha(1)));
    structure.of_kind[1] = {"Ca", 20};
    CHECK(backbone_of(structure).segments.empty());
}

TEST_CASE("files name helices and strands, with insertion codes and missing ends") {
    if (!has_gemmi()) return;
    const std::string atoms =
        pdb_of({"   1 ", "   2 ", "   2A", "   2B", "   3 ", "   5 ", "   6 "});
    const std::string helix =
        "HELIX    1  H1 ALA A    2A ALA A    3  1                                    3\n";
    CHECK(classes_of(frames(open_pdb, helix + atoms)[0]) == "--HHH--");
    const std::string strand = // residue 4 is missing
        "SHEET    1   S 1 ALA A   4  ALA A   6  0\n";
    CHECK(classes_of(frames(open_pdb, helix + strand + atoms)[0]) == "--HHHEE");
    const std::string polyproline =
        "HELIX    1  H1 ALA A    1  ALA A    3 10                                    3\n";
    CHECK(classes_of(frames(open_pdb, polyproline + strand + atoms)[0]) == "-----EE");
    // Each of several models has them, and a file that another one is appended to keeps its own.
    const std::string models =
        "MODEL        1\n" + atoms + "ENDMDL\nMODEL        2\n" + atoms + "ENDMDL\nEND\n";
    const auto read = frames(open_pdb, strand + models + atoms);
    REQUIRE(read.size() == 3);
    CHECK(classes_of(read[1]) == "-----EE");
    CHECK(!read[2].has_secondary);
}

TEST_CASE("mmCIF files name helices and strands") {
    if (!has_gemmi()) return;
    std::string text =
        "data_a\nloop_\n_struct_conf.conf_type_id\n_struct_conf.beg_auth_asym_id\n"
        "_struct_conf.beg_auth_seq_id\n_struct_conf.end_auth_asym_id\n"
        "_struct_conf.end_auth_seq_id\nHELX_P A 2 A 4\nTURN_P A 5 A 6\n"
        "_struct_sheet_range.sheet_id S\n_struct_sheet_range.beg_auth_asym_id A\n"
        "_struct_sheet_range.beg_auth_seq_id 6\n_struct_sheet_range.end_auth_asym_id A\n"
        "_struct_sheet_range.end_auth_seq_id 7\n"
        "loop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.auth_atom_id\n"
        "_atom_site.auth_comp_id\n_atom_site.auth_asym_id\n_atom_site.auth_seq_id\n"
        "_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n";
    for (int i = 1; i <= 7; ++i)
        text += std::to_string(i) + " C CA ALA A " + std::to_string(i) + " " +
                std::to_string(3.8 * i) + " 0 0\n";
    const std::vector<Structure> read = frames(
        [](InputFile& file, const ReaderOptions& options) { return open_cif(file, options); },
        text);
    CHECK(classes_of(read.at(0)) == "-HHH-EE");
    // Each block has its ranges.
    std::string other = text;
    other.replace(other.find("HELX_P A 2 A 4"), 14, "HELX_P A 5 A 7");
    const std::vector<Structure> both = frames(
        [](InputFile& file, const ReaderOptions& options) { return open_cif(file, options); },
        text + other.replace(0, 6, "data_b"));
    CHECK(classes_of(both.at(0)) == "-HHH-EE");
    CHECK(classes_of(both.at(1)) == "----HHH");
}
