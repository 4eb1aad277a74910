#include "core/hierarchy/duplicates.hpp"

#include "core/hierarchy/hash.hpp"
#include "core/shapes/shape_table.hpp"

#include <cstring>
#include <utility>

namespace raylane::core {

namespace {

std::uint64_t hash_of_bounds(const Item& item) {
    auto hash = static_cast<std::uint64_t>(item.kind());
    for (int axis = 0; axis < 3; ++axis)
        hash =
            mixed(hash, std::uint64_t{std::bit_cast<std::uint32_t>(float(item.lower[axis]))} << 32 |
                            std::bit_cast<std::uint32_t>(float(item.upper[axis])));
    return hash;
}

bool have_same_bounds(const Item& a, const Item& b) {
    return std::memcmp(&a.lower, &b.lower, 3 * sizeof(float)) == 0 &&
           std::memcmp(&a.upper, &b.upper, 3 * sizeof(float)) == 0;
}

} // namespace

std::size_t Duplicates::drop_from(std::span<Item> items, std::vector<std::uint32_t>& room,
                                  bool deep) const {
    // A hash table of the indices of the kept items, plus 1; 0: free.
    const std::size_t size = std::bit_ceil(2 * items.size());
    room.assign(size, 0);
    std::uint32_t left = 0;
    std::vector<MergedShape> merged; // `first`: the index of the kept item
    for (Item& item : items) {
        std::size_t at = (deep ? hash_of_shape(item) : hash_of_bounds(item)) & (size - 1);
        while (room[at] != 0 && !are_duplicates(items[room[at] - 1], item))
            at = (at + 1) & (size - 1);
        if (room[at] == 0) {
            items[left] = item;
            room[at] = ++left;
        } else {
            Item& kept = items[room[at] - 1];
            if (id_of(item) < id_of(kept)) std::swap(item, kept);
            merged.push_back({id_of(item), room[at] - 1});
        }
    }
    if (merged.empty()) return left;
    const std::lock_guard lock(mutex_);
    for (const MergedShape& shape : merged) {
        const Item& kept = items[shape.first];
        merged_[static_cast<std::size_t>(kept.kind())].push_back({shape.id, id_of(kept)});
    }
    return left;
}

MergedShapes Duplicates::merged() const {
    MergedShapes merged = merged_;
    for (std::vector<MergedShape>& of_kind : merged)
        std::ranges::sort(of_kind, {}, &MergedShape::id);
    return merged;
}

ShapeId Duplicates::id_of(const Item& item) const {
    return with_shape_type(item.kind(), [&]<class Shape>(std::type_identity<Shape>) {
        return std::get<ShapeList<Shape>>(lists_)[item.position()].id;
    });
}

bool Duplicates::are_duplicates(const Item& a, const Item& b) const {
    if (a.kind() != b.kind() || !have_same_bounds(a, b)) return false;
    return with_shape_type(a.kind(), [&]<class Shape>(std::type_identity<Shape>) {
        const auto& list = std::get<ShapeList<Shape>>(lists_);
        const Listed<Shape>&one = list[a.position()], &other = list[b.position()];
        const auto are_same = [](const auto& s, const auto& t) {
            return std::memcmp(&s, &t, sizeof s) == 0; // NOLINT: compares bits
        };
        return are_same(one.shape, other.shape) &&
               (!list.has_doubles() ||
                are_same(list.exact(a.position()), list.exact(b.position()))) &&
               material_of_[one.id] == material_of_[other.id] && !is_unique(one.id) &&
               !is_unique(other.id);
    });
}

std::uint64_t Duplicates::hash_of_shape(const Item& item) const {
    return with_shape_type(item.kind(), [&]<class Shape>(std::type_identity<Shape>) {
        const Listed<Shape>& listed = std::get<ShapeList<Shape>>(lists_)[item.position()];
        std::uint64_t hash =
            mixed(static_cast<std::uint64_t>(item.kind()), material_of_[listed.id]);
        for (const float value : numbers_of(listed.shape))
            hash = mixed(hash, std::bit_cast<std::uint32_t>(value));
        // A unique shape equals no other shape.
        return is_unique(listed.id) ? mixed(hash, listed.id) : hash;
    });
}

bool Duplicates::is_unique(ShapeId id) const {
    return !merge_ || range_with(polygons_, id) != nullptr ||
           (solids_ != nullptr && solids_->has(id));
}

} // namespace raylane::core
