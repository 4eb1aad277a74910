#pragma once

#include "core/scene/scene.hpp"
#include "scenes/formats/structure/representation.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

/// Colours are sRGB, 0xRRGGBB.
namespace raylane::scenes {

/// Returns the colour at a share in [0, 1] of a ramp, between two of its colours.
std::uint32_t color_between(std::span<const std::uint32_t> ramp, double share);

/// Returns one of 64 ordered colours of a palette, for a share in [0, 1]. `palette` is one of
/// palette_names(), or empty for the first.
std::uint32_t ramp_at(double share, std::string_view palette = {});

/// Returns a darker shade of a colour.
std::uint32_t darker(std::uint32_t srgb);

/// Returns the names of palettes. All are perceptually uniform, and ordered for colour-blind
/// readers as well.
std::vector<std::string_view> palette_names();

/// Returns the colour of a name of CSS such as "orange", in any case, or of "#rrggbb"; nothing for
/// other words.
std::optional<std::uint32_t> color_named(std::string_view word);

/// Returns the names that color_named() knows.
std::vector<std::string_view> color_names();

/// Returns the colour at `place` among `count` colours that have no order.
std::uint32_t color_of_one(std::size_t place, std::size_t count);

/// Returns the colour of a type that is not an element, by its number. Colours repeat.
std::uint32_t color_of_type(std::size_t number);

/// Materials of atoms, by colour.
class Palette {
  public:
    explicit Palette(core::SceneBuilder& builder, float opacity = 1.0F,
                     Finish finish = Finish::usual)
        : builder_(builder), opacity_(opacity), finish_(finish) {}

    /// Returns the material of a colour. A new one has the name that `name_of_new` returns.
    template <class Name>
    core::MaterialIndex of(std::uint32_t srgb, const Name& name_of_new) {
        if (srgb == last_color_ && !index_.empty()) return last_;
        const auto [found, is_new] = index_.try_emplace(srgb);
        if (is_new) found->second = add(srgb, name_of_new());
        last_color_ = srgb;
        return last_ = found->second;
    }

  private:
    core::MaterialIndex add(std::uint32_t srgb, std::string_view name);

    core::SceneBuilder& builder_;
    float opacity_;
    Finish finish_;
    std::unordered_map<std::uint32_t, core::MaterialIndex> index_;
    std::uint32_t last_color_ = 0;
    core::MaterialIndex last_ = 0;
};

} // namespace raylane::scenes
