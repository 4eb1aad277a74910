#pragma once

#include "core/kinds.hpp"
#include "core/shapes/types.hpp"

#include <tuple>
#include <type_traits>
#include <variant>

namespace raylane::tests {

using core::Vec3f;

namespace detail {

template <class Shapes>
struct VariantOf;
template <class... Shapes>
struct VariantOf<std::tuple<Shapes...>> : std::type_identity<std::variant<Shapes...>> {};
template <class Shapes>
struct InDoubleOf;
template <class... Shapes>
struct InDoubleOf<std::tuple<Shapes...>>
    : std::type_identity<std::variant<core::InDouble<Shapes>...>> {};

} // namespace detail

using AnyShape = detail::VariantOf<core::Shapes>::type;
using AnyShapeInDouble = detail::InDoubleOf<core::Shapes>::type;

/// Moves a shape by `offset`, then enlarges it about the origin. The result is exact for factors
/// that are powers of two and offsets whose sums fit in floats.
class Placing {
  public:
    Placing(const Vec3f& offset, float factor) : offset_(offset), factor_(factor) {}

    template <class Shape>
    Shape operator()(const Shape& shape) const {
        return placed(shape, *this); // in the shape's file
    }

    Vec3f point(const Vec3f& p) const { return (p + offset_) * factor_; }
    float factor() const { return factor_; }

  private:
    Vec3f offset_;
    float factor_;
};

} // namespace raylane::tests
