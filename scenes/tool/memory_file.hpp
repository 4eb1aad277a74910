#pragma once

#include <cstddef>
#include <filesystem>

namespace raylane::scenes {

/// A file in memory, which goes with it: for what is written to be read again. Throws
/// SystemRefused.
class MemoryFile {
  public:
    MemoryFile();
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::filesystem::path path() const;
    std::size_t bytes() const;

  private:
    int descriptor_;
};

} // namespace raylane::scenes
