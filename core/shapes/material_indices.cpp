#include "core/shapes/material_indices.hpp"

#include <algorithm>

namespace raylane::core {

namespace {

int width_of(MaterialIndex material) {
    return material == 0 ? 0 : material < 0x100 ? 1 : material < 0x10000 ? 2 : 4;
}

} // namespace

void MaterialIndices::push_back(MaterialIndex material) {
    constexpr std::size_t least = 64;
    const int width = std::max(width_, width_of(material));
    if (width != width_ || room_.is_shared() ||
        room_.bytes() < (size_ + 1) * static_cast<std::size_t>(width))
        rearrange(width, size_ < reserved_ ? reserved_ : std::max(least, 2 * size_));
    put(size_++, material);
}

void MaterialIndices::put(std::size_t i, MaterialIndex material) {
    const auto put_as = [&](auto number) {
        std::memcpy(room_.data() + i * sizeof number, &number, sizeof number);
    };
    if (width_ == 1) put_as(static_cast<std::uint8_t>(material));
    if (width_ == 2) put_as(static_cast<std::uint16_t>(material));
    if (width_ == 4) put_as(static_cast<std::uint32_t>(material));
}

void MaterialIndices::rearrange(int width, std::size_t count) {
    MaterialIndices other;
    other.width_ = width;
    other.room_ = BigArray<std::uint8_t>(count * static_cast<std::size_t>(width));
    if (width == width_ && size_ > 0 && width > 0)
        std::memcpy(other.room_.data(), room_.data(), stored().size());
    else
        for (std::size_t i = 0; i < size_; ++i)
            other.put(i, (*this)[i]);
    width_ = width;
    room_ = std::move(other.room_);
}

void MaterialIndices::reserve(std::size_t size) {
    reserved_ = size;
    if (size > size_ && room_.bytes() < size * static_cast<std::size_t>(width_))
        rearrange(width_, size);
}

void MaterialIndices::shrink_to_fit() {
    if (room_.bytes() > stored().size()) rearrange(width_, size_);
}

} // namespace raylane::core
