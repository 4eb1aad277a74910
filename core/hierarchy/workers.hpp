#pragma once

#include <cstddef>
#include <functional>

namespace raylane::core {

/// Threads that do the work of a build: here, the caller's alone, and nobody is told how far it is.
/// Whoever has threads, or somebody to tell, overrides this. Nothing that is built depends on it.
class Workers {
  public:
    using Task = std::function<void()>;

    Workers() = default;
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;
    virtual ~Workers() = default;

    /// Calls both, perhaps at the same time.
    virtual void both(const Task& one, const Task& other) {
        one();
        other();
    }
    /// Calls task(0) ... task(count - 1), perhaps at the same time.
    virtual void each(std::size_t count, const std::function<void(std::size_t)>& task) {
        for (std::size_t i = 0; i < count; ++i)
            task(i);
    }

    /// So many shapes have been added to the scene so far. Called every now and then.
    virtual void added(std::size_t count) { static_cast<void>(count); }
    /// `count` more of the bounded shapes, `all` in all, have found their place in the hierarchy.
    /// Called by whatever thread has placed them.
    virtual void placed(std::size_t count, std::size_t all) {
        static_cast<void>(count);
        static_cast<void>(all);
    }
};

} // namespace raylane::core
