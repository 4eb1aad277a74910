#pragma once

#include "core/scene/film.hpp"
#include "core/scene/transfer.hpp"
#include "scenes/images/image_options.hpp"

#include <cstdint>
#include <vector>

namespace raylane::scenes {

/// Encodes the components of a film's rows as codes of 8 or 16 bits, the high byte first. Colours
/// are not multiplied by alpha.
class RowEncoder {
  public:
    /// `options` must outlive the encoder.
    explicit RowEncoder(const ImageOptions& options)
        : options_(options), encode_(options.transfer) {}

    int bits() const { return options_.bits == 16 ? 16 : 8; }

    const std::vector<std::uint8_t>& codes(const core::Film& film, int y) {
        codes_.clear();
        for (int x = 0; x < film.width(); ++x) {
            const float alpha = film.alpha_at(x, y);
            for (int channel = 0; channel < 3; ++channel)
                add(alpha > 0.0F ? film.at(x, y)[channel] / alpha : 0.0F);
            if (film.has_alpha()) add_alpha(alpha);
        }
        return codes_;
    }

  private:
    void add(float component) {
        if (bits() == 8)
            codes_.push_back(encode_(component));
        else
            add_word(core::encode_in_16_bits(component, options_.transfer));
    }
    /// Adds an alpha without a transfer curve, since it is a fraction and not light.
    void add_alpha(float alpha) {
        if (bits() == 8)
            codes_.push_back(core::encode(alpha, core::Transfer::linear));
        else
            add_word(core::encode_in_16_bits(alpha, core::Transfer::linear));
    }
    void add_word(std::uint16_t code) {
        codes_.push_back(static_cast<std::uint8_t>(code >> 8));
        codes_.push_back(static_cast<std::uint8_t>(code & 0xFF));
    }

    const ImageOptions& options_;
    core::Encoder encode_;
    std::vector<std::uint8_t> codes_;
};

} // namespace raylane::scenes
