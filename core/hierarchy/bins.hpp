#pragma once

#include "core/hierarchy/item.hpp"
#include "core/hierarchy/workers.hpp"

#include <cstddef>
#include <span>

namespace raylane::core {

/// Consecutive items with their bounds and the bounds of their doubled centres.
struct Range {
    std::size_t first, last;
    Box4 box, centers;

    std::size_t size() const { return last - first; }
};

struct Halves {
    Range left, right;
};

/// Returns a range of the items with the bounds of its items and of their doubled centres.
Range range_of(std::span<const Item> items, std::size_t first, std::size_t last, Workers& workers);

/// Splits a range of more than one block by the surface-area heuristic over bins of centres (Wald,
/// "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007). The cost counts blocks
/// of 16. Rearranges the range's items. Neither half is empty.
Halves split_by_bins(std::span<Item> items, const Range& range, Workers& workers);

} // namespace raylane::core
