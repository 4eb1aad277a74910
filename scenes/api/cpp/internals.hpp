#pragma once

#include "core/scene/scene.hpp"
#include "raylane/material.hpp"
#include "raylane/scene.hpp"
#include "raylane/solid.hpp"
#include "scenes/api/cpp/scene_annotations.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace raylane::library {

/// Gives the library access to the private core objects of Scene and Solid.
struct Internals {
    static Scene scene(std::shared_ptr<const core::Scene> scene,
                       std::shared_ptr<const SceneAnnotations> annotations) {
        return Scene(std::move(scene), std::move(annotations));
    }
    static const core::Scene& of(const Scene& scene) { return *scene.scene_; }
    /// Returns the annotations of a scene's images, or null.
    static const std::shared_ptr<const SceneAnnotations>& annotations_of(const Scene& scene) {
        return scene.annotations_;
    }
    static Solid solid(core::Solid solid) {
        return Solid(std::make_shared<const core::Solid>(std::move(solid)));
    }
    static const core::Solid& of(const Solid& solid) { return *solid.solid_; }
    static Texture texture(const core::Texture& texture) {
        Texture result;
        result.texture_ = std::make_shared<const core::Texture>(texture);
        return result;
    }
    static const core::Texture& of(const Texture& texture) { return *texture.texture_; }
    static const std::vector<Solid>& members_of(const Group& group) { return group.members_; }
    static const core::Transform& of(const Transform& transform) { return *transform.transform_; }
};

/// Returns the public scene that shares the ownership of a core scene and of its annotations.
inline Scene owning(core::Scene&& scene,
                    std::shared_ptr<const SceneAnnotations> annotations = nullptr) {
    return Internals::scene(std::make_shared<const core::Scene>(std::move(scene)),
                            std::move(annotations));
}

} // namespace raylane::library
