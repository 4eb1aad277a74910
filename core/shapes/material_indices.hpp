#pragma once

#include "core/shapes/big_array.hpp"
#include "core/shapes/shape.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace raylane::core {

/// The material of each shape by its id. Each index takes as few bytes as the largest one needs: 0
/// if all shapes have the first material, 1, 2 or 4 otherwise. Indices of copies of shapes are
/// stored once for all of them.
class MaterialIndices {
  public:
    MaterialIndices() = default;
    /// Takes `size` indices of `width` bytes each, laid out as in stored().
    MaterialIndices(BigArray<std::uint8_t> stored, int width, std::size_t size)
        : size_(size), width_(width), room_(std::move(stored)) {}

    MaterialIndices(const MaterialIndices&) = default;
    MaterialIndices(MaterialIndices&& other) noexcept
        : size_(std::exchange(other.size_, 0)), reserved_(std::exchange(other.reserved_, 0)),
          width_(std::exchange(other.width_, 0)), room_(std::move(other.room_)),
          repeats_(std::exchange(other.repeats_, {})) {}
    MaterialIndices& operator=(MaterialIndices other) noexcept {
        size_ = other.size_;
        reserved_ = other.reserved_;
        width_ = other.width_;
        room_ = std::move(other.room_);
        repeats_ = std::move(other.repeats_);
        return *this;
    }
    ~MaterialIndices() = default;

    std::size_t size() const {
        return repeats_.empty() ? size_ : size_ - repeats_.back().stored + repeats_.back().end;
    }
    MaterialIndex operator[](std::size_t i) const {
        return repeats_.empty() ? stored_at(i) : at_any(i);
    }
    /// Returns the number of indices that are stored by themselves.
    std::size_t stored_count() const { return size_; }
    /// Returns the number of such indices before index i, or no_index if it is not one of them.
    std::size_t stored_index(std::size_t i) const;
    static constexpr std::size_t no_index = static_cast<std::size_t>(-1);
    /// Calls visit(material) at least once for each material.
    template <class Visit>
    void for_each_material(const Visit& visit) const {
        for (std::size_t i = 0; i < size_; ++i)
            visit(stored_at(i));
        for (const Repeat& repeat : repeats_)
            repeat.of_one->for_each_material(visit);
    }
    /// Appends all indices of `of_one` so many times.
    void push_back_repeated(const MaterialIndices& of_one, std::size_t times);
    /// Returns new_index[i] for each index i, in the same order.
    MaterialIndices renumbered(std::span<const MaterialIndex> new_index) const;
    /// Returns the same indices, all stored by themselves.
    MaterialIndices all_stored() const;

    void push_back(MaterialIndex material);
    /// Keeps the first `size` indices; there must be at least as many, and no copies behind them.
    void truncate(std::size_t size) { size_ -= this->size() - size; }
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
    /// `end - first` indices, those of `of_one` repeated.
    struct Repeat {
        std::size_t first, end;
        std::size_t stored; ///< number of stored indices before it
        std::shared_ptr<const MaterialIndices> of_one;
    };

    MaterialIndex stored_at(std::size_t i) const {
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
    MaterialIndex at_any(std::size_t i) const;
    /// Returns the last repeat that begins at or before index i, or null.
    const Repeat* repeat_before(std::size_t i) const;
    void put(std::size_t i, MaterialIndex material);
    /// Changes the bytes of each index to `width`, and the capacity to `count` indices.
    void rearrange(int width, std::size_t count);

    std::size_t size_ = 0, reserved_ = 0; // stored ones
    int width_ = 0;
    BigArray<std::uint8_t> room_;
    std::vector<Repeat> repeats_; // ascending
};

} // namespace raylane::core
