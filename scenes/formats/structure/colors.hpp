#pragma once

#include "core/scene/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <unordered_map>

/// Colours are sRGB, 0xRRGGBB.
namespace raylane::scenes {

/// Returns one of 64 ordered colours, for a share in [0, 1].
std::uint32_t ramp_at(double share);

/// Returns the colour at `place` among `of` colours that have no order.
std::uint32_t color_of_one(std::size_t place, std::size_t of);

/// Returns the colour of a type that is not an element, by its number. Colours repeat.
std::uint32_t color_of_type(std::size_t number);

/// Materials of atoms, by colour.
class Palette {
  public:
    explicit Palette(core::SceneBuilder& builder, float opacity = 1.0F)
        : builder_(builder), opacity_(opacity) {}

    core::MaterialIndex of(std::uint32_t srgb);

  private:
    core::SceneBuilder& builder_;
    float opacity_;
    std::unordered_map<std::uint32_t, core::MaterialIndex> index_;
    std::uint32_t last_color_ = 0;
    core::MaterialIndex last_ = 0;
};

} // namespace raylane::scenes
