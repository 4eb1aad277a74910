#include "scenes/tool/interrupt.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <stdexcept>
#include <unistd.h>

namespace raylane::scenes {

namespace {

std::array<std::atomic<const char*>, 8> removed{};
static_assert(std::atomic<const char*>::is_always_lock_free, "a signal handler must not wait");

/// Only calls that POSIX lists as safe in a signal handler.
extern "C" void end_process(int signal) {
    for (const auto& slot : removed)
        if (const char* path = slot.load(); path != nullptr) ::unlink(path);
    if (::isatty(STDERR_FILENO) == 1) {
        // The prompt shall not follow a progress bar.
        const auto written = ::write(STDERR_FILENO, "\n", 1);
        static_cast<void>(written);
    }
    ::_exit(128 + signal);
}

void on(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    ::sigfillset(&action.sa_mask);
    ::sigaction(signal, &action, nullptr);
}

/// `nohup` and shells in the background ask for a signal to be ignored.
bool is_ignored(int signal) {
    struct sigaction action {};
    return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

} // namespace

void catch_signals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (!is_ignored(signal)) on(signal, end_process);
    on(SIGPIPE, SIG_IGN);
    on(SIGXFSZ, SIG_IGN);
}

RemovedOnInterrupt::RemovedOnInterrupt(const char* path) : slot_(0) {
    if (*path == '\0') path = nullptr;
    for (auto& slot : removed) {
        const char* none = nullptr;
        if (slot.compare_exchange_strong(none, path)) return;
        ++slot_;
    }
    throw std::logic_error("more than 8 temporaries");
}

RemovedOnInterrupt::~RemovedOnInterrupt() {
    removed[slot_] = nullptr;
}

} // namespace raylane::scenes
