#include "scenes/tool/film_strip_arguments.hpp"

#include "scenes/tool/arguments.hpp"
#include "scenes/tool/output_name.hpp"
#include "scenes/tool/progress_bar.hpp"
#include "simd/threads.hpp"

#include <cstdio>
#include <utility>

namespace raylane::scenes {

namespace {

std::string with_percents_doubled(const std::string& text) {
    std::string result;
    for (const char c : text)
        result.append(c == '%' ? 2 : 1, c);
    return result;
}

} // namespace

std::function<std::string(std::size_t)> picture_names(const std::string& scene,
                                                      const Argument& output, bool is_one) {
    const NumberedName name("--output",
                            output ? file_argument("--output", *output)
                                   : with_percents_doubled(default_output(scene, "")) +
                                         (is_one ? ".png" : "-%05d.png"),
                            !is_one);
    return [=](std::size_t number) {
        std::string file = name(number);
        require_other_than_scene("--output", file, scene);
        return file;
    };
}

std::optional<FilmStrip> film_strip_of(const FrameArguments& frames,
                                       const SceneArguments& scene_arguments,
                                       const std::string& scene, const Argument& output,
                                       int threads, Verbosity verbosity) {
    FilmStrip strip;
    strip.view = scene_arguments.view.change();
    strip.turn = frames.turning();
    strip.fit_to = frames.fit_to();
    const std::optional<FrameRange> range = frames.range();
    auto parameters = scene_arguments.parameters.values(true);
    if (!range && !strip.turn && !scene_arguments.parameters.has_sweep()) return std::nullopt;
    if (range && !parameters.front().empty())
        throw BadInput("--set", "", "goes with a JSON scene, but --frames goes with atoms");

    LoadOptions options = scene_arguments.load_options(true);
    strip.workers = std::make_shared<simd::ParallelWorkers>(threads);
    options.workers = strip.workers.get();
    strip.verbosity = verbosity;
    if (verbosity != Verbosity::quiet)
        options.on_remark = [](const std::string& remark) {
            // Replaces the progress line, which is drawn again afterwards.
            std::fprintf(stderr, is_terminal() ? "\r%s\x1B[K\n" : "%s\n", remark.c_str());
        };
    strip.source = range ? trajectory_of(scene, options, *range)
                         : sweep_of(scene, options, std::move(parameters));
    const std::size_t count = strip.source->count();
    if (strip.turn && count > 1 && count != strip.turn->count)
        refuse_turn(*strip.turn, std::to_string(count));
    strip.name = picture_names(scene, output, frames.is_one());
    strip.overwrites = frames.overwrite || frames.is_one();
    return strip;
}

} // namespace raylane::scenes
