#pragma once

#include "core/scene/aovs.hpp"
#include "core/scene/film.hpp"
#include "scenes/files/atomic_file.hpp"
#include "scenes/images/image_options.hpp"

namespace raylane::scenes {

/// The encoding of an image:
/// - PNG, TIFF: 8 or 16 bits through the transfer curve
/// - Targa, BMP, PPM: 8 bits through the transfer curve, uncompressed
/// - EXR (OpenEXR): linear, halves or floats
/// - HDR (Radiance): linear, with a shared exponent
/// - PFM: linear floats, unchanged
enum class ImageFormat : std::uint8_t { png, tiff, exr, hdr, pfm, tga, bmp, ppm };

/// Returns true for the formats that store a film's alpha.
constexpr bool stores_alpha(ImageFormat format) {
    return format == ImageFormat::png || format == ImageFormat::tiff || format == ImageFormat::exr;
}

/// Returns the bytes of a file (scenes/images/exr.hpp, tiff.hpp). `aovs` may be null.
using EncodeImage = std::string (*)(const core::Film& film, const core::Aovs* aovs,
                                    const ImageOptions& options);

/// The functions for formats whose libraries the library is built without. Null: the format is not
/// written.
struct MoreEncoders {
    EncodeImage exr = nullptr, tiff = nullptr;
};

/// Returns the format for a file name's extension: .png, .exr, ... "-" is standard output, in PNG.
/// Throws BadInput if the extension is unknown, or is that of an encoder that is null.
ImageFormat image_format_of(const std::filesystem::path& path, const MoreEncoders& more = {});

/// The file of an image. PNG, TIFF and EXR store a film's alpha; in other formats the image lies
/// over black.
class OutputFile {
  public:
    /// Chooses the format by the extension, as image_format_of() does. Throws SystemRefused if it
    /// is already certain that the file cannot be written.
    explicit OutputFile(const std::filesystem::path& path, const MoreEncoders& more = {});
    OutputFile(const std::filesystem::path& path, ImageFormat format,
               const MoreEncoders& more = {});

    ImageFormat format() const { return format_; }

    /// Reserves as much of the disk space that an image of this size takes as is known. Throws
    /// SystemRefused if there is not enough.
    void reserve(int width, int height);

    /// Makes commit() flush the file to the disk before it gets its name, so that it survives a
    /// loss of power. This takes milliseconds.
    void be_durable() { file_.be_durable(); }

    /// Writes the image, and in EXR also the AOVs, unless null. Call it once. Throws
    /// SystemRefused; then there is no new file, and the call may be repeated.
    void commit(const core::Film& film, const ImageOptions& options,
                const core::Aovs* aovs = nullptr);
    void commit(const core::Film& film, core::Transfer transfer);

  private:
    void write_by(EncodeImage encode, const core::Film& film, const core::Aovs* aovs,
                  const ImageOptions& options);
    void write_codes(const core::Film& film, core::Transfer transfer);
    void write_hdr(const core::Film& film);
    void write_pfm(const core::Film& film);

    MoreEncoders more_;
    ImageFormat format_; // before file_: a wrong extension leaves no trace
    AtomicFile file_;
    bool has_failed_ = false;
};

} // namespace raylane::scenes
