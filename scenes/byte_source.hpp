#pragma once

#include "scenes/input_file.hpp"

#include <array>
#include <cstring>

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

} // namespace raylane::scenes
