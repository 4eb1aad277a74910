#include "scenes/formats/structure/secondary_records.hpp"

#include "scenes/formats/structure/lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace raylane::scenes {

namespace {

using gemmi_files::ResiduePlace;
using gemmi_files::SecondaryRange;

char character(std::string_view record, std::size_t column) {
    return record.size() < column ? ' ' : record[column - 1];
}

/// Returns the number in some columns, which count from 1.
std::optional<int> number(std::string_view record, std::size_t column, std::size_t width) {
    if (record.size() < column) return std::nullopt;
    const std::optional<double> value = number_in(trimmed(record.substr(column - 1, width)));
    if (!value || !(std::abs(*value) < 1e6)) return std::nullopt;
    return static_cast<int>(*value);
}

/// Reads a residue: its chain, two columns further its number, and its insertion code.
std::optional<ResiduePlace> residue(std::string_view record, std::size_t chain) {
    const std::optional<int> sequence_number =
        number(record, chain + (character(record, 1) == 'H' ? 2 : 1), 4);
    if (!sequence_number) return std::nullopt;
    const char name = character(record, chain);
    const std::size_t insertion = chain + (character(record, 1) == 'H' ? 6 : 5);
    return ResiduePlace{name == ' ' ? std::string() : std::string(1, name), *sequence_number,
                        character(record, insertion)};
}

/// The residues of a structure, in its order and by chain and number. Marks ranges of them.
class MarkedResidues {
  public:
    explicit MarkedResidues(const Structure& structure)
        : structure_(structure), starts_(structure.of_residue.size() + 1),
          starts_by_number_(starts_.size()) {
        for (std::uint32_t i = 0; i < structure.of_residue.size(); ++i) {
            const Residue& residue = structure.of_residue[i];
            of_place_.try_emplace({chain_of(i), residue.number, residue.insertion}, i);
            by_number_.push_back(i);
        }
        std::ranges::stable_sort(by_number_, {}, [&](std::uint32_t i) { return number_of(i); });
    }

    void mark(const SecondaryRange& range) {
        const auto first = find(range.first), last = find(range.last);
        if (first && last && *first <= *last &&
            structure_.of_residue[*first].chain == structure_.of_residue[*last].chain) {
            ++starts_[*first];
            --starts_[*last + 1];
            return;
        }
        if (range.first.number > range.last.number) return;
        const std::string& chain = range.first.chain;
        const auto start = std::lower_bound(
            by_number_.begin(), by_number_.end(), std::tie(chain, range.first.number),
            [&](std::uint32_t i, const auto& number) { return number_of(i) < number; });
        const auto end = std::upper_bound(
            by_number_.begin(), by_number_.end(), std::tie(chain, range.last.number),
            [&](const auto& number, std::uint32_t i) { return number < number_of(i); });
        ++starts_by_number_[static_cast<std::size_t>(start - by_number_.begin())];
        --starts_by_number_[static_cast<std::size_t>(end - by_number_.begin())];
    }

    /// Calls visit(index) for the residues in marked ranges, and removes the marks.
    template <class Visit>
    void take(const Visit& visit) {
        std::ptrdiff_t ranges = 0, ranges_by_number = 0; // around a residue
        for (std::size_t i = 0; i < by_number_.size(); ++i) {
            if ((ranges += starts_[i]) > 0) visit(i);
            if ((ranges_by_number += starts_by_number_[i]) > 0) visit(by_number_[i]);
        }
        std::ranges::fill(starts_, 0);
        std::ranges::fill(starts_by_number_, 0);
    }

  private:
    const std::string& chain_of(std::uint32_t i) const {
        return structure_.chains[structure_.of_residue[i].chain];
    }
    std::tuple<const std::string&, const int&> number_of(std::uint32_t i) const {
        return {chain_of(i), structure_.of_residue[i].number};
    }
    std::optional<std::uint32_t> find(const ResiduePlace& place) const {
        const auto found = of_place_.find({place.chain, place.number, place.insertion});
        if (found == of_place_.end()) return std::nullopt;
        return found->second;
    }

    const Structure& structure_;
    std::map<std::tuple<std::string, int, char>, std::uint32_t> of_place_;
    std::vector<std::uint32_t> by_number_; // residues, by chain and number
    // Ranges that start at a residue, minus those that end before it: in the structure's order, and
    // in that of by_number_.
    std::vector<std::ptrdiff_t> starts_, starts_by_number_;
};

} // namespace

void read_secondary(std::string_view record, std::vector<SecondaryRange>& ranges) {
    const bool is_helix = record.starts_with("HELIX ");
    if (!is_helix && !record.starts_with("SHEET ")) return;
    constexpr int polyproline = 10;
    if (is_helix && number(record, 39, 2).value_or(1) == polyproline) return;
    const auto first = residue(record, is_helix ? 20 : 22),
               last = residue(record, is_helix ? 32 : 33);
    if (first && last) ranges.push_back({!is_helix, *first, *last});
}

void assign_secondary(const std::vector<SecondaryRange>& ranges, Structure& structure) {
    if (ranges.empty()) return;
    MarkedResidues residues(structure);
    for (const bool is_strand : {true, false}) {
        for (const SecondaryRange& range : ranges)
            if (range.is_strand == is_strand) residues.mark(range);
        residues.take([&](std::size_t i) {
            structure.of_residue[i].secondary = is_strand ? Secondary::strand : Secondary::helix;
            structure.has_secondary = true;
        });
    }
}

} // namespace raylane::scenes
