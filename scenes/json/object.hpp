#pragma once

#include "core/scene/scene.hpp"
#include "scenes/json/value.hpp"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
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

/// Definitions by name.
class Definitions {
  public:
    bool may_lack_some = false; ///< a file that may have them could not be read

    bool contains(std::string_view name) const { return all_.contains(name); }
    /// Adds a definition, or nothing for one with a mistake.
    void add(std::string_view name, std::optional<Definition> definition) {
        all_.emplace(name, std::move(definition));
    }
    /// Returns the definition that a value names. Throws BadInput for an unknown name: with a line
    /// only the first time for each name, and only if no other error is the cause.
    const Definition& named_by(const JsonValue& value);

    /// Counts shapes that a few words ask for: of instances, lattices and sphereflakes. Throws
    /// BadInput at the value where all of them are more than `most_asked_for`.
    void count(std::size_t shapes, const JsonValue& value);

    static constexpr std::size_t most_asked_for = std::size_t{1} << 26;

    std::size_t kept_parts = 0; ///< shapes of instances in all definitions

  private:
    std::size_t asked_for_ = 0;
    std::map<std::string, std::optional<Definition>, std::less<>> all_;
    std::set<std::string, std::less<>> unknown_;
};

/// What objects refer to.
struct ObjectContext {
    const MaterialOf& material_of;
    Definitions& definitions;
};

/// Adds what the schema calls an object: a shape, a solid, or all shapes of a group, an instance or
/// a generator.
void add_object(const JsonValue& object, core::SceneBuilder& builder, const ObjectContext& context);

/// What an object is, for others to be instances of.
Definition described_object(const JsonValue& object, const ObjectContext& context);

} // namespace raylane::scenes
