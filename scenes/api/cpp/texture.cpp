#include "core/scene/texture.hpp"

#include "raylane/material.hpp"
#include "scenes/api/cpp/convert.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "scenes/api/cpp/translate.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

namespace raylane {

namespace {

/// Throws InvalidValue, field "image".
template <class Components>
std::shared_ptr<const core::Texture> made(int width, int height, Components components) {
    try {
        return std::make_shared<const core::Texture>(
            width < 0 ? 0 : static_cast<std::size_t>(width),
            height < 0 ? 0 : static_cast<std::size_t>(height), std::move(components));
    } catch (const core::InvalidValue& invalid) {
        throw InvalidValue("image", invalid.expectation);
    }
}

} // namespace

Texture::Texture(int width, int height, std::span<const std::uint8_t> srgb)
    : texture_(made(width, height, core::Texture::Codes(srgb.begin(), srgb.end()))) {}

Texture::Texture(int width, int height, std::span<const float> linear)
    : texture_(made(width, height, core::Texture::Floats(linear.begin(), linear.end()))) {}

int Texture::width() const {
    return any() ? texture_->width() : 0;
}

int Texture::height() const {
    return any() ? texture_->height() : 0;
}

Color Texture::pixel(int x, int y) const {
    if (x < 0 || x >= width() || y < 0 || y >= height())
        throw InvalidValue("image", "must have a pixel in column " + std::to_string(x) +
                                        " and row " + std::to_string(y) + ", got " +
                                        std::to_string(width()) + " x " + std::to_string(height()));
    const core::Vec3d color = texture_->pixel(x, y);
    return {static_cast<float>(color.x), static_cast<float>(color.y), static_cast<float>(color.z)};
}

bool operator==(const Texture& a, const Texture& b) {
    return a.any() && b.any() ? *a.texture_ == *b.texture_ : a.any() == b.any();
}

namespace library {

void copy_texture(const core::Texture& from, Texture& to) {
    to = from.any() ? Internals::texture(from) : Texture();
}
void copy_texture(const Texture& from, core::Texture& to) {
    to = from.any() ? Internals::of(from) : core::Texture();
}
void copy_texture(const Texture& from, const raylane_texture*& to) {
    to = from.any() ? reinterpret_cast<const raylane_texture*>(&from) : nullptr; // NOLINT
}
void copy_texture(const raylane_texture* from, Texture& to) {
    to = from != nullptr ? *reinterpret_cast<const Texture*>(from) : Texture(); // NOLINT
}

} // namespace library

} // namespace raylane
