#include "core/scene/transfer.hpp"

#include "core/numbers/elementary.hpp"
#include "core/numbers/more_functions.hpp"

#include <charconv>
#include <limits>

namespace raylane::core {

double shown(double linear, Transfer transfer) {
    if (transfer == Transfer::linear) return linear;
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * core::pow(linear, 1.0 / 2.4) - 0.055;
}

namespace {

/// Returns the code of a linear component, where `white` is the largest code.
double code_of(float linear, Transfer transfer, double white) {
    if (!(linear > 0.0F)) return 0.0;
    if (linear >= 1.0F) return white;
    return white * shown(static_cast<double>(linear), transfer) + 0.5;
}

} // namespace

std::uint8_t encode(float linear, Transfer transfer) {
    return static_cast<std::uint8_t>(code_of(linear, transfer, 255.0));
}

std::uint16_t encode_in_16_bits(float linear, Transfer transfer) {
    return static_cast<std::uint16_t>(code_of(linear, transfer, 65535.0));
}

double linear_of_srgb(double component) {
    return component <= 0.04045 ? component / 12.92 : power((component + 0.055) / 1.055, 2.4);
}

float decode_srgb(std::uint8_t code) {
    return static_cast<float>(linear_of_srgb(code / 255.0));
}

std::optional<std::uint32_t> srgb_code_of(std::string_view text) {
    std::uint32_t code = 0;
    const char* const end = text.data() + text.size();
    if (text.size() != 7 || text[0] != '#' ||
        std::from_chars(text.data() + 1, end, code, 16).ptr != end)
        return std::nullopt;
    return code;
}

Color color_from_srgb(std::uint32_t code) {
    const auto channel = [&](int shift) {
        return decode_srgb(static_cast<std::uint8_t>(code >> shift & 0xFF));
    };
    return Color(channel(16), channel(8), channel(0));
}

std::optional<Color> color_from_srgb(std::string_view text) {
    const std::optional<std::uint32_t> code = srgb_code_of(text);
    return code ? std::optional(color_from_srgb(*code)) : std::nullopt;
}

Encoder::Encoder(Transfer transfer) {
    starts_[0] = 0.0F;
    starts_[256] = std::numeric_limits<float>::infinity();
    for (int code = 1; code < 256; ++code) {
        auto below = std::bit_cast<std::uint32_t>(starts_[code - 1]);
        auto start = std::bit_cast<std::uint32_t>(1.0F);
        while (start - below > 1) {
            const std::uint32_t middle = below + (start - below) / 2;
            (encode(std::bit_cast<float>(middle), transfer) < code ? below : start) = middle;
        }
        starts_[code] = std::bit_cast<float>(start);
    }
    for (std::uint32_t stretch = first; stretch < last; ++stretch)
        codes_[stretch - first] = encode(std::bit_cast<float>(stretch << shift), transfer);
}

} // namespace raylane::core
