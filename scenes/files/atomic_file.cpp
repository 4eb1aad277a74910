#include "scenes/files/atomic_file.hpp"

#include "scenes/files/errors.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <fcntl.h>
#include <optional>
#include <random>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace raylane::scenes {

namespace {

constexpr std::size_t buffer_size = 64 << 10;
constexpr unsigned permission_bits = 07777;

/// Returns the descriptor of this process that a path such as /dev/stdout names, if any.
std::optional<int> own_descriptor(const std::filesystem::path& path) {
    std::error_code unknown;
    const std::string folder =
        std::filesystem::canonical(std::filesystem::absolute(path, unknown).parent_path(), unknown)
            .string();
    const std::string own = "/proc/" + std::to_string(::getpid()) + "/";
    if (!folder.starts_with(own) || !folder.ends_with("/fd")) return std::nullopt;
    const std::string name = path.filename().string();
    int descriptor = -1;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), descriptor);
    if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
    return descriptor;
}

struct Target {
    std::filesystem::path path;
    std::optional<int> descriptor; // if the file is already open
};

/// Returns the end of a chain of symbolic links, whether or not that file exists.
Target followed(std::filesystem::path path) {
    if (path == "-") return {path, STDOUT_FILENO};
    constexpr int longest_chain = 40; // Linux's own limit, beyond which it reports ELOOP
    std::error_code no_link;
    for (int i = 0; i < longest_chain; ++i) {
        if (const std::optional<int> descriptor = own_descriptor(path)) return {path, descriptor};
        const std::filesystem::path next = std::filesystem::read_symlink(path, no_link);
        if (no_link) break;
        path = path.parent_path() / next;
    }
    return {path, std::nullopt};
}

/// Gives a file the owner and mode of another one. Returns false if the owner cannot be changed.
bool take_over(int descriptor, const struct stat& from) {
    struct stat made {};
    if (::fstat(descriptor, &made) != 0) return false;
    if ((made.st_uid != from.st_uid || made.st_gid != from.st_gid) &&
        ::fchown(descriptor, from.st_uid, from.st_gid) != 0)
        return false;
    // Restores the permission bits that the umask removed. Errors are ignored, because file systems
    // without permissions may refuse.
    static_cast<void>(::fchmod(descriptor, from.st_mode & permission_bits));
    return true;
}

/// Writes all bytes. Returns false with errno set if that fails.
bool write_all(int descriptor, std::span<const char> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR) return false;
        if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return true;
}

std::string random_suffix() {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
    std::random_device random;
    std::string suffix;
    for (int i = 0; i < 6; ++i)
        suffix += letters[random() % letters.size()];
    return suffix;
}

/// Names of the temporary files that exist now. With more than 16, the signal handler misses the
/// rest, and only their AtomicFiles remove them.
std::array<std::atomic<const char*>, 16> temporaries{};
static_assert(std::atomic<const char*>::is_always_lock_free, "a signal handler must not wait");

void replace_known(const char* old_path, const char* new_path) {
    for (auto& slot : temporaries) {
        const char* expected = old_path;
        if (slot.compare_exchange_strong(expected, new_path)) return;
    }
}

/// Blocks all signals for the calling thread during the object's lifetime.
class SignalsHeld {
  public:
    SignalsHeld() {
        sigset_t signals;
        ::sigfillset(&signals);
        ::pthread_sigmask(SIG_BLOCK, &signals, &before_);
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

AtomicFile::AtomicFile(const std::filesystem::path& path, Temporary temporary)
    : name_(path == "-" ? "standard output" : path.string()) {
    buffer_.reserve(buffer_size);
    Target target = followed(path);
    target_ = std::move(target.path);
    if (target.descriptor) {
        open_existing(*target.descriptor);
        return;
    }
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
        open_temporary(0666, temporary);
        return;
    }
    // Renaming would replace even a write-protected file.
    if (::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0) refuse(errno);
    open_temporary(status.st_mode & permission_bits, temporary);
    keeps_target_ = !take_over(descriptor_, status);
}

AtomicFile::~AtomicFile() {
    discard_temporary();
    if (descriptor_ >= 0) ::close(descriptor_);
}

void AtomicFile::reserve(std::int64_t bytes) {
    if (!has_temporary()) return;
    // fallocate with FALLOC_FL_KEEP_SIZE does not check the limit on the file size.
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

bool AtomicFile::restart() {
    buffer_.clear();
    return has_temporary() && ::ftruncate(descriptor_, 0) == 0 &&
           ::lseek(descriptor_, 0, SEEK_SET) == 0;
}

void AtomicFile::commit() {
    flush();
    if (durable_ && has_temporary() && ::fdatasync(descriptor_) != 0 && errno != EINVAL)
        refuse(errno);
    if (keeps_target_) {
        copy_temporary();
        discard_temporary();
    } else if (unnamed_) {
        const std::string path = "/proc/self/fd/" + std::to_string(descriptor_);
        if (make_temporary([&](const char* name) {
                return ::linkat(AT_FDCWD, path.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW);
            }) < 0)
            refuse(errno);
    }
    // Some file systems report only on close that the disk is full.
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) refuse(errno);
    if (temporary_.empty()) return;
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) refuse(errno);
    replace_known(temporary_.c_str(), nullptr);
    temporary_.clear();
}

void AtomicFile::open_existing(int descriptor) {
    const int flags = ::fcntl(descriptor, F_GETFL);
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) refuse(EBADF);
    // Duplicates the descriptor, so that this copy can be closed. Both share one position in the
    // file.
    descriptor_ = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    if (descriptor_ < 0) refuse(errno);
}

void AtomicFile::copy_temporary() const {
    const std::string path = unnamed_ ? "/proc/self/fd/" + std::to_string(descriptor_) : temporary_;
    const int from = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (from < 0) refuse(errno);
    const int to = ::open(target_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
    int error_number = to < 0 ? errno : 0;
    std::vector<char> part(buffer_size);
    while (error_number == 0) {
        const ssize_t count = ::read(from, part.data(), part.size());
        if (count == 0) break;
        if (count < 0 && errno == EINTR) continue;
        if (count < 0 || !write_all(to, std::span(part).first(static_cast<std::size_t>(count))))
            error_number = errno;
    }
    ::close(from);
    if (to >= 0 && ::close(to) != 0 && error_number == 0) error_number = errno;
    if (error_number != 0) refuse(error_number);
}

/// Opens an unnamed temporary file. Returns false if the system or the file system does not support
/// these, or could not name the file later.
bool AtomicFile::open_unnamed(unsigned mode) {
#ifdef O_TMPFILE
    if (::access("/proc/self/fd", X_OK) != 0) return false;
    const std::filesystem::path folder = target_.parent_path();
    descriptor_ =
        ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
    unnamed_ = descriptor_ >= 0;
#else
    static_cast<void>(mode);
#endif
    return unnamed_;
}

void AtomicFile::open_temporary(unsigned mode, Temporary temporary) {
    if (temporary == Temporary::unnamed_if_possible && open_unnamed(mode)) return;
    descriptor_ = make_temporary([mode](const char* name) {
        return ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    });
    if (descriptor_ < 0) refuse(errno);
}

/// Calls make(name) with random names until one is not taken, and returns its result. make returns
/// a negative number on failure.
template <class Make>
int AtomicFile::make_temporary(const Make& make) {
    // A file name of the maximum length leaves no space for the prefix and the suffix.
    constexpr std::size_t longest_part = 200;
    std::string name = ".";
    name.append(target_.filename().string(), 0, longest_part).append(".");
    const std::string start = target_.parent_path() / name;
    while (true) {
        temporary_ = start + random_suffix();
        const SignalsHeld until_known;
        if (const int made = make(temporary_.c_str()); made >= 0) {
            replace_known(nullptr, temporary_.c_str());
            unnamed_ = false;
            return made;
        }
        const int error_number = errno;
        temporary_.clear(); // the name belongs to another file, or to none
        errno = error_number;
        if (error_number != EEXIST) return -1;
    }
}

void AtomicFile::discard_temporary() {
    unnamed_ = false;
    if (temporary_.empty()) return;
    ::unlink(temporary_.c_str());
    replace_known(temporary_.c_str(), nullptr);
    temporary_.clear();
}

void AtomicFile::flush() {
    if (!write_all(descriptor_, buffer_)) refuse(errno);
    buffer_.clear();
}

void AtomicFile::refuse(int error_number) const {
    throw SystemRefused(name_, "write", error_number);
}

} // namespace raylane::scenes
