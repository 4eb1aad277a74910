#pragma once

#include "scenes/images/writer.hpp"
#include "scenes/tool/checkpoint/checkpoint.hpp"
#include "scenes/tool/exit.hpp"
#include "scenes/tool/image_texts.hpp"
#include "scenes/tool/options/scene_options.hpp"
#include "scenes/tool/ranks/job.hpp"
#include "simd/wavefront/render.hpp"

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace raylane::scenes {

/// A signal has stopped the rendering of an image. Exit code 128 + signal.
struct Stopped : std::exception {
    int signal;
    std::string text; ///< how to resume, or why that is impossible
    Stopped(int signal_, std::string text_) : signal(signal_), text(std::move(text_)) {}
    const char* what() const noexcept override { return text.c_str(); }
};

/// The rendering of an image. It resumes where an earlier process ended, if that process left a
/// checkpoint of the same scene and options beside the output. It keeps a checkpoint itself.
class ResumableRendering {
  public:
    /// `output`: the file of the image. There is no checkpoint for "-", for other files that are
    /// not regular, or if `wanted` is false.
    ResumableRendering(const std::string& output, bool wanted, const core::Scene& scene,
                       const std::string& fingerprint, const core::Settings& settings,
                       simd::RenderOptions options, const std::optional<ImagePart>& part,
                       Verbosity verbosity);

    /// Renders the image, and reports a checkpoint that was found on standard error. Throws
    /// Stopped. With a job of several ranks, this is collective, and the ranks part at its end;
    /// rank 0 has the image. With a checkpoint, the first signal does not end the process from
    /// here until end_if_signalled().
    simd::Rendering draw(simd::Progress& progress, Job* job = nullptr);
    /// Writes the image. If the disk is full, it takes the space of the checkpoint. Throws
    /// SystemRefused.
    void write(OutputFile& output, const core::Film& film, const ImageOptions& options,
               const core::Aovs* aovs);
    /// Removes the checkpoint. Call it when the image is written.
    void finished();
    /// Throws Stopped if a signal has arrived since the last tiles were begun. Call it after
    /// finished().
    void end_if_signalled();
    /// Returns the number of pixels that all runs together render: those of the part.
    std::int64_t pixels() const;

  private:
    void say(const std::string& what) const;
    void say_found() const;
    bool is_others(std::size_t tile) const;
    simd::Rendering draw_alone(simd::Progress& progress);
    simd::Rendering draw_among(Job& job, simd::Progress& progress);
    [[noreturn]] void stopped() const;
    std::int64_t pixels_of_others() const;
    int percent(std::int64_t pixels) const;

    std::string output_;
    const core::Scene& scene_;
    core::Settings settings_;
    simd::RenderOptions options_;
    simd::TileGrid grid_;
    std::optional<ImagePart> part_;
    Verbosity verbosity_;
    std::optional<StopOnSignal> stop_on_signal_;
    std::unique_ptr<Checkpoint> checkpoint_; // null: no checkpoint
    std::int64_t drawn_ = 0;                 // pixels, including those of the checkpoint
};

} // namespace raylane::scenes
