#pragma once

#include "scenes/formats/pov/materials.hpp"

#include <optional>
#include <vector>

namespace raylane::scenes::pov {

/// Adds objects to a scene, with their parts, transforms and materials.
class Assembly {
  public:
    Assembly(core::SceneBuilder& builder, Tokens& tokens)
        : materials(builder, tokens), builder_(builder) {}

    Materials materials;
    std::vector<LightSource> lights;       ///< at their final places
    std::optional<Place> fog_differs_at{}; ///< first object with fog in raylane or POV-Ray only

    /// Negates z of everything that is added from now on.
    void set_mirrored();
    /// `texture`: used if the object has none.
    void add(const Object& object, const Shared<Texture>& texture) {
        add(object, {texture, nullptr, mirror_}, mirror_, {});
        add_lights(object, mirror_);
    }

  private:
    struct Clip {
        Shared<Object> by;
        Shared<Motion> above;
    };
    using Clips = std::vector<Clip>;

    void add(const Object& object, const Look& inherited, const Shared<Motion>& above, Clips clips);
    void add_lights(const Object& object, const Shared<Motion>& above);
    void add_mesh(const Object& object, const Look& look, const Shared<Motion>& motion);
    void add_shape(const Object& object, const core::PartShape& shape, const Look& look,
                   const Shared<Motion>& motion);
    bool add_quadric(const Object& object, const Look& look, const Shared<Motion>& motion,
                     const Clips& clips);
    core::Solid moved(const Object& object, const core::Solid& solid,
                      const Shared<Motion>& motion) const;
    core::Solid described(const Object& object, const Look& inherited, const Shared<Motion>& above,
                          bool is_clip);
    core::Solid made_of(const Object& object, const Look& look, const Shared<Motion>& motion);
    core::Solid clipped(core::Solid solid, const Clips& clips);
    void note_fog(const Object& object, const Look& look);
    void put(const Object& object, const core::Solid& solid, core::MaterialIndex material);

    core::SceneBuilder& builder_;
    Shared<Motion> mirror_{};
};

} // namespace raylane::scenes::pov
