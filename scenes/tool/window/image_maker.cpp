#include "scenes/tool/window/image_maker.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace raylane::scenes {

namespace {

/// The time limit for the first image. Stopping the previous one, and showing this one, may take
/// as long again.
constexpr double soon = 0.02; // seconds

double samples_of(const core::Settings& settings) {
    return static_cast<double>(settings.width) * settings.height * settings.grid * settings.grid;
}

} // namespace

ImageMaker::ImageMaker(core::Scene scene, MakeOverlay make_overlay, simd::RenderOptions options,
                       std::function<void()> on_image)
    : options_(std::move(options)), on_image_(std::move(on_image)), scene_(std::move(scene)),
      make_overlay_(std::move(make_overlay)) {
    options_.progress = &progress_;
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

ImageMaker::~ImageMaker() {
    thread_.request_stop();
    interrupt();
    thread_.join();
}

void ImageMaker::interrupt() {
    const std::lock_guard lock(mutex_);
    is_interrupted_ = true;
    progress_.abandon = true;
}

void ImageMaker::show(core::View view, const core::Settings& settings) {
    const std::lock_guard lock(mutex_);
    is_interrupted_ = true; // together with the wish, or an earlier wish could reset it
    progress_.abandon = true;
    wish_ = {std::move(view), settings};
    wake_.notify_all();
}

void ImageMaker::replace(core::Scene scene, MakeOverlay make_overlay) {
    interrupt();
    const std::lock_guard lock(scene_mutex_);
    scene_ = std::move(scene);
    make_overlay_ = std::move(make_overlay);
}

std::optional<ImageMaker::Image> ImageMaker::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(image_, std::nullopt);
}

void ImageMaker::with_scene(const std::function<void(const core::Scene&)>& use) {
    interrupt();
    const std::lock_guard lock(scene_mutex_);
    use(scene_);
}

void ImageMaker::rethrow() {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
}

void ImageMaker::run(const std::stop_token& stop) {
    try {
        while (true) {
            std::optional<Wish> wish;
            {
                std::unique_lock lock(mutex_);
                if (!wake_.wait(lock, stop, [&] { return wish_.has_value(); })) return;
                wish = std::exchange(wish_, std::nullopt);
                is_interrupted_ = false;
                progress_.abandon = false;
            }
            const std::lock_guard lock(scene_mutex_);
            const core::AutoCamera auto_camera = scene_.auto_camera();
            scene_ = std::move(scene_).seen(auto_camera, wish->view);
            draw(stop, wish->settings);
        }
    } catch (...) {
        const std::lock_guard lock(mutex_);
        failure_ = std::current_exception();
    }
    on_image_();
}

void ImageMaker::draw(const std::stop_token& stop, const core::Settings& settings) {
    constexpr std::array<Level, 7> levels = {
        {{16, 1}, {8, 1}, {4, 1}, {2, 1}, {1, 1}, {1, 2}, {1, 0}}};
    std::size_t level = 0;
    const auto settings_of = [&](const Level& chosen) {
        core::Settings result = settings;
        if (chosen.grid == 0) return result;
        result.quality = 0.0F;
        result.grid = std::min(chosen.grid, std::max(settings.grid, 1));
        result.width = (settings.width + chosen.step - 1) / chosen.step;
        result.height = (settings.height + chosen.step - 1) / chosen.step;
        return result;
    };
    // The first image is the finest one that is expected within this time limit.
    while (seconds_per_sample_ > 0.0 && level + 1 < levels.size() - 1 &&
           samples_of(settings_of(levels[level + 1])) * seconds_per_sample_ < soon)
        ++level;
    const auto overlay = make_overlay_ ? make_overlay_(scene_, settings) : nullptr;
    for (; level < levels.size(); ++level) {
        const bool is_last = level + 1 == levels.size();
        const auto start = std::chrono::steady_clock::now();
        const core::Settings of_level = settings_of(levels[level]);
        simd::Rendering rendering = simd::render(scene_, of_level, options_);
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        {
            const std::lock_guard lock(mutex_);
            if (stop.stop_requested() || is_interrupted_ || !rendering.complete) return;
            if (of_level.quality == 0.0F) seconds_per_sample_ = seconds / samples_of(of_level);
            image_ = Image{std::move(rendering.film), is_last, overlay};
        }
        on_image_();
    }
}

} // namespace raylane::scenes
