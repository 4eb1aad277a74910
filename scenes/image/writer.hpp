#pragma once

#include "core/scene/film.hpp"
#include "core/scene/surroundings.hpp"
#include "scenes/atomic_file.hpp"

#include <cstdint>

namespace raylane::scenes {

/// How a picture is written: PNG, Targa, BMP and PPM have 8 bits, through the transfer curve, and
/// but for PNG they are not compressed; HDR is Radiance's, linear, with a shared exponent; PFM has
/// linear floats, unchanged.
enum class PictureFormat : std::uint8_t { png, hdr, pfm, tga, bmp, ppm };

/// The format that a file's ending tells: .png, .hdr, .pfm, .tga, .bmp or .ppm. "-" is standard
/// output, in PNG. Throws BadInput if the ending is none of these.
PictureFormat picture_format_of(const std::filesystem::path& path);

/// A picture's file.
class OutputFile {
  public:
    /// In the format that the ending tells, which is a BadInput if it is none. Throws SystemRefused
    /// if the file cannot be written, as far as can be known without writing it.
    explicit OutputFile(const std::filesystem::path& path);
    OutputFile(const std::filesystem::path& path, PictureFormat format);

    /// Claims what is known of the room that a picture of this size takes. Throws SystemRefused if
    /// there is none.
    void reserve(int width, int height);

    /// Writes the picture; once. `transfer` concerns what has 8 bits. Throws SystemRefused, and
    /// then there is no new file.
    void commit(const core::Film& film, core::Transfer transfer);

  private:
    void write_codes(const core::Film& film, core::Transfer transfer);
    void write_hdr(const core::Film& film);
    void write_pfm(const core::Film& film);

    PictureFormat format_; // before the file: a wrong ending leaves no trace
    AtomicFile file_;
};

} // namespace raylane::scenes
