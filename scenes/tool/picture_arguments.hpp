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
    bool layers = false, alpha = false;

    void add_to(CLI::App& command);
};

/// The same, parsed.
struct PictureChoice {
    /// Throws BadInput.
    explicit PictureChoice(const PictureArguments& arguments);

    /// Throws BadInput for what the format of the output does not have.
    void require_fit(PictureFormat format) const;
    /// The outline and alpha that are asked for, or else stay. Throws BadInput for an outline
    /// without a width.
    void apply_to(core::Settings& settings) const;
    /// Throws BadInput for a crop that does not lie in the picture.
    void apply_to(simd::RenderOptions& options, const core::Settings& settings) const;
    /// How the file has a picture of the scene with this name, of which it says what would draw it
    /// again: these options, of which `names_size` is the first, and `others` (" --style sticks").
    PictureOptions options(const std::string& scene, const core::Settings& settings,
                           const core::Settings& own, const std::string& others,
                           bool names_size) const;

    /// The settings and crop as options of the tool, for a scene that has `own` settings.
    std::string text(const core::Settings& settings, const core::Settings& own,
                     bool names_size) const;

    bool layers, alpha;
    int bits = 0;
    std::optional<core::Region> crop;
    std::optional<float> dpi, outline, outline_creases;
    std::optional<core::Color> outline_color;
};

/// Throws BadInput, in the option's name, for OpenEXR if raylane was built without.
void require_writable(const std::string& option, PictureFormat format);

} // namespace raylane::scenes
