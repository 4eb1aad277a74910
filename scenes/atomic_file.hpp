#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace raylane::scenes {

/// A file that appears whole or not at all: written to a temporary beside it, which takes its name
/// when all went well, and has none before where the system can do that: then nothing is left of it
/// however the process ends. What is no regular file (a pipe, a device), or open already ("-",
/// standard output; /dev/stdout, /proc/self/fd/3), is written directly, from where it stands.
///
/// All that can be known is checked at construction, so before the work whose result is to be
/// written. Functions throw SystemRefused; the temporary is gone when the object is, and a signal
/// handler can remove it by remove_temporaries().
class AtomicFile {
  public:
    /// Whether its temporary has a name from the start, as it must where the system has no files
    /// without one (on some network file systems, say).
    enum class Temporary : std::uint8_t { unnamed_if_possible, named };

    /// A symbolic link is followed: what it leads to is replaced, and keeps its permissions and
    /// owner. Where they can only be kept by not replacing it, it is overwritten in commit().
    explicit AtomicFile(const std::filesystem::path& path,
                        Temporary temporary = Temporary::unnamed_if_possible);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Name as the user wrote it, for messages.
    const std::string& name() const { return name_; }
    /// Claims room on the disk, where the file system can tell.
    void reserve(std::int64_t bytes);
    void write(std::span<const char> bytes);
    /// Throws away what has been written. False where that cannot be (a pipe).
    bool restart();
    /// It is to survive a loss of power as soon as it has its name: takes milliseconds.
    void be_durable() { durable_ = true; }
    /// Once, at the end.
    void commit();

  private:
    void open_existing(int descriptor);
    void open_temporary(unsigned mode, Temporary temporary);
    bool open_unnamed(unsigned mode);
    template <class Make>
    int make_temporary(const Make& make);
    bool has_temporary() const { return unnamed_ || !temporary_.empty(); }
    void copy_temporary() const;
    void discard_temporary();
    void flush();
    [[noreturn]] void refuse(int error_number) const;

    std::string name_;
    std::filesystem::path target_;
    std::string temporary_;     // its name, once it has one
    bool unnamed_ = false;      // it has none; where there is none at all, the target is written
    bool keeps_target_ = false; // its content alone is replaced
    bool durable_ = false;
    int descriptor_ = -1;
    std::vector<char> buffer_;
};

/// Removes the temporaries of all files that this process is writing, for it is about to end. May
/// be called by a signal handler.
void remove_temporaries() noexcept;

} // namespace raylane::scenes
