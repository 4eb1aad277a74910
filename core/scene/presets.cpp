#include "core/scene/presets.hpp"

namespace raylane::core {

namespace {

Pattern of_color(float gray) {
    return {.colors = {Color(gray), Color(gray)}};
}

/// Returns a clear material with this index of refraction.
Material clear(float index) {
    return {.pattern = of_color(0.0F),
            .reflection = Reflection::dielectric,
            .transmission = 1.0F,
            .index = index};
}

} // namespace

std::span<const NamedMaterial> material_presets() {
    static const NamedMaterial presets[] = {
        {"matte", {}},
        {"plastic",
         {.pattern = {},
          .specular = 0.3F,
          .exponent = 60.0F,
          .reflection = Reflection::dielectric}},
        {"metal",
         {.pattern = of_color(0.7F),
          .diffuse = 0.4F,
          .specular = 0.6F,
          .exponent = 80.0F,
          .reflectivity = 0.35F}},
        {"mirror", {.pattern = of_color(0.0F), .reflectivity = 0.95F}},
        {"glass", clear(1.5F)},
        {"water", clear(1.33F)},
        {"diamond", clear(2.42F)},
    };
    return presets;
}

} // namespace raylane::core
