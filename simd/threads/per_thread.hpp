#pragma once

#include <functional>
#include <list>
#include <mutex>
#include <thread>
#include <utility>

namespace raylane::simd {

/// Owns one value for each thread that calls local(), made at the first call.
template <class Value>
class PerThread {
  public:
    explicit PerThread(std::function<Value()> make) : make_(std::move(make)) {}

    Value& local() {
        const std::thread::id own = std::this_thread::get_id();
        {
            const std::lock_guard lock(adding_);
            for (Entry& entry : entries_)
                if (entry.thread == own) return entry.value;
        }
        std::list<Entry> made;
        made.emplace_back(own, make_);
        const std::lock_guard lock(adding_);
        entries_.splice(entries_.begin(), made);
        return entries_.front().value;
    }

    /// Visits the values of all threads. To be called when these are done.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (const Entry& entry : entries_)
            visit(entry.value);
    }

  private:
    struct Entry {
        Entry(std::thread::id id, const std::function<Value()>& make) : thread(id), value(make()) {}
        std::thread::id thread;
        Value value; // may be a type that cannot be moved
    };

    std::function<Value()> make_;
    std::mutex adding_;
    std::list<Entry> entries_;
};

} // namespace raylane::simd
