#pragma once

#include "core/material.hpp"

#include <array>
#include <limits>

namespace raylane::core {

/// The transmissive materials that a ray is inside of, the last entered on top. That one decides
/// index and absorption. Four deep: of a fifth the outermost is forgotten, and counts as empty
/// space.
class Media {
  public:
    static constexpr int depth = 4;
    static constexpr MaterialIndex none = std::numeric_limits<MaterialIndex>::max();

    Media() = default;
    /// The stack, its top first.
    explicit Media(const std::array<MaterialIndex, depth>& stack) : stack_(stack) {}

    MaterialIndex top() const { return stack_[0]; }
    /// Number i from the top.
    MaterialIndex at(int i) const { return stack_[i]; }
    bool empty() const { return stack_[0] == none; }

    void enter(MaterialIndex material) {
        for (int i = depth - 1; i > 0; --i)
            stack_[i] = stack_[i - 1];
        stack_[0] = material;
    }

    /// Takes out the innermost entry of this material, if there is one.
    void leave(MaterialIndex material) {
        bool below = false;
        for (int i = 0; i < depth; ++i) {
            below = below || stack_[i] == material;
            const MaterialIndex next = i + 1 < depth ? stack_[i + 1] : none;
            stack_[i] = below ? next : stack_[i];
        }
    }

  private:
    std::array<MaterialIndex, depth> stack_ = {none, none, none, none};
};

} // namespace raylane::core
