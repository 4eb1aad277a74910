#include "scenes/tool/memory_file.hpp"

#include "scenes/errors.hpp"

#include <cerrno>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace raylane::scenes {

MemoryFile::MemoryFile() : descriptor_(::memfd_create("raylane picture", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw SystemRefused("a file in memory", "open", errno);
}

MemoryFile::~MemoryFile() {
    ::close(descriptor_);
}

std::filesystem::path MemoryFile::path() const {
    return "/proc/self/fd/" + std::to_string(descriptor_);
}

std::size_t MemoryFile::bytes() const {
    struct stat status {};
    return ::fstat(descriptor_, &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
}

} // namespace raylane::scenes
