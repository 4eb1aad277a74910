#pragma once

#include <cstddef>
#include <filesystem>

namespace raylane::scenes {

/// A file in memory, which goes with it: for what is written to be read again. Throws
/// SystemRefused.
class MemoryFile {
  public:
    /// `what` is for who looks at the process.
    explicit MemoryFile(const char* what);
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    /// For AtomicFile and InputFile, here.
    std::filesystem::path path() const;
    /// For the same user's other processes, as long as this one has it.
    std::filesystem::path path_for_others() const;
    /// From its start, and without this object, which is of no more use.
    void become_standard_input();
    std::size_t bytes() const;

  private:
    int descriptor_;
};

} // namespace raylane::scenes
