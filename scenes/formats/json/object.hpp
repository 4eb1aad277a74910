#pragma once

#include "core/scene/scene.hpp"
#include "scenes/formats/json/value.hpp"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// Returns the material that the value of a key "material" refers to.
using MaterialOf = std::function<core::MaterialIndex(const JsonValue& value)>;

/// Named objects, each described as shapes and solids. Those without a material take that of their
/// instances.
struct Definition {
    std::vector<core::Solid> solids;
    std::size_t parts; ///< number of shapes in the solids
};

/// Definitions by name.
class Definitions {
  public:
    bool may_lack_some = false; ///< an error may have kept some definitions from being read

    bool contains(std::string_view name) const { return all_.contains(name); }
    /// Adds a definition, or marks the name as invalid if the definition has an error.
    void add(std::string_view name, std::optional<Definition> definition) {
        all_.emplace(name, std::move(definition));
    }
    /// Returns the definition that a value names. Throws BadInput for an unknown name: with a line
    /// only the first time for each name, and only if no other error is the cause.
    const Definition& named_by(const JsonValue& value);

    /// Counts shapes that instances, lattices and sphereflakes generate. Throws BadInput at the
    /// value if their total exceeds `max_requested`.
    void count(std::size_t shapes, const JsonValue& value);

    static constexpr std::size_t max_requested = std::size_t{1} << 26;

    std::size_t kept_parts = 0; ///< shapes of instances in all definitions

  private:
    std::size_t asked_for_ = 0;
    std::map<std::string, std::optional<Definition>, std::less<>> all_;
    std::set<std::string, std::less<>> unknown_;
};

/// The materials and definitions that objects refer to, and the builder of the scene.
struct ObjectContext {
    const MaterialOf& material_of;
    Definitions& definitions;
    const core::SceneBuilder& builder;
};

/// Adds an object of the schema: a shape, a solid, or all shapes of a group, an instance or a
/// generator.
void add_object(const JsonValue& object, core::SceneBuilder& builder, const ObjectContext& context);

/// Returns the description of an object, for instances to use.
Definition described_object(const JsonValue& object, const ObjectContext& context);

} // namespace raylane::scenes
