#pragma once

#include <cstddef>
#include <functional>

namespace raylane::core {

/// Runs the tasks of a build. This base class runs them in the caller's thread and reports no
/// progress. A subclass may add threads or progress reports. The result of a build depends on
/// node_width() alone.
class Workers {
  public:
    using Task = std::function<void()>;

    explicit Workers(int node_width = 16) : node_width_(node_width) {}
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;
    virtual ~Workers() = default;

    /// Returns the largest number of children that a node of a hierarchy gets, at most 16. It is 16
    /// in hierarchies whose spheres may be packed.
    /// Traversals skip empty registers, so 8 are faster if a register holds 8 or fewer.
    int node_width() const { return node_width_; }

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

  private:
    int node_width_;
};

} // namespace raylane::core
