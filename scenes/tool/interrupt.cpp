#include "scenes/tool/interrupt.hpp"

#include "scenes/atomic_file.hpp"

#include <atomic>
#include <csignal>
#include <unistd.h>

namespace raylane::scenes {

namespace {

std::atomic<bool> ending = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not wait");

/// Only calls that POSIX lists as safe in a signal handler.
extern "C" void end_process(int signal) {
    ending = true;
    remove_temporaries();
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
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2})
        if (!is_ignored(signal)) on(signal, end_process);
    on(SIGPIPE, SIG_IGN);
    on(SIGXFSZ, SIG_IGN);
}

bool is_ending() {
    return ending;
}

} // namespace raylane::scenes
