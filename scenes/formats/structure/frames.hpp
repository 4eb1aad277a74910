#pragma once

#include "scenes/formats/structure/structure_file.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace raylane::scenes {

/// Reads "5", "-1" or "0:100:2". Throws BadInput.
FrameRange frame_range_of(const std::string& option, const std::string& text);

/// The frames of the options' range in a file of atoms, read only as far as necessary.
class Frames {
  public:
    /// Reads all frames if the range counts from the end. Throws BadInput.
    Frames(InputFile& file, Format format, ReaderOptions options);

    /// Reads the next frame of the range. Returns its number, or nothing at the end. Throws
    /// BadInput if the file has no frame of the range.
    std::optional<std::size_t> next();
    /// The frame that was read last.
    Structure& structure() { return structure_; }
    /// Returns to the start. Throws BadInput for a stream.
    void rewind();
    /// Returns the maximum number of frames, or 0 if it is unknown.
    std::size_t count() const;

  private:
    std::optional<std::size_t> end() const;

    InputFile& file_;
    Format format_;
    ReaderOptions options_;
    FrameRange range_;
    std::unique_ptr<FrameReader> reader_;
    Structure structure_;
    std::size_t read_ = 0; // frames
    std::optional<std::size_t> at_;
};

} // namespace raylane::scenes
