#pragma once

#include "core/scene/film.hpp"
#include "core/scene/layers.hpp"
#include "scenes/byte_source.hpp"
#include "scenes/image/picture_options.hpp"
#include "scenes/image/reader.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// OpenEXR, by its library, which raylane may have been built without.
bool has_exr();

/// The bytes of a file: R G B, linear, and A if the film has an alpha, in halves, or with 32 bits
/// in floats; of layers, if there are any, Z, N.X, N.Y and N.Z in floats, and id.shape, id.material
/// and samples in whole numbers. Where there is nothing, Z is infinite, N is 0 and ids are
/// 4294967295. Throws std::bad_alloc.
std::string exr_of(const core::Film& film, const core::Layers* layers,
                   const PictureOptions& options);

/// All that exr_of has written, but what the options say beside the texts.
struct ExrPicture {
    core::Film film{1, 1};
    std::optional<core::Layers> layers;
    std::vector<std::pair<std::string, std::string>> texts;
};

/// Throws BadInput for a file that has more or less than exr_of writes, and SystemRefused: other
/// attributes, channels and parts may change how a viewer shows it.
ExrPicture read_own_exr(const std::filesystem::path& path);
ExrPicture read_own_exr(InputFile& file);

/// R, G and B, or Y alone, and A, of what the display window shows; what the file does not have of
/// that is 0. Throws MalformedPicture and std::bad_alloc.
void read_exr(ByteSource& source, Image& image);

} // namespace raylane::scenes
