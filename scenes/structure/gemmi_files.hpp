#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// What gemmi reads, in plain terms. Its headers want C++17, as does what includes this; the rest
/// of raylane is not to know them.
namespace raylane::scenes::gemmi_files {

struct Atom {
    double at[3]; ///< angstrom
    int element;  ///< atomic number; 0: not said
    std::string name;
    int serial = 0;
    float b_factor = 0.0F, occupancy = 1.0F; ///< B is U by 8 pi^2
    char conformer = '\0';                   ///< of places that exclude each other
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

struct Model {
    std::string title; ///< empty: that of the model before, but of crystals
    bool has_cell = false;
    double edges[3][3] = {};
    /// Of a small molecule's crystal, one residue without a name, which is all that is in the cell.
    std::vector<Chain> chains;
    bool is_small = false;
};

/// What gemmi refuses: its message, which begins with the name of the file, perhaps with a line.
class Refused : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Throw Refused. Models without atoms are left out. Add differences from the file to `remarks`.
std::vector<Model> read_pdb(std::string_view text, const std::string& name);
std::vector<Model> read_cif(std::string_view text, const std::string& name,
                            std::vector<std::string>& remarks);

} // namespace raylane::scenes::gemmi_files
