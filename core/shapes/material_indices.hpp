#pragma once

#include "core/shapes/big_array.hpp"
#include "core/shapes/shape.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>

namespace raylane::core {

/// The material of each shape by its id. Each index takes as few bytes as the largest one needs: 0
/// if all shapes have the first material, 1, 2 or 4 otherwise.
class MaterialIndices {
  public:
    MaterialIndices() = default;
    /// Takes `size` indices of `width` bytes each, laid out as in stored().
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
    /// Keeps the first `size` indices; there must be at least as many.
    void truncate(std::size_t size) { size_ = size; }
    /// Reserves memory for `size` indices, so that adding them copies nothing.
    void reserve(std::size_t size);
    /// Frees the unused memory.
    void shrink_to_fit();
    std::size_t bytes() const { return room_.bytes(); }

    /// Returns the bytes of each index.
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
    /// Changes the bytes of each index to `width`, and the capacity to `count` indices.
    void rearrange(int width, std::size_t count);

    std::size_t size_ = 0, reserved_ = 0;
    int width_ = 0;
    BigArray<std::uint8_t> room_;
};

} // namespace raylane::core
