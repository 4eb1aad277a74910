#pragma once

#include "core/solids/transform.hpp"
#include "scenes/formats/json/value.hpp"

#include <array>
#include <string_view>

namespace raylane::scenes {

/// The keys that transform an object.
inline constexpr std::array<std::string_view, 4> transform_keys = {"scale", "rotate", "translate",
                                                                   "transform"};

bool has_transform(const JsonValue& object);
/// Returns scaling, then rotation, then translation; or a matrix.
core::Transform transform_of(const JsonValue& object);

} // namespace raylane::scenes
