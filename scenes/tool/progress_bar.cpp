#include "scenes/tool/progress_bar.hpp"

#include "scenes/tool/exit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace raylane::scenes {

namespace {

std::string formatted(const char* format, auto... values) {
    char text[128];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

} // namespace

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string with_prefix(double value) {
    if (value >= 1e9) return formatted("%.2f G", value / 1e9);
    if (value >= 1e6) return formatted("%.2f M", value / 1e6);
    if (value >= 1e3) return formatted("%.1f k", value / 1e3);
    return formatted("%.0f ", value);
}

std::string duration_text(double seconds) {
    if (seconds < 59.95) return formatted("%.1f s", seconds);
    const auto rounded = static_cast<long long>(std::llround(seconds));
    if (rounded < 3600) return formatted("%lld min %02lld s", rounded / 60, rounded % 60);
    return formatted("%lld h %02lld min", rounded / 3600, rounded / 60 % 60);
}

std::string bar_text(double done) {
    constexpr int cells = 24;
    std::string bar(cells, '.');
    std::fill_n(bar.begin(), static_cast<int>(done * cells), '#');
    return formatted("[%s] %3d %%", bar.c_str(), static_cast<int>(done * 100.0));
}

bool is_terminal() {
    const char* kind = std::getenv("TERM");
    return ::isatty(STDERR_FILENO) == 1 && (kind == nullptr || std::string_view(kind) != "dumb");
}

ProgressLine::ProgressLine(Verbosity verbosity, std::function<std::string()> text)
    : text_(std::move(text)), is_drawn_anew_(is_terminal()) {
    using std::chrono_literals::operator""ms;
    if (verbosity == Verbosity::quiet) return;
    const std::chrono::milliseconds pause = is_drawn_anew_                    ? 100ms
                                            : verbosity == Verbosity::verbose ? 1'000ms
                                                                              : 10'000ms;
    thread_ = std::jthread([this, pause](const std::stop_token& stop) { run(stop, pause); });
}

ProgressLine::~ProgressLine() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
    if (drawn_ && is_drawn_anew_) std::fputs("\r\x1B[K", stderr);
}

void ProgressLine::run(const std::stop_token& stop, std::chrono::milliseconds pause) {
    constexpr std::chrono::milliseconds longest = std::chrono::minutes(10);
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, stop, pause, [] { return false; }) && !stop.stop_requested()) {
        draw();
        if (!is_drawn_anew_) pause = std::min(2 * pause, longest);
    }
}

void ProgressLine::draw() {
    const std::string text = text_();
    if (text.empty() || is_ending()) return;
    drawn_ = true;
    std::fprintf(stderr, is_drawn_anew_ ? "\r%s\x1B[K" : "%s\n", text.c_str());
    std::fflush(stderr);
}

ProgressBar::ProgressBar(Verbosity verbosity, const simd::Progress& progress, std::int64_t pixels)
    : progress_(progress), pixels_(pixels), line_(verbosity, [this] { return text(); }) {}

std::string ProgressBar::text() const {
    const double seconds = seconds_since(start_);
    const std::int64_t done = progress_.pixels, drawn = done - progress_.recalled;
    const auto left = static_cast<double>(pixels_ - done);
    return bar_text(static_cast<double>(done) / static_cast<double>(pixels_)) + "  " +
           with_prefix(static_cast<double>(progress_.rays) / seconds) + "rays/s  " +
           (drawn > 0 ? duration_text(seconds_since(progress_.first_tile) * left /
                                      static_cast<double>(drawn)) +
                            " left"
                      : "");
}

} // namespace raylane::scenes
