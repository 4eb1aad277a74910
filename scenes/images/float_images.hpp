#pragma once

#include "scenes/files/input_file.hpp"
#include "scenes/images/reader.hpp"

#include <array>
#include <cstring>
#include <stdexcept>

/// Decoders of the formats with float components. stb_image has an HDR decoder, but it never
/// returns on a truncated file.
namespace raylane::scenes {

/// Reads a file byte by byte, from start to end.
class ByteSource {
  public:
    explicit ByteSource(InputFile& file) : file_(file) {}

    /// Returns the next byte, or -1 at the end.
    int get() {
        if (position_ == filled_ && !refill()) return -1;
        return static_cast<unsigned char>(buffer_[position_++]);
    }

    /// Fills `bytes` as far as the file goes. Returns the number of bytes read.
    std::size_t read(std::span<char> bytes) {
        std::size_t done = 0;
        while (done < bytes.size() && (position_ < filled_ || refill())) {
            const std::size_t count = std::min(bytes.size() - done, filled_ - position_);
            std::memcpy(bytes.data() + done, buffer_.data() + position_, count);
            position_ += count;
            done += count;
        }
        return done;
    }

  private:
    bool refill() {
        position_ = 0;
        filled_ = file_.read(buffer_);
        return filled_ != 0;
    }

    InputFile& file_;
    std::array<char, 1 << 16> buffer_;
    std::size_t position_ = 0;
    std::size_t filled_ = 0;
};

/// An error in an image file, without the file's name.
class MalformedImage : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

MalformedImage damaged(const std::string& format);

/// Throws MalformedImage if a side or the number of pixels is out of range.
void check_size(std::int64_t width, std::int64_t height);

/// Reads Radiance's shared-exponent RGB (Ward 1991, "Real Pixels"), flat or run-length encoded by
/// component, rows from the top down. EXPOSURE is ignored, as in all readers but Radiance's own.
/// Throws MalformedImage.
void read_hdr(ByteSource& source, Image& image);

/// Reads a portable float map (Debevec), RGB or grey, in either byte order. The magnitude of the
/// scale is ignored, as in most readers. Throws MalformedImage.
void read_pfm(ByteSource& source, Image& image);

} // namespace raylane::scenes
