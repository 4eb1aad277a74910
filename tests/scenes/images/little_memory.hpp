#pragma once

#include "scenes/files/errors.hpp"

#include <fstream>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace raylane::tests {

enum class Ended { well, badly, refused_by_the_system, as_bad_input, otherwise };

/// Returns the address space of this process, in MiB.
inline rlim_t used_megabytes() {
    std::ifstream file("/proc/self/statm");
    rlim_t pages = 0;
    file >> pages;
    return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) >> 20;
}

/// Calls `run` in a child process that may have this much more memory, and returns how it ends:
/// well if `run` returns true. Not for sanitizers, which reserve the whole address space.
template <class Run>
Ended within(rlim_t megabytes, const Run& run) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::malloc_trim(0); // other tests leave free memory in the heap
        rlimit limit{};
        ::getrlimit(RLIMIT_AS, &limit);
        limit.rlim_cur = (used_megabytes() + megabytes) << 20;
        ::setrlimit(RLIMIT_AS, &limit);
        Ended ended = Ended::otherwise;
        try {
            ended = run() ? Ended::well : Ended::badly;
        } catch (const scenes::SystemRefused&) {
            ended = Ended::refused_by_the_system;
        } catch (const scenes::BadInput&) {
            ended = Ended::as_bad_input;
        } catch (...) {
        }
        ::_exit(static_cast<int>(ended));
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? static_cast<Ended>(WEXITSTATUS(status)) : Ended::otherwise;
}

} // namespace raylane::tests
