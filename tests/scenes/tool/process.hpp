#pragma once

#include "tests/scenes/files/temporary_directory.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace raylane::tests {

/// Outcome of a run of a program.
struct Outcome {
    int code;         ///< the exit code, or 128 + the number of the signal that killed it
    bool exited;      ///< true if no signal killed it
    std::string out;  ///< text on standard output
    std::string err;  ///< text on standard error
    long peak_memory; ///< MiB
};

/// Setup in which a program is started.
struct Setup {
    std::filesystem::path directory = "."; ///< working directory
    bool terminal = false;                 ///< true if standard error is a terminal
    std::string out;                       ///< a file to be standard output; "" for Outcome::out
    std::function<void()> in_child;        ///< called before the start: limits, users, signals
};

/// Owns a running process of the raylane tool.
class Process {
  public:
    Process(const std::vector<std::string>& arguments, const Setup& setup);
    /// Kills the process if it still runs.
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void send(int signal) const;
    /// Waits until the process has written a text on standard error. Returns false if it ends
    /// without the text, and after ten minutes.
    bool wait_for_err(std::string_view text);
    /// Waits for a text that the process writes from now on.
    bool wait_for_further_err(std::string_view text);
    /// Returns true if the main thread waits in open(2), as for the other end of a named pipe.
    bool waits_in_open() const;
    /// Returns how many files without a name the process has open in a directory.
    int unnamed_files_in(const std::filesystem::path& directory) const;
    /// Reads the output until the process ends. Kills it after ten minutes.
    Outcome wait();

  private:
    bool collect(std::chrono::steady_clock::time_point end, std::string_view expected,
                 std::size_t from = 0);

    pid_t child_ = -1;
    int out_ = -1, err_ = -1; // the reading ends of its output
    std::string out_text_, err_text_;
};

/// Holds a process at a call of the C library: see held_call.c.
class Hold {
  public:
    /// Holds at the `count`-th call, counted from 1.
    Hold(const std::string& call, int count);
    ~Hold() { release(); }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

    /// Returns the setup of a process that is to be held.
    Setup in(Setup setup) const;
    /// Waits until the process is at the call. Returns false after ten minutes.
    bool wait() const;
    /// Lets the process go on.
    void release();

  private:
    TemporaryDirectory directory_;
    std::string text_;
    int pipe_ = -1;
};

inline Outcome run(const std::vector<std::string>& arguments, const Setup& setup) {
    return Process(arguments, setup).wait();
}

} // namespace raylane::tests
