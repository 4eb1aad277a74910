#include "core/transfer.hpp"

#include "core/elementary.hpp"

namespace raylane::core {

std::uint8_t encode(float linear, Transfer transfer) {
    if (!(linear > 0.0F)) return 0;
    if (linear >= 1.0F) return 255;
    auto value = static_cast<double>(linear);
    if (transfer == Transfer::srgb)
        value = value <= 0.0031308 ? 12.92 * value : 1.055 * core::pow(value, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(255.0 * value + 0.5);
}

} // namespace raylane::core
