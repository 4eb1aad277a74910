#pragma once

#include "core/scene/material.hpp"
#include "core/shapes/shape.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace raylane::core {

/// The index of empty space among materials.
inline constexpr MaterialIndex no_medium = std::numeric_limits<MaterialIndex>::max();

/// Returns the refractive index of a medium; that of empty space is 1.
inline float index_of(const std::vector<Material>& materials, MaterialIndex medium) {
    return medium == no_medium ? 1.0F : materials[medium].index;
}

/// The stack of transmissive materials that a ray is inside of, as its number in MediaStacks.
using Media = std::uint32_t;
inline constexpr Media empty_space = 0;

/// All stacks of materials that rays have been inside of, the last entered on top. The top decides
/// index and absorption. Each stack exists once, so two stacks are equal if their numbers are, and
/// a ray carries any number of materials in one number. For use by one thread.
class MediaStacks {
  public:
    MediaStacks() {
        stacks_.reserve(256);
        stacks_.assign(1, {no_medium, empty_space, none, none});
    }

    MaterialIndex top(Media media) const { return stacks_[media].material; }

    Media entered(Media media, MaterialIndex material) {
        for (Media above = stacks_[media].above; above != none; above = stacks_[above].next)
            if (top(above) == material) return above;
        const auto number = static_cast<Media>(stacks_.size());
        stacks_.push_back({material, media, none, stacks_[media].above});
        return stacks_[media].above = number;
    }
    /// Returns the stack without the innermost entry of this material, if it has one.
    Media left(Media media, MaterialIndex material) {
        above_.clear();
        Media at = media;
        for (; at != empty_space && top(at) != material; at = stacks_[at].below)
            above_.push_back(top(at));
        if (at == empty_space) return media;
        at = stacks_[at].below;
        for (; !above_.empty(); above_.pop_back())
            at = entered(at, above_.back());
        return at;
    }
    /// Returns the stack behind a surface of this material.
    Media crossed(Media media, MaterialIndex material, bool entering) {
        return entering ? entered(media, material) : left(media, material);
    }

    /// Returns the medium of a ray before it meets a surface of this material. A ray that leaves a
    /// body without having entered it started inside of it.
    MaterialIndex before(Media media, MaterialIndex material, bool transmits, bool entering) const {
        return media == empty_space && !entering && transmits ? material : top(media);
    }

  private:
    static constexpr Media none = std::numeric_limits<Media>::max();

    struct Stack {
        MaterialIndex material;
        Media below;
        Media above; ///< the newest stack on top of this one
        Media next;  ///< the next older stack on top of the same one
    };

    std::vector<Stack> stacks_;
    std::vector<MaterialIndex> above_; // materials above the removed entry
};

} // namespace raylane::core
