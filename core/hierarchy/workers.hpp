#pragma once

#include <cstddef>
#include <functional>

namespace raylane::core {

/// Runs the tasks of a build. This base class runs them in the caller's thread and reports no
/// progress. A subclass may add threads or progress reports. The result of a build does not depend
/// on it.
class Workers {
  public:
    using Task = std::function<void()>;

    Workers() = default;
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;
    virtual ~Workers() = default;

    /// Calls both, possibly at the same time.
    virtual void both(const Task& one, const Task& other) {
        one();
        other();
    }
    /// Calls task(0) ... task(count - 1), possibly at the same time.
    virtual void each(std::size_t count, const std::function<void(std::size_t)>& task) {
        for (std::size_t i = 0; i < count; ++i)
            task(i);
    }

    /// Reports the number of shapes added to the scene so far. Called every now and then.
    virtual void added(std::size_t count) { static_cast<void>(count); }
    /// Reports that `count` more of the bounded shapes, out of `all`, have a place in the
    /// hierarchy. Called by the thread that placed them.
    virtual void placed(std::size_t count, std::size_t total) {
        static_cast<void>(count);
        static_cast<void>(total);
    }
};

} // namespace raylane::core
