#pragma once

#include "scenes/atomic_file.hpp"

#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>

namespace raylane::scenes {

/// Pieces of a file that arrive in any order and from any thread, and are written in the order of
/// their numbers. Early pieces are kept in memory. There are at most `window` of them if no piece
/// is begun further ahead than wait_for() permits.
class OrderedOutput {
  public:
    OrderedOutput(AtomicFile& file, std::size_t window) : file_(file), window_(window) {}

    /// Waits until a piece is less than a window ahead of the next one to write. Returns false once
    /// cancelled.
    bool wait_for(std::size_t number) {
        std::unique_lock lock(mutex_);
        written_.wait(lock, [&] { return is_cancelled_ || number - next_ < window_; });
        return !is_cancelled_;
    }
    /// Releases all waiting threads, because a piece will never arrive.
    void cancel() {
        const std::lock_guard lock(mutex_);
        is_cancelled_ = true;
        written_.notify_all();
    }
    /// Adds a piece and returns the number of the next one to write. Throws SystemRefused.
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
    std::mutex mutex_; // protects the members below and the file
    std::condition_variable written_;
    std::size_t next_ = 0;
    std::map<std::size_t, std::string> early_;
    bool is_cancelled_ = false;
};

} // namespace raylane::scenes
