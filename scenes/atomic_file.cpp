#include "scenes/atomic_file.hpp"

#include "scenes/errors.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <random>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace raylane::scenes {

namespace {

constexpr std::size_t buffer_size = 64 << 10;
constexpr unsigned permission_bits = 07777;

/// End of a chain of symbolic links, there or not.
std::filesystem::path followed(std::filesystem::path path) {
    constexpr int longest_chain = 40; // as in Linux, which then says ELOOP
    std::error_code no_link;
    for (int i = 0; i < longest_chain; ++i) {
        const std::filesystem::path next = std::filesystem::read_symlink(path, no_link);
        if (no_link) break;
        path = path.parent_path() / next;
    }
    return path;
}

std::string random_suffix() {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
    std::random_device random;
    std::string suffix;
    for (int i = 0; i < 6; ++i)
        suffix += letters[random() % letters.size()];
    return suffix;
}

/// The temporaries that there are. More than so many at a time are left to their owners.
std::array<std::atomic<const char*>, 16> temporaries{};
static_assert(std::atomic<const char*>::is_always_lock_free, "a signal handler must not wait");

void replace_known(const char* old_path, const char* new_path) {
    for (auto& slot : temporaries) {
        const char* expected = old_path;
        if (slot.compare_exchange_strong(expected, new_path)) return;
    }
}

/// Keeps signals from this thread as long as it lives.
class SignalsHeld {
  public:
    SignalsHeld() {
        sigset_t all;
        ::sigfillset(&all);
        ::pthread_sigmask(SIG_BLOCK, &all, &before_);
    }
    ~SignalsHeld() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    SignalsHeld(const SignalsHeld&) = delete;
    SignalsHeld& operator=(const SignalsHeld&) = delete;

  private:
    sigset_t before_;
};

} // namespace

void remove_temporaries() noexcept {
    for (const auto& slot : temporaries)
        if (const char* path = slot.load(); path != nullptr) ::unlink(path);
}

AtomicFile::AtomicFile(const std::filesystem::path& path)
    : name_(path.string()), target_(followed(path)) {
    buffer_.reserve(buffer_size);
    struct stat status {};
    const bool exists = ::stat(path.c_str(), &status) == 0;
    if (!exists && errno != ENOENT) refuse(errno);
    if (exists && S_ISDIR(status.st_mode)) refuse(EISDIR);
    if (exists && !S_ISREG(status.st_mode)) {
        descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0) refuse(errno);
        return;
    }
    if (!exists) {
        open_temporary(0666);
        return;
    }
    // Renaming would replace a file that its owner protected.
    if (::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0) refuse(errno);
    const unsigned mode = status.st_mode & permission_bits;
    open_temporary(mode);
    // Gives back what the umask took. A file system without permissions may refuse; so be it.
    static_cast<void>(::fchmod(descriptor_, mode));
}

AtomicFile::~AtomicFile() {
    discard_temporary();
    if (descriptor_ >= 0) ::close(descriptor_);
}

void AtomicFile::reserve(std::int64_t bytes) {
    if (temporary_.empty()) return;
    // Claiming room beyond the size does not ask for the limit of the size.
    rlimit limit{};
    if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && static_cast<rlim_t>(bytes) > limit.rlim_cur)
        refuse(EFBIG);
    int result;
    do {
        result = ::fallocate(descriptor_, FALLOC_FL_KEEP_SIZE, 0, bytes);
    } while (result != 0 && errno == EINTR);
    if (result != 0 && (errno == ENOSPC || errno == EFBIG || errno == EDQUOT)) refuse(errno);
}

void AtomicFile::write(std::span<const char> bytes) {
    while (!bytes.empty()) {
        const auto part = bytes.first(std::min(bytes.size(), buffer_size - buffer_.size()));
        buffer_.insert(buffer_.end(), part.begin(), part.end());
        if (buffer_.size() == buffer_size) flush();
        bytes = bytes.subspan(part.size());
    }
}

void AtomicFile::commit() {
    flush();
    // Some file systems say only now that there is no room.
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) refuse(errno);
    if (temporary_.empty()) return;
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) refuse(errno);
    replace_known(temporary_.c_str(), nullptr);
    temporary_.clear();
}

void AtomicFile::open_temporary(unsigned mode) {
    // A name of the greatest length has no room for more.
    constexpr std::size_t longest_part = 200;
    std::string name = ".";
    name.append(target_.filename().string(), 0, longest_part).append(".");
    const std::string start = target_.parent_path() / name;
    while (true) {
        temporary_ = start + random_suffix();
        const SignalsHeld until_known;
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (descriptor_ >= 0) return replace_known(nullptr, temporary_.c_str());
        const int error_number = errno;
        temporary_.clear(); // of somebody else, or nothing
        if (error_number != EEXIST) refuse(error_number);
    }
}

void AtomicFile::discard_temporary() {
    if (temporary_.empty()) return;
    ::unlink(temporary_.c_str());
    replace_known(temporary_.c_str(), nullptr);
    temporary_.clear();
}

void AtomicFile::flush() {
    for (std::size_t done = 0; done < buffer_.size();) {
        const ssize_t count = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
        if (count < 0 && errno != EINTR) refuse(errno);
        if (count > 0) done += static_cast<std::size_t>(count);
    }
    buffer_.clear();
}

void AtomicFile::refuse(int error_number) const {
    throw SystemRefused(name_, "write", error_number);
}

} // namespace raylane::scenes
