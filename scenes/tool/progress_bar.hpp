#pragma once

#include "scenes/tool/verbosity.hpp"
#include "simd/render.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace raylane::scenes {

/// "1.23 M" for 1,234,567.
std::string with_prefix(double value);

/// "12.3 s", "4 min 05 s", "2 h 03 min".
std::string duration_text(double seconds);

double seconds_since(std::chrono::steady_clock::time_point start);

/// "[######..................]  25 %"
std::string bar_text(double done);

/// True if standard error is one that lines can be drawn anew on.
bool is_terminal();

/// One line on standard error that is drawn anew every so often, as long as this lives, and then
/// wiped away. Where there is no terminal it is a line each time, ever more rarely, from ten
/// seconds on (verbose: from one). Quiet: none.
class ProgressLine {
  public:
    /// `text` is called by a thread of its own; the line stays as it is where it returns nothing.
    ProgressLine(Verbosity verbosity, std::function<std::string()> text);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

  private:
    void run(const std::stop_token& stop, std::chrono::milliseconds pause);
    void draw();

    std::function<std::string()> text_;
    bool is_drawn_anew_ = false;
    bool drawn_ = false; // read once the thread has ended
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::jthread thread_; // the last: the others must outlive it
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
    ProgressLine line_; // the last: it asks for the text
};

} // namespace raylane::scenes
