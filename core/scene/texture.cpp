#include "core/scene/texture.hpp"

#include "core/scene/material.hpp"
#include "core/scene/transfer.hpp"
#include "core/shapes/checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace raylane::core {

namespace {

/// Returns the linear components of all codes.
const std::array<float, 256>& linear_of_codes() {
    static const auto table = [] {
        std::array<float, 256> linear{};
        for (std::size_t code = 0; code < linear.size(); ++code)
            linear[code] = decode_srgb(static_cast<std::uint8_t>(code));
        return linear;
    }();
    return table;
}

void check_components(const Texture::Codes&) {}
void check_components(const Texture::Floats& components) {
    for (std::size_t i = 0; i < components.size(); ++i)
        if (!(components[i] >= 0.0F && components[i] <= 1e10F))
            throw InvalidValue("", "must have components from 0 to 1e10, got " +
                                       checks::text_of(components[i]) + " in pixel " +
                                       std::to_string(i / 3));
}

} // namespace

template <class Components>
Texture::Texture(std::size_t width, std::size_t height, Components components,
                 const std::string& file) {
    if (width == 0 || height == 0 || width > max_pixels || height > max_pixels ||
        width * height > max_pixels)
        throw InvalidValue("", "must be an image of 1 to " + std::to_string(max_pixels) +
                                   " pixels, got " + std::to_string(width) + " x " +
                                   std::to_string(height));
    if (components.size() != 3 * width * height)
        throw InvalidValue("", "must have 3 components for each of " + std::to_string(width) +
                                   " x " + std::to_string(height) + " pixels, got " +
                                   std::to_string(components.size()));
    check_components(components);
    parts_ = std::make_shared<const Parts>(
        Parts{static_cast<int>(width), static_cast<int>(height), std::move(components)});
    if (!file.empty()) *this = named(file);
}
template Texture::Texture(std::size_t, std::size_t, Codes, const std::string&);
template Texture::Texture(std::size_t, std::size_t, Floats, const std::string&);

const std::string& Texture::file() const {
    static const std::string none;
    return file_ != nullptr ? *file_ : none;
}

Texture Texture::named(const std::string& file) const {
    Texture same = *this;
    same.file_ = std::make_shared<const std::string>(file);
    return same;
}

Vec3d Texture::pixel(int x, int y) const {
    const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) +
                                static_cast<std::size_t>(x));
    const auto color = [&](const auto& component) {
        return Vec3d(static_cast<double>(component(at)), static_cast<double>(component(at + 1)),
                     static_cast<double>(component(at + 2)));
    };
    if (const auto* codes = std::get_if<Codes>(&parts_->components))
        return color([&](std::size_t i) { return linear_of_codes()[(*codes)[i]]; });
    const auto& floats = *std::get_if<Floats>(&parts_->components);
    return color([&](std::size_t i) { return floats[i]; });
}

bool Texture::operator==(const Texture& other) const {
    if (parts_ == other.parts_) return true;
    return any() && other.any() && width() == other.width() && components() == other.components();
}

namespace {

/// The two pixels of a row or column between which a point is.
struct Between {
    int first, second;
    double weight; ///< of the second
};

/// Returns the pixels around a coordinate, in images from the first edge on. `end`: coordinates on
/// the shape run from 0 to this; infinite if they have no end.
Between pixels_around(double coordinate, double end, int count, ImageWrap wrap) {
    if (!std::isfinite(coordinate)) return {0, 0, 0.0};
    constexpr double most_images = 0x1p20; // with more of them, no end is visible
    const bool ends = end <= most_images && wrap == ImageWrap::repeat;
    if (wrap == ImageWrap::clamp)
        coordinate = std::clamp(coordinate, 0.0, 1.0);
    else if (!ends)
        coordinate -= std::floor(coordinate);
    const auto pixels = static_cast<double>(count);
    const double at = coordinate * pixels - 0.5, below = std::floor(at);
    double first = below, second = below + 1.0;
    if (ends || wrap == ImageWrap::clamp) {
        const double last = std::max(std::ceil((ends ? end : 1.0) * pixels) - 1.0, 0.0);
        first = std::clamp(first, 0.0, last);
        second = std::clamp(second, 0.0, last);
    }
    const auto in_image = [&](double pixel) {
        return static_cast<int>(pixel - pixels * std::floor(pixel / pixels));
    };
    return {in_image(first), in_image(second), at - below};
}

} // namespace

Vec3d color_in_image(const Pattern& pattern, const ShapeCoordinates& on_shape, bool is_round) {
    const Texture& image = pattern.image;
    constexpr double no_end = std::numeric_limits<double>::infinity();
    const auto width = static_cast<double>(pattern.width);
    const auto height = static_cast<double>(pattern.height);
    const Between x = pixels_around(on_shape.u / width, no_end, image.width(), pattern.wrap);
    // Rows are counted from below.
    const Between y = pixels_around(on_shape.v / height, is_round ? 1.0 / height : no_end,
                                    image.height(), pattern.wrap);
    const auto in_row = [&](int row) {
        const int from_top = image.height() - 1 - row;
        const Vec3d first = image.pixel(x.first, from_top);
        return first + x.weight * (image.pixel(x.second, from_top) - first);
    };
    const Vec3d below = in_row(y.first);
    return below + y.weight * (in_row(y.second) - below);
}

} // namespace raylane::core
