#pragma once

#include "simd/render.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace raylane::scenes {

/// "1.23 M" for 1,234,567.
std::string with_prefix(double value);

/// "12.3 s", "4 min 05 s", "2 h 03 min".
std::string duration_text(double seconds);

/// One line on standard error that shows how far a rendering is, as long as this lives: percentage,
/// rays per second, time left. Shows nothing where standard error is no terminal.
class ProgressBar {
  public:
    ProgressBar(const simd::Progress& progress, std::int64_t pixels);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

  private:
    void run(const std::stop_token& stop);
    void draw() const;

    const simd::Progress& progress_;
    std::int64_t pixels_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::jthread thread_; // the last: the others must outlive it
};

} // namespace raylane::scenes
