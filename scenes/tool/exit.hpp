#pragma once

#include "simd/wavefront/render.hpp"

#include <string_view>

/// The ends of the program: exit codes, messages of exceptions, and signals such as Ctrl-C, which
/// may arrive at any moment.
namespace raylane::scenes {

/// Exit codes of the program.
enum ExitCode { done = 0, bad_input = 2, refused = 3 };

/// The message for an exception, one line per error, and the exit code of the program.
struct Failure {
    int code; ///< an ExitCode, or 128 + the number of the signal that stopped the program
    std::string_view text;
};

/// Describes the exception that is being handled. The text is valid until the handler ends.
/// Allocates no memory, because memory may have run out.
Failure failure_being_handled();

/// Installs the signal handlers. SIGINT, SIGTERM, SIGHUP and the other signals from outside that
/// end a process then remove the temporary files and end it at once, with exit code 128 + the
/// signal's number. Writes to closed pipes and beyond the limit on file sizes fail instead of
/// killing the process. If a mapped file loses its pages, the process ends with the exit code
/// `refused`.
void catch_signals();

/// While an object exists, the first SIGINT or SIGTERM stops a rendering instead of the process: no
/// new tile is begun, and after half a second the tiles in progress are abandoned. The second
/// signal ends the process. Only one object may exist at a time.
class StopOnSignal {
  public:
    explicit StopOnSignal(simd::Progress& progress);
    ~StopOnSignal();
    StopOnSignal(const StopOnSignal&) = delete;
    StopOnSignal& operator=(const StopOnSignal&) = delete;

    /// Returns the signal that has arrived, or 0.
    static int signal();
};

/// Sets a line to print when a signal ends the process at once; null: none. `line` must remain
/// valid.
void say_when_ended(const char* line);

/// Returns true if a signal is ending the process at this moment, in another thread. Then nothing
/// may be shown any more.
bool is_ending();

} // namespace raylane::scenes
