#pragma once

#include "scenes/image/writer.hpp"
#include "scenes/tool/interrupt.hpp"
#include "scenes/tool/journal/journal.hpp"
#include "scenes/tool/picture_part.hpp"
#include "scenes/tool/ranks/job.hpp"
#include "scenes/tool/verbosity.hpp"
#include "simd/render.hpp"

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace raylane::scenes {

/// A signal has ended the drawing of a picture, of which a journal is kept. Exit code 128 + signal.
struct Stopped : std::exception {
    int signal;
    std::string text; ///< how to go on, or why that cannot be
    Stopped(int signal_, std::string text_) : signal(signal_), text(std::move(text_)) {}
    const char* what() const noexcept override { return text.c_str(); }
};

/// The drawing of a picture that goes on where an earlier process was ended, if that has left a
/// journal beside the output of the same scene and options; and that leaves one.
class ResumableRendering {
  public:
    /// For a picture that is written to `output`: "-" and what is no regular file have no journal,
    /// and so if it is not `wanted`.
    ResumableRendering(const std::string& output, bool wanted, const core::Scene& scene,
                       const std::string& fingerprint, const core::Settings& settings,
                       simd::RenderOptions options, const std::optional<PicturePart>& part,
                       Verbosity verbosity);

    /// Says on standard error what there was. Throws Stopped. With a job of several ranks,
    /// together, which part then: rank 0 has the picture. If there is a journal, the first signal
    /// does not end the process from here until end_if_signalled().
    simd::Rendering draw(simd::Progress& progress, Job* job = nullptr);
    /// Writes the picture; where the disk is full, in the room that its journal gives. Throws
    /// SystemRefused.
    void write(OutputFile& output, const core::Film& film, const PictureOptions& options,
               const core::Layers* layers);
    /// The picture has been written.
    void finished();
    /// Behind that: throws Stopped if a signal has come since the last tiles were begun.
    void end_if_signalled();
    /// How many pixels are to be drawn, by whichever run: those of the part.
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
    std::optional<PicturePart> part_;
    Verbosity verbosity_;
    std::optional<StopOnSignal> stop_on_signal_;
    std::unique_ptr<Journal> journal_; // null: none
    std::int64_t drawn_ = 0;           // pixels, with those that were found
};

} // namespace raylane::scenes
