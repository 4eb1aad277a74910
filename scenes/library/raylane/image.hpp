#pragma once

#include "raylane/api.h"
#include "raylane/precision.hpp"
#include "raylane/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace RAYLANE_API raylane {

/// What the ray through the middle of each pixel, and the middle of the lens, hits first of what
/// can be seen from there, see-through or not. Arrays are height x width, as in Image.
struct Layers {
    /// From the camera or, orthographic, from the plane through it that the picture is in, along
    /// the ray, in units of length; infinite where there is nothing.
    std::vector<float> depth{};
    /// height x width x 3: unit, to shade with, on the side that is seen; 0 where there is nothing.
    std::vector<float> normal{};
    /// Of shapes that are the same, the first; no_shape where there is nothing. Parts of solids
    /// count for themselves (Scene::solid_of).
    std::vector<ShapeId> shape{};
    std::vector<MaterialIndex> material{}; ///< 4294967295 where there is nothing
    std::vector<std::uint32_t> samples{};  ///< that the colour is the mean of
};

/// A picture in linear float RGB. Components are >= 0 and may exceed 1.
struct Image {
    int width = 0;            ///< pixels
    int height = 0;           ///< pixels
    std::vector<float> rgb{}; ///< height x width x 3: rows from the top down, pixels left to right
    /// height x width, or empty. The share of each pixel that something covers, in [0, 1]; colours
    /// are multiplied by it, so that over a background they are rgb + (1 - alpha) * background.
    std::vector<float> alpha{};
    Layers layers{}; ///< empty if they were not asked for

    /// The pixel in column x from the left, row y from the top.
    Color at(int x, int y) const {
        const float* pixel =
            rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(x));
        return {pixel[0], pixel[1], pixel[2]};
    }
};

/// A part of a picture, in its pixels, from the left and from the top.
struct PixelRect {
    int x = 0, y = 0;
    int width = 0, height = 0;
};

struct RenderOptions {
    std::optional<Settings> settings{}; ///< in place of the scene's
    int threads = 0; ///< at most, 1 to 4096; 0: as RAYLANE_THREADS says, or all of the machine
    Precision precision = Precision::exact;
    /// The part of the picture that becomes the image, with the bits that it has in the whole.
    std::optional<PixelRect> crop{};
    bool layers = false; ///< wanted, too
};

/// Part of a picture, where the picture is drawn: not to be read behind the call that it is an
/// argument of.
struct Tile {
    int x = 0, y = 0;             ///< of the picture's pixel that is the tile's upper left one
    int width = 0, height = 0;    ///< pixels
    const float* rgb = nullptr;   ///< linear components of the upper left pixel, then of its row
    std::size_t floats_a_row = 0; ///< from a pixel to the one below
    const float* alpha = nullptr; ///< as rgb, with a third as many a row; null if there is none

    /// The pixel in the tile's column from the left, row from the top.
    Color at(int column, int row) const {
        const float* pixel = rgb + static_cast<std::size_t>(row) * floats_a_row +
                             3 * static_cast<std::size_t>(column);
        return {pixel[0], pixel[1], pixel[2]};
    }
};

/// Progress of a rendering.
struct Progress {
    std::int64_t pixels = 0;       ///< done
    std::int64_t total_pixels = 0; ///< of the picture, or of what is drawn for a crop
    std::uint64_t rays = 0;        ///< traced, of all kinds
    Tile tile;                     ///< done last; no two share a pixel
};

/// Hears of progress, and answers whether to continue.
using ProgressCallback = std::function<bool(const Progress&)>;

/// The picture of a scene. With Precision::exact the same scene and settings give the same bits,
/// whatever the threads and the processor. May be called by several threads at a time. Throws
/// InvalidValue for options that are none (fields "settings/width", ..., "crop", "threads",
/// "precision"), and std::bad_alloc.
RAYLANE_API Image render(const Scene& scene, const RenderOptions& options = {});

/// The same, with a callback: called with every tile of some hundred pixels or more, by whichever
/// thread has drawn it, never by two at a time, so it should be quick. Once it returns false it is
/// not called again, the tiles under way are finished, and there is no picture. What it throws
/// comes out.
RAYLANE_API std::optional<Image> render(const Scene& scene, const RenderOptions& options,
                                        const ProgressCallback& progress);

/// Writes a picture; the file's ending tells the format: .png, .tga, .bmp, .ppm (8 bits through the
/// transfer curve), .hdr (Radiance) or .pfm (the floats unchanged). Of alpha .png tells, as its
/// format has it, with colours not multiplied; in the others the picture lies over black. The file
/// appears whole or not at all. Throws InvalidValue for an image whose size is not that of its
/// pixels, BadInput for another ending, and SystemRefused.
RAYLANE_API void write_image(const std::filesystem::path& path, const Image& image,
                             Transfer transfer = Transfer::srgb);

} // namespace raylane
