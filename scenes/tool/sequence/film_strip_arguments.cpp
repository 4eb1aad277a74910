#include "scenes/tool/sequence/film_strip_arguments.hpp"

#include "scenes/number.hpp"
#include "scenes/tool/options/files.hpp"
#include "scenes/tool/progress_bar.hpp"
#include "simd/threads.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace raylane::scenes {

namespace {

/// The names of several files, made from a pattern with one number, such as "frame-%05d.png". "%%"
/// stands for one %.
class NumberedName {
  public:
    /// Throws BadInput with the option's name if the pattern is malformed. `needs_number`: false if
    /// a pattern without a number is acceptable, for a single file.
    NumberedName(const std::string& option, const std::string& pattern, bool needs_number);
    std::string operator()(std::size_t number) const;

  private:
    std::string before_, behind_;
    bool has_number_ = false;
    std::size_t width_ = 0;
    char fill_ = ' ';
};

NumberedName::NumberedName(const std::string& option, const std::string& pattern,
                           bool needs_number) {
    const auto refuse = [&] {
        throw BadInput(
            option, "",
            "must have one placeholder for the image number, such as %05d, and %% for a %, got \"" +
                printable(pattern, 4096) + "\"");
    };
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        std::string& part = has_number_ ? behind_ : before_;
        if (pattern[i] != '%') {
            part += pattern[i];
            continue;
        }
        if (++i < pattern.size() && pattern[i] == '%') {
            part += '%';
            continue;
        }
        const std::size_t end = pattern.find_first_not_of("0123456789", i);
        if (has_number_ || end == std::string::npos || pattern[end] != 'd' || end - i > 2) refuse();
        has_number_ = true;
        if (end > i) {
            fill_ = pattern[i] == '0' ? '0' : ' ';
            width_ = static_cast<std::size_t>(*to_int(pattern.substr(i, end - i)));
        }
        i = end;
    }
    if (needs_number && !has_number_) refuse();
}

std::string NumberedName::operator()(std::size_t number) const {
    if (!has_number_) return before_;
    const std::string digits = std::to_string(number);
    const std::size_t missing = width_ - std::min(width_, digits.size());
    return before_ + std::string(missing, fill_) + digits + behind_;
}

std::string with_percents_doubled(const std::string& text) {
    std::string result;
    for (const char c : text)
        result.append(c == '%' ? 2 : 1, c);
    return result;
}

} // namespace

std::function<std::string(std::size_t)>
picture_names(const std::string& scene, const std::optional<std::string>& output, bool is_one) {
    const std::string standard =
        with_percents_doubled(default_output(scene, "")) + (is_one ? ".png" : "-%05d.png");
    const NumberedName name("--output", output.value_or(standard), !is_one);
    return [=](std::size_t number) {
        std::string file = name(number);
        require_other_than_scene("--output", file, scene);
        return file;
    };
}

std::optional<FilmStrip> film_strip_of(const RenderArguments& arguments, int threads,
                                       Verbosity verbosity) {
    const FrameArguments& frames = arguments.frames;
    const ParameterArguments& parameters = arguments.scene_arguments.parameters;
    const std::optional<FrameRange>& range = frames.frames.value();
    if (!range && !frames.turn && !parameters.has_sweep()) return std::nullopt;
    if (range && !(*parameters.set).empty())
        throw BadInput("--set", "", "goes with a JSON scene, but --frames goes with atoms");

    FilmStrip strip;
    strip.view = arguments.scene_arguments.view.change();
    strip.turn = frames.turn.value();
    strip.fit_to = *frames.camera_from;
    LoadOptions options = arguments.scene_arguments.load_options();
    strip.workers = std::make_shared<simd::ParallelWorkers>(threads);
    options.workers = strip.workers.get();
    strip.verbosity = verbosity;
    if (verbosity != Verbosity::quiet)
        options.on_remark = [](const std::string& remark) {
            // Replaces the progress line, which is drawn again afterwards.
            std::fprintf(stderr, is_terminal() ? "\r%s\x1B[K\n" : "%s\n", remark.c_str());
        };
    strip.source = range ? trajectory_of(*arguments.scene, options, *range)
                         : sweep_of(*arguments.scene, options, parameters.values());
    const std::size_t count = strip.source->count();
    if (strip.turn && count > 1 && count != strip.turn->count)
        refuse_turn(*strip.turn, std::to_string(count));
    strip.name = picture_names(*arguments.scene, arguments.output.value(), frames.is_one());
    strip.overwrites = frames.overwrite || frames.is_one();
    strip.settings = [&](const core::Settings& own) { return arguments.settings_of(own); };
    return strip;
}

} // namespace raylane::scenes
