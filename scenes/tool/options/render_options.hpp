#pragma once

#include "scenes/annotation/annotations.hpp"
#include "scenes/images/writer.hpp"
#include "scenes/tool/image_texts.hpp"
#include "scenes/tool/options/scene_options.hpp"
#include "simd/wavefront/render.hpp"

#include <memory>
#include <string>
#include <utility>

/// Options for rendering images.
namespace raylane::scenes {

Values<core::Region> crops();
Values<core::Color> colors();
Values<ImagePart> image_parts();
Values<simd::Isa> instruction_sets();

/// Returns true for images that depend on tiles and instruction sets.
inline bool is_inexact(const Rendered& rendered) {
    return rendered.options.precision != core::Precision::exact;
}

/// Throws BadInput with the option's name for OpenEXR if raylane was built without it.
void require_writable(const std::string& option, ImageFormat format);

/// Options for the encoding of an image's file.
struct EncodingArguments : OptionTable {
    EncodingArguments(OptionTable& parent, std::string default_bits)
        : OptionTable(parent, parent.group()),
          bits(*this, "--bits",
               choice<int>({{"8", 8}, {"16", 16}, {"32", 32}}).otherwise(std::move(default_bits)),
               "Bits per channel: 8 or 16 (PNG, TIFF), 16 (half) or 32 (float) (EXR).") {}

    /// Throws BadInput for options that the format does not support.
    void require_fit(ImageFormat format) const;
    /// Returns the resolution to store. A size on paper has one.
    std::optional<float> dpi_for(const Option<ImageSize>& size) const;

    Option<int> bits;
    Option<float> dpi = {*this, "--dpi",
                         number(1.0F, 10000.0F, "N")
                             .in("pixels per inch")
                             .recorded()
                             .otherwise("none, or 300 for a size on paper"),
                         "Print resolution stored in PNG, TIFF or EXR."};
};

/// Options for the settings of an image, except its size.
struct SettingArguments : OptionTable {
    explicit SettingArguments(OptionTable& parent) : OptionTable(parent, parent.group()) {}

    /// Returns a scene's settings with the size of an image and the changes that the options
    /// request. `scales_outline`: whether the scene's outline is as thick on a larger image. Throws
    /// BadInput for details of an outline without a width.
    core::Settings settings_of(const core::Settings& own, const std::pair<int, int>& size,
                               bool scales_outline) const;

    Option<int> samples = {
        *this, "--spp",
        square_of(core::Settings::max_grid)
            .replacing(&core::Settings::grid,
                       [](const Rendered& rendered) { return rendered.settings.quality == 0.0F; })
            .otherwise(as_in_file, "see --quality"),
        "Samples per pixel, a square number."};
    Option<float> quality = {
        *this, "--quality",
        number(10.0F, 80.0F, "DB")
            .in("dB")
            .replacing(&core::Settings::quality,
                       [](const Rendered& rendered) { return rendered.settings.quality != 0.0F; })
            .otherwise(as_in_file, "46, or 40 for spheres and points; --spp 9 if over 135,000 of "
                                   "these are narrower than two pixels")
            .without({"--spp"}),
        "Target PSNR against a converged image, instead of --spp; 40 suits print."};
    Option<core::PixelFilter> filter = {
        *this, "--filter",
        choice<core::PixelFilter>({{"box", core::PixelFilter::box},
                                   {"gaussian", core::PixelFilter::gaussian},
                                   {"blackman-harris", core::PixelFilter::blackman_harris}})
            .replacing(&core::Settings::filter),
        "Pixel filter: box (the square of the pixel), or the smoother gaussian or "
        "blackman-harris (radius 1.5 pixels)."};
    Option<int> light_samples = {
        *this, "--light-samples",
        whole(core::Settings::hard_light, core::Settings::max_light_samples)
            .replacing_rarely(&core::Settings::light_samples),
        "Shadow rays to each area or sky light, from each shaded point. 0: 4 with one "
        "sample per pixel, 1 with more. -1: hard shadows, with one ray to the centre of "
        "each light, and an unshadowed sky."};
    Option<bool> transparent_shadows = {
        *this, "--transparent-shadows",
        choice<bool>({{"on", true}, {"off", false}})
            .replacing_rarely(&core::Settings::transparent_shadows)
            .otherwise(as_in_file, "on"),
        "Shadows of transparent surfaces and glass. off: an envelope leaves its contents as bright "
        "as they are without it."};
    Flag draft = {*this, "--draft",
                  flag().without({"--print", "--spp", "--quality", "--light-samples"}),
                  "Fast preview, same as --spp 1 --light-samples -1."};
    Flag print = {*this, "--print", flag().without({"--spp", "--quality"}),
                  "Print quality, without grain at 300 dpi, same as --quality 50."};
    Option<int> max_depth = {
        *this, "--max-depth",
        whole(0, core::Settings::depth_limit).replacing(&core::Settings::max_depth),
        "Maximum number of reflections and refractions along a path."};
    Option<int> max_transparent = {
        *this, "--max-transparent",
        whole(1, core::Settings::transparent_limit)
            .replacing_rarely(&core::Settings::max_transparent)
            .otherwise(as_in_file, "all"),
        "Maximum number of transparent surfaces shown one behind the other; further ones "
        "are omitted."};
    Option<float> min_weight = {*this, "--min-weight",
                                number(0.0F, 1.0F, "W").replacing(&core::Settings::min_weight),
                                "Minimum weight of a path in its pixel; paths below it end."};
    Option<core::Transfer> transfer = {
        *this, "--transfer",
        choice<core::Transfer>({{"srgb", core::Transfer::srgb}, {"linear", core::Transfer::linear}})
            .replacing_rarely(&core::Settings::transfer),
        "Transfer function of 8-bit and 16-bit images."};
    Option<float> outline = {
        *this, "--outline",
        number(0.0F, core::Outline::max_width, "WIDTH").in("pixels").replacing_rarely([
        ](auto& settings) -> auto& { return settings.outline.width; }),
        "Draw outlines of this width where one surface hides another; 0 for none."};
    Option<core::Color> outline_color = {
        *this, "--outline-color",
        colors().replacing(
            [](auto& settings) -> auto& { return settings.outline.color; },
            // The colour of a scene may lie between two codes.
            [](const Rendered& rendered) {
                return rendered.settings.outline.any() &&
                       rendered.settings.outline.color != rendered.own.outline.color;
            }),
        "Colour of the outlines, such as black or #204060."};
    Option<float> outline_creases = {
        *this, "--outline-creases",
        number(0.0F, 180.0F, "DEGREES")
            .replacing(
                [](auto& settings) -> auto& { return settings.outline.creases; },
                [](const Rendered& rendered) {
                    return rendered.settings.outline.any() &&
                           rendered.settings.outline.creases != rendered.own.outline.creases;
                }),
        "Draw outlines also between materials and where surfaces bend by more than "
        "DEGREES; 180 for none of these."};
};

/// Options for the region of an image and its channels.
struct ImageArguments : OptionTable {
    explicit ImageArguments(OptionTable& parent) : OptionTable(parent, "Images") {}

    /// Throws BadInput for options that the output's format does not support.
    void require_fit(ImageFormat format) const;
    /// Sets crop and AOVs. Throws BadInput if the crop is not within the image.
    void apply_to(simd::RenderOptions& options, const core::Settings& settings) const;

    Option<core::Region> crop = {
        *this, "--crop", crops().recorded(),
        "Render only this rectangle: its upper left corner and its size, in pixels of "
        "the whole image."};
    EncodingArguments encoding{*this, "8 (PNG, TIFF), 16 (EXR)"};
    Flag aovs = {*this, "--aovs", flag(),
                 "Add AOVs of the first surface at the middle of each pixel to an EXR: Z "
                 "(distance along the ray), N.X, N.Y, N.Z, id.shape, id.material and "
                 "samples (number of samples)."};
    Flag alpha = {*this, "--alpha", flag().recorded(),
                  "Omit the background, for compositing. The alpha of a PNG, TIFF or EXR is the "
                  "covered share of each pixel."};
};

/// A length in angstrom, or 0 for "auto".
Values<double> bar_lengths();
Values<LabelWords> label_texts();
Values<DistanceWords> distance_texts();

/// Options for legends and labels on images.
struct AnnotationArguments : OptionTable {
    explicit AnnotationArguments(OptionTable& parent)
        : OptionTable(parent, "Annotations (of atoms)") {}

    /// Returns the annotations of images with a resolution in pixels per inch, if that is known.
    /// `axes_on_right`: as arrows of the cell are on the left. Throws BadInput for details without
    /// annotations.
    Annotations annotations_at(std::optional<float> dpi, bool axes_on_right) const;

    Flag legend = {
        *this, "--legend", flag().recorded(),
        "Explain the colours by a bar with numbers, or by the names of elements or chains."};
    Option<std::string> legend_title = {*this, "--legend-title",
                                        word("TEXT").recorded().otherwise("the name of the number"),
                                        "Text above the legend."};
    Option<double> scale_bar = {
        *this, "--scale-bar", bar_lengths().recorded(),
        "Bar of this length in angstrom, within the image; auto: of a round "
        "length. Scenes that are not of atoms have no unit."};
    Option<Axes> axes = {*this, "--triad", choice(named_axes()).recorded(),
                         "Arrows along the axes of space or of the cell: on the left, or on the "
                         "right beside the arrows of --axes. auto: of the cell, if there is one."};
    ListOption<LabelWords> label = {
        *this, "--label", label_texts().recorded(),
        "Label at the middle of the selected atoms, as \"SELECTION: TEXT\". With {element}, {name} "
        "or "
        "{index} in the text, each copy of each atom has a label; with {resn} or {resi}, each "
        "residue; with {chain}, each chain. Labels with fields are left out where other atoms hide "
        "them, and all at atoms that the image does not show."};
    ListOption<DistanceWords> distance = {
        *this, "--distance", distance_texts().recorded(),
        "Dashed line with the distance between the middles of two selections, as \"SELECTION: "
        "SELECTION\"."};
    Option<std::string> font = {*this, "--font", word("NAME").recorded().otherwise("sans-serif"),
                                "Font of texts. A remark names another one if this is not "
                                "installed."};
    Option<float> font_size = {
        *this, "--font-size",
        number(1.0F, 1000.0F, "POINTS")
            .recorded()
            .otherwise("1/32 of the image's height, at least 10 pixels"),
        "Size of texts in points, at the resolution of --dpi, or of 300 pixels per inch. A "
        "remark tells if they are too small or too large for the image. Legend, axes and scale bar "
        "have smaller ones where they have no room."};
};

/// These options, and one for a file of annotations.
struct AnnotationFileArguments : AnnotationArguments {
    using AnnotationArguments::AnnotationArguments;

    Option<std::string> annotations = {
        *this, "--annotations", file_name(),
        "Write the annotations to an SVG file of the image's size, and leave them off the image. "
        "The name for several images has a number, as that of --output."};
};

/// Options of render.
struct RenderArguments : OptionTable {
    RenderArguments();

    /// Returns the settings of a scene with the changes that the options request. Throws BadInput
    /// for details of an outline without a width.
    core::Settings settings_of(const core::Settings& own) const;
    /// Throws BadInput for options that the output's format does not support.
    void require_fit(ImageFormat format) const;
    /// Returns true if the background is transparent because of --background.
    bool has_no_background() const;
    /// Returns engine, instruction set, precision, tile size and threads. `with_isa`: whether this
    /// processor must support --isa. Throws BadInput.
    simd::RenderOptions render_options(bool with_isa = true) const;
    /// Returns the resolution to store. A size on paper has one.
    std::optional<float> dpi() const;
    Annotations annotations() const;
    /// Returns true if the options request several images, of which each has a number.
    bool has_sequence() const;

    Option<std::string> scene = {
        *this, "SCENE", file_argument(),
        "Scene (JSON, NFF, POV-Ray, Tachyon, or .rl from build) or atoms (PDB, mmCIF, "
        "CIF, PQR, XYZ, GRO, MOL, SDF, MOL2, LAMMPS), optionally gzipped; - is standard input."};
    Option<std::string> output = {
        *this, "-o,--output",
        file_name().otherwise("the scene's name with .png, in the current folder"),
        "Image, .png, .tif, .exr, .hdr, .pfm, .tga, .bmp or .ppm; - writes a PNG to standard "
        "output."};
    Option<ImageSize> size = {
        *this, "--size",
        image_size_on_paper().recorded(
            [](const Rendered& rendered) {
                return ImageSize{static_cast<double>(rendered.settings.width),
                                 static_cast<double>(rendered.settings.height)};
            },
            [](const Rendered& rendered) { return rendered.names_size; }),
        "Image width and height in pixels; or on paper: the width, or both, in cm, mm or in, such "
        "as 8.5cm or 85x60mm, at the resolution of --dpi."};
    SettingArguments setting{*this};
    ThreadsOption threads{*this};
    Option<simd::Engine> engine = {
        *this, "--engine",
        choice<simd::Engine>(
            {{"vector", simd::Engine::vector}, {"reference", simd::Engine::reference}})
            .initially(simd::Engine::vector)
            .recorded([](const Rendered& rendered) { return rendered.options.engine; },
                      [](const Rendered& rendered) {
                          return rendered.options.engine != simd::Engine::vector;
                      }),
        "Engine: vector, or reference, which is scalar and slow."};
    Option<simd::Isa> isa = {
        *this, "--isa",
        instruction_sets()
            .recorded([](const Rendered& rendered) { return rendered.options.isa; },
                      [](const Rendered& rendered) {
                          return is_inexact(rendered) &&
                                 rendered.options.engine == simd::Engine::vector;
                      })
            .otherwise("the widest available one"),
        "Instruction set of the vector engine."};
    Option<int> tile = {
        *this, "--tile",
        whole(8, 64).in("pixels").recorded(
            [](const Rendered& rendered) {
                return simd::tile_of(rendered.settings, rendered.options);
            },
            is_inexact),
        "Side of the tiles that threads render. Images of precision exact do not depend "
        "on it."};
    Option<core::Precision> precision = {
        *this, "--precision",
        precisions()
            .initially(core::Precision::exact)
            .recorded([](const Rendered& rendered) { return rendered.options.precision; },
                      is_inexact),
        "Arithmetic of intersections: fast (textbook formulas in float), robust (best "
        "formulas in float), exact (certified, with the results of real arithmetic) or "
        "double (formulas of robust in double)."};
    Option<std::string> stats = {*this, "--stats", file_name(),
                                 "Write statistics of the render as JSON; - is standard output."};
    Flag no_resume = {*this, "--no-resume", flag(),
                      "Ignore checkpoints of interrupted renders (FILE.part), and write "
                      "none."};
    Option<ImagePart> part = {
        *this, "--part", image_parts(),
        "Render part K of N, for N processes or machines: some tiles of an image, in an "
        "EXR for merge; of a sequence, every N-th image from the K-th on."};
    ImageArguments image{*this};
    AnnotationFileArguments annotation{*this};
    FrameArguments frames{*this};
    SceneArguments scene_arguments{*this, true};
};

/// Returns the options that an image records, as arguments of render for this scene. Throws
/// BadInput.
std::unique_ptr<RenderArguments>
recorded_arguments(const std::string& image, const ImageTexts& texts, const std::string& scene);

} // namespace raylane::scenes
