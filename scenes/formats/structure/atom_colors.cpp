#include "scenes/formats/structure/atom_colors.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/structure/cartoon/chain_colors.hpp"
#include "scenes/formats/structure/colors.hpp"
#include "scenes/formats/structure/kind_table.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::scenes {

AtomColors::AtomColors(const Structure& structure, const ColorWords& words,
                       std::vector<std::string>& unmatched)
    : structure_(structure), palette_(words.palette), only_carbons_(words.carbons) {
    find_elements();
    color_by(words);
    override_kinds(words, unmatched);
}

/// Sets the colours of elements. Types that are not elements have colours by number.
void AtomColors::find_elements() {
    std::size_t unknown = 0;
    for (const AtomKind& kind : structure_.of_kind)
        of_kind_.push_back(kind.element != 0 ? data_of(kind.element).color
                                             : color_of_type(unknown++));
    is_overridden_.resize(of_kind_.size());
}

void AtomColors::color_by(const ColorWords& words) {
    const std::string& by = words.by;
    if (by.empty() || by == "element") return;
    if (by == "chain" || by == "residue") {
        if (structure_.residues.empty())
            throw BadInput(words.option, "",
                           "must not be " + by + " here: the atoms have no residues");
        color_by_residue(by == "chain");
        return;
    }
    if (is_chain_color(by) && !structure_.residues.empty()) {
        chain_colors(structure_, by, of_residue_, name_of_residue_);
        return;
    }
    for (const AtomProperty& property : structure_.properties)
        if (property_ == nullptr && property.name == by) property_ = &property;
    if (property_ != nullptr) return;
    one_ = color_named(by);
    one_name_ = by;
    if (one_) return;
    std::vector<std::string_view> known = {"element"};
    if (!structure_.residues.empty())
        known.insert(known.end(), {"chain", "residue", "secondary", "rainbow"});
    for (const AtomProperty& property : structure_.properties)
        known.push_back(property.name);
    std::vector<std::string> choices(known.begin(), known.end());
    choices.emplace_back("a colour such as red or #ff8000");
    if (words.option != "--color") { // the word of a representation may be meant as a style
        choices.insert(choices.begin(), "a style");
        for (const auto& [name, style] : named_styles())
            known.push_back(name);
    }
    const std::vector<std::string_view> colors = color_names();
    known.insert(known.end(), colors.begin(), colors.end());
    throw BadInput(words.option, "",
                   "must be " + alternatives(choices) + ", got \"" + printable(by) + "\"" +
                       suggestion(by, known));
}

void AtomColors::color_by_residue(bool by_chain) {
    for (const Residue& residue : structure_.of_residue)
        name_of_residue_.push_back(by_chain ? structure_.chains[residue.chain] : residue.name);
    std::vector<std::string> distinct = name_of_residue_;
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    for (std::string& name : name_of_residue_) {
        const auto place = static_cast<std::size_t>(
            std::lower_bound(distinct.begin(), distinct.end(), name) - distinct.begin());
        of_residue_.push_back(color_of_one(place, distinct.size()));
        if (by_chain) name.insert(0, "chain ");
    }
}

void AtomColors::override_kinds(const ColorWords& words, std::vector<std::string>& unmatched) {
    for (const OfKind<std::uint32_t>& words_of_kind : words.of_kinds) {
        const std::vector<std::size_t> kinds = kinds_named(structure_.of_kind, words_of_kind.kind);
        if (kinds.empty()) unmatched.push_back(matches_no_kind(words.option, words_of_kind.kind));
        for (const std::size_t kind : kinds) {
            of_kind_[kind] = words_of_kind.value;
            is_overridden_[kind] = 1;
        }
    }
}

bool AtomColors::is_by_kind(AtomIndex atom) const {
    const bool is_plain = !one_ && of_residue_.empty() && property_ == nullptr;
    return is_plain || is_overridden_[structure_.kinds[atom]] != 0 ||
           (only_carbons_ && structure_.element(atom) != 6);
}

std::uint32_t AtomColors::of(AtomIndex atom) const {
    if (is_by_kind(atom)) return of_kind_[structure_.kinds[atom]];
    if (one_) return *one_;
    if (property_ == nullptr) return of_residue_[structure_.residues[atom]];
    const auto value = static_cast<double>(property_->values[atom]);
    if (!std::isfinite(value)) return data_of(0).color;
    const auto [least, most] = range_;
    return ramp_at(most > least ? (value - least) / (most - least) : 0.5, palette_);
}

std::string AtomColors::meaning_of(AtomIndex atom) const {
    const AtomKind& kind = structure_.of_kind[structure_.kinds[atom]];
    if (is_by_kind(atom))
        return kind.element != 0 ? std::string(data_of(kind.element).symbol) : "type " + kind.label;
    if (one_) return one_name_;
    if (property_ == nullptr) return name_of_residue_[structure_.residues[atom]];
    return property_->name + " " + to_text(property_->values[atom]);
}

} // namespace raylane::scenes
