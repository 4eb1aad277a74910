#pragma once

#include "raylane/api.hpp"
#include "raylane/material.hpp"
#include "raylane/precision.hpp"
#include "raylane/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace RAYLANE_API raylane {

/// AOVs (render outputs): for each pixel, the first visible surface, transparent or not, on the ray
/// through the centre of the pixel and the centre of the lens. Arrays are height x width, as in
/// Image.
struct Aovs {
    /// Distance along the ray, in units of length: from the camera's position or, orthographic,
    /// from the image plane through that position. Infinite where nothing is hit.
    std::vector<float> depth{};
    /// height x width x 3: unit shading normal on the visible side; 0 where nothing is hit.
    std::vector<float> normal{};
    /// Id of the shape, for identical shapes the id of the first; no_shape where nothing is hit.
    /// Parts of solids have their own ids (Scene::solid_of).
    std::vector<ShapeId> shape_id{};
    std::vector<MaterialIndex> material{}; ///< 4294967295 where nothing is hit
    std::vector<std::uint32_t> samples{};  ///< number of samples in the pixel's colour
};

using Layers [[deprecated("renamed to Aovs")]] = Aovs;

/// Reads a PNG for Pattern::image: grey, palettes and 16 bits too. Throws BadInput for other
/// formats, malformed files and transparent pixels, and SystemRefused. Give one Texture to several
/// materials, which then share the pixels.
RAYLANE_API Texture read_texture(const std::filesystem::path& path);

/// An image in linear float RGB. Components are >= 0 and may exceed 1.
struct Image {
    int width = 0;            ///< pixels
    int height = 0;           ///< pixels
    std::vector<float> rgb{}; ///< height x width x 3: rows from the top down, pixels left to right
    /// height x width, or empty: the covered fraction of each pixel, in [0, 1]. Colours are
    /// premultiplied: over a background they are rgb + (1 - alpha) * background.
    std::vector<float> alpha{};
    Aovs aovs{}; ///< empty unless RenderOptions::aovs is set

    /// Returns the colour of the pixel in column x from the left and row y from the top.
    Color at(int x, int y) const {
        const float* pixel =
            rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(x));
        return {pixel[0], pixel[1], pixel[2]};
    }
};

/// A rectangle of an image, in pixels from the left and from the top.
struct PixelRect {
    int x = 0, y = 0;
    int width = 0, height = 0;
};

struct RenderOptions {
    /// Unset: the scene's settings. For other proportions an automatic camera is placed again.
    std::optional<Settings> settings{};
    int threads = 0; ///< maximum, 1 to 4096; 0: the value of RAYLANE_THREADS, or all processors
    Precision precision = Precision::exact;
    /// The part of the image to render. It has the same bits as in the whole image. Unset: all.
    std::optional<PixelRect> crop{};
    bool aovs = false; ///< true: fill Image::aovs
    /// The name of an SVG file, ".svg", that receives the annotations of a scene of atoms
    /// (AtomOptions). Empty: they are put over the image, which needs Pango. The file has the size
    /// of the whole image, and appears complete or not at all.
    std::filesystem::path annotations{};
    /// Receives remarks on annotations that are left out, too small or too large.
    OnRemark on_remark{};
};

/// A finished tile, in the memory of the image that is being rendered. Valid only during the
/// callback that receives it.
struct Tile {
    int x = 0, y = 0;             ///< position of the tile's upper left pixel in the image
    int width = 0, height = 0;    ///< pixels
    const float* rgb = nullptr;   ///< linear components of the upper left pixel, then of its row
    std::size_t floats_a_row = 0; ///< stride of `rgb` in floats: from a pixel to the one below
    const float* alpha = nullptr; ///< in the layout of `rgb`, with a third of the stride; or null

    /// Returns the colour of the pixel in the tile's column from the left and row from the top.
    Color at(int column, int row) const {
        const float* pixel = rgb + static_cast<std::size_t>(row) * floats_a_row +
                             3 * static_cast<std::size_t>(column);
        return {pixel[0], pixel[1], pixel[2]};
    }
};

/// Progress of a rendering.
struct Progress {
    std::int64_t pixels = 0;       ///< finished pixels
    std::int64_t total_pixels = 0; ///< pixels of the image, or those rendered for a crop
    std::uint64_t rays = 0;        ///< rays traced so far, of all kinds
    Tile tile;                     ///< the tile finished last; tiles do not overlap
};

/// Receives the progress. Returns whether to continue.
using ProgressCallback = std::function<bool(const Progress&)>;

/// Renders the image of a scene. With Precision::exact the same scene and settings give the same
/// bits for any number of threads and on any processor. Throws InvalidValue if an option is out of
/// range (fields "settings/width", ..., "crop", "threads", "precision") or the environment variable
/// RAYLANE_THREADS is invalid (field "RAYLANE_THREADS"). Throws std::bad_alloc.
///
/// The annotations of a scene of atoms (AtomOptions) are put over the image after it is rendered:
/// the colours of callbacks do not have them. Throws BadInput for a scale bar that is not in the
/// image, and SystemRefused if raylane was built without Pango, or if the file of annotations
/// cannot be written. Throws InvalidValue, field "annotations", for the file of a scene without
/// annotations and for another ending. Thread-safe.
RAYLANE_API Image render(const Scene& scene, const RenderOptions& options = {});

/// Renders the image and reports its progress. The thread that has finished a tile, typically of
/// several hundred pixels or more, calls `progress`. Calls never overlap, so the callback should
/// return quickly. Once it returns false, it is not called again, the tiles in progress are
/// abandoned, and the result is empty. Exceptions thrown by the callback propagate.
RAYLANE_API std::optional<Image> render(const Scene& scene, const RenderOptions& options,
                                        const ProgressCallback& progress);

/// How write_image() encodes an image.
struct ImageEncoding {
    Transfer transfer = Transfer::srgb; ///< for .png, .tga, .bmp and .ppm
    int bits = 8;                       ///< per component: 8, or 16 for .png
    float dpi = 0.0F; ///< print resolution that a .png stores, 1 to 10000 per inch; 0: none
};

/// Writes an image to a file. The ending decides the format: .png (8 or 16 bits), .tga, .bmp, .ppm
/// (8 bits through the transfer curve), .hdr (Radiance) or .pfm (the floats unchanged). "-" is
/// standard output, as PNG. PNG stores the alpha, with colours that are not premultiplied; in the
/// other formats the image lies over black. The file appears complete or not at all. Throws
/// InvalidValue if the size of the arrays differs from the image's size, or for an encoding that
/// the format lacks (fields "transfer", "bits", "dpi"), BadInput for another ending, and
/// SystemRefused.
RAYLANE_API void write_image(const std::filesystem::path& path, const Image& image,
                             const ImageEncoding& encoding = {});

} // namespace raylane
