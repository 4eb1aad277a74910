#pragma once

#include "scenes/image/writer.hpp"
#include "scenes/tool/command.hpp"
#include "simd/render.hpp"

#include <string>

namespace raylane::scenes {

/// Command line options for the region of a picture, the lines over it, and the encoding of its
/// file.
struct PictureArguments {
    Argument crop, bits, dpi, outline, outline_color, outline_creases;
    bool layers = false, alpha = false;

    void add_to(CLI::App& command);
};

/// The parsed values of PictureArguments.
struct PictureChoice {
    /// Throws BadInput.
    explicit PictureChoice(const PictureArguments& arguments);

    /// Throws BadInput for options that the output's format does not support.
    void require_fit(PictureFormat format) const;
    /// Sets the outline and alpha that the options request, and keeps the others. Throws BadInput
    /// for details of an outline without a width.
    void apply_to(core::Settings& settings) const;
    /// Sets crop and layers. Throws BadInput if the crop is not within the picture.
    void apply_to(simd::RenderOptions& options, const core::Settings& settings) const;
    /// Returns the encoding and the metadata of a picture of the scene with this file name. Its
    /// Comment has the options that draw it again: those of text(), then `others`, which
    /// begins with a space. With `names_size`, --size is the first.
    PictureOptions options(const std::string& scene, const core::Settings& settings,
                           const core::Settings& own, const std::string& others,
                           bool names_size) const;

    /// Returns options of the tool that reproduce the settings and the crop for a scene whose
    /// settings are `own`.
    std::string text(const core::Settings& settings, const core::Settings& own,
                     bool names_size) const;

    bool layers, alpha;
    int bits = 0;
    std::optional<core::Region> crop;
    std::optional<float> dpi, outline, outline_creases;
    std::optional<core::Color> outline_color;
};

/// Throws BadInput with the option's name for OpenEXR if raylane was built without it.
void require_writable(const std::string& option, PictureFormat format);

} // namespace raylane::scenes
