#include "scenes/tool/sequence/frame_sequence.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/tool/options/option.hpp"
#include "scenes/tool/progress_bar.hpp"
#include "simd/threads/threads.hpp"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <future>
#include <utility>

namespace raylane::scenes {

namespace {

[[noreturn]] void refuse_none() {
    throw BadInput("--frames", "", "must select at least one frame, got none");
}

/// An image of the sequence.
struct Frame {
    std::size_t place, number;
    std::string name;
    std::optional<core::Scene> scene;     ///< empty if the file exists already
    std::shared_ptr<const Legend> legend; ///< of the scene
};

/// Makes the scenes one after the other, each with its camera.
class Stage {
  public:
    explicit Stage(const FrameSequence& sequence) : sequence_(sequence), change_(sequence.view) {
        change_.turning = sequence.turn.has_value();
        if (sequence.fit_to == FitTo::all && sequence.source->count() != 1) fit_to_all();
    }

    /// Returns true if there is only one scene, around which the camera may turn.
    bool is_still() const { return sequence_.source->count() == 1; }
    std::size_t count() const {
        return is_still() && sequence_.turn ? sequence_.turn->count : sequence_.source->count();
    }

    /// Returns true if there were any images, including those of other processes.
    bool has_any() const { return made_ > 0; }

    /// Returns the first image, and the meaning of its shapes, unless `legend` is null.
    SequenceFrame first(Legend* legend) {
        const std::optional<std::size_t> number = sequence_.source->next();
        if (!number) refuse_none();
        const std::size_t shown = is_still() && sequence_.turn ? 0 : *number;
        return {scene(made_++, legend), shown, sequence_.name(shown)};
    }

    std::optional<Frame> next() {
        for (;;) {
            if (sequence_.only && made_ > *sequence_.only) return std::nullopt;
            if (is_still() && made_ > 0) {
                if (made_ >= count()) return std::nullopt;
                number_ = made_;
            } else {
                const std::optional<std::size_t> number = sequence_.source->next();
                if (!number) {
                    if (made_ > 0) require_turn_of(made_);
                    return std::nullopt;
                }
                number_ = *number;
            }
            const std::size_t place = made_++;
            // The source may not know the number of images before its end.
            if (sequence_.turn && made_ > sequence_.turn->count)
                refuse_turn(*sequence_.turn, "at least " + std::to_string(made_));
            const bool is_ours = sequence_.only
                                     ? place == *sequence_.only
                                     : place % sequence_.share.of == sequence_.share.number;
            const std::size_t number = is_still() && sequence_.turn ? place : number_;
            Frame image{place, number, sequence_.name(number), std::nullopt, legend_};
            if (is_ours && is_wanted(image.name)) {
                image.scene = scene_with_legend(place);
                image.legend = legend_;
            }
            // The view of the first image fixes that of the others, so its scene is needed in any
            // case.
            else if (place == 0 && sequence_.fit_to == FitTo::first && !is_still())
                static_cast<void>(scene(place, nullptr));
            if (is_ours) return image;
        }
    }

    /// Takes back a scene that has been rendered. If it is the only scene, the next image reuses
    /// it.
    void take_back(core::Scene scene) {
        if (is_still()) still_ = std::move(scene);
    }

  private:
    void require_turn_of(std::size_t count) const {
        if (sequence_.turn && sequence_.turn->count != count)
            refuse_turn(*sequence_.turn, std::to_string(count));
    }

    /// Returns true if the image must be rendered. A loss of power may leave an empty file, which
    /// does not count.
    bool is_wanted(const std::string& name) const {
        std::error_code unknown;
        return sequence_.overwrites || !std::filesystem::is_regular_file(name, unknown) ||
               std::filesystem::file_size(name, unknown) == 0;
    }

    /// Returns a scene. Sets `legend_` if the sequence wants legends, except for a scene that is
    /// used again.
    core::Scene scene_with_legend(std::size_t place) {
        if (!sequence_.wants_legends || still_) return scene(place, nullptr);
        const auto legend = std::make_shared<Legend>();
        core::Scene result = scene(place, legend.get());
        legend_ = legend;
        return result;
    }

    core::Scene scene(std::size_t place, Legend* legend) {
        core::Scene scene =
            still_ ? *std::exchange(still_, std::nullopt) : sequence_.source->scene(legend);
        if (place == 0 && sequence_.fit_to == FitTo::first) sequence_.source->keep_scale();
        if (!is_still() || !is_set_up_) {
            const core::Settings settings = sequence_.settings(scene.settings());
            scene = seen(std::move(scene), change_, settings, frame_);
            // Scenes with an explicit camera keep it (below).
            if (!is_set_up_ && (is_still() || sequence_.fit_to != FitTo::each))
                fixed_ = view_of(scene);
            is_set_up_ = true;
        }
        const core::AutoCamera auto_camera = scene.auto_camera();
        core::View view = view_of(scene);
        if (fixed_ && (auto_camera.fit_camera || is_still())) {
            const core::Fog own = view.fog;
            view = *fixed_;
            if (!(auto_camera.depth_cue > 0.0F)) view.fog = own;
        }
        if (sequence_.turn) {
            const core::Vec3f up =
                auto_camera.fit_camera ? auto_camera.fit_camera->up : view.camera.up;
            view = core::turned(view, up,
                                sequence_.turn->degrees * static_cast<double>(place) /
                                    static_cast<double>(sequence_.turn->count));
        }
        return std::move(scene).seen(auto_camera, view);
    }

    /// Reads all scenes once to find the frame that contains their shapes.
    void fit_to_all() {
        std::atomic<std::size_t> count = 0;
        const ProgressLine line(sequence_.verbosity,
                                [&] { return std::to_string(count) + " frames surveyed"; });
        for (; sequence_.source->next(); ++count) {
            const core::Scene scene = sequence_.source->scene(nullptr);
            core::Camera camera = scene.camera();
            const core::AutoCamera auto_camera = change_.auto_camera(scene, camera);
            if (auto_camera.fit_camera) {
                if (!frame_)
                    frame_ =
                        core::empty_frame(scene, auto_camera, sequence_.settings(scene.settings()));
                core::include_shapes(scene, *frame_);
            }
        }
        if (count > 0) require_turn_of(count);
        sequence_.source->keep_scale();
        sequence_.source->rewind();
    }

    const FrameSequence& sequence_;
    ViewChange change_;
    std::optional<core::Frame> frame_; // contains the shapes of all scenes
    std::optional<core::View> fixed_;
    std::optional<core::Scene> still_;
    std::shared_ptr<const Legend> legend_ = std::make_shared<Legend>(); // of the last scene
    bool is_set_up_ = false;
    std::size_t made_ = 0, number_ = 0;
};

/// Progress over all images. Another thread may read it.
class StripProgress {
  public:
    explicit StripProgress(std::size_t count) : count_(count) {}

    simd::Progress& of_image(const core::Settings& settings) {
        rays_ += progress_.rays.exchange(0);
        progress_.pixels = 0;
        pixels_ = std::int64_t{settings.width} * settings.height;
        return progress_;
    }
    void drawn() { ++drawn_; }
    void kept() { ++kept_; }
    std::size_t kept_count() const { return kept_; }

    std::string text() const {
        const double seconds = seconds_since(start_);
        const std::size_t done = drawn_ + kept_;
        const std::string rate =
            with_prefix(static_cast<double>(rays_ + progress_.rays) / seconds) + "rays/s";
        if (count_ == 0) return "image " + std::to_string(done + 1) + "  " + rate;
        const double part =
            std::min(1.0, static_cast<double>(progress_.pixels) / static_cast<double>(pixels_));
        const double drawn = static_cast<double>(drawn_) + (done < count_ ? part : 0.0);
        const double left = static_cast<double>(count_ - std::min(count_, done)) - part;
        return bar_text(std::min(1.0, (static_cast<double>(kept_) + drawn) /
                                          static_cast<double>(count_))) +
               "  image " + std::to_string(std::min(done + 1, count_)) + " of " +
               std::to_string(count_) + "  " + rate + "  " +
               (drawn > 0.0 ? duration_text(seconds * std::max(0.0, left) / drawn) + " left" : "");
    }

  private:
    std::size_t count_;
    simd::Progress progress_;
    std::atomic<std::uint64_t> rays_ = 0;
    std::atomic<std::int64_t> pixels_ = 1;
    std::atomic<std::size_t> drawn_ = 0, kept_ = 0;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The names of several files, made from a pattern with one number, such as "frame-%05d.png". "%%"
/// stands for one %.
class NumberedName {
  public:
    /// See numbered_names().
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

void refuse_turn(const Turn& turn, const std::string& otherwise) {
    throw BadInput("--turn", "",
                   "must have as many images as the sequence, " + otherwise + ", got " +
                       std::to_string(turn.count));
}

SequenceFrame first_frame(const FrameSequence& sequence, Legend* legend) {
    const auto start = std::chrono::steady_clock::now();
    const ProgressLine line(sequence.verbosity, [start] {
        return "reading the frame: " + duration_text(seconds_since(start));
    });
    return Stage(sequence).first(legend);
}

void draw(const FrameSequence& sequence) {
    Stage stage(sequence);
    const auto [number, of] = sequence.share;
    StripProgress progress((stage.count() + of - 1 - number) / of);
    const auto start = std::chrono::steady_clock::now();
    std::size_t images = 0;
    {
        const ProgressLine line(sequence.verbosity, [&] { return progress.text(); });
        const auto make_next = [&] { return stage.next(); };
        std::optional<Frame> image = stage.next();
        while (image) {
            ++images;
            std::future<std::optional<Frame>> next;
            // If there is only one scene, the next image reuses it after this one is rendered.
            if (!stage.is_still()) next = std::async(std::launch::async, make_next);
            if (image->scene) {
                sequence.draw(
                    {*image->scene, *image->legend, image->place, image->number, image->name},
                    progress.of_image(sequence.settings(image->scene->settings())));
                progress.drawn();
                stage.take_back(*std::move(image->scene));
            } else {
                progress.kept();
            }
            image = next.valid() ? next.get() : stage.next();
        }
    }
    if (!stage.has_any()) refuse_none();
    const std::size_t kept = progress.kept_count();
    if (sequence.verbosity == Verbosity::verbose ||
        (sequence.verbosity == Verbosity::normal && is_terminal()))
        std::fprintf(stderr, "%zu images rendered in %s\n", images - kept,
                     duration_text(seconds_since(start)).c_str());
    if (kept > 0 && sequence.verbosity != Verbosity::quiet)
        std::fprintf(stderr, "%zu of %zu images exist already; --overwrite renders them again\n",
                     kept, images);
}

std::function<std::string(std::size_t)>
numbered_names(const std::string& option, const std::string& pattern, bool needs_number) {
    return NumberedName(option, pattern, needs_number);
}

std::function<std::string(std::size_t)>
image_names(const std::string& scene, const std::optional<std::string>& output, bool is_one) {
    const std::string standard =
        with_percents_doubled(default_output(scene, "")) + (is_one ? ".png" : "-%05d.png");
    const NumberedName name("--output", output.value_or(standard), !is_one);
    return [=](std::size_t number) {
        std::string file = name(number);
        require_other_than_scene("--output", file, scene);
        return file;
    };
}

std::optional<FrameSequence> requested_sequence(const RenderArguments& arguments, int threads,
                                                Verbosity verbosity) {
    const FrameArguments& frames = arguments.frames;
    const ParameterArguments& parameters = arguments.scene_arguments.parameters;
    const std::optional<FrameRange>& range = frames.frames.value();
    if (!range && !frames.turn && !parameters.has_sweep()) return std::nullopt;
    if (range && !(*parameters.set).empty())
        throw BadInput("--set", "", "goes with a JSON scene, but --frames goes with atoms");

    FrameSequence sequence;
    sequence.view = arguments.scene_arguments.view.change();
    sequence.turn = frames.turn.value();
    sequence.fit_to = *frames.camera_from;
    LoadOptions options = arguments.scene_arguments.load_options();
    sequence.workers = std::make_shared<simd::ParallelWorkers>(
        threads, arguments.isa ? simd::node_width_of(*arguments.isa) : simd::node_width());
    options.workers = sequence.workers.get();
    sequence.verbosity = verbosity;
    if (verbosity != Verbosity::quiet)
        options.on_remark = [](const std::string& remark) {
            // Replaces the progress line, which is drawn again afterwards.
            std::fprintf(stderr, is_terminal() ? "\r%s\x1B[K\n" : "%s\n", remark.c_str());
        };
    if (range) options.frames = *range;
    sequence.source = range ? trajectory_of(*arguments.scene, options)
                            : sweep_of(*arguments.scene, options, parameters.values());
    const std::size_t count = sequence.source->count();
    if (sequence.turn && count > 1 && count != sequence.turn->count)
        refuse_turn(*sequence.turn, std::to_string(count));
    sequence.name = image_names(*arguments.scene, arguments.output.value(), frames.is_one());
    sequence.overwrites = frames.overwrite || frames.is_one();
    sequence.settings = [&](const core::Settings& own) { return arguments.settings_of(own); };
    return sequence;
}

} // namespace raylane::scenes
