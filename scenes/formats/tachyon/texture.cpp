#include "scenes/formats/tachyon/texture.hpp"

#include <algorithm>

namespace raylane::scenes {

namespace {

/// Skips the image file and the placement of an image or a solid pattern.
void skip_texture_map(TachyonWords& words, int function) {
    constexpr int first_of_images = 7;
    if (function >= first_of_images) words.take(); // its file
    for (;;) {
        bool more = false;
        for (const char* const place : {"CENTER", "ROTATE", "SCALE", "UAXIS", "VAXIS", "WAXIS"})
            if (words.accept(place)) {
                words.triple(place);
                more = true;
            }
        if (!more) return;
    }
}

void read_highlight(TachyonWords& words, TachyonTexture& texture) {
    texture.is_metal = words.accept("METAL");
    if (texture.is_metal)
        words.remark("METAL is ignored: highlights have its brightness, but not its colour");
    else
        words.expect("PLASTIC");
    texture.highlight = words.number("PHONG");
    texture.exponent = words.named_number("PHONG_SIZE");
}

/// Sets the opacity. Tachyon's default adds the light from behind to all of the surface's light.
/// For an opacity above 0 this equals weighing the surface's light, after it has been divided by
/// the opacity.
void set_opacity(core::Material& material, float opacity, bool weighed) {
    constexpr float min_divisor_limit = 0x1p-12F; // this share of the light behind is lost
    material.opacity = weighed ? opacity : std::max(opacity, min_divisor_limit);
    if (weighed) return;
    for (float* const term : {&material.ambient, &material.diffuse, &material.specular})
        *term /= material.opacity;
    material.reflectivity = std::min(material.reflectivity / material.opacity, 1.0F);
}

} // namespace

TachyonTexture read_texture(TachyonWords& words) {
    TachyonTexture texture;
    texture.ambient = words.named_number("AMBIENT");
    texture.diffuse = words.named_number("DIFFUSE");
    texture.specular = words.named_number("SPECULAR");
    texture.opacity = words.named_number("OPACITY");
    for (;;) {
        if (words.accept("PHONG")) {
            read_highlight(words, texture);
        } else if (words.accept("TRANSMODE")) {
            words.take();
            words.remark("TRANSMODE is ignored: opacity does not change with the angle");
        } else if (words.accept("OUTLINE")) {
            words.number("OUTLINE");
            words.named_number("OUTLINE_WIDTH");
            words.remark("OUTLINE is ignored: the image has no outlines");
        } else if (words.accept("COLOR")) {
            texture.color = words.triple("COLOR");
        } else if (words.accept("TEXFUNC")) {
            const int function = words.whole_number("TEXFUNC", 0, 1000);
            if (function == 0) return texture;
            words.remark("TEXFUNC is ignored: COLOR replaces images and patterns");
            skip_texture_map(words, function);
            return texture;
        } else {
            return texture;
        }
    }
}

core::MaterialIndex TachyonMaterials::index_of(const TachyonTexture& texture) {
    if (last_ != nullptr && last_->first == texture) return last_->second;
    auto place = indices_.find(texture);
    if (place == indices_.end())
        place = indices_.emplace(texture, builder_.add_material(material_of(texture))).first;
    if (texture.name != nullptr) builder_.name_material(place->second, *texture.name);
    last_ = &*place;
    return last_->second;
}

core::Material TachyonMaterials::material_of(const TachyonTexture& texture) {
    core::Material material;
    material.pattern.colors[0] = texture.color;
    if (shading_.quality_or_full() == TachyonShading::Quality::flat) {
        material.ambient = 1.0F;
        material.diffuse = 0.0F;
        return material;
    }
    material.ambient = texture.ambient;
    material.diffuse = texture.diffuse;
    const auto highlight = shading_.highlight.value_or(TachyonShading::Highlight::blinn);
    if (highlight != TachyonShading::Highlight::none) material.specular = texture.highlight;
    if (texture.is_metal)
        material.specular *= (texture.color.x + texture.color.y + texture.color.z) / 3.0F;
    // The angle to the half vector is half of the angle to the reflected ray.
    constexpr float from_phong = 4.0F;
    material.exponent =
        texture.exponent * (highlight == TachyonShading::Highlight::phong ? from_phong : 1.0F);
    material.reflectivity = std::min(texture.specular, 1.0F);
    if (texture.opacity < 1.0F) {
        if (shading_.opaque_aslant.value_or(false))
            words_.remark("TRANS_RASTER3D is ignored: opacity does not change with the angle");
        if (shading_.max_transparent_surfaces == 0)
            material.opacity = 0.0F;
        else
            set_opacity(material, std::max(texture.opacity, 0.0F),
                        shading_.weighed_by_opacity.value_or(false));
    }
    return material;
}

} // namespace raylane::scenes
