#pragma once

#include "core/numbers/vector.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace raylane::core {

struct Pattern;
struct ShapeCoordinates;

/// An image as the colour of surfaces. Copies share the pixels.
class Texture {
  public:
    /// Components red, green and blue of all pixels, rows from the top down: codes of the sRGB
    /// curve, or linear numbers.
    using Codes = std::vector<std::uint8_t>;
    using Floats = std::vector<float>;

    static constexpr std::size_t max_pixels = std::size_t{1} << 26;

    Texture() = default;
    /// Throws InvalidValue: `width` and `height` must be positive, with at most max_pixels and as
    /// many components as pixels need; floats must be from 0 to 1e10.
    /// `file`: the file that holds the image, if any.
    template <class Components>
    Texture(std::size_t width, std::size_t height, Components components,
            const std::string& file = {});

    bool any() const { return parts_ != nullptr; }
    int width() const { return parts_->width; }
    int height() const { return parts_->height; }
    const std::variant<Codes, Floats>& components() const { return parts_->components; }
    /// Returns the linear colour of a pixel, which must exist.
    Vec3d pixel(int x, int y) const;

    /// The file that holds the image; empty if it comes from memory.
    const std::string& file() const;
    /// Returns the same image, by another name of its file.
    Texture named(const std::string& file) const;

    bool operator==(const Texture& other) const;

  private:
    struct Parts {
        int width, height;
        std::variant<Codes, Floats> components;
    };
    std::shared_ptr<const Parts> parts_;
    std::shared_ptr<const std::string> file_;
};

/// Returns the colour of a pattern's image at coordinates on a shape: between the four nearest
/// pixels, in linear light. `is_round`: u is a fraction of a turn, and v runs from 0 to 1 without
/// a return from the last row to the first one.
Vec3d color_in_image(const Pattern& pattern, const ShapeCoordinates& on_shape, bool is_round);

} // namespace raylane::core
