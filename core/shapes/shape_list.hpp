#pragma once

#include "core/shapes/big_array.hpp"
#include "core/shapes/types.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <utility>

namespace raylane::core {

/// A list that grows by pieces, each as large as all before it. Pieces are never copied, and the
/// unused part of the last piece is never touched.
template <class T>
class GrowingList {
  public:
    GrowingList() = default;
    /// Copies the elements, so that both lists may grow.
    GrowingList(const GrowingList& other) {
        for (std::size_t i = 0; i < other.size(); ++i)
            add(other[i]);
    }
    GrowingList(GrowingList&& other) noexcept
        : pieces_(std::move(other.pieces_)), size_(std::exchange(other.size_, 0)) {}
    GrowingList& operator=(GrowingList other) noexcept {
        pieces_ = std::move(other.pieces_);
        size_ = other.size_;
        return *this;
    }
    ~GrowingList() = default;

    std::size_t size() const { return size_; }

    const T& operator[](std::size_t i) const {
        const int piece = piece_of(i);
        return pieces_[piece][i - first_of(piece)];
    }

    void add(const T& value) {
        const int piece = piece_of(size_);
        const std::size_t first = first_of(piece);
        if (size_ == first) pieces_[piece] = BigArray<T>(std::max(first, first_piece_size));
        pieces_[piece][size_ - first] = value;
        ++size_;
    }

  private:
    static constexpr std::size_t first_piece_size = 64;

    static int piece_of(std::size_t i) {
        return static_cast<int>(std::bit_width(i / first_piece_size));
    }
    static std::size_t first_of(int piece) {
        return piece == 0 ? 0 : first_piece_size << (piece - 1);
    }

    std::array<BigArray<T>, 34> pieces_; // enough for more than 2^32 elements
    std::size_t size_ = 0;
};

/// A shape's floats, or the floats nearest to its numbers, and its id in the scene.
template <class Shape>
struct Listed {
    Shape shape;
    ShapeId id;
};

/// All shapes of one kind, in the order in which they were added. Stores ids only once an id does
/// not follow the one before it, and doubles only once a shape has a number that is not a float.
template <class Shape>
class ShapeList {
  public:
    std::size_t size() const { return shapes_.size(); }
    Listed<Shape> operator[](std::size_t i) const { return {shapes_[i], id(i)}; }

    bool has_doubles() const { return doubles_.size() > 0; }
    /// Returns the exact shape.
    InDouble<Shape> exact(std::size_t i) const {
        return has_doubles() ? doubles_[i] : to_doubles(shapes_[i]);
    }

    void add(const Shape& shape, ShapeId id) {
        add_id(id);
        shapes_.add(shape);
        if (has_doubles()) doubles_.add(to_doubles(shape));
    }
    /// `as_doubles`: true stores doubles also if all numbers are floats.
    void add(const InDouble<Shape>& shape, ShapeId id, bool as_doubles = false) {
        if (!has_doubles()) {
            if (!as_doubles && is_in_floats(shape)) return add(to_floats(shape), id);
            for (std::size_t i = 0; i < size(); ++i)
                doubles_.add(to_doubles(shapes_[i]));
        }
        add_id(id);
        shapes_.add(to_floats(shape));
        doubles_.add(shape);
    }

    /// Prefetches the memory that `[i]` reads.
    void prefetch(std::size_t i) const {
        __builtin_prefetch(&shapes_[i]);
        if (ids_.size() > 0) __builtin_prefetch(&ids_[i]);
    }

  private:
    ShapeId id(std::size_t i) const {
        return ids_.size() > 0 ? ids_[i] : first_id_ + static_cast<ShapeId>(i);
    }
    /// Adds an id. Call it before adding the shape.
    void add_id(ShapeId id) {
        if (size() == 0) first_id_ = id;
        if (ids_.size() == 0) {
            if (id == first_id_ + static_cast<ShapeId>(size())) return;
            for (std::size_t i = 0; i < size(); ++i)
                ids_.add(first_id_ + static_cast<ShapeId>(i));
        }
        ids_.add(id);
    }

    GrowingList<Shape> shapes_;
    ShapeId first_id_ = 0;
    GrowingList<ShapeId> ids_;             // one for each shape, or empty
    GrowingList<InDouble<Shape>> doubles_; // one for each shape, or empty
};

/// One list per kind, in the order of `Kind`.
using ShapeLists = OfEachShape<ShapeList>;

} // namespace raylane::core
