#include "scenes/tool/journal/resumable.hpp"

#include "scenes/errors.hpp"
#include "scenes/tool/interrupt.hpp"

#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>

namespace raylane::scenes {

namespace {

bool may_have_journal(const std::string& output) {
    if (output == "-") return false;
    std::error_code unknown;
    return !std::filesystem::exists(output, unknown) ||
           std::filesystem::is_regular_file(output, unknown);
}

int percent(std::int64_t pixels, const core::Settings& settings,
            const simd::RenderOptions& options) {
    const std::int64_t all = simd::drawn_part(settings, options.crop).pixels();
    return static_cast<int>(100 * pixels / all);
}

} // namespace

ResumableRendering::ResumableRendering(const std::string& output, bool wanted,
                                       const core::Scene& scene, const std::string& fingerprint,
                                       const core::Settings& settings, simd::RenderOptions options,
                                       const std::string& options_text, Verbosity verbosity)
    : output_(output), scene_(scene), settings_(settings), options_(std::move(options)),
      verbosity_(verbosity) {
    if (!wanted || !may_have_journal(output)) return;
    std::string text =
        options_text + " --tile " + std::to_string(simd::tile_of(settings, options_));
    text += settings.samples == core::SamplePattern::regular ? " regular" : " stratified";
    if (options_.precision != core::Precision::exact)
        text += " --isa " + std::string(simd::name_of(options_.isa));
    journal_ =
        std::make_unique<Journal>(output + ".part", JournalSubject{fingerprint, std::move(text)},
                                  TileRecords(settings, options_));
    say_found(settings);
}

void ResumableRendering::say_found(const core::Settings& settings) const {
    const auto say = [&](const std::string& what) {
        if (verbosity_ == Verbosity::quiet) return;
        std::fprintf(stderr, "raylane: %s: %s\n",
                     printable(journal_->path().string(), 4096).c_str(), what.c_str());
    };
    switch (journal_->found()) {
    case Journal::Found::nothing:
        return;
    case Journal::Found::same:
        return say("goes on at " +
                   std::to_string(percent(journal_->found_pixels(), settings, options_)) + " %");
    case Journal::Found::other_scene:
        return say("is of another scene, and begun anew");
    case Journal::Found::other_options:
        return say("is of other options or another version, and begun anew");
    case Journal::Found::none_of_ours:
        return say("is none of raylane's, so the picture is drawn without a journal");
    case Journal::Found::in_use:
        return say("is in use, so the picture is drawn without a journal");
    }
}

simd::Rendering ResumableRendering::draw(simd::Progress& progress) {
    options_.progress = &progress;
    if (!journal_) return simd::render(scene_, settings_, options_);
    options_.recall = [this](const simd::TileToFill& tile) { return journal_->recall(tile); };
    options_.after_tile = [this](const simd::FinishedTile& tile) { journal_->note(tile); };
    std::optional<StopOnSignal> stop_on_signal(progress.stop);
    simd::Rendering rendering = simd::render(scene_, settings_, options_);
    if (rendering.complete) {
        if (const std::string problem = journal_->problem(); !problem.empty())
            std::fprintf(stderr, "raylane: %s\n", problem.c_str());
        return rendering;
    }
    const std::string done =
        "stopped at " + std::to_string(percent(progress.pixels, settings_, options_)) + " %";
    throw Stopped(StopOnSignal::signal(),
                  journal_->keep() ? done + "; the same command goes on with " +
                                         printable(journal_->path().string(), 4096)
                  : journal_->problem().empty() ? done + ", without a journal to go on with"
                                                : done + "; " + journal_->problem());
}

void ResumableRendering::finished() {
    if (journal_) journal_->replace_by(output_);
}

} // namespace raylane::scenes
