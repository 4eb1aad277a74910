#pragma once

#include "core/shapes/big_array.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace raylane::core {

/// A shape and its number in the scene.
template <class Shape>
struct Listed {
    Shape shape;
    ShapeId id;
};

/// All shapes of one kind, in the order in which they came. It grows by pieces, each as large as
/// all before it: none is ever copied, and what is not used of the last is never touched.
template <class Shape>
class ShapeList {
  public:
    std::size_t size() const { return size_; }

    const Listed<Shape>& operator[](std::size_t i) const {
        const int piece = piece_of(i);
        return pieces_[piece][i - first_of(piece)];
    }

    void add(const Shape& shape, ShapeId id) {
        const int piece = piece_of(size_);
        const std::size_t first = first_of(piece);
        if (size_ == first)
            pieces_[piece] = BigArray<Listed<Shape>>(std::max(first, first_piece_size));
        pieces_[piece][size_ - first] = {shape, id};
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

    std::array<BigArray<Listed<Shape>>, 34> pieces_; // for more than 2^32 shapes
    std::size_t size_ = 0;
};

/// One list per kind, in the order of `Kind`.
using ShapeLists = OfEachShape<ShapeList>;

} // namespace raylane::core
