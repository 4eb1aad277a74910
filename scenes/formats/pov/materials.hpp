#pragma once

#include "core/scene/scene.hpp"
#include "scenes/formats/pov/tokens.hpp"

#include <map>

namespace raylane::scenes::pov {

/// The texture and interior of an object, and its transform.
struct Look {
    Shared<Texture> texture{};
    Shared<Interior> interior{};
    Shared<Motion> above{}; ///< transforms the whole texture
    bool is_hollow = false;
};

/// Makes the materials of looks. Equal materials are added once.
class Materials {
  public:
    Materials(core::SceneBuilder& builder, Tokens& tokens) : builder_(builder), tokens_(tokens) {}

    double ambient_light = 1.0;

    /// `plane`: the surface, if it is a plane; a checker's cells have no thickness in it.
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
