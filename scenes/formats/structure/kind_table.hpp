#pragma once

#include "scenes/formats/structure/structure.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// The kinds of a structure's atoms, by label.
class KindTable {
  public:
    explicit KindTable(std::vector<AtomKind>& kinds) : kinds_(kinds) { kinds_.clear(); }

    /// Returns the index of a label's kind, and adds the kind if it is new. Returns one above the
    /// last index if there are too many kinds.
    template <class ElementOf>
    std::size_t index_of(std::string_view label, const ElementOf& element_of) {
        if (last_ < kinds_.size() && kinds_[last_].label == label) return last_;
        constexpr std::size_t few = 8;
        for (std::size_t kind = 0; kind < std::min(kinds_.size(), few); ++kind)
            if (kinds_[kind].label == label) return last_ = kind;
        const auto found = index_.find(label);
        if (found != index_.end()) return last_ = found->second;
        if (kinds_.size() == Structure::max_kinds) return kinds_.size();
        last_ = kinds_.size();
        kinds_.push_back({.label = std::string(label), .element = element_of(label)});
        index_.emplace(std::string(label), last_);
        return last_;
    }

  private:
    std::vector<AtomKind>& kinds_;
    std::map<std::string, std::size_t, std::less<>> index_;
    std::size_t last_ = 0;
};

/// Returns the indices of the kinds with this label, or with this element's symbol in any case.
inline std::vector<std::size_t> kinds_named(const std::vector<AtomKind>& kinds,
                                            std::string_view word) {
    const Element element = element_of(word);
    std::vector<std::size_t> found;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        if (kinds[kind].label == word || (element != 0 && kinds[kind].element == element))
            found.push_back(kind);
    return found;
}

} // namespace raylane::scenes
