#include "scenes/tool/journal/resumable.hpp"

#include "scenes/errors.hpp"
#include "scenes/export/writers.hpp"
#include "scenes/image/exr.hpp"
#include "scenes/tool/interrupt.hpp"
#include "scenes/tool/memory_file.hpp"
#include "scenes/tool/ranks/ranked_tiles.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace raylane::scenes {

namespace {

bool may_have_journal(const std::string& output) {
    if (output == "-") return false;
    std::error_code unknown;
    if (!std::filesystem::exists(output, unknown)) return true;
    // A link may lead to a stream that happens to be a file.
    const std::string target = std::filesystem::canonical(output, unknown).string();
    return std::filesystem::is_regular_file(output, unknown) && !target.starts_with("/proc/") &&
           std::filesystem::read_symlink(output, unknown).string().find("/dev/") ==
               std::string::npos;
}

} // namespace

ResumableRendering::ResumableRendering(const std::string& output, bool wanted,
                                       const core::Scene& scene, const std::string& fingerprint,
                                       const core::Settings& settings, simd::RenderOptions options,
                                       const std::optional<PicturePart>& part, Verbosity verbosity)
    : output_(output), scene_(scene), settings_(settings), options_(std::move(options)),
      grid_(simd::grid_of(settings, options_)), part_(part), verbosity_(verbosity) {
    if (!wanted || !may_have_journal(output)) return;
    std::string text;
    TextFile settings_text([&](std::string_view piece) { text += piece; });
    write_json_settings(settings_text, settings);
    settings_text.flush();
    text += options_.engine == simd::Engine::vector ? " vector" : " reference";
    text += " --precision " + std::string(core::name_of(options_.precision)) + " --tile " +
            std::to_string(simd::tile_of(settings, options_));
    if (const std::optional<core::Region>& crop = options_.crop)
        for (const int edge : {crop->x0, crop->y0, crop->x1, crop->y1})
            text += " " + std::to_string(edge);
    if (options_.layers) text += " --layers";
    if (part_) text += " --part " + part_->text();
    if (options_.precision != core::Precision::exact)
        text += " --isa " + std::string(simd::name_of(options_.isa));
    journal_ = std::make_unique<Journal>(output, JournalSubject{fingerprint, std::move(text)},
                                         TileRecords(settings, options_));
    say_found();
}

void ResumableRendering::say_found() const {
    const auto say = [&](const std::string& what) {
        if (verbosity_ == Verbosity::quiet) return;
        std::fprintf(stderr, "raylane: %s: %s\n",
                     printable(journal_->path().string(), 4096).c_str(), what.c_str());
    };
    switch (journal_->found()) {
    case Journal::Found::nothing:
        return;
    case Journal::Found::same:
        return say("goes on at " + std::to_string(percent(journal_->found_pixels())) + " %");
    case Journal::Found::other_scene:
        return say("is of another scene, and not gone on with");
    case Journal::Found::other_options:
        return say("is of other options or another version, and not gone on with");
    case Journal::Found::cut_off:
        return say("has been cut off at its beginning, and is not gone on with");
    case Journal::Found::none_of_ours:
        return say("is none of raylane's, so the picture is drawn without a journal");
    case Journal::Found::in_use:
        return say("is in use, so the picture is drawn without a journal");
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

/// Of what is to be drawn.
int ResumableRendering::percent(std::int64_t pixels) const {
    return static_cast<int>(100 * pixels / std::max<std::int64_t>(1, this->pixels()));
}

simd::Rendering ResumableRendering::draw(simd::Progress& progress, Job* job) {
    options_.progress = &progress;
    const bool is_shared = job != nullptr && job->ranks() != nullptr;
    simd::Rendering rendering = is_shared ? draw_among(*job, progress) : draw_alone(progress);
    if (!rendering.complete) stopped();
    if (!journal_) return rendering;
    if (const std::string problem = journal_->problem(); !problem.empty())
        std::fprintf(stderr, "raylane: %s\n", problem.c_str());
    return rendering;
}

simd::Rendering ResumableRendering::draw_alone(simd::Progress& progress) {
    std::atomic<std::int64_t> left_out = 0;
    options_.recall = [&](const simd::TileToFill& tile) {
        if (is_others(grid_.number_of(tile.region))) {
            left_out += tile.region.pixels();
            return true; // it stays black
        }
        return journal_ && journal_->recall(tile);
    };
    if (!journal_) return simd::render(scene_, settings_, options_);
    options_.after_tile = [this](const simd::FinishedTile& tile) { journal_->note(tile); };
    const StopOnSignal stop_on_signal(progress.stop);
    simd::Rendering rendering = simd::render(scene_, settings_, options_);
    drawn_ = progress.pixels - left_out;
    return rendering;
}

simd::Rendering ResumableRendering::draw_among(Job& job, simd::Progress& progress) {
    RankedTiles::Tiles tiles;
    for (std::size_t number = 0; job.is_first() && number < grid_.count(); ++number)
        if (!is_others(number))
            (journal_ && journal_->has(number) ? tiles.to_visit : tiles.to_draw)
                .push_back(static_cast<std::uint32_t>(number));
    progress.pixels = pixels_of_others();
    const StopOnSignal stop_on_signal(progress.stop);
    const TileRecords records(settings_, options_);
    RankedTiles ranked(*job.ranks(), std::move(tiles), records, options_.threads, progress.stop);
    options_.tiles = &ranked;
    options_.recall = [&](const simd::TileToFill& tile) {
        const std::optional<std::string> bytes = ranked.recall(tile);
        if (!bytes) return journal_ && journal_->recall(tile);
        progress.rays += tile.counters.rays();
        if (journal_) journal_->note(grid_.number_of(tile.region), *bytes);
        return true;
    };
    options_.after_tile = [&](const simd::FinishedTile& tile) {
        ranked.note(tile);
        if (journal_) journal_->note(tile);
    };
    simd::Rendering rendering = simd::render(scene_, settings_, options_);
    for (const auto& [number, bytes] : ranked.finish()) {
        if (journal_) journal_->note(number, bytes);
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
    if (!journal_) throw Stopped(signal, done);
    throw Stopped(signal, journal_->keep() ? done + "; the same command goes on with " +
                                                 printable(journal_->path().string(), 4096)
                          : journal_->problem().empty() ? done + ", without a journal to go on with"
                                                        : done + "; " + journal_->problem());
}

void ResumableRendering::write(OutputFile& output, const core::Film& film,
                               const PictureOptions& options, const core::Layers* layers) {
    try {
        return output.commit(film, options, layers);
    } catch (const SystemRefused& refused) {
        const bool is_full = refused.error_number == ENOSPC || refused.error_number == EDQUOT;
        if (!is_full || !journal_) throw;
        // Not before it is known that this helps.
        const MemoryFile memory("raylane picture");
        OutputFile(memory.path(), output.format(), exr_of).commit(film, options, layers);
        if (!journal_->give_room(memory.bytes())) throw;
    }
    output.commit(film, options, layers);
}

void ResumableRendering::finished() {
    if (journal_) journal_->remove();
}

void ResumableRendering::end_if_signalled() const {
    if (journal_ && StopOnSignal::signal() != 0)
        throw Stopped(StopOnSignal::signal(),
                      "stopped, and " + printable(output_, 4096) + " is whole");
}

} // namespace raylane::scenes
