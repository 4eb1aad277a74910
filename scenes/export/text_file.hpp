#pragma once

#include "core/numbers/vector.hpp"
#include "scenes/files/atomic_file.hpp"
#include "scenes/files/number.hpp"

#include <charconv>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace raylane::scenes {

/// Buffers text for a file, or for a callback that takes it piece by piece. Writes floats and
/// doubles so that reading them gives the same values.
class TextFile {
  public:
    using Take = std::function<void(std::string_view)>;

    explicit TextFile(Take take) : take_(std::move(take)) {}
    explicit TextFile(AtomicFile& file)
        : TextFile([&file](std::string_view text) { file.write(text); }) {}

    TextFile& operator<<(std::string_view text) {
        text_ += text;
        if (text_.size() > 1 << 16) flush();
        return *this;
    }
    TextFile& operator<<(const char* text) { return *this << std::string_view(text); }
    TextFile& operator<<(float value) {
        return is_negative_zero(value) ? *this << "-0.0"
                                       : *this << std::string_view(to_text(value));
    }
    TextFile& operator<<(double value) {
        if (is_negative_zero(value)) return *this << "-0.0";
        char text[32];
        const auto end = std::to_chars(text, text + sizeof text, value).ptr;
        return *this << std::string_view(text, static_cast<std::size_t>(end - text));
    }
    TextFile& operator<<(int value) { return *this << std::string_view(std::to_string(value)); }

    /// Writes the components of a vector, separated by `between`.
    template <class Real>
    TextFile& list(const core::Vec3<Real>& v, const char* between) {
        return *this << v.x << between << v.y << between << v.z;
    }

    void flush() {
        take_(text_);
        text_.clear();
    }

  private:
    /// Without a decimal point, -0 would be read as a whole number, which has no sign.
    template <class Real>
    static bool is_negative_zero(Real value) {
        return value == 0 && std::signbit(value);
    }

    Take take_;
    std::string text_;
};

} // namespace raylane::scenes
