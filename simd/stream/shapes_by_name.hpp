#pragma once

#include "simd/query/scene_data.hpp"

#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace raylane::simd {

/// Slots of shapes by their ids, for rays that name the shapes that they leave. Made when the first
/// ray does. Any number of threads may call it at a time.
class ShapesByName {
  public:
    explicit ShapesByName(const SceneData& scene) : scene_(scene) {}

    std::span<const std::uint32_t> slots() const {
        std::call_once(are_there_, [&] { slots_ = scene_.slots_by_id(); });
        return slots_;
    }

  private:
    const SceneData& scene_;
    mutable std::once_flag are_there_;
    mutable std::vector<std::uint32_t> slots_;
};

} // namespace raylane::simd
