#pragma once

#include "core/material.hpp"

#include <array>
#include <limits>
#include <vector>

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

    /// Through a surface of this material.
    void cross(MaterialIndex material, bool entering) {
        if (entering)
            enter(material);
        else
            leave(material);
    }

    /// What a ray is inside of that meets a surface of this material. One that leaves a body which
    /// it never entered has been inside from its start.
    MaterialIndex before(MaterialIndex material, bool transmits, bool entering) const {
        return empty() && !entering && transmits ? material : top();
    }

  private:
    std::array<MaterialIndex, depth> stack_ = {none, none, none, none};
};

/// Of a medium; of empty space 1.
inline float index_of(const std::vector<Material>& materials, MaterialIndex medium) {
    return medium == Media::none ? 1.0F : materials[medium].index;
}

} // namespace raylane::core
