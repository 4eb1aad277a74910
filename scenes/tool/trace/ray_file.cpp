#include "scenes/tool/trace/ray_file.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/tool/system.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

namespace raylane::scenes {

namespace {

using std::string_view_literals::operator""sv;

constexpr std::string_view magic = "\x93NUMPY"sv;
constexpr std::uint64_t max_bytes = std::uint64_t{1} << 62;

/// Parser of the header, a dictionary as a Python literal.
class Literal {
  public:
    Literal(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    [[noreturn]] void refuse(const std::string& message) const {
        throw BadInput(file_, "", message);
    }
    /// Consumes the character and returns true if it is next.
    bool takes(char character) {
        skip_space();
        if (!text_.starts_with(character)) return false;
        text_.remove_prefix(1);
        return true;
    }
    bool takes(std::string_view word) {
        skip_space();
        if (text_.substr(0, text_.find_first_of(", \t\n\r\f}#")) != word) return false;
        text_.remove_prefix(word.size());
        return true;
    }
    bool is_at_end() {
        skip_space();
        return text_.empty();
    }
    std::optional<std::string_view> string() {
        skip_space();
        if (text_.empty() || (text_[0] != '\'' && text_[0] != '"')) return std::nullopt;
        const std::size_t end = text_.find(text_[0], 1);
        if (end == std::string_view::npos) return std::nullopt;
        const std::string_view inside = text_.substr(1, end - 1);
        text_.remove_prefix(end + 1);
        return inside;
    }
    std::optional<std::uint64_t> number() {
        skip_space();
        std::uint64_t number = 0;
        const auto [behind, error] =
            std::from_chars(text_.data(), text_.data() + text_.size(), number);
        const auto digits = static_cast<std::size_t>(behind - text_.data());
        if (error != std::errc() || (digits > 1 && text_[0] == '0')) return std::nullopt;
        text_.remove_prefix(digits);
        return number;
    }

  private:
    void skip_space() {
        text_.remove_prefix(std::min(text_.find_first_not_of(" \t\n\r\f"), text_.size()));
    }

    std::string_view text_;
    const std::string& file_;
};

std::string type_of(Literal& text) {
    const std::optional<std::string_view> type = text.string();
    if (!type) text.refuse("must have numbers of one type, float32 or float64");
    return std::string(*type);
}

bool order_of(Literal& text) {
    if (text.takes("True"sv)) return true;
    if (!text.takes("False"sv)) text.refuse("must have a fortran_order of True or False");
    return false;
}

/// Parses a tuple. A tuple of one number has a comma.
std::vector<std::uint64_t> shape_of(Literal& text) {
    constexpr const char* none = "has a malformed shape";
    std::vector<std::uint64_t> numbers;
    if (!text.takes('(')) text.refuse(none);
    bool has_comma = true;
    while (!text.takes(')')) {
        const std::optional<std::uint64_t> number = text.number();
        if (!number || !has_comma) text.refuse(none);
        numbers.push_back(*number);
        has_comma = text.takes(',');
    }
    if (numbers.size() == 1 && !has_comma) text.refuse(none);
    return numbers;
}

} // namespace

NpyHead npy_head_of(std::string_view text, const std::string& file) {
    constexpr const char* none = "has a header that is not a Python dictionary";
    Literal literal(text, file);
    std::optional<std::string> type;
    std::optional<bool> by_columns;
    std::optional<std::vector<std::uint64_t>> shape;
    if (!literal.takes('{')) literal.refuse(none);
    bool has_comma = true;
    while (!literal.takes('}')) {
        const std::optional<std::string_view> key = literal.string();
        if (!key || !has_comma || !literal.takes(':')) literal.refuse(none);
        if (*key == "descr")
            type = type_of(literal);
        else if (*key == "fortran_order")
            by_columns = order_of(literal);
        else if (*key == "shape")
            shape = shape_of(literal);
        else
            literal.refuse("has an unknown key in its header, \"" + printable(*key) + "\"");
        has_comma = literal.takes(',');
    }
    if (!literal.is_at_end()) literal.refuse(none);
    if (!type) literal.refuse("has no descr in its header");
    if (!by_columns) literal.refuse("has no fortran_order in its header");
    if (!shape) literal.refuse("has no shape in its header");
    return {*type, *by_columns, *shape};
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

RayFile::RayFile(const std::filesystem::path& path)
    : name_(path == "-" ? "standard input" : path.string()) {
    descriptor_ = path == "-" ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                              : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
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
    if (!S_ISREG(status.st_mode)) refuse("must be a regular file");
    const auto size = static_cast<std::uint64_t>(status.st_size);
    // Standard input may have another position than the start.
    const auto begin = std::min<std::uint64_t>(
        size, static_cast<std::uint64_t>(::lseek(descriptor_, 0, SEEK_CUR)));
    char start[12] = {};
    if (size - begin >= sizeof start) read_bytes(begin, start, sizeof start);
    const auto version = static_cast<unsigned char>(start[6]);
    if (!std::string_view(start, sizeof start).starts_with(magic) || version < 1 || version > 3)
        refuse("must be an array in NumPy's format (.npy)");
    std::uint32_t length = 0;
    std::memcpy(&length, start + 8, version == 1 ? 2 : 4);
    start_ = begin + (version == 1 ? 10 : 12) + length;
    if (start_ > size || length > 1U << 20) refuse("must be complete, got a truncated header");
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
    if (is_pairs && by_columns_) refuse("must be in C order if its shape is (n, 2, 3)");
    if (!is_pairs && (shape.size() != 2 || (shape[1] != 6 && shape[1] != 8)))
        refuse(
            "must have the shape (n, 6), origins and directions, or (n, 8), with t_min and t_max");
    count_ = shape[0];
    columns_ = is_pairs ? 6 : shape[1];
    const std::size_t ray_bytes = columns_ * (has_doubles_ ? 8 : 4);
    if (count_ > max_bytes / ray_bytes || size - start_ != count_ * ray_bytes)
        refuse("has another length than its header states");
}

void RayFile::read_bytes(std::uint64_t place, char* bytes, std::size_t count) const {
    if (read_at(descriptor_, static_cast<std::int64_t>(place), {bytes, count}) == count) return;
    if (errno != 0) throw SystemRefused(name_, "read", errno);
    refuse("was truncated while it was read");
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
