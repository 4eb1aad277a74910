#include "scenes/formats/structure/lines.hpp"

#include "core/shapes/checks.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"

#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

namespace raylane::scenes {

namespace {

constexpr std::size_t longest_line = std::size_t{1} << 20;

bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

} // namespace

Lines::Lines(InputFile& file) : file_(file), buffer_(std::size_t{1} << 16) {}

bool Lines::next() {
    if (is_put_back_) {
        is_put_back_ = false;
        return true;
    }
    ++number_;
    std::size_t searched = begin_;
    for (;;) {
        const char* const data = buffer_.data();
        if (const void* found = std::memchr(data + searched, '\n', end_ - searched)) {
            const auto stop = static_cast<std::size_t>(static_cast<const char*>(found) - data);
            text_ = {data + begin_, stop - begin_};
            passed_ += stop + 1 - begin_;
            begin_ = stop + 1;
            break;
        }
        searched = end_ - begin_;
        if (!refill()) {
            if (begin_ == end_) return false;
            text_ = {buffer_.data() + begin_, end_ - begin_};
            passed_ += end_ - begin_;
            begin_ = end_;
            break;
        }
    }
    if (text_.ends_with('\r')) text_.remove_suffix(1);
    return true;
}

/// Moves the rest to the start of the buffer, and reads more. Returns false at the end of the file.
bool Lines::refill() {
    if (at_end_) return false;
    const std::size_t left = end_ - begin_;
    std::memmove(buffer_.data(), buffer_.data() + begin_, left);
    begin_ = 0;
    end_ = left;
    if (left == buffer_.size()) {
        if (left >= longest_line) fail("must be a text with lines of less than 1 MiB");
        buffer_.resize(2 * buffer_.size());
    }
    const std::size_t count = file_.read(std::span(buffer_).subspan(end_));
    at_end_ = count == 0;
    end_ += count;
    return !at_end_;
}

void Lines::next_atom(std::size_t number, std::size_t count) {
    if (!next())
        fail("must be atom " + std::to_string(number) + " of " + std::to_string(count) +
             ", got the end of the file");
}

void Lines::fail(std::string_view message, std::size_t column) const {
    throw BadInput({{.file = file_.name(),
                     .position = {.line = static_cast<std::size_t>(number_), .column = column},
                     .place = {},
                     .message = std::string(message)}});
}

void Words::skip_blanks() {
    while (position_ < text_.size() && is_blank(text_[position_]))
        ++position_;
}

std::string_view Words::next() {
    skip_blanks();
    column_ = position_ + 1;
    const std::size_t begin = position_;
    while (position_ < text_.size() && !is_blank(text_[position_]))
        ++position_;
    return text_.substr(begin, position_ - begin);
}

std::string_view Words::get(std::string_view what) {
    const std::string_view word = next();
    if (word.empty()) fail("must have " + std::string(what) + ", got the end of the line");
    return word;
}

double Words::number(std::string_view what) {
    const std::string_view word = get(what);
    const std::optional<double> value = number_in(word);
    if (!value) fail(std::string(what) + " must be a number, got \"" + printable(word) + "\"");
    return *value;
}

float Words::coordinate(std::string_view what) {
    skip_blanks();
    const std::size_t before = position_;
    if (const auto leading = leading_number(text_.substr(position_)))
        if (const std::size_t end = position_ + leading->length;
            end == text_.size() || is_blank(text_[end])) {
            column_ = position_ + 1;
            position_ = end;
            return leading->value;
        }
    const std::optional<float> nearest = to_float(get(what));
    if (nearest && std::abs(*nearest) <= core::coordinate_limit) return *nearest;
    position_ = before; // a Fortran exponent, or no number
    const double value = number(what);
    if (!(std::abs(value) <= static_cast<double>(core::coordinate_limit)))
        fail(std::string(what) + " must be from -1e30 to 1e30");
    return static_cast<float>(value);
}

long long Words::whole(std::string_view what, long long least, long long most) {
    const std::string_view word = get(what);
    long long value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (error != std::errc() || stop != end || value < least || value > most)
        fail(std::string(what) + " must be a whole number from " + std::to_string(least) + " to " +
             std::to_string(most) + ", got \"" + printable(word) + "\"");
    return value;
}

std::string_view Words::rest() {
    skip_blanks();
    column_ = position_ + 1;
    const std::string_view rest = text_.substr(position_);
    position_ = text_.size();
    return rest;
}

std::optional<double> number_in(std::string_view word) {
    if (word.starts_with('+')) {
        word.remove_prefix(1);
        if (word.starts_with('-')) return {};
    }
    double value = 0.0;
    const char* const end = word.data() + word.size();
    auto [stop, error] = std::from_chars(word.data(), end, value);
    if (error == std::errc() && stop != end && (*stop == 'D' || *stop == 'd') &&
        stop != word.data()) {
        std::string text(word);
        text[static_cast<std::size_t>(stop - word.data())] = 'e';
        const char* const text_end = text.data() + text.size();
        const auto again = std::from_chars(text.data(), text_end, value);
        if (again.ec != std::errc() || again.ptr != text_end) return {};
    } else if (error != std::errc() || stop != end) {
        return {};
    }
    if (!std::isfinite(value)) return {};
    return value;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back()))
        text.remove_suffix(1);
    return text;
}

} // namespace raylane::scenes
