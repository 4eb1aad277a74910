#pragma once

#include "core/scene/texture.hpp"
#include "scenes/files/included_files.hpp"
#include "scenes/formats/json/value.hpp"

#include <cstddef>
#include <map>
#include <string>

namespace raylane::scenes {

/// The images of a scene's patterns. Each file is read once.
class PatternImages {
  public:
    /// Returns the image in the PNG file that a value names, relative to the file that holds the
    /// value. Throws BadInput with the value's place.
    core::Texture named_by(const JsonValue& value);

  private:
    IncludedFiles opener_;
    std::map<std::string, core::Texture> images_; // by the path of the file
    std::size_t pixels_left_ = core::Texture::max_pixels;
};

} // namespace raylane::scenes
