#pragma once

#include "core/scene/material.hpp"

#include <cstddef>
#include <vector>

namespace raylane::core {

/// A picture in linear float RGB; rows run from the top down, pixels from left to right.
class Film {
  public:
    Film(int width, int height)
        : width_(width), height_(height),
          pixels_(static_cast<std::size_t>(width) * height, Color(0.0F)) {}

    int width() const { return width_; }
    int height() const { return height_; }
    Color& at(int x, int y) { return pixels_[index(x, y)]; }
    const Color& at(int x, int y) const { return pixels_[index(x, y)]; }
    /// width * height colours, row by row.
    const std::vector<Color>& pixels() const { return pixels_; }

  private:
    std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

    int width_;
    int height_;
    std::vector<Color> pixels_;
};

} // namespace raylane::core
