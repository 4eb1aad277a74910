#include "scenes/tool/memory_file.hpp"

#include "scenes/errors.hpp"

#include <cerrno>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace raylane::scenes {

MemoryFile::MemoryFile(const char* what) : descriptor_(::memfd_create(what, MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw SystemRefused("a file in memory", "open", errno);
}

MemoryFile::~MemoryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

std::filesystem::path MemoryFile::path() const {
    return "/proc/self/fd/" + std::to_string(descriptor_);
}

std::filesystem::path MemoryFile::path_for_others() const {
    return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(descriptor_);
}

void MemoryFile::become_standard_input() {
    if (::lseek(descriptor_, 0, SEEK_SET) != 0 || ::dup2(descriptor_, STDIN_FILENO) < 0)
        throw SystemRefused("standard input", "keep in memory", errno);
    if (descriptor_ != STDIN_FILENO) ::close(descriptor_); // equal if standard input was closed
    descriptor_ = -1;
}

std::size_t MemoryFile::bytes() const {
    struct stat status {};
    return ::fstat(descriptor_, &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
}

} // namespace raylane::scenes
