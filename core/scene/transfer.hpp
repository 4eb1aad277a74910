#pragma once

#include "core/scene/surroundings.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <string_view>

namespace raylane::core {

/// Returns a linear component in [0, 1] as the film shows it, in [0, 1]. srgb: by the curve of IEC
/// 61966-2-1.
double shown(double linear, Transfer transfer);

/// Returns the 8-bit code of a linear component, which is clamped to [0, 1] first; NaN gives 0.
/// srgb: the curve of IEC 61966-2-1. Rounded to the nearest code.
std::uint8_t encode(float linear, Transfer transfer);

/// Same, in 16 bits.
std::uint16_t encode_in_16_bits(float linear, Transfer transfer);

/// Returns the linear component of a component of the sRGB curve. Any number is valid.
double linear_of_srgb(double component);

/// Same, for an 8-bit code.
float decode_srgb(std::uint8_t code);

/// Returns the code 0xRRGGBB of "#rrggbb", six hexadecimal digits; none for another text.
std::optional<std::uint32_t> srgb_code_of(std::string_view text);

/// Returns the linear colour of a code 0xRRGGBB of the sRGB curve, or of its text "#rrggbb"; none
/// for another text.
Color color_from_srgb(std::uint32_t code);
std::optional<Color> color_from_srgb(std::string_view text);

/// encode() for many components, with a lookup table: the codes are the same.
class Encoder {
  public:
    explicit Encoder(Transfer transfer);

    std::uint8_t operator()(float linear) const {
        if (!(linear > lowest)) return 0;
        if (linear >= 1.0F) return 255;
        const std::uint8_t code = codes_[stretch_of(linear)];
        return static_cast<std::uint8_t>(code + (linear >= starts_[code + 1] ? 1 : 0));
    }

  private:
    /// A stretch is 2^-7 of a power of two wide. From one stretch to the next, the code rises by at
    /// most 1.
    static constexpr int shift = 16;
    static constexpr float lowest = 0x1p-13F; // below half of the first code
    static constexpr std::uint32_t first = std::bit_cast<std::uint32_t>(lowest) >> shift;
    static constexpr std::uint32_t last = std::bit_cast<std::uint32_t>(1.0F) >> shift;
    static std::uint32_t stretch_of(float linear) {
        return (std::bit_cast<std::uint32_t>(linear) >> shift) - first;
    }

    std::array<float, 257> starts_;                ///< by code: the lowest component with that code
    std::array<std::uint8_t, last - first> codes_; ///< by stretch: the code at its start
};

} // namespace raylane::core
