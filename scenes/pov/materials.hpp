#pragma once

#include "core/scene/scene.hpp"
#include "scenes/pov/tokens.hpp"

#include <map>

namespace raylane::scenes::pov {

/// What an object looks like, and where it is.
struct Look {
    Shared<Texture> texture{};
    Shared<Interior> interior{};
    Shared<Motion> above{}; ///< what moves all of the texture
    bool is_hollow = false;
};

/// Makes materials of looks: of those that are the same, one.
class Materials {
  public:
    Materials(core::SceneBuilder& builder, Tokens& tokens) : builder_(builder), tokens_(tokens) {}

    double ambient_light = 1.0;

    /// `plane`: that of the surface, if it is one; there a checker's cells have no thickness.
    core::MaterialIndex index_of(const Look& look, const Place& place,
                                 const core::PlaneOf<double>* plane = nullptr);

  private:
    core::Material material_of(const Look& look, const Place& place,
                               const core::PlaneOf<double>* plane);

    core::SceneBuilder& builder_;
    Tokens& tokens_;
    std::map<std::array<float, 24>, core::MaterialIndex> known_;
    Look last_{};
    core::MaterialIndex last_index_ = core::no_material;
};

} // namespace raylane::scenes::pov
