#pragma once

#include "core/scene/scene.hpp"
#include "scenes/formats/tachyon/shading.hpp"

#include <array>
#include <map>
#include <string>

namespace raylane::scenes {

/// The parameters of a TEXTURE or a TEXDEF.
struct TachyonTexture {
    core::Color color{1.0F};
    float ambient = 0.1F; ///< Tachyon's defaults for an undefined texture
    float diffuse = 0.9F;
    float specular = 0.0F; ///< the reflected share
    float opacity = 1.0F;
    float highlight = 0.0F; ///< PHONG
    float exponent = 1.0F;  ///< PHONG_SIZE
    bool is_metal = false;  ///< its highlights have its colour
    /// The name of its definition, which is not compared; null if it has none.
    const std::string* name = nullptr;

    bool operator==(const TachyonTexture& other) const { return key() == other.key(); }
    bool operator<(const TachyonTexture& other) const { return key() < other.key(); }

  private:
    std::array<float, 10> key() const {
        return {color.x,  color.y, color.z,   ambient,  diffuse,
                specular, opacity, highlight, exponent, is_metal ? 1.0F : 0.0F};
    }
};

/// Reads the statement after TEXTURE, or after TEXDEF and a name.
TachyonTexture read_texture(TachyonWords& words);

/// Adds the material of each texture once. `shading` must be final before the first texture.
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
