#include "scenes/formats/nff/scanner.hpp"

#include "scenes/files/errors.hpp"

#include <array>
#include <cstring>

namespace raylane::scenes {

namespace {

constexpr std::size_t buffer_size = 1 << 20;
constexpr std::size_t word_limit = 256;
constexpr std::uint64_t line_limit = 1 << 20;

enum class Part : std::uint8_t { word, blank, line_feed, comment };

constexpr std::array<Part, 256> parts = [] {
    std::array<Part, 256> table{};
    for (const char c : {' ', '\t', '\r', '\f', '\v'})
        table[static_cast<unsigned char>(c)] = Part::blank;
    table['\n'] = Part::line_feed;
    table['#'] = Part::comment;
    return table;
}();

Part part_of(char c) {
    return parts[static_cast<unsigned char>(c)];
}

} // namespace

NffScanner::NffScanner(InputFile& file)
    : file_(file), buffer_(buffer_size + 1), position_(buffer_.data()), end_(position_) {
    *end_ = '\n';
}

void NffScanner::fail(std::uint64_t line, std::string_view message) const {
    throw BadInput({{file_.name(), {static_cast<std::size_t>(line), 0}, "", std::string(message)}});
}

std::string_view NffScanner::word() {
    skip_blanks();
    while (part_of(*position_) == Part::line_feed) {
        if (position_ == end_) return {};
        check_line_length();
        ++position_;
        ++line_;
        line_begins_at_ = bytes_passed();
        skip_blanks();
    }
    word_line_ = line_;
    const char* begin = position_;
    while (true) {
        while (part_of(*position_) == Part::word)
            ++position_;
        const std::string_view word(begin, static_cast<std::size_t>(position_ - begin));
        if (word.size() >= word_limit)
            fail(line_, "must have words shorter than " + std::to_string(word_limit) +
                            " bytes, got \"" + printable(word) + "\"");
        if (position_ != end_ || !refill(begin)) return {begin, word.size()}; // refill moves it
    }
}

bool NffScanner::at_line_end() {
    skip_blanks();
    return part_of(*position_) == Part::line_feed;
}

/// Leaves position_ at a word, at the line feed that ends the line, or at the end of the file.
void NffScanner::skip_blanks() {
    while (true) {
        while (part_of(*position_) == Part::blank)
            ++position_;
        if (part_of(*position_) == Part::comment) skip_rest_of_line();
        const char* none = position_;
        if (position_ != end_ || !refill(none)) return;
    }
}

void NffScanner::skip_rest_of_line() {
    do {
        position_ = static_cast<char*>(
            std::memchr(position_, '\n', static_cast<std::size_t>(end_ - position_) + 1));
        const char* none = position_;
        if (position_ != end_ || !refill(none)) return;
    } while (true);
}

void NffScanner::check_line_length() const {
    if (bytes_passed() - line_begins_at_ >= line_limit)
        fail(line_, "must be a line shorter than " + std::to_string(line_limit) + " bytes");
}

/// Reads more at the end of the buffer, and keeps its contents from `keep_from` on. Returns false
/// at the end of the file.
bool NffScanner::refill(const char*& keep_from) {
    check_line_length();
    const auto kept = static_cast<std::size_t>(end_ - keep_from);
    passed_ += static_cast<std::uint64_t>(keep_from - buffer_.data());
    std::memmove(buffer_.data(), keep_from, kept);
    keep_from = buffer_.data();
    position_ = buffer_.data() + kept;
    end_ = position_ + file_.read(std::span(position_, buffer_size - kept));
    *end_ = '\n';
    return end_ != position_;
}

void ShapeReserve::update(core::SceneBuilder& builder, std::uint64_t passed,
                          const InputFile& file) {
    constexpr std::uint64_t sample_size = 1 << 20;
    if (is_reserved_ || passed < sample_size) return;
    is_reserved_ = true;
    if (file.size() <= passed) return;
    constexpr double margin = 17.0 / 16.0;
    const double rest =
        margin * static_cast<double>(file.size() - passed) / static_cast<double>(passed);
    builder.reserve(static_cast<std::size_t>(rest * static_cast<double>(builder.shape_count())));
}

} // namespace raylane::scenes
