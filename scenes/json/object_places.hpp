#pragma once

#include "core/scene/scene.hpp"

#include <string>
#include <vector>

namespace raylane::scenes {

/// Where in which file the object is that a shape belongs to.
class ObjectPlaces {
  public:
    /// The shapes of an object.
    void add(std::size_t first, std::size_t count);
    /// From the shape with this id on, objects are those of an included file.
    void enter(std::string file, std::size_t first);
    /// And from here on those of the file that includes it again.
    void leave(std::size_t first);

    /// "/objects/3", behind the name of an included file.
    std::string name_of(core::ShapeId id) const;

  private:
    struct Section {
        std::string file;                // empty: the first
        std::size_t first_of_all, first; // object, among all and in its file
    };

    std::size_t rank_of(std::size_t shape) const {
        return core::rank_in_groups(several_, static_cast<core::ShapeId>(shape));
    }

    std::vector<core::IdRange> several_; // the shapes of each object that is more than one
    std::vector<Section> sections_ = {{"", 0, 0}};
    std::vector<std::size_t> outer_; // sections that go on behind what they include
};

} // namespace raylane::scenes
