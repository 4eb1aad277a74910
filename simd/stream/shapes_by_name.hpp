#pragma once

#include "simd/query/scene_data.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace raylane::simd {

/// The slots of a scene's shapes by their ids.
class SlotsByName {
  public:
    explicit SlotsByName(const SceneData& scene) : scene_(scene), slots_(scene.slots_by_id()) {
        for (const auto& prototype : scene.prototypes())
            of_prototypes_.push_back(prototype->slots_by_id());
    }

    /// Returns no_slot if no shape has this id, and for duplicates other than the first.
    std::uint32_t operator[](core::ShapeId id) const {
        if (of_prototypes_.empty()) return id < slots_.size() ? slots_[id] : no_slot;
        return id < scene_.scene().shape_count() ? slot_beside_copies(id) : no_slot;
    }
    /// Fetches the slot of a shape into the cache.
    void prefetch(core::ShapeId id) const {
        if (id < slots_.size()) __builtin_prefetch(&slots_[id]); // useless beside copies
    }

  private:
    std::uint32_t slot_beside_copies(core::ShapeId id) const {
        const std::size_t own = scene_.scene().material_indices().stored_index(id);
        if (own != core::MaterialIndices::no_index) return slots_[own];
        const core::Copies& copies = *scene_.scene().copies();
        const core::Copies::Copy copy = copies.copy_with(id);
        const auto set = static_cast<std::size_t>(&copy.set - copies.sets().data());
        const std::uint32_t slot = of_prototypes_[set][id - core::Copies::first_id_of(copy)];
        return slot == no_slot ? no_slot : scene_.slot_in_copy(copy, slot);
    }

    const SceneData& scene_;
    core::BigArray<std::uint32_t> slots_;
    std::vector<core::BigArray<std::uint32_t>> of_prototypes_;
};

/// Makes the slots by name when the first ray names a shape. Any number of threads may call it at a
/// time.
class ShapesByName {
  public:
    explicit ShapesByName(const SceneData& scene) : scene_(scene) {}

    const SlotsByName& slots() const {
        std::call_once(are_there_, [&] { slots_ = std::make_unique<const SlotsByName>(scene_); });
        return *slots_;
    }

  private:
    const SceneData& scene_;
    mutable std::once_flag are_there_;
    mutable std::unique_ptr<const SlotsByName> slots_;
};

} // namespace raylane::simd
