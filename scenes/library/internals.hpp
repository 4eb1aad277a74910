#pragma once

#include "core/scene/scene.hpp"
#include "raylane/scene.hpp"

#include <memory>
#include <utility>

namespace raylane::library {

/// Access to the parts of a Scene that it hides from its users.
struct Internals {
    static Scene scene(std::shared_ptr<const core::Scene> scene) { return Scene(std::move(scene)); }
    static const core::Scene& of(const Scene& scene) { return *scene.scene_; }
};

} // namespace raylane::library
