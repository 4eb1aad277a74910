#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

/// Services of the operating system.
namespace raylane::scenes {

/// A file in memory, for data that is written and read again. It exists as long as the object.
/// Functions throw SystemRefused.
class MemoryFile {
  public:
    /// `what` is the name that /proc shows to users.
    explicit MemoryFile(const char* what);
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    /// Returns a path for AtomicFile and InputFile in this process.
    std::filesystem::path path() const;
    /// Returns a path for other processes of the same user, valid as long as the object exists.
    std::filesystem::path path_for_others() const;
    /// Makes the file standard input, read from its start. The object must not be used afterwards.
    void become_standard_input();
    std::size_t bytes() const;

  private:
    int descriptor_;
};

/// Fills `bytes` from a position in a file on, as far as the file goes, and returns the number of
/// bytes. If there are fewer, errno is 0 at the end of the file, otherwise the system's error.
/// Thread-safe.
std::size_t read_at(int descriptor, std::int64_t place, std::span<char> bytes);

} // namespace raylane::scenes
