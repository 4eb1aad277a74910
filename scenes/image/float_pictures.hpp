#pragma once

#include "scenes/byte_source.hpp"
#include "scenes/image/reader.hpp"

#include <stdexcept>

/// Decoders of the formats with float components. stb_image has an HDR decoder, but it never
/// returns on a truncated file.
namespace raylane::scenes {

/// An error in a picture file, without the file's name.
class MalformedPicture : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

MalformedPicture damaged(const std::string& format);

/// Throws MalformedPicture if a side or the number of pixels is out of range.
void check_size(std::int64_t width, std::int64_t height);

/// Reads Radiance's shared-exponent RGB (Ward 1991, "Real Pixels"), flat or run-length encoded by
/// component, rows from the top down. EXPOSURE is ignored, as in all readers but Radiance's own.
/// Throws MalformedPicture.
void read_hdr(ByteSource& source, Image& image);

/// Reads a portable float map (Debevec), RGB or grey, in either byte order. The magnitude of the
/// scale is ignored, as in most readers. Throws MalformedPicture.
void read_pfm(ByteSource& source, Image& image);

} // namespace raylane::scenes
