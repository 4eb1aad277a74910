#pragma once

#include "core/shapes/big_array.hpp"
#include "core/shapes/shape.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace raylane::core {

/// The material of each shape by its id, in as few bytes as the largest index that has been added
/// takes: none where all are of the first material, else 1, 2 or 4.
class MaterialIndices {
  public:
    MaterialIndices() = default;
    /// `size` of them, `width` bytes each, as stored() has them.
    MaterialIndices(BigArray<std::uint8_t> stored, int width, std::size_t size)
        : size_(size), width_(width), room_(std::move(stored)) {}

    MaterialIndices(const MaterialIndices&) = default;
    MaterialIndices(MaterialIndices&& other) noexcept
        : size_(std::exchange(other.size_, 0)), reserved_(std::exchange(other.reserved_, 0)),
          width_(std::exchange(other.width_, 0)), room_(std::move(other.room_)) {}
    MaterialIndices& operator=(MaterialIndices other) noexcept {
        size_ = other.size_;
        reserved_ = other.reserved_;
        width_ = other.width_;
        room_ = std::move(other.room_);
        return *this;
    }
    ~MaterialIndices() = default;

    std::size_t size() const { return size_; }
    MaterialIndex operator[](std::size_t i) const {
        switch (width_) {
        case 0:
            return 0;
        case 1:
            return at<std::uint8_t>(i);
        case 2:
            return at<std::uint16_t>(i);
        default:
            return at<std::uint32_t>(i);
        }
    }

    void push_back(MaterialIndex material);
    /// Leaves the first `size`, of no fewer.
    void truncate(std::size_t size) { size_ = size; }
    /// Room for as many, so that adding them copies nothing.
    void reserve(std::size_t size);
    /// Gives back the room that is left.
    void shrink_to_fit();
    std::size_t bytes() const { return room_.bytes(); }

    /// Bytes of each.
    int width() const { return width_; }
    std::span<const std::uint8_t> stored() const {
        return {room_.data(), size_ * static_cast<std::size_t>(width_)};
    }

  private:
    template <class Number>
    MaterialIndex at(std::size_t i) const {
        Number number;
        std::memcpy(&number, room_.data() + i * sizeof number, sizeof number);
        return number;
    }
    void put(std::size_t i, MaterialIndex material);
    /// Has so many bytes each from now on, and room for as many.
    void rearrange(int width, std::size_t count);

    std::size_t size_ = 0, reserved_ = 0;
    int width_ = 0;
    BigArray<std::uint8_t> room_;
};

} // namespace raylane::core
