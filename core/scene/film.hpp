#pragma once

#include "core/scene/material.hpp"
#include "core/scene/region.hpp"

#include <cstddef>
#include <vector>

namespace raylane::core {

/// An image in linear float RGB; rows from top to bottom, pixels from left to right. It may have an
/// alpha: the share of each pixel that something covers, in [0, 1]. Colours are premultiplied, so
/// the image over a background is color + (1 - alpha) * background.
class Film {
  public:
    Film(int width, int height, bool with_alpha = false)
        : Film(Region{0, 0, width, height}, with_alpha) {}
    /// A part of an image. Its pixels have the coordinates of the whole image.
    explicit Film(const Region& part, bool with_alpha = false)
        : x0_(part.x0), y0_(part.y0), width_(part.x1 - part.x0), height_(part.y1 - part.y0),
          pixels_(static_cast<std::size_t>(width_) * height_, Color(0.0F)),
          alphas_(with_alpha ? pixels_.size() : 0, 0.0F) {}

    int width() const { return width_; }
    int height() const { return height_; }
    Color& at(int x, int y) { return pixels_[index(x, y)]; }
    const Color& at(int x, int y) const { return pixels_[index(x, y)]; }
    /// Returns width * height colours, row by row.
    const std::vector<Color>& pixels() const { return pixels_; }

    bool has_alpha() const { return !alphas_.empty(); }
    float& alpha_at(int x, int y) { return alphas_[index(x, y)]; }
    /// Returns 1 if the film has no alpha.
    float alpha_at(int x, int y) const { return has_alpha() ? alphas_[index(x, y)] : 1.0F; }
    /// Returns width * height values, row by row, or an empty vector.
    const std::vector<float>& alphas() const { return alphas_; }
    /// Returns the index of a pixel in both vectors.
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - y0_) * width_ + (x - x0_);
    }

    /// Returns a part as a separate image, which begins at (0, 0).
    Film cropped(const Region& part) const {
        Film film(part.x1 - part.x0, part.y1 - part.y0, has_alpha());
        for (int y = part.y0; y < part.y1; ++y)
            for (int x = part.x0; x < part.x1; ++x) {
                film.at(x - part.x0, y - part.y0) = at(x, y);
                if (has_alpha()) film.alpha_at(x - part.x0, y - part.y0) = alpha_at(x, y);
            }
        return film;
    }

  private:
    int x0_;
    int y0_;
    int width_;
    int height_;
    std::vector<Color> pixels_;
    std::vector<float> alphas_;
};

} // namespace raylane::core
