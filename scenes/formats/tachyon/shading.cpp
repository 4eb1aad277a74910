#include "scenes/formats/tachyon/shading.hpp"

#include "core/scene/validate.hpp"
#include "scenes/files/number.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::scenes {

namespace {

using Quality = TachyonShading::Quality;

Quality read_quality(TachyonWords& words) {
    if (words.accept("FULL")) return Quality::full;
    if (words.accept("MEDIUM")) return Quality::no_shadows;
    if (words.accept("LOW") || words.accept("LOWEST")) return Quality::flat;
    words.refuse_next("FULL, MEDIUM, LOW or LOWEST");
}

void read_ambient_occlusion(TachyonWords& words, TachyonShading& shading) {
    shading.sky = words.named_triple("AMBIENT_COLOR");
    core::validate_color("ambient_color", *shading.sky);
    shading.direct = words.named_number("RESCALE_DIRECT");
    if (*shading.direct < 0.0F)
        throw core::InvalidValue("rescale_direct",
                                 "must not be negative, got " + to_text(*shading.direct));
    words.expect("SAMPLES");
    shading.sky_samples = words.whole_number("SAMPLES", 0, std::numeric_limits<int>::max());
}

template <class Value>
void take_over(std::optional<Value>& value, const std::optional<Value>& over) {
    if (over) value = over;
}

} // namespace

TachyonShading TachyonShading::overridden_by(const TachyonShading& over) const {
    TachyonShading result = *this;
    take_over(result.quality, over.quality);
    take_over(result.highlight, over.highlight);
    take_over(result.weighed_by_opacity, over.weighed_by_opacity);
    take_over(result.opaque_aslant, over.opaque_aslant);
    take_over(result.planar_fog, over.planar_fog);
    take_over(result.max_transparent_surfaces, over.max_transparent_surfaces);
    take_over(result.sky, over.sky);
    take_over(result.direct, over.direct);
    take_over(result.sky_samples, over.sky_samples);
    take_over(result.ray_depth, over.ray_depth);
    return result;
}

int grid_of_samples(int antialiasing) {
    constexpr double most = core::Settings::max_grid;
    return static_cast<int>(std::lround(std::min(std::sqrt(antialiasing + 1.0), most)));
}

void read_shader_mode(TachyonWords& words, TachyonShading& shading) {
    shading.quality = read_quality(words);
    while (!words.accept("END_SHADER_MODE")) {
        if (words.accept("AMBIENT_OCCLUSION")) {
            read_ambient_occlusion(words, shading);
        } else if (words.accept("TRANS_VMD")) {
            shading.weighed_by_opacity = true;
        } else if (words.accept("TRANS_RASTER3D")) {
            shading.opaque_aslant = true;
        } else if (words.accept("TRANS_ORIG")) {
            shading.weighed_by_opacity = false;
        } else if (words.accept("TRANS_MAX_SURFACES")) {
            shading.max_transparent_surfaces =
                words.whole_number("TRANS_MAX_SURFACES", 0, std::numeric_limits<int>::max());
        } else if (words.accept("FOG_VMD")) {
            shading.planar_fog = true;
        } else if (words.accept("FOG_NORMAL")) {
            shading.planar_fog = false;
        } else if (words.accept("SHADOW_FILTER_OFF")) {
            words.remark("SHADOW_FILTER_OFF is ignored: transparent objects cast partial shadows");
        } else if (words.accept("SHADOW_FILTER_ON")) { // as in raylane
        } else {
            words.refuse_next("AMBIENT_OCCLUSION, TRANS_VMD, TRANS_RASTER3D, TRANS_MAX_SURFACES, "
                              "FOG_VMD, SHADOW_FILTER_ON, SHADOW_FILTER_OFF or END_SHADER_MODE");
        }
    }
}

} // namespace raylane::scenes
