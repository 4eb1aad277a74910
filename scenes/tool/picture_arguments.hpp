#pragma once

#include "scenes/image/writer.hpp"
#include "scenes/tool/command.hpp"
#include "simd/render.hpp"

#include <string>

namespace raylane::scenes {

/// What of a picture is drawn, with which lines over it, and how its file has it, as the command
/// line says it.
struct PictureArguments {
    Argument crop, bits, dpi, outline, outline_color, outline_creases;
    bool layers = false;

    void add_to(CLI::App& command);
};

/// The same, parsed.
struct PictureChoice {
    /// Throws BadInput.
    explicit PictureChoice(const PictureArguments& arguments);

    /// Throws BadInput for what the format of the output does not have.
    void require_fit(PictureFormat format) const;
    /// The outline that is asked for, or else stays. Throws BadInput for one without a width.
    void apply_to(core::Settings& settings) const;
    /// Throws BadInput for a crop that does not lie in the picture.
    void apply_to(simd::RenderOptions& options, const core::Settings& settings) const;
    /// How the file has a picture of the scene with this name, of which it says what would draw it
    /// again, but for what changes none.
    PictureOptions options(const std::string& scene, const core::Settings& settings) const;

    bool layers;
    int bits = 0;
    std::optional<core::Region> crop;
    std::optional<float> dpi, outline, outline_creases;
    std::optional<core::Color> outline_color;
};

} // namespace raylane::scenes
