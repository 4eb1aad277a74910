#include "core/scene/features.hpp"

#include "core/shapes/shapes.hpp"

#include <algorithm>

namespace raylane::core {

std::array<std::pair<std::string_view, bool>, 19> Features::named() const {
    return {{{"hierarchy", bounded_shapes},
             {"planes", planes},
             {"constructed solids", solids},
             {"double-precision shapes", doubles},
             {"smooth normals", smooth_normals},
             {"patterns", patterns},
             {"light and shadow rays", shading},
             {"soft light", soft_light},
             {"lens", lens},
             {"highlights", highlights},
             {"reflected rays", reflection},
             {"Fresnel weights", fresnel},
             {"refracted rays", refraction},
             {"absorption", absorption},
             {"transparent surfaces", transparent},
             {"fog", fog},
             {"spectrum", spectrum},
             {"one-sided surfaces", one_sided},
             {"supersampling", supersampling}}};
}

Features features_of(const Scene& scene, const Settings& settings) {
    Features features;
    for_each_table(scene.shapes(), [&]<class Shape>(const Table<Shape>& table) {
        if (table.size() == 0 && table.copied_blocks() == 0) return;
        (is_bounded<Shape> ? features.bounded_shapes : features.planes) = true;
        features.doubles |= table.has_doubles();
        features.smooth_normals |= has_shading_normals<Shape>;
    });

    std::vector<bool> used(scene.materials().size());
    scene.material_indices().for_each_material(
        [&](MaterialIndex material) { used[material] = true; });
    const bool traces_further = settings.max_depth > 0;
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        const Material& material = scene.materials()[i];
        const bool highlights = material.specular > 0.0F;
        features.patterns |= material.pattern.kind != PatternKind::solid;
        features.highlights |= highlights;
        features.shading |= highlights || material.diffuse > 0.0F;
        features.reflection |= traces_further && (material.reflects() || material.transmits());
        features.fresnel |= material.reflection != Reflection::constant;
        features.refraction |= material.transmits();
        features.absorption |= material.transmits() && material.absorption != Vec3f(0.0F);
        features.transparent |= material.is_transparent();
        features.one_sided |= material.visible != Visible::both;
    }
    features.soft_light =
        features.shading && std::any_of(scene.lights().begin(), scene.lights().end(),
                                        [](const Light& light) { return is_soft(light.kind); });
    features.solids = scene.solids().any();
    features.spectrum = !scene.wavelengths().empty();
    features.lens = scene.camera().lens_radius > 0.0F;
    features.fog = scene.fog().kind != FogKind::none;
    features.supersampling = settings.grid > 1 || settings.quality != 0.0F;
    return features;
}

} // namespace raylane::core
