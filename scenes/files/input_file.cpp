#include "scenes/files/input_file.hpp"

#include "core/shapes/big_array.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/inflater.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace raylane::scenes {

namespace {

constexpr std::size_t head_size = 64 << 10;

/// Converts a size to std::size_t. Throws std::bad_alloc if it cannot fit into memory.
std::size_t in_memory(std::uint64_t bytes) {
    if (bytes > std::string().max_size()) throw std::bad_alloc();
    return static_cast<std::size_t>(bytes);
}

/// Replaces carriage returns without a line feed by line feeds. `next` is the character after
/// `text`.
void end_lines(std::span<char> text, std::optional<char> next) {
    for (auto at = text.begin();; ++at) {
        at = std::find(at, text.end(), '\r');
        if (at == text.end()) return;
        if (at + 1 != text.end() ? *(at + 1) != '\n' : next != '\n') *at = '\n';
    }
}

} // namespace

InputFile::InputFile(const std::filesystem::path& path)
    : name_(path == "-" ? "standard input" : path.string()),
      descriptor_(path == "-" ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                              : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) {
        if (errno == ENOENT || errno == ENOTDIR) throw BadInput(name_, "", "no such file");
        throw SystemRefused(name_, "open", errno);
    }
    struct stat status {};
    const int stated = ::fstat(descriptor_, &status);
    if (stated != 0 || S_ISDIR(status.st_mode)) {
        const int error_number = errno;
        ::close(descriptor_);
        if (stated != 0) throw SystemRefused(name_, "read", error_number);
        throw BadInput(name_, "", "must be a file, got a directory");
    }
    if (S_ISREG(status.st_mode)) size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::InputFile(std::string name, std::string_view text)
    : name_(std::move(name)), size_(text.size()), head_(text) {}

InputFile::~InputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

std::string_view InputFile::head() {
    if (head_.empty()) {
        head_.resize(head_size);
        std::size_t filled = 0;
        while (filled < head_size) {
            const std::size_t count = read_some(std::span(head_).subspan(filled));
            if (count == 0) break;
            filled += count;
        }
        head_.resize(filled);
        if (inflater_ == nullptr && head_.starts_with("\x1F\x8B")) {
            inflater_ = std::make_unique<Inflater>(
                name_, std::exchange(head_, {}),
                [this](std::span<char> buffer) { return read_as_it_is(buffer); });
            return head();
        }
    }
    return std::string_view(head_).substr(head_used_, head_size);
}

void InputFile::take_as_text() {
    if (is_text_) return;
    head();
    if (head_.starts_with("\xEF\xBB\xBF")) head_.erase(0, 3);
    char next = 0;
    if (head_.ends_with('\r') && read_some(std::span(&next, 1)) == 1) held_back_ = next;
    end_lines(head_, held_back_);
    is_text_ = true;
}

std::size_t InputFile::read(std::span<char> buffer) {
    if (head_.empty()) head();
    if (head_used_ == head_.size()) return read_some(buffer);
    const std::size_t count = std::min(buffer.size(), head_.size() - head_used_);
    std::memcpy(buffer.data(), head_.data() + head_used_, count);
    head_used_ += count;
    return count;
}

std::string InputFile::read_all() {
    std::string text;
    text.resize(in_memory(size() + 1)); // one more, so that the end is found without growing
    std::size_t filled = 0;
    while (const std::size_t count = read(std::span(text).subspan(filled))) {
        filled += count;
        if (filled == text.size()) text.resize(2 * text.size() + head_size);
    }
    text.resize(filled);
    return text;
}

FileBytes InputFile::whole() {
    head(); // detects compression
    if (descriptor_ >= 0 && inflater_ == nullptr && size_ > 0) {
        const std::size_t size = in_memory(size_);
        void* const memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor_, 0);
        if (memory != MAP_FAILED) {
            if (on_read) on_read(size_, size_);
            return {{static_cast<const std::byte*>(memory), size},
                    {memory, [size](void* mapped) { ::munmap(mapped, size); }}};
        }
    }
    const std::string text = read_all();
    const auto bytes = std::make_shared<core::BigArray<std::byte>>(text.size());
    std::copy_n(reinterpret_cast<const std::byte*>(text.data()), text.size(), bytes->data());
    return {{bytes->data(), bytes->size()}, bytes};
}

bool InputFile::rewind() {
    if (descriptor_ >= 0) {
        if (::lseek(descriptor_, 0, SEEK_SET) != 0) return false;
        head_.clear();
        inflater_.reset();
        bytes_read_ = 0;
        held_back_.reset();
        if (std::exchange(is_text_, false)) take_as_text();
    }
    head_used_ = 0;
    return true;
}

std::size_t InputFile::read_some(std::span<char> buffer) {
    return is_text_ ? read_text(buffer) : read_bytes(buffer);
}

std::size_t InputFile::read_text(std::span<char> buffer) {
    if (buffer.empty()) return 0;
    std::size_t count = 0;
    if (held_back_) buffer[count++] = *std::exchange(held_back_, {});
    count += read_bytes(buffer.subspan(count));
    char next = 0;
    if (count > 0 && buffer[count - 1] == '\r' && read_bytes(std::span(&next, 1)) == 1)
        held_back_ = next;
    end_lines(buffer.first(count), held_back_);
    return count;
}

std::size_t InputFile::read_bytes(std::span<char> buffer) {
    return inflater_ != nullptr ? inflater_->read(buffer) : read_as_it_is(buffer);
}

std::size_t InputFile::read_as_it_is(std::span<char> buffer) {
    while (descriptor_ >= 0) {
        const ssize_t count = ::read(descriptor_, buffer.data(), buffer.size());
        if (count >= 0) {
            if (count == 0) require_same_size();
            bytes_read_ += static_cast<std::uint64_t>(count);
            if (on_read) on_read(bytes_read_, size_);
            return static_cast<std::size_t>(count);
        }
        if (errno != EINTR) throw SystemRefused(name_, "read", errno);
    }
    return 0;
}

void InputFile::require_same_size() const {
    struct stat status {};
    if (size_ == 0 || ::fstat(descriptor_, &status) != 0) return;
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (size != size_)
        throw BadInput(name_, "",
                       "must not change while it is read: it had " + std::to_string(size_) +
                           " bytes, and now has " + std::to_string(size));
}

} // namespace raylane::scenes
