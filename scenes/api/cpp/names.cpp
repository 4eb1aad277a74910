#include "core/scene/fit_camera.hpp"
#include "core/scene/presets.hpp"
#include "core/scene/transfer.hpp"
#include "raylane/errors.hpp"
#include "raylane/material.hpp"
#include "raylane/surroundings.hpp"
#include "raylane/vector.hpp"
#include "scenes/api/cpp/convert.hpp"

#include <span>
#include <string>

/// Values that files know by name.
namespace raylane {

using library::converted;

namespace {

/// Returns the value with a name. Throws InvalidValue with all names.
template <class Named>
const Named& find(const char* field, std::string_view name, std::span<const Named> table) {
    std::string names;
    for (const Named& each : table) {
        if (each.name == name) return each;
        names.append(names.empty() ? "\"" : ", \"").append(each.name).append("\"");
    }
    throw InvalidValue(field, "must be one of " + names + ", got \"" + std::string(name) + '"');
}

} // namespace

Material material_preset(std::string_view name) {
    return converted<Material>(find("preset", name, core::material_presets()).material);
}

Sellmeier catalogue_glass(std::string_view name) {
    const core::Sellmeier& glass = find("glass", name, core::glass_catalogue()).glass;
    return {glass.B, glass.C};
}

AutoCamera named_view(std::string_view name) {
    const core::NamedView& view = find("view", name, core::named_views());
    return {.direction = converted<Vec3>(view.direction), .up = converted<Vec3>(view.up)};
}

Color color_from_srgb(std::string_view text) {
    const auto color = core::color_from_srgb(text);
    if (!color)
        throw InvalidValue("color", R"(must be "#rrggbb", got ")" + std::string(text) + '"');
    return converted<Color>(*color);
}

} // namespace raylane
