#pragma once

#include "scenes/files/atomic_file.hpp"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// The contents of the header of a file in NumPy's format.
struct NpyHead {
    std::string type; ///< "<f4"
    bool by_columns = false;
    std::vector<std::uint64_t> shape;
};

/// Parses the text of a file's header: a dictionary as a Python literal, with exactly these keys.
/// Throws BadInput.
NpyHead npy_head_of(std::string_view text, const std::string& file);

/// Returns magic, version and header of a file of `count` elements. `type` is a Python literal,
/// such as '<f4' with its quotes.
std::string npy_head(const std::string& type, std::uint64_t count);

/// Rays in a file in NumPy's format: an array (n, 6), also in the form (n, 2, 3), or (n, 8), of
/// float32 or float64, by rows or by columns. A ray has an origin, a direction and, with 8 columns,
/// t_min and t_max. The numbers are used exactly as they are.
class RayFile {
  public:
    /// "-" is standard input from its current position, which must also be a file. Throws BadInput
    /// if the file is malformed, and SystemRefused.
    explicit RayFile(const std::filesystem::path& path);
    ~RayFile();
    RayFile(const RayFile&) = delete;
    RayFile& operator=(const RayFile&) = delete;

    std::uint64_t count() const { return count_; }
    std::size_t columns() const { return columns_; }
    bool has_doubles() const { return has_doubles_; }

    /// Reads rays from `first` on, column by column: columns() arrays of `count` numbers in
    /// sequence. Thread-safe. Throws SystemRefused, and BadInput if the file was truncated
    /// meanwhile.
    template <class Real>
    void read(std::uint64_t first, std::size_t count, std::vector<Real>& numbers) const;

  private:
    void read_head();
    void read_bytes(std::uint64_t place, char* bytes, std::size_t count) const;
    [[noreturn]] void refuse(const std::string& message) const;

    std::string name_;
    int descriptor_ = -1;
    std::uint64_t start_ = 0; // of the numbers, in bytes
    std::uint64_t count_ = 0;
    std::size_t columns_ = 6;
    bool has_doubles_ = false, by_columns_ = false;
};

/// Pieces of a file that arrive in any order and from any thread, and are written in the order of
/// their numbers. Early pieces are kept in memory. There are at most `window` of them if no piece
/// is begun further ahead than wait_for() permits.
class OrderedOutput {
  public:
    OrderedOutput(AtomicFile& file, std::size_t window) : file_(file), window_(window) {}

    /// Waits until a piece is less than a window ahead of the next one to write. Returns false once
    /// cancelled.
    bool wait_for(std::size_t number) {
        std::unique_lock lock(mutex_);
        written_.wait(lock, [&] { return is_cancelled_ || number - next_ < window_; });
        return !is_cancelled_;
    }
    /// Releases all waiting threads, because a piece will never arrive.
    void cancel() {
        const std::lock_guard lock(mutex_);
        is_cancelled_ = true;
        written_.notify_all();
    }
    /// Adds a piece and returns the number of the next one to write. Throws SystemRefused.
    std::size_t add(std::size_t number, std::string bytes) {
        const std::lock_guard lock(mutex_);
        early_.emplace(number, std::move(bytes));
        for (; !early_.empty() && early_.begin()->first == next_; ++next_) {
            file_.write(early_.begin()->second);
            early_.erase(early_.begin());
            written_.notify_all();
        }
        return next_;
    }

  private:
    AtomicFile& file_;
    const std::size_t window_;
    std::mutex mutex_; // protects the members below and the file
    std::condition_variable written_;
    std::size_t next_ = 0;
    std::map<std::size_t, std::string> early_;
    bool is_cancelled_ = false;
};

} // namespace raylane::scenes
