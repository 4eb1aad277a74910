#pragma once

#include "core/scene/material.hpp"
#include "core/shapes/shape.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace raylane::core {

/// Empty space, among materials.
inline constexpr MaterialIndex no_medium = std::numeric_limits<MaterialIndex>::max();

/// Refractive index of a medium; of empty space 1.
inline float index_of(const std::vector<Material>& materials, MaterialIndex medium) {
    return medium == no_medium ? 1.0F : materials[medium].index;
}

/// The transmissive materials that a ray is inside of, by number: MediaStacks knows them.
using Media = std::uint32_t;
inline constexpr Media empty_space = 0;

/// All stacks of materials that rays have been inside of, the last entered on top. That one decides
/// index and absorption. Each is said once, so two are the same where their numbers are, and a ray
/// carries any number of materials in one. To be used by one thread.
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
    /// Without the innermost entry of this material, if there is one.
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
    /// Through a surface of this material.
    Media crossed(Media media, MaterialIndex material, bool entering) {
        return entering ? entered(media, material) : left(media, material);
    }

    /// Medium of a ray before it meets a surface of this material. One that leaves a body which it
    /// never entered has been inside from its start.
    MaterialIndex before(Media media, MaterialIndex material, bool transmits, bool entering) const {
        return media == empty_space && !entering && transmits ? material : top(media);
    }

  private:
    static constexpr Media none = std::numeric_limits<Media>::max();

    struct Stack {
        MaterialIndex material;
        Media below;
        Media above; ///< the last that has come on top of this one
        Media next;  ///< another on top of the same
    };

    std::vector<Stack> stacks_;
    std::vector<MaterialIndex> above_; // what is taken out
};

} // namespace raylane::core
