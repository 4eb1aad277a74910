#pragma once

#include "scenes/tool/options/scene_options.hpp"
#include "simd/wavefront/render.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace raylane::scenes {

/// Returns a number with a prefix, such as "1.23 M" for 1,234,567.
std::string with_prefix(double value);

/// Returns a duration such as "12.3 s", "4 min 05 s" or "2 h 03 min".
std::string duration_text(double seconds);

double seconds_since(std::chrono::steady_clock::time_point start);

/// Returns a bar such as "[######..................]  25 %". `done`: from 0 to 1.
std::string bar_text(double done);

/// Returns true if standard error is a terminal on which lines can be redrawn.
bool is_terminal();

/// A line on standard error that is redrawn at short intervals while the object exists, and then
/// erased. Without a terminal, a new line is printed each time, at growing intervals, the first
/// after ten seconds (verbose: one second). Quiet: nothing is printed.
class ProgressLine {
  public:
    /// `text` is called by a separate thread. If it returns an empty text, the line stays as it is.
    ProgressLine(Verbosity verbosity, std::function<std::string()> text);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

  private:
    void run(const std::stop_token& stop, std::chrono::milliseconds pause);
    void draw();

    std::function<std::string()> text_;
    bool is_drawn_anew_ = false;
    bool drawn_ = false; // read after the thread has ended
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::jthread thread_; // last, because it uses the other members
};

/// Progress of a rendering: percentage, rays per second, time left.
class ProgressBar {
  public:
    ProgressBar(Verbosity verbosity, const simd::Progress& progress, std::int64_t pixels);

  private:
    std::string text() const;

    const simd::Progress& progress_;
    std::int64_t pixels_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    ProgressLine line_; // last, because it calls text()
};

} // namespace raylane::scenes
