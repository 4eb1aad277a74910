#pragma once

#include "core/scene/scene.hpp"
#include "scenes/tachyon/shading.hpp"

#include <array>
#include <map>
#include <string>

namespace raylane::scenes {

/// What a TEXTURE, or a TEXDEF, says.
struct TachyonTexture {
    core::Color color{1.0F};
    float ambient = 0.1F; ///< as Tachyon has it for a texture that is not defined
    float diffuse = 0.9F;
    float specular = 0.0F; ///< what is reflected
    float opacity = 1.0F;
    float highlight = 0.0F; ///< PHONG
    float exponent = 1.0F;  ///< PHONG_SIZE
    bool is_metal = false;  ///< its highlights are of its colour
    /// The name that it is defined by, which does not tell it from others; null if it has none.
    const std::string* name = nullptr;

    bool operator==(const TachyonTexture& other) const { return key() == other.key(); }
    bool operator<(const TachyonTexture& other) const { return key() < other.key(); }

  private:
    std::array<float, 10> key() const {
        return {color.x,  color.y, color.z,   ambient,  diffuse,
                specular, opacity, highlight, exponent, is_metal ? 1.0F : 0.0F};
    }
};

/// Reads what is behind TEXTURE, or TEXDEF and a name.
TachyonTexture read_texture(TachyonWords& words);

/// The materials of textures, each added once. `shading` is to be as it is meant before the first.
class TachyonMaterials {
  public:
    TachyonMaterials(core::SceneBuilder& builder, TachyonWords& words,
                     const TachyonShading& shading)
        : builder_(builder), words_(words), shading_(shading) {}

    core::MaterialIndex index_of(const TachyonTexture& texture);

  private:
    core::Material material_of(const TachyonTexture& texture);

    core::SceneBuilder& builder_;
    TachyonWords& words_;
    const TachyonShading& shading_;
    std::map<TachyonTexture, core::MaterialIndex> indices_;
    const std::pair<const TachyonTexture, core::MaterialIndex>* last_ = nullptr;
};

} // namespace raylane::scenes
