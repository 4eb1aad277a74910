#pragma once

#include "scenes/tool/options/render_options.hpp"
#include "scenes/tool/options/scene_options.hpp"
#include "scenes/tool/sequence/scene_source.hpp"
#include "simd/wavefront/render.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace raylane::scenes {

/// An image of a sequence.
struct SequenceImage {
    const core::Scene& scene;
    const Legend& legend; ///< empty unless the sequence wants legends
    std::size_t place;    ///< in the sequence, from 0
    std::size_t number;   ///< in the names of its files
    const std::string& name;
};

/// Several images that belong together: frames of atoms, values of parameters, views of a turn.
struct FrameSequence {
    std::shared_ptr<core::Workers> workers; ///< used by `source`
    std::unique_ptr<SceneSource> source;
    std::function<std::string(std::size_t)> name; ///< the file name for an image's number
    ViewChange view;
    FitTo fit_to = FitTo::first;
    std::optional<Turn> turn;
    bool overwrites = true; ///< render images whose files exist already
    /// The share of this process: its number, from 0, and the number of processes, which take the
    /// images in turn.
    struct Share {
        std::size_t number = 0, of = 1;
    } share;
    std::optional<std::size_t> only; ///< render only the image at this place, regardless of `share`
    Verbosity verbosity = Verbosity::normal;
    /// Returns the settings to use for a scene, given the scene's own.
    std::function<core::Settings(const core::Settings&)> settings;
    bool wants_legends = false; ///< with atoms
    /// Renders an image into its file.
    std::function<void(const SequenceImage&, simd::Progress&)> draw;
};

/// Throws BadInput. `otherwise`: the number of images without the turn.
[[noreturn]] void refuse_turn(const Turn& turn, const std::string& otherwise);

/// The scene of an image, the number in the names of its files, and the name of its file.
struct SequenceFrame {
    core::Scene scene;
    std::size_t number;
    std::string name;
};

/// Returns the first image, whether or not its file exists. The caller renders it. `legend`, unless
/// null, receives the meaning of its shapes. Exceptions of the source propagate.
SequenceFrame first_frame(const FrameSequence& sequence, Legend* legend);

/// Renders all images. The scene of the next one is made while one is rendered. Exceptions of the
/// source and of `sequence.draw` propagate after the previous images are drawn. Throws BadInput
/// if the turn has another number of images than the source: before the first image too many,
/// or after the last one.
void draw(const FrameSequence& sequence);

/// Returns a function from the number of an image to the name of a file, which an option gives by
/// a pattern such as "frame-%05d.png". `needs_number`: false if a pattern without a number is
/// acceptable, for a single file. Throws BadInput, with the option, for a malformed pattern.
std::function<std::string(std::size_t)>
numbered_names(const std::string& option, const std::string& pattern, bool needs_number);

/// Returns a function from the number of an image to the name of its file, according to --output.
/// `is_one`: there is a single image, whose name needs no number. Both functions throw BadInput
/// for the name of the scene's file.
std::function<std::string(std::size_t)>
image_names(const std::string& scene, const std::optional<std::string>& output, bool is_one);

/// Returns the images that the command line requests, if there may be several. The caller sets
/// how they are rendered. Scenes are made with `threads` threads. `arguments` must outlive the
/// result. Throws BadInput.
std::optional<FrameSequence> requested_sequence(const RenderArguments& arguments, int threads,
                                                Verbosity verbosity);

} // namespace raylane::scenes
