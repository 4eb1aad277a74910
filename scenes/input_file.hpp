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

/// Is told how many bytes have been read so far, and how many there are or 0.
using OnRead = std::function<void(std::uint64_t bytes, std::uint64_t of)>;

/// Is told, in a line that begins with the file and often the place, of what a file says and the
/// scene does not have.
using OnRemark = std::function<void(const std::string& remark)>;

/// All bytes of a file, which stay where they are, from a multiple of 64 on, as long as `keeper`
/// is.
struct FileBytes {
    std::span<const std::byte> bytes;
    std::shared_ptr<const void> keeper;
};

/// A file, or anything else that can be read from start to end. What gzip has compressed reads as
/// what that was.
class InputFile {
  public:
    /// Throws BadInput if there is no such file or it is a directory, SystemRefused if it cannot be
    /// opened.
    /// "-" is standard input.
    explicit InputFile(const std::filesystem::path& path);
    /// A text in memory that is read as if it were the content of a file of that name.
    InputFile(std::string name, std::string_view text);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    OnRead on_read; ///< called whenever bytes of a file have been read

    /// Name as the user wrote it, for messages.
    const std::string& name() const { return name_; }
    /// Bytes in all, or 0 where that is unknown: of a pipe, and of what is compressed.
    std::uint64_t size() const { return inflater_ == nullptr ? size_ : 0; }

    /// The first bytes, at most 64 KiB, without consuming them.
    std::string_view head();
    /// Makes this a text, before any of it is read: a byte order mark at its start is left out, and
    /// a carriage return that no line feed follows is read as a line feed.
    void take_as_text();
    /// Fills `buffer` as far as the file goes; returns how many bytes, 0 at the end. Throws
    /// SystemRefused, and BadInput if the file turns out to have another length than at first: it
    /// is being written.
    std::size_t read(std::span<char> buffer);
    /// Everything that is left. Throws SystemRefused.
    std::string read_all();
    /// Everything, before any of it is read: mapped into memory, where the system can do that; then
    /// nobody may shorten the file meanwhile. Throws SystemRefused.
    FileBytes whole();
    /// Begins again at the start. False where that cannot be (a pipe).
    bool rewind();

  private:
    std::size_t read_some(std::span<char> buffer);
    std::size_t read_text(std::span<char> buffer);
    std::size_t read_bytes(std::span<char> buffer);
    std::size_t read_as_it_is(std::span<char> buffer);
    void require_same_size() const;

    std::string name_;
    int descriptor_ = -1; // none for a text
    std::uint64_t size_ = 0;
    std::uint64_t bytes_read_ = 0;
    std::string head_; // read ahead; all of a text
    std::size_t head_used_ = 0;
    std::unique_ptr<Inflater> inflater_; // of what is compressed
    bool is_text_ = false;
    std::optional<char> held_back_; // of a text: read ahead, behind a carriage return
};

} // namespace raylane::scenes
