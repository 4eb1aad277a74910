#include "scenes/tool/journal/journal.hpp"

#include "scenes/errors.hpp"
#include "scenes/library/raylane/version.h"
#include "scenes/tool/journal/fingerprint.hpp"
#include "scenes/tool/read_at.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>
#include <utility>

namespace raylane::scenes {

namespace {

constexpr std::string_view magic = "raylane journal ";

/// Before each tile's bytes; a checksum of both is behind them.
struct RecordHead {
    std::uint32_t number;
    std::uint32_t bytes;
};

constexpr std::size_t bytes_around = sizeof(RecordHead) + sizeof(std::uint64_t);

std::string head_of(const JournalSubject& subject) {
    return std::string(magic) + RAYLANE_VERSION "\nscene " + subject.scene + "\noptions " +
           subject.options + "\n\n";
}

/// As many bytes as there are from a place on, at most `most`.
std::string bytes_at(int descriptor, std::int64_t place, std::size_t most) {
    std::string bytes(most, '\0');
    bytes.resize(read_at(descriptor, place, bytes));
    return bytes;
}

bool write_at(int descriptor, std::int64_t place, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::pwrite(descriptor, bytes.data(), bytes.size(), place);
        if (count < 0 && errno != EINTR) return false;
        if (count <= 0) continue;
        bytes.remove_prefix(static_cast<std::size_t>(count));
        place += count;
    }
    return true;
}

/// So that the file's name survives, too.
void sync_folder_of(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.parent_path();
    const int descriptor =
        ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    static_cast<void>(::fsync(descriptor));
    ::close(descriptor);
}

/// False if another process has it. File systems without locks have none for anybody.
bool take_lock(int descriptor) {
    int result;
    do {
        result = ::flock(descriptor, LOCK_EX | LOCK_NB);
    } while (result != 0 && errno == EINTR);
    return result == 0 || errno != EWOULDBLOCK;
}

/// A tile's bytes as the file has them. `seed`: of the journal, whose records alone are read again.
std::string record_of(std::size_t number, std::string_view bytes, std::uint64_t seed) {
    const RecordHead head{static_cast<std::uint32_t>(number),
                          static_cast<std::uint32_t>(bytes.size())};
    std::string record(reinterpret_cast<const char*>(&head), sizeof head);
    record += bytes;
    const std::uint64_t checksum = checksum_of(record, seed);
    record.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
    return record;
}

} // namespace

Journal::Journal(const std::filesystem::path& picture, const JournalSubject& subject,
                 TileRecords records)
    : picture_(picture), path_(picture.string() + ".part"), records_(records),
      head_(head_of(subject)), seed_(checksum_of(head_, 0)), places_(records_.grid().count(), -1) {
    open();
}

Journal::~Journal() {
    {
        const std::lock_guard lock(mutex_);
        is_ending_ = true;
    }
    ends_.notify_all();
    if (keeping_.joinable()) keeping_.join();
    if (descriptor_ >= 0) ::close(descriptor_);
}

/// Looks at what there is of a file, and takes it if it is ours.
void Journal::open() {
    const int descriptor = ::open(path_.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0) {
        // A name that is too long is nobody's: what is said of it is what the system says.
        if (errno != ENOENT && errno != ENAMETOOLONG) found_ = Found::none_of_ours;
        return;
    }
    struct stat status {};
    const bool is_file = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
                         status.st_uid == ::geteuid(); // others may write what they like
    const std::string head = is_file ? bytes_at(descriptor, 0, head_.size()) : "";
    const bool may_be_ours =
        is_file && (head.starts_with(magic) || magic.starts_with(head)); // or cut off in it
    if (!may_be_ours)
        found_ = Found::none_of_ours;
    else if (!take_lock(descriptor))
        found_ = Found::in_use;
    if (found_ != Found::nothing) {
        ::close(descriptor);
        return;
    }
    descriptor_ = descriptor;
    is_ours_ = read(head);
}

/// True if it is of this picture.
bool Journal::read(const std::string& head) {
    if (head == head_) {
        found_ = Found::same;
        end_ = static_cast<std::int64_t>(head_.size());
        for (;;) {
            RecordHead record{};
            const std::string start = bytes_at(descriptor_, end_, sizeof record);
            if (start.size() < sizeof record) break;
            std::memcpy(&record, start.data(), sizeof record);
            if (record.number >= places_.size() || record.bytes != records_.bytes(record.number))
                break;
            const std::string all = bytes_at(descriptor_, end_, bytes_around + record.bytes);
            if (all.size() < bytes_around + record.bytes) break;
            const std::span<const char> summed(all.data(), sizeof record + record.bytes);
            std::uint64_t checksum;
            std::memcpy(&checksum, summed.data() + summed.size(), sizeof checksum);
            // What has been damaged is drawn again; the next ones may be whole.
            if (checksum == checksum_of(summed, seed_))
                places_[record.number] = end_ + static_cast<std::int64_t>(sizeof record);
            end_ += static_cast<std::int64_t>(all.size());
        }
        // What is behind it was being written when its process ended.
        if (::ftruncate(descriptor_, end_) != 0) fail();
        return true;
    }
    if (head_.starts_with(head)) {
        found_ = Found::cut_off;
        return false;
    }
    const std::size_t options = head_.find("options ");
    const bool is_of_version = head.starts_with(std::string(magic) + RAYLANE_VERSION "\n");
    const bool is_of_scene = head.compare(0, options, head_, 0, options) == 0;
    found_ = is_of_version && !is_of_scene ? Found::other_scene : Found::other_options;
    return false;
}

std::int64_t Journal::found_pixels() const {
    std::int64_t pixels = 0;
    for (std::size_t number = 0; number < places_.size(); ++number)
        if (places_[number] >= 0) pixels += records_.grid().tile(number).pixels();
    return pixels;
}

bool Journal::recall(const simd::TileToFill& tile) {
    const std::size_t number = records_.grid().number_of(tile.region);
    if (places_[number] < 0) return false;
    const std::string bytes = bytes_at(descriptor_, places_[number], records_.bytes(number));
    if (bytes.size() < records_.bytes(number)) return false;
    records_.fill(tile, bytes);
    return true;
}

void Journal::note(const simd::FinishedTile& tile) {
    if (is_left_alone()) return;
    std::string bytes;
    records_.append(tile, bytes);
    note(records_.grid().number_of(tile.region), bytes);
}

void Journal::note(std::size_t number, std::string_view bytes) {
    if (is_left_alone()) return;
    const std::string record = record_of(number, bytes, seed_);
    const std::lock_guard lock(mutex_);
    if (!problem_.empty()) return;
    if (!keeping_.joinable()) try {
            keeping_ = std::thread([this] { keep_up(); });
        } catch (const std::exception&) { // no thread, or no memory for it
        }
    if (is_ours_) return write(record);
    waiting_ += record;
    if (std::chrono::steady_clock::now() >= start_ + begin_after) begin();
}

/// Makes the file, or empties it, and writes what has been waiting.
void Journal::begin() {
    if (descriptor_ < 0) {
        is_ours_ = make(head_ + waiting_);
        waiting_.clear();
        return;
    }
    if (::ftruncate(descriptor_, 0) != 0) return fail();
    end_ = 0;
    write(head_);
    static_cast<void>(::fdatasync(descriptor_));
    is_ours_ = true;
    write(std::exchange(waiting_, {}));
}

/// Tiles may be minutes apart: whoever writes the next one is no help to the last.
void Journal::keep_up() {
    std::unique_lock lock(mutex_);
    const auto is_ending = [this] { return is_ending_; };
    bool ends = ends_.wait_until(lock, start_ + begin_after, is_ending);
    while (!ends) {
        if (!is_ours_ && !waiting_.empty() && problem_.empty()) begin();
        if (std::exchange(is_to_be_synced_, false) && is_writable()) {
            lock.unlock();
            static_cast<void>(::fdatasync(descriptor_)); // others may go on
            lock.lock();
        }
        ends = ends_.wait_for(lock, sync_every, is_ending);
    }
}

/// With all in it before it has a name, where the system can do that: so no file is there that is
/// not known for what it is, or that lacks what has been waiting. As private as the picture that is
/// there. False, and that is told, if it cannot be.
bool Journal::make(const std::string& content) {
    struct stat picture {};
    const bool is_there = ::stat(picture_.c_str(), &picture) == 0;
    const mode_t mode = is_there ? picture.st_mode & 0666 : 0666;
    const std::filesystem::path folder = path_.parent_path();
    int made = ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
    if (made >= 0) {
        const std::string own = "/proc/self/fd/" + std::to_string(made);
        const bool done =
            write_at(made, 0, content) && ::fsync(made) == 0 && take_lock(made) &&
            ::linkat(AT_FDCWD, own.c_str(), AT_FDCWD, path_.c_str(), AT_SYMLINK_FOLLOW) == 0;
        const int error_number = errno;
        if (!done) ::close(made);
        if (!done && error_number != ENOENT) { // or else there is no /proc
            errno = error_number;
            fail();
            return false;
        }
        if (!done) made = -1;
    }
    if (made < 0) {
        made = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        const bool is_taken = made >= 0 && take_lock(made);
        if (!is_taken || !write_at(made, 0, content) || ::fsync(made) != 0) {
            fail();
            if (is_taken) ::unlink(path_.c_str());
            if (made >= 0) ::close(made);
            return false;
        }
    }
    descriptor_ = made;
    end_ = static_cast<std::int64_t>(content.size());
    sync_folder_of(path_);
    return true;
}

void Journal::fail() {
    problem_ = errno == EEXIST // since this began
                   ? printable(path_.string(), 4096) +
                         ": is in use by another process, so this one kept none"
                   : SystemRefused(path_.string(), "write", errno).what();
}

/// All of it or nothing.
void Journal::write(const std::string& bytes) {
    if (!problem_.empty()) return;
    if (write_at(descriptor_, end_, bytes)) {
        end_ += static_cast<std::int64_t>(bytes.size());
        is_to_be_synced_ = true;
        return;
    }
    fail();
    [[maybe_unused]] const int shortened =
        ::ftruncate(descriptor_, end_); // or it has half a record
}

bool Journal::keep() {
    if (is_left_alone()) return false;
    const std::lock_guard lock(mutex_);
    if (!is_ours_ && !waiting_.empty()) begin();
    if (is_ours_) static_cast<void>(::fsync(descriptor_));
    return is_writable();
}

bool Journal::give_room(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    struct statvfs disk {};
    struct stat own {};
    if (!is_ours_ || ::fstatvfs(descriptor_, &disk) != 0 || ::fstat(descriptor_, &own) != 0)
        return false;
    constexpr std::uint64_t block = 512; // as POSIX counts
    const std::uint64_t room = std::uint64_t{disk.f_bavail} * disk.f_frsize +
                               block * static_cast<std::uint64_t>(own.st_blocks);
    if (room < bytes || ::ftruncate(descriptor_, 0) != 0) return false;
    if (problem_.empty()) problem_ = path_.string() + ": has given its room to the picture";
    return true;
}

/// Somebody may have put another file in its place.
bool Journal::is_still_there() const {
    struct stat own {
    }, there{};
    return ::fstat(descriptor_, &own) == 0 && ::lstat(path_.c_str(), &there) == 0 &&
           own.st_dev == there.st_dev && own.st_ino == there.st_ino;
}

void Journal::remove() {
    const std::lock_guard lock(mutex_);
    if (!is_ours_ || !is_still_there()) return;
    std::error_code unknown;
    const std::filesystem::path target = std::filesystem::canonical(picture_, unknown);
    const int written = ::open(target.c_str(), O_RDONLY | O_CLOEXEC);
    const bool is_safe = written >= 0 && (::fsync(written) == 0 || errno == EINVAL);
    if (written >= 0) ::close(written);
    if (!is_safe) return;
    sync_folder_of(target);
    ::unlink(path_.c_str());
}

std::string Journal::problem() {
    const std::lock_guard lock(mutex_);
    return problem_;
}

} // namespace raylane::scenes
