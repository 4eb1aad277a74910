#include "scenes/formats/structure/secondary_records.hpp"

#include "scenes/formats/structure/lines.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <tuple>

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
    const std::optional<int> of = number(record, chain + (character(record, 1) == 'H' ? 2 : 1), 4);
    if (!of) return std::nullopt;
    const char name = character(record, chain);
    const std::size_t insertion = chain + (character(record, 1) == 'H' ? 6 : 5);
    return ResiduePlace{name == ' ' ? std::string() : std::string(1, name), *of,
                        character(record, insertion)};
}

/// The residues of a structure by place.
class Places {
  public:
    explicit Places(const Structure& structure) : structure_(structure) {
        for (std::uint32_t i = 0; i < structure.of_residue.size(); ++i) {
            const Residue& of = structure.of_residue[i];
            const std::string& chain = structure.chains[of.chain];
            of_place_.try_emplace({chain, of.number, of.insertion}, i);
            of_number_[chain].emplace(of.number, i);
        }
    }

    /// Calls visit(index) for the residues in a range.
    template <class Visit>
    void for_each(const SecondaryRange& range, const Visit& visit) const {
        const auto first = find(range.first), last = find(range.last);
        if (first && last && *first <= *last &&
            structure_.of_residue[*first].chain == structure_.of_residue[*last].chain) {
            for (std::uint32_t i = *first; i <= *last; ++i)
                visit(i);
            return;
        }
        const auto chain = of_number_.find(range.first.chain);
        if (chain == of_number_.end()) return;
        const auto end = chain->second.upper_bound(range.last.number);
        for (auto of = chain->second.lower_bound(range.first.number);
             range.first.number <= range.last.number && of != end; ++of)
            visit(of->second);
    }

  private:
    std::optional<std::uint32_t> find(const ResiduePlace& place) const {
        const auto found = of_place_.find({place.chain, place.number, place.insertion});
        if (found == of_place_.end()) return std::nullopt;
        return found->second;
    }

    const Structure& structure_;
    std::map<std::tuple<std::string, int, char>, std::uint32_t> of_place_;
    std::map<std::string, std::multimap<int, std::uint32_t>> of_number_; // by chain
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
    const Places places(structure);
    for (const bool is_strand : {true, false})
        for (const SecondaryRange& range : ranges) {
            if (range.is_strand != is_strand) continue;
            places.for_each(range, [&](std::uint32_t i) {
                structure.of_residue[i].secondary =
                    is_strand ? Secondary::strand : Secondary::helix;
                structure.has_secondary = true;
            });
        }
}

} // namespace raylane::scenes
