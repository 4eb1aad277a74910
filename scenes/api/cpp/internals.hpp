#pragma once

#include "core/scene/scene.hpp"
#include "raylane/scene.hpp"
#include "raylane/solid.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace raylane::library {

/// Gives the library access to the private core objects of Scene and Solid.
struct Internals {
    static Scene scene(std::shared_ptr<const core::Scene> scene) { return Scene(std::move(scene)); }
    static const core::Scene& of(const Scene& scene) { return *scene.scene_; }
    static Solid solid(core::Solid solid) {
        return Solid(std::make_shared<const core::Solid>(std::move(solid)));
    }
    static const core::Solid& of(const Solid& solid) { return *solid.solid_; }
    static const std::vector<Solid>& members_of(const Group& group) { return group.members_; }
    static const core::Transform& of(const Transform& transform) { return *transform.transform_; }
};

/// Returns the public scene that shares the ownership of a core scene.
inline Scene owning(core::Scene&& scene) {
    return Internals::scene(std::make_shared<const core::Scene>(std::move(scene)));
}

} // namespace raylane::library
