#include "scenes/tool/read_at.hpp"

#include <cerrno>
#include <unistd.h>

namespace raylane::scenes {

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
