#pragma once

#include <memory>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

namespace raylane::simd {

/// Workers that nobody uses now: their memory is made once. May be used by any number of threads at
/// a time.
template <class Worker>
class Pool {
  public:
    /// A worker as long as it is used: one from the pool or, if there is none, make()'s.
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
            } catch (const std::bad_alloc&) { // one less to keep
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
