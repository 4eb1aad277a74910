#pragma once

#include "core/scene/scene.hpp"
#include "scenes/json/value.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace raylane::scenes {

/// The material that the value of a key "material" means.
using MaterialOf = std::function<core::MaterialIndex(const JsonValue& value)>;

/// Objects that are there by name, each what it is described as: shapes and solids. Without
/// materials of their own, they have those of their instances.
struct Definition {
    std::vector<core::Solid> solids;
    std::size_t parts; ///< shapes that these are made of
};
using Definitions = std::map<std::string, Definition, std::less<>>;

/// What objects refer to.
struct ObjectContext {
    const MaterialOf& material_of;
    const Definitions& definitions;
};

/// Adds what the schema calls an object: a shape, a solid, or all shapes of a group, an instance or
/// a generator.
void add_object(const JsonValue& object, core::SceneBuilder& builder, const ObjectContext& context);

/// What an object is, for others to be instances of.
Definition described_object(const JsonValue& object, const ObjectContext& context);

} // namespace raylane::scenes
