#pragma once

#include "core/scene/material.hpp"

#include <span>
#include <string_view>

namespace raylane::core {

struct NamedMaterial {
    std::string_view name;
    Material material;
};

/// The materials that files and programs know by name.
std::span<const NamedMaterial> material_presets();

} // namespace raylane::core
