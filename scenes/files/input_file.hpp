#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace raylane::scenes {

class Inflater;

/// Receives the number of bytes read so far, and the total, or 0 if that is unknown.
using OnRead = std::function<void(std::uint64_t bytes, std::uint64_t size)>;

/// Receives a line for each statement of a file that the scene ignores. The line begins with the
/// file's name and often the position.
using OnRemark = std::function<void(const std::string& remark)>;

/// All bytes of a file. They start at a multiple of 64 and remain valid as long as `keeper` exists.
struct FileBytes {
    std::span<const std::byte> bytes;
    std::shared_ptr<const void> keeper;
};

/// A file, or any other source that can be read from start to end. Data compressed by gzip is
/// decompressed.
class InputFile {
  public:
    /// Throws BadInput if the file does not exist or is a directory. Throws SystemRefused if it
    /// cannot be opened. "-" is standard input.
    explicit InputFile(const std::filesystem::path& path);
    /// Makes a text in memory readable as if it were the content of a file of that name.
    InputFile(std::string name, std::string_view text);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    OnRead on_read; ///< called whenever bytes of a file have been read

    /// Returns the name as the user wrote it, for messages.
    const std::string& name() const { return name_; }
    /// Returns the number of bytes, or 0 if unknown (pipes and compressed data).
    std::uint64_t size() const { return inflater_ == nullptr ? size_ : 0; }

    /// Returns the first bytes, at most 64 KiB, without consuming them.
    std::string_view head();
    /// Makes this a text. Call it before anything is read. A byte order mark at the start is
    /// skipped, and a carriage return without a line feed is read as a line feed.
    void take_as_text();
    /// Fills `buffer` as far as the file goes. Returns the number of bytes, 0 at the end. Throws
    /// SystemRefused. Throws BadInput if the file's size has changed since it was opened, which
    /// means that it is being written.
    std::size_t read(std::span<char> buffer);
    /// Returns the rest of the file. Throws SystemRefused.
    std::string read_all();
    /// Returns all bytes. Call it before anything is read. The file is mapped into memory where the
    /// system supports that; then it must not be truncated meanwhile. Throws SystemRefused.
    FileBytes whole();
    /// Starts again at the beginning. Returns false if that is impossible (a pipe).
    bool rewind();

  private:
    std::size_t read_some(std::span<char> buffer);
    std::size_t read_text(std::span<char> buffer);
    std::size_t read_bytes(std::span<char> buffer);
    std::size_t read_as_it_is(std::span<char> buffer);
    void require_same_size() const;

    std::string name_;
    int descriptor_ = -1; // -1 for a text in memory
    std::uint64_t size_ = 0;
    std::uint64_t bytes_read_ = 0;
    std::string head_; // read ahead; the whole of a text in memory
    std::size_t head_used_ = 0;
    std::unique_ptr<Inflater> inflater_; // for compressed data only
    bool is_text_ = false;
    std::optional<char> held_back_; // of a text: the character read ahead, after a carriage return
};

} // namespace raylane::scenes
