#pragma once

#include "core/solids/transform.hpp"
#include "scenes/json/value.hpp"

#include <array>
#include <string_view>

namespace raylane::scenes {

/// The keys by which an object is moved.
inline constexpr std::array<std::string_view, 4> transform_keys = {"scale", "rotate", "translate",
                                                                   "transform"};

bool has_transform(const JsonValue& object);
/// Scaled first, then turned, then moved; or by a matrix.
core::Transform transform_of(const JsonValue& object);

} // namespace raylane::scenes
