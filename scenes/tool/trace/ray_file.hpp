#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// What the head of a file in NumPy's format says.
struct NpyHead {
    std::string type; ///< "<f4"
    bool by_columns = false;
    std::vector<std::uint64_t> shape;
};

/// Of the text of a file's head: a dictionary, as a literal of Python's, of these keys alone.
/// Throws BadInput.
NpyHead npy_head_of(std::string_view text, const std::string& file);

/// Magic, version and head of a file of `count` elements of a type, such as '<f4' (with its
/// quotes).
std::string npy_head(const std::string& type, std::uint64_t count);

/// Rays in a file of NumPy's: an array (n, 6), which may be said as (n, 2, 3), or (n, 8), of
/// float32 or float64, by rows or by columns. Each is origin, direction and, with 8 columns, t_min
/// and t_max. The numbers are taken for exactly these.
class RayFile {
  public:
    /// "-" is standard input, from where it stands: a file, too. Throws BadInput if it is none, and
    /// SystemRefused.
    explicit RayFile(const std::filesystem::path& path);
    ~RayFile();
    RayFile(const RayFile&) = delete;
    RayFile& operator=(const RayFile&) = delete;

    std::uint64_t count() const { return count_; }
    std::size_t columns() const { return columns_; }
    bool has_doubles() const { return has_doubles_; }

    /// Rays from one on, column by column: columns() arrays of `count`, one after the other. By any
    /// number of threads at a time. Throws SystemRefused, and BadInput if the file has become
    /// shorter.
    template <class Real>
    void read(std::uint64_t first, std::size_t count, std::vector<Real>& numbers) const;

  private:
    void read_head();
    void read_bytes(std::uint64_t place, char* bytes, std::size_t count) const;
    [[noreturn]] void refuse(const std::string& message) const;

    std::string name_;
    int descriptor_ = -1;
    std::uint64_t start_ = 0; // of the numbers
    std::uint64_t count_ = 0;
    std::size_t columns_ = 6;
    bool has_doubles_ = false, by_columns_ = false;
};

} // namespace raylane::scenes
