#include "scenes/tool/exit.hpp"

#include "core/shapes/invalid_value.hpp"
#include "scenes/files/atomic_file.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/tool/checkpoint/resumable.hpp"
#include "scenes/tool/ranks/job.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <exception>
#include <new>
#include <unistd.h>

namespace raylane::scenes {

namespace {

std::atomic<bool> ends_early = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not wait");

// The functions from here to catch_signals() call only functions that POSIX lists as safe in a
// signal handler.

void say(const char* text) {
    const auto written = ::write(STDERR_FILENO, text, std::strlen(text));
    static_cast<void>(written);
}

bool is_shown() {
    return ::isatty(STDERR_FILENO) == 1;
}

std::atomic<const char*> last_words = nullptr;
static_assert(std::atomic<const char*>::is_always_lock_free, "a signal handler must not wait");

extern "C" void end_process(int signal) {
    ends_early = true;
    remove_temporaries();
    if (is_shown()) say("\n"); // the prompt must not follow a progress bar
    if (const char* const line = last_words; line != nullptr) say(line);
    ::_exit(128 + signal);
}

std::atomic<simd::Progress*> stopped = nullptr;
std::atomic<int> stopped_by = 0;
timer_t patience;

extern "C" void stop_first(int signal) {
    simd::Progress* const progress = stopped;
    if (progress == nullptr || stopped_by != 0) return end_process(signal);
    const int before = errno; // the program may be about to read it
    stopped_by = signal;
    progress->stop = true;
    constexpr itimerspec half_a_second{{}, {0, 500'000'000}};
    ::timer_settime(patience, 0, &half_a_second, nullptr);
    if (is_shown()) say("\nraylane: finishing tiles in progress; interrupt again to end at once\n");
    errno = before;
}

extern "C" void abandon(int signal) {
    if (stopped_by == 0) return end_process(signal); // not sent by our timer
    if (simd::Progress* const progress = stopped; progress != nullptr) progress->abandon = true;
}

/// Handles SIGBUS: pages of a mapped file are gone or cannot be read. All threads that read them
/// arrive here; the first one ends the process.
extern "C" void lose_pages(int) {
    static std::atomic_flag is_said;
    while (is_said.test_and_set())
        ::pause();
    ends_early = true;
    remove_temporaries();
    if (is_shown()) say("\n");
    say("raylane: a built scene was truncated while in use, or can no longer be read\n");
    ::_exit(refused);
}

void on(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    ::sigfillset(&action.sa_mask);
    ::sigaction(signal, &action, nullptr);
}

/// Returns true if the signal is ignored from the start, as `nohup` and shells arrange for
/// background jobs.
bool is_ignored(int signal) {
    struct sigaction action {};
    return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

} // namespace

Failure failure_being_handled() {
    try {
        throw;
    } catch (const BadInput& error) {
        return {bad_input, error.what()};
    } catch (const core::InvalidValue& error) {
        return {bad_input, error.what()};
    } catch (const Stopped& stopped) {
        return {128 + stopped.signal, stopped.what()};
    } catch (const RankFailed& failed) {
        return {failed.code, failed.what()};
    } catch (const std::bad_alloc&) {
        return {refused, "not enough memory"};
    } catch (const std::exception& error) {
        return {refused, error.what()};
    }
}

void catch_signals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2})
        if (!is_ignored(signal))
            on(signal, signal == SIGINT || signal == SIGTERM ? stop_first
                       : signal == SIGALRM                   ? abandon
                                                             : end_process);
    on(SIGBUS, lose_pages);
    on(SIGPIPE, SIG_IGN);
    on(SIGXFSZ, SIG_IGN);
}

StopOnSignal::StopOnSignal(simd::Progress& progress) {
    stopped_by = 0;
    ::timer_create(CLOCK_MONOTONIC, nullptr, &patience); // sends SIGALRM
    stopped = &progress;
}

StopOnSignal::~StopOnSignal() {
    stopped = nullptr;
    ::timer_delete(patience);
}

int StopOnSignal::signal() {
    return stopped_by;
}

void say_when_ended(const char* line) {
    last_words = line;
}

bool is_ending() {
    return ends_early;
}

} // namespace raylane::scenes
