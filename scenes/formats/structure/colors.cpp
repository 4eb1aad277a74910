#include "scenes/formats/structure/colors.hpp"

#include "core/scene/transfer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace raylane::scenes {

namespace {

/// Okabe and Ito, "Color Universal Design" (2008), without black.
constexpr std::array<std::uint32_t, 7> apart_from_each_other = {
    0x0072b2, 0xe69f00, 0x009e73, 0xd55e00, 0x56b4e9, 0xcc79a7, 0xf0e442};

/// Kelly, "Twenty-two colors of maximum contrast" (1965), without white and black.
constexpr std::array<std::uint32_t, 20> many_apart = {
    0xf3c300, 0x875692, 0xf38400, 0xa1caf1, 0xbe0032, 0xc2b280, 0x848482,
    0x008856, 0xe68fac, 0x0067a5, 0xf99379, 0x604e97, 0xf6a600, 0xb3446c,
    0xdcd300, 0x882d17, 0x8db600, 0x654522, 0xe25822, 0x2b3d26};

/// Viridis: Smith and van der Walt (2015), sampled at nine colours.
constexpr std::array<std::uint32_t, 9> ramp = {0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c,
                                               0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};

core::Color linear(std::uint32_t srgb) {
    const auto channel = [&](int shift) {
        return core::decode_srgb(static_cast<std::uint8_t>(srgb >> shift & 255));
    };
    return {channel(16), channel(8), channel(0)};
}

} // namespace

std::uint32_t ramp_at(double share) {
    constexpr int steps = static_cast<int>(ramp.size()) - 1;
    // 64 colours are enough for the eye, and need few materials.
    const double place = std::round(std::clamp(share, 0.0, 1.0) * 64.0) / 64.0 * steps;
    const int below = std::min(static_cast<int>(place), steps - 1);
    const double part = place - below;
    std::uint32_t color = 0;
    for (int shift = 16; shift >= 0; shift -= 8) {
        const auto channel = [&](int step) {
            return static_cast<double>(ramp[static_cast<std::size_t>(step)] >> shift & 255);
        };
        const double value = channel(below) + part * (channel(below + 1) - channel(below));
        color |= static_cast<std::uint32_t>(std::lround(value)) << shift;
    }
    return color;
}

std::uint32_t color_of_one(std::size_t place, std::size_t of) {
    if (of <= apart_from_each_other.size()) return apart_from_each_other[place];
    if (of <= many_apart.size()) return many_apart[place];
    return ramp_at(static_cast<double>(place) / static_cast<double>(of - 1));
}

std::uint32_t color_of_type(std::size_t number) {
    return apart_from_each_other[number % apart_from_each_other.size()];
}

core::MaterialIndex Palette::of(std::uint32_t srgb) {
    if (srgb == last_color_ && !index_.empty()) return last_;
    const auto [found, is_new] = index_.try_emplace(srgb);
    if (is_new) {
        core::Material material;
        material.pattern.colors[0] = linear(srgb);
        material.ambient = 0.0F;
        material.specular = 0.15F;
        material.exponent = 20.0F;
        material.opacity = opacity_;
        found->second = builder_.add_material(material);
    }
    last_color_ = srgb;
    return last_ = found->second;
}

} // namespace raylane::scenes
