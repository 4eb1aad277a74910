#include "scenes/tool/checkpoint/checkpoint.hpp"

#include "scenes/api/cpp/raylane/version.h"
#include "scenes/files/errors.hpp"
#include "scenes/tool/checkpoint/fingerprint.hpp"
#include "scenes/tool/system.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
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

/// Precedes each tile's bytes. A checksum of both follows them.
struct RecordHead {
    std::uint32_t number;
    std::uint32_t bytes;
};

constexpr std::size_t bytes_around = sizeof(RecordHead) + sizeof(std::uint64_t);

/// Reads a file from start to end, in large blocks.
class Window {
  public:
    explicit Window(int descriptor) : descriptor_(descriptor) {}

    /// Returns `count` bytes from a position on, or fewer at the end of the readable part.
    std::span<const char> at(std::int64_t place, std::size_t count) {
        const bool has_all = place >= start_ && place + static_cast<std::int64_t>(count) <=
                                                    start_ + static_cast<std::int64_t>(have_);
        if (!has_all) {
            if (buffer_.size() < count) buffer_.resize(std::max(count, least));
            start_ = place;
            have_ = read_at(descriptor_, place, buffer_);
            is_refused_ = have_ < buffer_.size() && errno != 0;
        }
        const std::span<const char> from =
            std::span(buffer_).first(have_).subspan(static_cast<std::size_t>(place - start_));
        return from.first(std::min(count, from.size()));
    }
    /// Returns true if the last bytes ended at a read error, not at the end of the file.
    bool is_refused() const { return is_refused_; }

  private:
    static constexpr std::size_t least = std::size_t{1} << 20;

    int descriptor_;
    std::vector<char> buffer_;
    std::int64_t start_ = 0;
    std::size_t have_ = 0;
    bool is_refused_ = false;
};

std::string head_of(const CheckpointSubject& subject) {
    return std::string(magic) + RAYLANE_VERSION "\nscene " + subject.scene + "\noptions " +
           subject.options + "\n\n";
}

/// Returns the bytes from a position on, at most `most`.
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

/// Flushes the folder to the disk, so that the file's name survives a loss of power, too.
void sync_folder_of(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.parent_path();
    const int descriptor =
        ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    static_cast<void>(::fsync(descriptor));
    ::close(descriptor);
}

/// Returns false if another process has locked the file. Without support for locks, returns true.
bool take_lock(int descriptor) {
    int result;
    do {
        result = ::flock(descriptor, LOCK_EX | LOCK_NB);
    } while (result != 0 && errno == EINTR);
    return result == 0 || errno != EWOULDBLOCK;
}

/// Returns the record of a tile. `seed`: that of the checkpoint, which accepts only such records.
std::string record_of(std::size_t number, std::string_view bytes, std::uint64_t seed) {
    const RecordHead head{static_cast<std::uint32_t>(number),
                          static_cast<std::uint32_t>(bytes.size())};
    std::string record(reinterpret_cast<const char*>(&head), sizeof head);
    record += bytes;
    const std::uint64_t checksum = checksum_of(record, seed);
    record.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
    return record;
}

/// Returns true if a record is complete and has the right checksum. `size`: its expected size.
bool is_whole(std::span<const char> record, std::size_t size, std::uint64_t seed) {
    if (record.size() < size) return false;
    const std::span<const char> summed = record.first(size - sizeof(std::uint64_t));
    std::uint64_t checksum;
    std::memcpy(&checksum, summed.data() + summed.size(), sizeof checksum);
    return checksum == checksum_of(summed, seed);
}

constexpr std::string_view ending = ".part";
constexpr std::size_t digits_of_seed = 16;

std::filesystem::path shared_name(const std::filesystem::path& image) {
    return image.string().append(ending);
}

/// Returns the name of a checkpoint if another subject has the output's shared name.
std::filesystem::path own_name(const std::filesystem::path& image, std::uint64_t seed) {
    char digits[digits_of_seed + 1];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(seed));
    return (image.string() + '.' + digits).append(ending);
}

bool is_name_of_checkpoint(std::string_view name, std::string_view image) {
    if (!name.starts_with(image) || !name.ends_with(ending)) return false;
    name.remove_prefix(image.size());
    if (name == ending) return true;
    return name.size() == 1 + digits_of_seed + ending.size() && name.front() == '.' &&
           name.substr(1, digits_of_seed).find_first_not_of("0123456789abcdef") == name.npos;
}

/// Opens a checkpoint. Returns -1 with errno set if that fails.
int open_checkpoint(const std::filesystem::path& path) {
    return ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
}

/// Returns the first bytes of a checkpoint, which may be cut off within the header. Returns nothing
/// if the file is not a checkpoint of this user, because other users may write anything.
std::optional<std::string> head_in(int descriptor, std::size_t most) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode) ||
        status.st_uid != ::geteuid())
        return std::nullopt;
    std::string head = bytes_at(descriptor, 0, most);
    if (!head.starts_with(magic) && !magic.starts_with(head)) return std::nullopt;
    return head;
}

/// Returns false if the file was removed, or if another file has its name.
bool is_at(const std::filesystem::path& path, int descriptor) {
    struct stat own {
    }, there{};
    return ::fstat(descriptor, &own) == 0 && ::lstat(path.c_str(), &there) == 0 &&
           own.st_dev == there.st_dev && own.st_ino == there.st_ino;
}

} // namespace

Checkpoint::Checkpoint(std::filesystem::path image, const CheckpointSubject& subject,
                       TileRecords records, std::function<void(const std::string&)> tell)
    : image_(std::move(image)), records_(records), head_(head_of(subject)),
      seed_(checksum_of(head_, 0)), places_(records_.grid().count(), -1), tell_(std::move(tell)) {
    open();
    if (descriptor_ < 0) next_try_ = start_ + begin_after;
}

Checkpoint::~Checkpoint() {
    {
        const std::lock_guard lock(mutex_);
        is_ending_ = true;
    }
    ends_.notify_all();
    if (keeping_.joinable()) keeping_.join();
    if (descriptor_ >= 0) ::close(descriptor_);
}

/// Opens the checkpoint of this subject under either name, or chooses the name of a new one.
void Checkpoint::open() {
    path_ = found_at_ = own_name(image_, seed_);
    const Found own = look_at(path_);
    const auto is_others = [](Found found) {
        return found == Found::other_scene || found == Found::other_options;
    };
    found_ = is_others(own) ? Found::none_of_ours : own;
    if (own == Found::nothing || own == Found::named_too_long) {
        const std::filesystem::path shared = shared_name(image_);
        const Found found = look_at(shared);
        if (!is_others(found)) path_ = shared;
        if (!is_others(found) || own == Found::nothing) {
            found_ = found;
            found_at_ = shared;
        }
    }
    if (found_ != Found::same) return;
    read_records();
    is_ours_ = true;
}

/// Keeps the file open and locked if it belongs to this subject or was cut off.
Checkpoint::Found Checkpoint::look_at(const std::filesystem::path& path) {
    const int descriptor = open_checkpoint(path);
    if (descriptor < 0)
        return errno == ENOENT         ? Found::nothing
               : errno == ENAMETOOLONG ? Found::named_too_long
                                       : Found::none_of_ours;
    const std::optional<std::string> head = head_in(descriptor, head_.size());
    Found found = head ? kind_of(*head) : Found::none_of_ours;
    if (found == Found::same || found == Found::cut_off) {
        if (!take_lock(descriptor))
            found = Found::in_use;
        else if (!is_at(path, descriptor)) // its process has just removed it
            found = Found::nothing;
    }
    if (found == Found::same || found == Found::cut_off)
        descriptor_ = descriptor;
    else
        ::close(descriptor);
    return found;
}

Checkpoint::Found Checkpoint::kind_of(const std::string& head) const {
    if (head == head_) return Found::same;
    if (head_.starts_with(head)) return Found::cut_off;
    const std::size_t options = head_.find("options ");
    const bool is_of_version = head.starts_with(std::string(magic) + RAYLANE_VERSION "\n");
    const bool is_of_scene = head.compare(0, options, head_, 0, options) == 0;
    return is_of_version && !is_of_scene ? Found::other_scene : Found::other_options;
}

/// Finds the complete records. After a damaged one, whichever of its bytes that is, it searches
/// byte by byte for the next complete record.
void Checkpoint::read_records() {
    std::vector<std::size_t> sizes(places_.size());
    for (std::size_t number = 0; number < sizes.size(); ++number)
        sizes[number] = records_.bytes(number);
    end_ = static_cast<std::int64_t>(head_.size());
    Window window(descriptor_);
    for (std::int64_t place = end_;;) {
        RecordHead head{};
        const std::span<const char> start = window.at(place, sizeof head);
        if (start.size() < sizeof head) break;
        std::memcpy(&head, start.data(), sizeof head);
        const bool is_head = head.number < sizes.size() && head.bytes == sizes[head.number];
        const std::size_t size = is_head ? bytes_around + head.bytes : 0;
        if (!is_head || !is_whole(window.at(place, size), size, seed_)) {
            ++place;
            continue;
        }
        places_[head.number] = place + static_cast<std::int64_t>(sizeof head);
        end_ = place += static_cast<std::int64_t>(size);
    }
    struct stat status {};
    if (window.is_refused() && ::fstat(descriptor_, &status) == 0) {
        end_ = std::max<std::int64_t>(end_, status.st_size); // the rest may be readable later
        return;
    }
    // The rest was being written when its process ended. It does no harm if it stays.
    [[maybe_unused]] const int shortened = ::ftruncate(descriptor_, end_);
}

std::int64_t Checkpoint::found_pixels() const {
    std::int64_t pixels = 0;
    for (std::size_t number = 0; number < places_.size(); ++number)
        if (places_[number] >= 0) pixels += records_.grid().tile(number).pixels();
    return pixels;
}

bool Checkpoint::recall(const simd::TileToFill& tile) {
    const std::size_t number = records_.grid().number_of(tile.region);
    if (places_[number] < 0) return false;
    const std::string bytes = bytes_at(descriptor_, places_[number], records_.bytes(number));
    if (bytes.size() < records_.bytes(number)) return false;
    records_.fill(tile, bytes);
    return true;
}

void Checkpoint::note(const simd::FinishedTile& tile) {
    if (is_left_alone()) return;
    std::string bytes;
    records_.append(tile, bytes);
    note(records_.grid().number_of(tile.region), bytes);
}

void Checkpoint::note(std::size_t number, std::string_view bytes) {
    if (is_left_alone()) return;
    std::string record = record_of(number, bytes, seed_);
    const std::lock_guard lock(mutex_);
    if (is_given_up_) return;
    if (!keeping_.joinable()) try {
            keeping_ = std::thread([this] { keep_up(); });
        } catch (const std::exception&) { // no thread, or no memory for it
        }
    waiting_bytes_ += record.size();
    waiting_.push_back(std::move(record));
    if (std::chrono::steady_clock::now() >= next_try_) write_waiting();
    while (!problem_.empty() && waiting_bytes_ > max_waiting)
        drop_oldest();
}

void Checkpoint::drop_oldest() {
    waiting_bytes_ -= waiting_.front().size();
    waiting_.pop_front();
}

/// Writes as many of the waiting records as the system accepts.
void Checkpoint::write_waiting() {
    if (is_given_up_ || waiting_.empty()) return;
    bool goes_on = is_ours_ || begin();
    if (goes_on && end_ == 0) {
        goes_on = append(head_);
        if (goes_on) static_cast<void>(::fdatasync(descriptor_)); // before any record is written
    }
    while (goes_on && !waiting_.empty()) {
        goes_on = append(waiting_.front());
        if (goes_on) drop_oldest();
    }
    if (goes_on) problem_.clear();
    next_try_ = goes_on ? std::chrono::steady_clock::time_point{}
                        : std::chrono::steady_clock::now() + sync_every;
}

/// Makes the file, with the waiting records, or empties one that was cut off. Returns false, and
/// reports it, if the system refuses.
bool Checkpoint::begin() {
    if (descriptor_ < 0) {
        if (!make()) return false;
        waiting_.clear();
        waiting_bytes_ = 0;
    } else {
        if (::ftruncate(descriptor_, 0) != 0) {
            fail();
            return false;
        }
        end_ = 0;
    }
    is_ours_ = true;
    return true;
}

/// Writes and flushes at intervals. Tiles may be minutes apart, so the last one must not wait until
/// note() is called for the next one.
void Checkpoint::keep_up() {
    std::unique_lock lock(mutex_);
    const auto is_ending = [this] { return is_ending_; };
    bool ends = ends_.wait_until(lock, start_ + begin_after, is_ending);
    while (!ends) {
        write_waiting();
        if (std::exchange(is_to_be_synced_, false) && is_ours_ && !is_given_up_) {
            lock.unlock();
            static_cast<void>(::fdatasync(descriptor_)); // unlocked for other threads
            lock.lock();
        }
        ends = ends_.wait_for(lock, sync_every, is_ending);
    }
}

/// Makes the file. Where the system supports it, the file is complete before it has a name. So a
/// named file is always identifiable and contains the waiting records. It is as private as an
/// existing image. Returns false after an error, which it reports.
bool Checkpoint::make() {
    struct stat image {};
    const bool is_there = ::stat(image_.c_str(), &image) == 0;
    const mode_t mode = is_there ? image.st_mode & 0666 : 0666;
    const std::filesystem::path folder = path_.parent_path();
    std::optional<std::int64_t> end;
    int made = ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
    if (made >= 0) {
        const std::string own = "/proc/self/fd/" + std::to_string(made);
        end = write_all(made);
        const bool done =
            end && ::fsync(made) == 0 && take_lock(made) &&
            ::linkat(AT_FDCWD, own.c_str(), AT_FDCWD, path_.c_str(), AT_SYMLINK_FOLLOW) == 0;
        const int error_number = errno;
        if (!done) ::close(made);
        if (!done && error_number != ENOENT) { // ENOENT: /proc does not exist
            errno = error_number;
            fail();
            return false;
        }
        if (!done) made = -1;
    }
    if (made < 0) {
        made = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        const bool is_taken = made >= 0 && take_lock(made);
        end = is_taken ? write_all(made) : std::nullopt;
        if (!end || ::fsync(made) != 0) {
            fail();
            if (is_taken) ::unlink(path_.c_str());
            if (made >= 0) ::close(made);
            return false;
        }
    }
    descriptor_ = made;
    end_ = *end;
    sync_folder_of(path_);
    return true;
}

/// Writes the header and the waiting records into an empty file. Returns the end of the file, or
/// nothing after an error.
std::optional<std::int64_t> Checkpoint::write_all(int descriptor) const {
    if (!write_at(descriptor, 0, head_)) return std::nullopt;
    auto end = static_cast<std::int64_t>(head_.size());
    for (const std::string& record : waiting_) {
        if (!write_at(descriptor, end, record)) return std::nullopt;
        end += static_cast<std::int64_t>(record.size());
    }
    return end;
}

void Checkpoint::fail() {
    const bool is_others = errno == EEXIST; // made after open() searched for it
    problem_ = is_others ? printable(path_.string(), 4096) +
                               ": is in use by another process, so this process keeps no checkpoint"
                         : SystemRefused(path_.string(), "write", errno).what();
    if (is_others) give_up();
    if (const auto tell = std::exchange(tell_, {})) tell(problem_);
}

/// Stops writing for good.
void Checkpoint::give_up() {
    is_given_up_ = true;
    waiting_.clear();
    waiting_bytes_ = 0;
}

/// Appends all bytes or none. Returns false after an error, which it reports.
bool Checkpoint::append(const std::string& bytes) {
    if (write_at(descriptor_, end_, bytes)) {
        end_ += static_cast<std::int64_t>(bytes.size());
        is_to_be_synced_ = true;
        return true;
    }
    fail();
    [[maybe_unused]] const int shortened =
        ::ftruncate(descriptor_, end_); // removes a partial record
    return false;
}

bool Checkpoint::keep() {
    if (is_left_alone()) return false;
    const std::lock_guard lock(mutex_);
    write_waiting();
    if (is_ours_) static_cast<void>(::fsync(descriptor_));
    return is_ours_ && problem_.empty();
}

bool Checkpoint::give_room(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    struct statvfs disk {};
    struct stat own {};
    if (!is_ours_ || ::fstatvfs(descriptor_, &disk) != 0 || ::fstat(descriptor_, &own) != 0)
        return false;
    constexpr std::uint64_t block = 512; // POSIX counts st_blocks in 512 bytes
    const std::uint64_t room = std::uint64_t{disk.f_bavail} * disk.f_frsize +
                               block * static_cast<std::uint64_t>(own.st_blocks);
    if (room < bytes || ::ftruncate(descriptor_, 0) != 0) return false;
    give_up(); // otherwise the checkpoint would use the space again
    if (problem_.empty()) problem_ = path_.string() + ": was emptied to free space for the image";
    return true;
}

void Checkpoint::remove() {
    const std::lock_guard lock(mutex_);
    give_up(); // otherwise waiting records would make a new file
    if (!is_ours_ && found_ == Found::nothing) return;
    std::error_code unknown;
    const std::filesystem::path target = std::filesystem::canonical(image_, unknown);
    const int written = ::open(target.c_str(), O_RDONLY | O_CLOEXEC);
    const bool is_safe = written >= 0 && (::fsync(written) == 0 || errno == EINVAL);
    if (written >= 0) ::close(written);
    if (!is_safe) return;
    sync_folder_of(target);
    if (is_ours_ && is_at(path_, descriptor_)) ::unlink(path_.c_str());
    remove_others();
}

void Checkpoint::remove_others() const {
    std::error_code end;
    const std::filesystem::path folder = path_.parent_path();
    std::filesystem::directory_iterator file(folder.empty() ? "." : folder, end);
    for (; !end && file != std::filesystem::directory_iterator(); file.increment(end)) {
        if (!is_name_of_checkpoint(file->path().filename().string(), image_.filename().string()))
            continue;
        const int descriptor = open_checkpoint(file->path());
        if (descriptor < 0) continue;
        if (head_in(descriptor, magic.size()) && take_lock(descriptor) &&
            is_at(file->path(), descriptor))
            ::unlink(file->path().c_str());
        ::close(descriptor);
    }
}

std::string Checkpoint::problem() {
    const std::lock_guard lock(mutex_);
    return problem_;
}

} // namespace raylane::scenes
