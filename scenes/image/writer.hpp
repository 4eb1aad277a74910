#pragma once

#include "core/scene/film.hpp"
#include "core/scene/layers.hpp"
#include "scenes/atomic_file.hpp"
#include "scenes/image/picture_options.hpp"

namespace raylane::scenes {

/// How a picture is written: PNG has 8 or 16 bits through the transfer curve; Targa, BMP and PPM 8,
/// without compression; EXR is OpenEXR's, linear, in halves or floats; HDR Radiance's, linear, with
/// a shared exponent; PFM has linear floats, unchanged.
enum class PictureFormat : std::uint8_t { png, exr, hdr, pfm, tga, bmp, ppm };

/// The format that a file's ending tells: .png, .exr, ... "-" is standard output, in PNG. Throws
/// BadInput if the ending is none of these, or .exr and that is not to be.
PictureFormat picture_format_of(const std::filesystem::path& path, bool with_exr);

/// The bytes of a file in OpenEXR (scenes/image/exr.hpp), which the library does without. `layers`
/// may be null.
using EncodeExr = std::string (*)(const core::Film& film, const core::Layers* layers,
                                  const PictureOptions& options);

/// A picture's file. Of a film's alpha .png and .exr tell; in the others it lies over black.
class OutputFile {
  public:
    /// In the format that the ending tells, which is a BadInput if it is none, or .exr and there is
    /// nothing to encode that. Throws SystemRefused if the file cannot be written, as far as can be
    /// known without writing it.
    explicit OutputFile(const std::filesystem::path& path, EncodeExr encode_exr = nullptr);
    OutputFile(const std::filesystem::path& path, PictureFormat format,
               EncodeExr encode_exr = nullptr);

    PictureFormat format() const { return format_; }

    /// Claims what is known of the room that a picture of this size takes. Throws SystemRefused if
    /// there is none.
    void reserve(int width, int height);

    /// It is to survive a loss of power as soon as it is there: takes milliseconds.
    void be_durable() { file_.be_durable(); }

    /// Writes the picture, and into .exr its layers, unless that is null; once. Throws
    /// SystemRefused, and then there is no new file; it may be tried again.
    void commit(const core::Film& film, const PictureOptions& options,
                const core::Layers* layers = nullptr);
    void commit(const core::Film& film, core::Transfer transfer);

  private:
    void write_exr(const core::Film& film, const core::Layers* layers,
                   const PictureOptions& options);
    void write_codes(const core::Film& film, core::Transfer transfer);
    void write_hdr(const core::Film& film);
    void write_pfm(const core::Film& film);

    EncodeExr encode_exr_;
    PictureFormat format_; // before the file: a wrong ending leaves no trace
    AtomicFile file_;
    bool has_failed_ = false;
};

} // namespace raylane::scenes
