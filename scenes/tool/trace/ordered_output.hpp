#pragma once

#include "scenes/atomic_file.hpp"

#include <cstddef>
#include <map>
#include <mutex>
#include <string>

namespace raylane::scenes {

/// Pieces of a file, which come in any order and from any thread, and are written in theirs.
class OrderedOutput {
  public:
    explicit OrderedOutput(AtomicFile& file) : file_(file) {}

    /// Throws SystemRefused.
    void add(std::size_t number, std::string bytes) {
        const std::lock_guard lock(mutex_);
        early_.emplace(number, std::move(bytes));
        for (; !early_.empty() && early_.begin()->first == next_; ++next_) {
            file_.write(early_.begin()->second);
            early_.erase(early_.begin());
        }
    }

  private:
    AtomicFile& file_;
    std::mutex mutex_; // of what follows, and the file
    std::size_t next_ = 0;
    std::map<std::size_t, std::string> early_;
};

} // namespace raylane::scenes
