#include "scenes/tool/checkpoint/resumable.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/images/exr.hpp"
#include "scenes/tool/progress_bar.hpp"
#include "scenes/tool/ranks/ranked_tiles.hpp"
#include "scenes/tool/system.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace raylane::scenes {

namespace {

/// Returns true if the name, or a link that it leads to, is in /proc or is a link in /dev. Such a
/// stream may be a regular file.
bool leads_to_stream(const std::string& output) {
    std::error_code unknown;
    std::filesystem::path path = output;
    constexpr int longest_chain = 40; // Linux's own limit
    for (int i = 0; i < longest_chain; ++i) {
        const std::filesystem::path folder = std::filesystem::canonical(
            std::filesystem::absolute(path, unknown).parent_path(), unknown);
        const std::string name = (folder / path.filename()).string();
        const bool is_link = std::filesystem::is_symlink(name, unknown);
        if (name.starts_with("/proc/")) return true;
        if (name.starts_with("/dev/") && (is_link || i > 0)) return true;
        if (!is_link) return false;
        path = folder / std::filesystem::read_symlink(name, unknown);
    }
    return false;
}

bool may_have_checkpoint(const std::string& output) {
    if (output == "-") return false;
    std::error_code unknown;
    return !std::filesystem::exists(output, unknown) ||
           (std::filesystem::is_regular_file(output, unknown) && !leads_to_stream(output));
}

} // namespace

ResumableRendering::ResumableRendering(const std::string& output, bool wanted,
                                       const core::Scene& scene, const std::string& fingerprint,
                                       const core::Settings& settings, simd::RenderOptions options,
                                       const std::optional<ImagePart>& part, Verbosity verbosity)
    : output_(output), scene_(scene), settings_(settings), options_(std::move(options)),
      grid_(simd::grid_of(settings, options_)), part_(part), verbosity_(verbosity) {
    if (!wanted || !may_have_checkpoint(output)) return;
    std::string text = options_line(settings, options_);
    text += " --tile " + std::to_string(simd::tile_of(settings, options_));
    if (options_.aovs) text += " --aovs";
    if (part_) text += " --part " + part_->text();
    checkpoint_ = std::make_unique<Checkpoint>(
        output, CheckpointSubject{fingerprint, std::move(text)}, TileRecords(settings, options_),
        [this](const std::string& problem) { say(problem); });
}

/// Prints a line in place of the progress line, which is redrawn below it.
void ResumableRendering::say(const std::string& what) const {
    const bool has_bar = verbosity_ != Verbosity::quiet && is_terminal();
    std::fprintf(stderr, "%sraylane: %s\n", has_bar ? "\r\x1B[K" : "", what.c_str());
}

void ResumableRendering::say_found() const {
    const auto say_of_it = [&](const std::string& what) {
        if (verbosity_ != Verbosity::quiet)
            say(printable(checkpoint_->found_at().string(), 4096) + ": " + what);
    };
    const std::string is_kept = "; not resumed, kept until this image is complete";
    switch (checkpoint_->found()) {
    case Checkpoint::Found::nothing:
        return;
    case Checkpoint::Found::same:
        return say_of_it("resumes at " + std::to_string(percent(checkpoint_->found_pixels())) +
                         " %");
    case Checkpoint::Found::other_scene:
        return say_of_it("belongs to another scene" + is_kept);
    case Checkpoint::Found::other_options:
        return say_of_it("belongs to other options or another version" + is_kept);
    case Checkpoint::Found::cut_off:
        return say_of_it("has a truncated header; not resumed");
    case Checkpoint::Found::none_of_ours:
        return say_of_it("is not a checkpoint of this user; rendering without a checkpoint");
    case Checkpoint::Found::in_use:
        return say_of_it("is in use; rendering without a checkpoint");
    case Checkpoint::Found::named_too_long:
        return say_of_it("has too long a name; rendering without a checkpoint");
    }
}

bool ResumableRendering::is_others(std::size_t tile) const {
    return part_ && !part_->has(tile);
}

std::int64_t ResumableRendering::pixels_of_others() const {
    std::int64_t pixels = 0;
    for (std::size_t number = 0; number < grid_.count(); ++number)
        if (is_others(number)) pixels += grid_.tile(number).pixels();
    return pixels;
}

std::int64_t ResumableRendering::pixels() const {
    return grid_.part().pixels() - pixels_of_others();
}

/// Returns the percentage of the pixels to render.
int ResumableRendering::percent(std::int64_t pixels) const {
    return static_cast<int>(100 * pixels / std::max<std::int64_t>(1, this->pixels()));
}

simd::Rendering ResumableRendering::draw(simd::Progress& progress, Job* job) {
    options_.progress = &progress;
    const bool is_shared = job != nullptr && job->ranks() != nullptr;
    if (checkpoint_ || is_shared) stop_on_signal_.emplace(progress);
    if (checkpoint_) say_found();
    simd::Rendering rendering = is_shared ? draw_among(*job, progress) : draw_alone(progress);
    if (!rendering.complete) stopped();
    if (!checkpoint_) stop_on_signal_.reset();
    return rendering;
}

simd::Rendering ResumableRendering::draw_alone(simd::Progress& progress) {
    std::atomic<std::int64_t> left_out = 0;
    options_.recall = [&](const simd::TileToFill& tile) {
        if (is_others(grid_.number_of(tile.region))) {
            left_out += tile.region.pixels();
            return true; // the tile stays black
        }
        return checkpoint_ && checkpoint_->recall(tile);
    };
    if (!checkpoint_) return simd::render(scene_, settings_, options_);
    options_.after_tile = [this](const simd::FinishedTile& tile) { checkpoint_->note(tile); };
    simd::Rendering rendering = simd::render(scene_, settings_, options_);
    drawn_ = progress.pixels - left_out;
    return rendering;
}

simd::Rendering ResumableRendering::draw_among(Job& job, simd::Progress& progress) {
    RankedTiles::Tiles tiles;
    for (std::size_t number = 0; job.is_first() && number < grid_.count(); ++number)
        if (!is_others(number))
            (checkpoint_ && checkpoint_->has(number) ? tiles.to_visit : tiles.to_draw)
                .push_back(static_cast<std::uint32_t>(number));
    progress.pixels = pixels_of_others();
    const TileRecords records(settings_, options_);
    RankedTiles ranked(*job.ranks(), std::move(tiles), records, options_.threads, progress.stop);
    options_.tiles = &ranked;
    options_.recall = [&](const simd::TileToFill& tile) {
        const std::optional<std::string> bytes = ranked.recall(tile);
        if (!bytes) return checkpoint_ && checkpoint_->recall(tile);
        progress.rays += tile.counters.rays();
        progress.recalled -= tile.region.pixels(); // another rank has rendered it
        if (checkpoint_) checkpoint_->note(grid_.number_of(tile.region), *bytes);
        return true;
    };
    options_.after_tile = [&](const simd::FinishedTile& tile) {
        ranked.note(tile);
        if (checkpoint_) checkpoint_->note(tile);
    };
    simd::Rendering rendering = simd::render(scene_, settings_, options_);
    for (const auto& [number, bytes] : ranked.finish()) {
        if (checkpoint_) checkpoint_->note(number, bytes);
        progress.pixels += grid_.tile(number).pixels();
        rendering.complete = false;
    }
    drawn_ = progress.pixels - pixels_of_others();
    job.part();
    if (job.is_first())
        rendering.complete = rendering.complete && progress.pixels == grid_.part().pixels();
    else if (StopOnSignal::signal() != 0)
        throw RankFailed::silent();
    return rendering;
}

void ResumableRendering::stopped() const {
    const std::string done = "stopped at " + std::to_string(percent(drawn_)) + " %";
    const int signal = StopOnSignal::signal() != 0 ? StopOnSignal::signal() : SIGTERM;
    if (!checkpoint_) throw Stopped(signal, done);
    throw Stopped(signal, checkpoint_->keep() ? done + "; the same command resumes from " +
                                                    printable(checkpoint_->path().string(), 4096)
                          : checkpoint_->problem().empty() ? done + ", without a checkpoint"
                                                           : done + "; " + checkpoint_->problem());
}

void ResumableRendering::write(OutputFile& output, const core::Film& film,
                               const ImageOptions& options, const core::Aovs* aovs) {
    try {
        return output.commit(film, options, aovs);
    } catch (const SystemRefused& refused) {
        const bool is_full = refused.error_number == ENOSPC || refused.error_number == EDQUOT;
        if (!is_full || !checkpoint_) throw;
        // Measures the image in memory first, to give the checkpoint up only if that helps.
        const MemoryFile memory("raylane picture");
        OutputFile(memory.path(), output.format(), more_encoders).commit(film, options, aovs);
        if (!checkpoint_->give_room(memory.bytes())) throw;
    }
    output.commit(film, options, aovs);
}

void ResumableRendering::finished() {
    if (checkpoint_) checkpoint_->remove();
}

void ResumableRendering::end_if_signalled() {
    stop_on_signal_.reset();
    if (checkpoint_ && StopOnSignal::signal() != 0)
        throw Stopped(StopOnSignal::signal(),
                      "stopped; " + printable(output_, 4096) + " is complete");
}

} // namespace raylane::scenes
