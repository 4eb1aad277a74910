#pragma once

#include "scenes/byte_source.hpp"
#include "scenes/image/reader.hpp"

#include <stdexcept>

/// Decoders of the formats whose components are floats. stb_image has one for HDR, but it never
/// ends on a file that is cut short.
namespace raylane::scenes {

/// Fault of a picture's file, without the file's name.
class MalformedPicture : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

MalformedPicture damaged(const std::string& format);

/// Throws MalformedPicture for a size that no picture has.
void check_size(std::int64_t width, std::int64_t height);

/// Radiance's shared-exponent RGB (Ward 1991, "Real Pixels"), flat or with run lengths by
/// component, rows from the top down. An EXPOSURE is left as it is, as all readers but Radiance's
/// own do. Throws MalformedPicture.
void read_hdr(ByteSource& source, Image& image);

/// Portable float map (Debevec), RGB or grey, either byte order. The scale's size is left aside, as
/// most readers do. Throws MalformedPicture.
void read_pfm(ByteSource& source, Image& image);

} // namespace raylane::scenes
