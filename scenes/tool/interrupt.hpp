#pragma once

/// Ctrl-C and its kin, which may come at any moment: the temporaries are removed and the process
/// ends at once, with 128 + the signal's number.
namespace raylane::scenes {

/// Catches SIGINT, SIGTERM and SIGHUP from now on, and has writes to closed pipes and beyond file
/// size limits fail rather than kill.
void catch_signals();

/// A file for the signal handler to remove, as long as this lives. At most 8 at a time.
class RemovedOnInterrupt {
  public:
    /// `path` must outlive this; "" is no file.
    explicit RemovedOnInterrupt(const char* path);
    ~RemovedOnInterrupt();
    RemovedOnInterrupt(const RemovedOnInterrupt&) = delete;
    RemovedOnInterrupt& operator=(const RemovedOnInterrupt&) = delete;

  private:
    int slot_;
};

} // namespace raylane::scenes
