#include "scenes/tool/trace/ray_file.hpp"

#include "scenes/errors.hpp"
#include "scenes/tool/read_at.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <limits>
#include <sys/stat.h>
#include <unistd.h>

namespace raylane::scenes {

namespace {

using std::string_view_literals::operator""sv;

constexpr std::string_view magic = "\x93NUMPY"sv;
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 62;

/// What is behind a key in the head, which is a dictionary as Python writes it.
std::string_view value_of(std::string_view text, std::string_view key, const std::string& file) {
    for (const char quote : {'\'', '"'}) {
        const std::string quoted = quote + std::string(key) + quote;
        const std::size_t at = text.find(quoted);
        if (at == std::string_view::npos) continue;
        text.remove_prefix(at + quoted.size());
        const std::size_t start = text.find_first_not_of(" :");
        if (start != std::string_view::npos) return text.substr(start);
    }
    throw BadInput(file, "", "has no " + std::string(key) + " in its head");
}

std::vector<std::uint64_t> numbers_of(std::string_view text, const std::string& file) {
    const BadInput none(file, "", "has a shape that is none");
    std::vector<std::uint64_t> numbers;
    const std::size_t end = text.find(')');
    if (!text.starts_with('(') || end == std::string_view::npos) throw none;
    text = text.substr(1, end - 1);
    while (!text.empty()) {
        const std::size_t start = text.find_first_not_of(" ,");
        if (start == std::string_view::npos) break;
        text.remove_prefix(start);
        std::uint64_t number = 0;
        const auto [behind, error] =
            std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc()) throw none;
        numbers.push_back(number);
        text.remove_prefix(static_cast<std::size_t>(behind - text.data()));
    }
    return numbers;
}

} // namespace

NpyHead npy_head_of(std::string_view text, const std::string& file) {
    NpyHead head;
    const std::string_view type = value_of(text, "descr", file);
    const std::size_t end = type.find(type.empty() ? '\'' : type[0], 1);
    if (type.empty() || (type[0] != '\'' && type[0] != '"') || end == std::string_view::npos)
        throw BadInput(file, "", "must have numbers of one type, float32 or float64");
    head.type = type.substr(1, end - 1);
    head.by_columns = value_of(text, "fortran_order", file).starts_with("True");
    head.shape = numbers_of(value_of(text, "shape", file), file);
    return head;
}

std::string npy_head(const std::string& type, std::uint64_t count) {
    std::string text = "{'descr': " + type + ", 'fortran_order': False, 'shape': (" +
                       std::to_string(count) + ",), }";
    constexpr std::size_t before = 10; // magic, version and length
    while ((before + text.size() + 1) % 64 != 0)
        text += ' ';
    text += '\n';
    const auto length = static_cast<std::uint16_t>(text.size());
    std::string head(magic);
    head += "\x01\x00"sv;
    head.append(reinterpret_cast<const char*>(&length), sizeof length);
    return head + text;
}

RayFile::RayFile(const std::filesystem::path& path) : name_(path.string()) {
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0 && errno == ENOENT) throw BadInput(name_, "", "no such file");
    if (descriptor_ < 0) throw SystemRefused(name_, "open", errno);
    try {
        read_head();
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
}

RayFile::~RayFile() {
    ::close(descriptor_);
}

void RayFile::refuse(const std::string& message) const {
    throw BadInput(printable(name_, 4096), "", message);
}

void RayFile::read_head() {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) throw SystemRefused(name_, "read", errno);
    if (!S_ISREG(status.st_mode)) refuse("must be a file");
    const auto size = static_cast<std::uint64_t>(status.st_size);
    char start[12] = {};
    if (size >= sizeof start) read_bytes(0, start, sizeof start);
    const auto version = static_cast<unsigned char>(start[6]);
    if (!std::string_view(start, sizeof start).starts_with(magic) || version < 1 || version > 3)
        refuse("must be an array in NumPy's format (.npy)");
    std::uint32_t length = 0;
    std::memcpy(&length, start + 8, version == 1 ? 2 : 4);
    start_ = (version == 1 ? 10 : 12) + std::uint64_t{length};
    if (start_ > size || length > 1U << 20) refuse("ends in its head");
    std::string text(length, '\0');
    read_bytes(start_ - length, text.data(), text.size());
    const NpyHead head = npy_head_of(text, printable(name_, 4096));
    has_doubles_ = head.type == "<f8";
    if (!has_doubles_ && head.type != "<f4")
        refuse("must have numbers of type float32 or float64 (<f4 or <f8), got \"" +
               printable(head.type) + "\"");
    by_columns_ = head.by_columns;
    const auto& shape = head.shape;
    const bool is_pairs = shape.size() == 3 && shape[1] == 2 && shape[2] == 3;
    if (is_pairs && by_columns_) refuse("must be in C's order if its shape is (n, 2, 3)");
    if (!is_pairs && (shape.size() != 2 || (shape[1] != 6 && shape[1] != 8)))
        refuse("must have a shape of (n, 6), origins and directions, or (n, 8), with t_min and "
               "t_max");
    count_ = shape[0];
    columns_ = is_pairs ? 6 : shape[1];
    const std::size_t ray_bytes = columns_ * (has_doubles_ ? 8 : 4);
    if (count_ > most_bytes / ray_bytes || size - start_ != count_ * ray_bytes)
        refuse("has another length than its head says");
}

void RayFile::read_bytes(std::uint64_t place, char* bytes, std::size_t count) const {
    if (read_at(descriptor_, static_cast<std::int64_t>(place), {bytes, count}) == count) return;
    if (errno != 0) throw SystemRefused(name_, "read", errno);
    refuse("has become shorter");
}

template <class Real>
void RayFile::read(std::uint64_t first, std::size_t count, std::vector<Real>& numbers) const {
    numbers.resize(columns_ * count);
    if (by_columns_) {
        for (std::size_t column = 0; column < columns_; ++column)
            read_bytes(start_ + (column * count_ + first) * sizeof(Real),
                       reinterpret_cast<char*>(numbers.data() + column * count),
                       count * sizeof(Real));
        return;
    }
    std::vector<Real> rows(columns_ * count);
    read_bytes(start_ + first * columns_ * sizeof(Real), reinterpret_cast<char*>(rows.data()),
               rows.size() * sizeof(Real));
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t column = 0; column < columns_; ++column)
            numbers[column * count + i] = rows[columns_ * i + column];
}

template void RayFile::read(std::uint64_t, std::size_t, std::vector<float>&) const;
template void RayFile::read(std::uint64_t, std::size_t, std::vector<double>&) const;

} // namespace raylane::scenes
