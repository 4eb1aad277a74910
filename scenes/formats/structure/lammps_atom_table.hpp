#pragma once

#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/kind_table.hpp"
#include "scenes/formats/structure/lammps_atom_styles.hpp"
#include "scenes/formats/structure/lines.hpp"

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace raylane::scenes {

/// The lines of the section Atoms of LAMMPS' data as columns of numbers, and the facts about the
/// columns that tell the atom style.
class AtomTable {
  public:
    static constexpr std::size_t max_columns = 64; ///< that are stored

    /// A word and its position.
    struct Word {
        TextPosition place;
        std::string text;
    };
    struct Column {
        std::vector<float> values;         ///< NaN if the word is not a finite number
        std::vector<std::uint16_t> labels; ///< 1 + index in texts(), or 0; empty: only numbers
        float least = std::numeric_limits<float>::infinity(), most = -least;
        TextPosition min_position, max_position;
        /// The first word that is not a number, not a finite number, a number with decimals.
        std::optional<Word> text, not_finite, not_whole;
    };

    AtomTable() = default;
    AtomTable(const AtomTable&) = delete;
    AtomTable& operator=(const AtomTable&) = delete;

    /// Adds a line. Throws BadInput if its first word is not the number of an atom.
    void add(const Lines& lines);

    std::size_t size() const { return ids_.size(); }
    const std::vector<long long>& ids() const { return ids_; }
    /// Returns a column. Column 0 is the number of the atom, and has no values here. Valid up to
    /// min_width() and max_columns.
    Column& column(std::size_t index) { return columns_[index]; }
    const Column& column(std::size_t index) const { return columns_[index]; }
    const std::vector<AtomKind>& texts() const { return texts_; }
    std::size_t min_width() const { return min_width_; }
    std::size_t max_width() const { return max_width_; }

  private:
    void add_word(const Lines& lines, const Words& words, std::string_view word, std::size_t index);

    std::vector<long long> ids_;
    std::vector<Column> columns_;
    std::vector<AtomKind> texts_;
    KindTable text_table_{texts_};
    std::size_t min_width_ = std::numeric_limits<std::size_t>::max(), max_width_ = 0;
};

/// The counts and the box of a header of LAMMPS' data.
struct LammpsHeader {
    std::map<std::string, std::size_t, std::less<>> counts; ///< "atom types"
    Cell cell;
    bool has_masses = false; ///< true if a section Masses has come before the atoms

    std::size_t count(std::string_view name) const {
        const auto found = counts.find(name);
        return found == counts.end() ? 0 : found->second;
    }
};

/// A value that contradicts a layout.
struct Misfit {
    TextPosition place;
    std::string message; ///< "an atom type must be a whole number from 1 to 2, got 0.5"
};

/// Checks LAMMPS' rules for a line: the number of columns, with or without three image flags; types
/// from 1 to "atom types", or labels; and whole numbers where they are required. Returns the first
/// misfit. A misfit in the number of columns has no place.
std::optional<Misfit> misfit_of(const AtomTable& table, const AtomLayout& layout,
                                const LammpsHeader& header);

/// Returns the most probable of the layouts without a misfit; nothing if each has one.
std::optional<AtomLayout> probable_layout(std::vector<AtomLayout> layouts, const AtomTable& table,
                                          const LammpsHeader& header);

/// Returns the layouts that agree with all evidence, the most usual first. If layouts have the same
/// positions and types, returns only the first. Never returns an open layout.
std::vector<AtomLayout> layouts_that_fit(const AtomTable& table, const LammpsHeader& header);

} // namespace raylane::scenes
