#pragma once

#include "core/scene/scene.hpp"

#include <string>
#include <vector>

namespace raylane::scenes {

/// Maps the shapes to their objects' places in the files.
class ObjectPlaces {
  public:
    /// Adds an object with `count` shapes, from the id `first` on.
    void add(std::size_t first, std::size_t count);
    /// Marks objects from this shape's id on as those of an included file.
    void enter(std::string file, std::size_t first);
    /// Marks objects from this shape's id on as those of the including file again.
    void leave(std::size_t first);

    /// Returns "/objects/3", after the name of an included file.
    std::string name_of(core::ShapeId id) const;

  private:
    struct Section {
        std::string file;                // empty: the main file
        std::size_t first_of_all, first; // object, among all objects and in its file
    };

    std::size_t rank_of(std::size_t shape) const {
        return core::rank_in_groups(several_, static_cast<core::ShapeId>(shape));
    }

    std::vector<core::IdRange> several_; // the shapes of each object that has more than one
    std::vector<Section> sections_ = {{"", 0, 0}};
    std::vector<std::size_t> outer_; // sections that continue after the files they include
};

} // namespace raylane::scenes
