#include "scenes/tool/system.hpp"

#include "scenes/files/errors.hpp"

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

std::size_t read_at(int descriptor, std::int64_t place, std::span<char> bytes) {
    std::size_t have = 0;
    while (have < bytes.size()) {
        const ssize_t count = ::pread(descriptor, bytes.data() + have, bytes.size() - have,
                                      place + static_cast<std::int64_t>(have));
        if (count < 0 && errno == EINTR) continue;
        if (count == 0) errno = 0;
        if (count <= 0) break;
        have += static_cast<std::size_t>(count);
    }
    return have;
}

} // namespace raylane::scenes
