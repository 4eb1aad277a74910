#include "simd/threads/threads.hpp"

#include "core/shapes/invalid_value.hpp"
#include "simd/threads/default_rounding.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#ifdef RAYLANE_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <list>
#include <mutex>
#include <string>
#include <string_view>

namespace raylane::simd {

int default_threads() {
    const char* told = std::getenv("RAYLANE_THREADS");
    const std::string_view text = told != nullptr ? told : "";
    if (text.empty()) return tbb::info::default_concurrency();
    int threads = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), threads);
    if (error != std::errc() || end != text.data() + text.size() || threads < 1 ||
        threads > max_threads)
        throw core::InvalidValue("RAYLANE_THREADS",
                                 "must be a whole number from 1 to " + std::to_string(max_threads));
    return threads;
}

struct AllowedThreads::Control : tbb::global_control {
    using tbb::global_control::global_control;
};

AllowedThreads::AllowedThreads(int threads)
    : control_(std::make_unique<Control>(
          Control::max_allowed_parallelism,
          std::max<std::size_t>(Control::active_value(Control::max_allowed_parallelism),
                                static_cast<std::size_t>(std::max(threads, 0))))) {}
AllowedThreads::~AllowedThreads() = default;

namespace {

/// An arena that an earlier call has returned, or a new one. oneTBB frees the memory of ended
/// arenas, some 10 kB each, later than short calls would make new ones. All threads of an arena
/// round like the thread that made it.
class LentArena {
  public:
    explicit LentArena(int threads) {
        const std::lock_guard lock(idle_mutex);
        if (idle == nullptr) idle = new std::list<Arena>;
        const auto found = std::ranges::find(*idle, threads, &Arena::threads);
        if (found != idle->end())
            own_.splice(own_.begin(), *idle, found);
        else
            own_.emplace_back(threads).arena.initialize();
    }
    ~LentArena() {
        const std::lock_guard lock(idle_mutex);
        idle->splice(idle->begin(), own_);
        if (idle->size() > max_idle) idle->pop_back();
    }
    LentArena(const LentArena&) = delete;
    LentArena& operator=(const LentArena&) = delete;

    tbb::task_arena& operator*() { return own_.front().arena; }

  private:
    struct Arena {
        explicit Arena(int count) : threads(count), arena(count) {}
        int threads;
        tbb::task_arena arena;
    };
    static constexpr std::size_t max_idle = 64;
    static constinit std::mutex idle_mutex;
    /// Never destroyed: threads that are never joined may call until the process ends.
    static constinit std::list<Arena>* idle;

    std::list<Arena> own_;
};

constinit std::mutex LentArena::idle_mutex;
constinit std::list<LentArena::Arena>* LentArena::idle = nullptr;

} // namespace

void on_threads(int threads, const std::function<void()>& body) {
    const int count = threads > 0 ? threads : default_threads();
    const AllowedThreads allowed(count);
    const DefaultRounding rounding;
    LentArena arena(count);
    (*arena).execute(body);
}

namespace {

/// Reports to the thread sanitizer that tasks run after the code before the fork, and before the
/// code after it.
class Fork {
  public:
    Fork() { release(start_); }
    ~Fork() { acquire(end_); }
    Fork(const Fork&) = delete;
    Fork& operator=(const Fork&) = delete;

    template <class Task, class... Arguments>
    void run(const Task& task, Arguments... arguments) {
        acquire(start_);
        struct End {
            Fork& fork;
            ~End() { release(fork.end_); }
        } const end{*this};
        task(arguments...);
    }

  private:
    static void acquire([[maybe_unused]] char& at) {
#ifdef RAYLANE_THREAD_SANITIZER
        __tsan_acquire(&at);
#endif
    }
    static void release([[maybe_unused]] char& at) {
#ifdef RAYLANE_THREAD_SANITIZER
        __tsan_release(&at);
#endif
    }
    char start_ = 0, end_ = 0;
};

} // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& task) {
    Fork fork;
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { fork.run(task, i); });
}

void parallel_invoke(const std::function<void()>& one, const std::function<void()>& other) {
    Fork fork;
    tbb::parallel_invoke([&] { fork.run(one); }, [&] { fork.run(other); });
}

void isolate(const std::function<void()>& body) {
    tbb::this_task_arena::isolate([&] { body(); });
}

} // namespace raylane::simd
