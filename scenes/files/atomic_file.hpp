#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace raylane::scenes {

/// A file that appears complete or not at all. It is written to a temporary file in the same
/// folder, which takes the final name on success. Where the system supports it, the temporary file
/// has no name until then, so nothing is left of it however the process ends. Targets that are not
/// regular files (pipes, devices), and files that are already open ("-" for standard output,
/// /dev/stdout, /proc/self/fd/3), are written directly, from their current position.
///
/// The constructor makes all checks that are possible before the work whose result is written.
/// Functions throw SystemRefused. The destructor removes the temporary file; a signal handler can
/// remove it by remove_temporaries().
class AtomicFile {
  public:
    /// Whether the temporary file has a name from the start. It always has one where the system
    /// cannot create unnamed files (on some network file systems, for example).
    enum class Temporary : std::uint8_t { unnamed_if_possible, named };

    /// Follows symbolic links: the file that a link leads to is replaced, and keeps its permissions
    /// and owner. If these can be kept only without replacing the file, commit() overwrites it.
    explicit AtomicFile(const std::filesystem::path& path,
                        Temporary temporary = Temporary::unnamed_if_possible);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Returns the name as the user wrote it, for messages.
    const std::string& name() const { return name_; }
    /// Reserves disk space, where the file system supports that.
    void reserve(std::int64_t bytes);
    void write(std::span<const char> bytes);
    /// Discards everything written so far. Returns false if that is impossible (a pipe).
    bool restart();
    /// Makes commit() flush the file to the disk before it gets its name, so that it survives a
    /// loss of power. This takes milliseconds.
    void be_durable() { durable_ = true; }
    /// Completes the file. Call it once, at the end.
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
    bool unnamed_ = false;      // it has no name yet; without any temporary, the target is written
    bool keeps_target_ = false; // only the content of the target is replaced
    bool durable_ = false;
    int descriptor_ = -1;
    std::vector<char> buffer_;
};

/// Removes the temporary files of all AtomicFiles of this process, which is about to end. A signal
/// handler may call this.
void remove_temporaries() noexcept;

} // namespace raylane::scenes
