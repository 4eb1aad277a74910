#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
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

} // namespace raylane::scenes
