#pragma once

#include "core/scene/aovs.hpp"
#include "core/scene/film.hpp"
#include "scenes/images/float_images.hpp"
#include "scenes/images/image_options.hpp"
#include "scenes/images/reader.hpp"
#include "scenes/images/tiff.hpp"
#include "scenes/images/writer.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// Returns true if raylane was built with the OpenEXR library.
bool has_exr();

/// Returns the bytes of an EXR file. It has linear R, G, B, and A if the film has an alpha, as
/// halves, or as floats if `options` requests 32 bits. If `aovs` is not null, it also has Z, N.X,
/// N.Y and N.Z as floats, and id.shape, id.material and samples as integers. In pixels without a
/// hit, Z is infinite, N is 0 and ids are 4294967295. Throws std::bad_alloc.
std::string exr_of(const core::Film& film, const core::Aovs* aovs, const ImageOptions& options);

/// The encoders that need optional libraries.
inline constexpr MoreEncoders more_encoders = {.exr = exr_of, .tiff = tiff_of};

/// The contents of a file of exr_of(); of the options, only the texts.
struct ExrImage {
    core::Film film{1, 1};
    std::optional<core::Aovs> aovs;
    std::vector<std::pair<std::string, std::string>> texts;
};

/// Throws BadInput for a file that has more or less than exr_of() writes, since other attributes,
/// channels and parts may change how a viewer shows it. Throws SystemRefused.
ExrImage read_own_exr(const std::filesystem::path& path);
ExrImage read_own_exr(InputFile& file);

/// Reads the display window: R, G and B, or Y alone, and A. Pixels outside of the data window are
/// 0. Throws MalformedImage and std::bad_alloc.
void read_exr(ByteSource& source, Image& image);

} // namespace raylane::scenes
