#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// Contents of the files that gemmi reads, in plain types. gemmi's headers need C++17, so the units
/// that include them are compiled as C++17, and include this header. The rest of raylane does not
/// see them.
namespace raylane::scenes::gemmi_files {

struct Atom {
    double at[3]; ///< angstrom
    int element;  ///< atomic number; 0: unknown
    std::string name;
    int serial = 0; ///< in a crystal: the number of the operation of symmetry, from 1
    float b_factor = 0.0F, occupancy = 1.0F; ///< B is 8 pi^2 U
    char conformer = '\0'; ///< name of one of several places that exclude each other
    bool has_u = false;
    float u[6] = {}; ///< U11, U22, U33, U12, U13, U23
};

struct Residue {
    std::string name;
    int number = 0;
    char insertion = ' ';
    bool is_hetero = false;
    std::vector<Atom> atoms;
};

struct Chain {
    std::string name;
    std::vector<Residue> residues;
};

struct ResiduePlace {
    std::string chain;
    int number = 0;
    char insertion = ' ';
};

/// A helix or a strand of a sheet, from its first to its last residue.
struct SecondaryRange {
    bool is_strand = false;
    ResiduePlace first, last;
};

struct Model {
    std::string title; ///< empty: that of the previous model, except for crystals
    bool has_cell = false;
    double edges[3][3] = {};
    /// A small molecule's crystal has one residue without a name, with all atoms in the cell.
    std::vector<Chain> chains;
    bool is_small = false;
    std::size_t entry = 0; ///< index of the block that it is in
};

/// The models of a file, and the helices and strands that those of a block share.
struct Models {
    std::vector<Model> models;
    std::vector<std::vector<SecondaryRange>> secondary_of_entry; ///< at least one
};

/// A refusal by gemmi. Its message begins with the name of the file, perhaps with a line.
class Refused : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Throw Refused. Omit models without atoms. Add differences from the file to `remarks`.
std::vector<Model> read_pdb(std::string_view text, const std::string& name);
Models read_cif(std::string_view text, const std::string& name, std::vector<std::string>& remarks);

} // namespace raylane::scenes::gemmi_files
