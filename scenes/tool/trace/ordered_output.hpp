#pragma once

#include "scenes/atomic_file.hpp"

#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>

namespace raylane::scenes {

/// Pieces of a file, which come in any order and from any thread, and are written in theirs. Those
/// that come early are kept: no more than a window of them, if no piece is begun that is so far
/// ahead.
class OrderedOutput {
  public:
    OrderedOutput(AtomicFile& file, std::size_t window) : file_(file), window_(window) {}

    /// Until a piece is less than a window ahead of the next to be written. False once cancelled.
    bool wait_for(std::size_t number) {
        std::unique_lock lock(mutex_);
        written_.wait(lock, [&] { return is_cancelled_ || number - next_ < window_; });
        return !is_cancelled_;
    }
    /// No thread is to wait any more: a piece will never come.
    void cancel() {
        const std::lock_guard lock(mutex_);
        is_cancelled_ = true;
        written_.notify_all();
    }
    /// Returns the next to be written then. Throws SystemRefused.
    std::size_t add(std::size_t number, std::string bytes) {
        const std::lock_guard lock(mutex_);
        early_.emplace(number, std::move(bytes));
        for (; !early_.empty() && early_.begin()->first == next_; ++next_) {
            file_.write(early_.begin()->second);
            early_.erase(early_.begin());
            written_.notify_all();
        }
        return next_;
    }

  private:
    AtomicFile& file_;
    const std::size_t window_;
    std::mutex mutex_; // of what follows, and the file
    std::condition_variable written_;
    std::size_t next_ = 0;
    std::map<std::size_t, std::string> early_;
    bool is_cancelled_ = false;
};

} // namespace raylane::scenes
