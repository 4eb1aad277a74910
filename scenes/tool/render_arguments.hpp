#pragma once

#include "scenes/tool/film_strip_arguments.hpp"
#include "scenes/tool/picture_arguments.hpp"
#include "scenes/tool/picture_part.hpp"
#include "scenes/tool/scene_arguments.hpp"
#include "simd/render.hpp"

#include <optional>
#include <string>
#include <utility>

namespace raylane::scenes {

/// Command line options of render.
struct RenderArguments {
    Argument scene, output, size, samples, quality, filter, light_samples, max_depth,
        max_see_through, min_weight, threads, transfer, stats, part;
    Argument engine = "vector", isa, tile, precision = "exact";
    bool no_resume = false, draft = false, print = false;
    SceneArguments scene_arguments;
    FrameArguments frames;
    PictureArguments picture;

    void add_to(CLI::App& command);
};

/// The options that override a scene's settings. They are parsed before the scene is loaded, so
/// that errors are reported at once.
struct Overrides {
    /// Throws BadInput.
    explicit Overrides(const RenderArguments& arguments);

    core::Settings applied_to(core::Settings settings) const;

    std::optional<std::pair<int, int>> size;
    std::optional<int> grid, light_samples, max_depth, max_see_through;
    std::optional<float> quality, min_weight;
    std::optional<core::Transfer> transfer;
    std::optional<core::PixelFilter> filter;
};

/// Throws BadInput.
core::Precision precision_argument(const std::string& text);

/// Throws BadInput.
std::optional<PicturePart> part_argument(const Argument& text);

/// Returns engine, instruction set, tile size and threads. Throws BadInput.
simd::RenderOptions options_of(const RenderArguments& arguments);

} // namespace raylane::scenes
