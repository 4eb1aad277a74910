#pragma once

#include "simd/render.hpp"

/// Ctrl-C and its kin, which may come at any moment.
namespace raylane::scenes {

/// Makes SIGINT, SIGTERM, SIGHUP and all others that come from outside to end a process, from now
/// on, remove the temporaries and end it at once, with 128 + the signal's number; and writes to
/// closed pipes and beyond file size limits fail rather than kill. What is mapped and then is no
/// longer there ends a process as what the system refuses does.
void catch_signals();

/// While it lives, the first SIGINT or SIGTERM stops a rendering instead of the process: no tile is
/// begun any more, and after half a second those under way are abandoned. The second signal ends
/// the process. There may be one object at a time.
class StopOnSignal {
  public:
    explicit StopOnSignal(simd::Progress& progress);
    ~StopOnSignal();
    StopOnSignal(const StopOnSignal&) = delete;
    StopOnSignal& operator=(const StopOnSignal&) = delete;

    /// The one that has come; 0: none.
    static int signal();
};

/// What a signal that ends the process at once says from now on: a line, which stays where it is.
/// Null: nothing.
void say_when_ended(const char* line);

/// True if a signal is ending the process at this moment, in another thread: nothing shall be shown
/// any more.
bool is_ending();

} // namespace raylane::scenes
