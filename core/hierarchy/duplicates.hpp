#pragma once

#include "core/hierarchy/item.hpp"
#include "core/shapes/material_indices.hpp"
#include "core/shapes/shape_list.hpp"
#include "core/solids/solids.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace raylane::core {

/// A shape that a scene does not store, because it equals the stored shape `first`.
struct MergedShape {
    ShapeId id, first; ///< first < id
};

/// The merged shapes of each kind, in the order of their ids.
using MergedShapes = std::array<std::vector<MergedShape>, kind_count>;

/// Finds duplicate shapes: same kind, numbers and material. A scene needs only the first of them.
/// Triangles of a larger polygon are never duplicates, because each has its own list of coplanar
/// triangles. Parts of solids are never duplicates either. Without `merge`, no shape is one.
class Duplicates {
  public:
    /// `material_of`: by id. `polygons`: those of more than one triangle, ascending. `solids`: null
    /// if the scene has no solids.
    Duplicates(const ShapeLists& lists, const MaterialIndices& material_of,
               std::span<const IdRange> polygons, const Solids* solids = nullptr, bool merge = true)
        : lists_(lists), material_of_(material_of), polygons_(polygons), solids_(solids),
          merge_(merge) {}

    /// Returns the bounds of a part of a solid within the solid; null for other shapes.
    const Bounds* bounds_of_part(ShapeId id) const {
        return solids_ != nullptr ? solids_->bounds_of(id) : nullptr;
    }

    /// Moves one item of each distinct shape to the front, that of the lowest id, and returns their
    /// number. Takes linear time if few items have the same bounds, or if `deep`, which hashes the
    /// shapes rather than the bounds. `room` is scratch memory.
    std::size_t drop_from(std::span<Item> items, std::vector<std::uint32_t>& room, bool deep) const;

    /// Returns the shapes that drop_from() has dropped.
    MergedShapes merged() const;

    /// Returns the unbounded shapes of a list without duplicates.
    template <class Shape>
    ShapeList<Shape> without_duplicates(const ShapeList<Shape>& list) const {
        std::vector<Item> items;
        items.reserve(list.size());
        for (std::size_t i = 0; i < list.size(); ++i)
            items.emplace_back(Bounds{}, kind_of<Shape>, static_cast<std::uint32_t>(i));
        std::vector<std::uint32_t> room;
        items.resize(drop_from(items, room, true));
        std::sort(items.begin(), items.end(),
                  [](const Item& a, const Item& b) { return a.position() < b.position(); });
        ShapeList<Shape> left;
        for (const Item& item : items)
            left.add(list.exact(item.position()), list[item.position()].id);
        return left;
    }

  private:
    bool are_duplicates(const Item& a, const Item& b) const;
    ShapeId id_of(const Item& item) const;
    std::uint64_t hash_of_shape(const Item& item) const;
    bool is_unique(ShapeId id) const;

    const ShapeLists& lists_;
    const MaterialIndices& material_of_;
    std::span<const IdRange> polygons_;
    const Solids* solids_;
    bool merge_;
    mutable std::mutex mutex_; // of merged_
    mutable MergedShapes merged_;
};

} // namespace raylane::core
