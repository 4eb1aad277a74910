#pragma once

#include <cstddef>
#include <filesystem>

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

} // namespace raylane::scenes
