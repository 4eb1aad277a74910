#pragma once

#include <memory>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

namespace raylane::simd {

/// Idle workers, whose memory is allocated only once. Any number of threads may use it at a time.
template <class Worker>
class Pool {
  public:
    /// Holds a worker while it is used: one from the pool or, if the pool is empty, make()'s.
    class Lease {
      public:
        template <class Make>
        Lease(Pool& pool, const Make& make) : pool_(pool) {
            {
                const std::lock_guard lock(pool.mutex_);
                if (!pool.idle_.empty()) {
                    worker_ = std::move(pool.idle_.back());
                    pool.idle_.pop_back();
                }
            }
            if (worker_ == nullptr) worker_ = make();
        }
        ~Lease() {
            const std::lock_guard lock(pool_.mutex_);
            try {
                pool_.idle_.push_back(std::move(worker_));
            } catch (const std::bad_alloc&) { // the worker is not kept
            }
        }
        Lease(const Lease&) = delete;
        Lease& operator=(const Lease&) = delete;

        Worker& operator*() const { return *worker_; }

      private:
        Pool& pool_;
        std::unique_ptr<Worker> worker_;
    };

  private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<Worker>> idle_;
};

} // namespace raylane::simd
