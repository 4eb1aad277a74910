#pragma once

#include "scenes/export/text_file.hpp"

#include <initializer_list>
#include <string_view>
#include <utility>

namespace raylane::scenes {

/// Writes objects, one key after the other.
class JsonObject {
  public:
    explicit JsonObject(TextFile& file, const char* separator = ", ")
        : file_(file), separator_(separator) {
        file_ << "{";
    }
    ~JsonObject() { file_ << "}"; }
    JsonObject(const JsonObject&) = delete;
    JsonObject& operator=(const JsonObject&) = delete;

    TextFile& key(std::string_view name) {
        if (!std::exchange(first_, false)) file_ << separator_;
        return file_ << "\"" << name << "\": ";
    }
    void text(std::string_view name, std::string_view value) { key(name) << "\"" << value << "\""; }
    void number(std::string_view name, auto value) { key(name) << value; }
    template <class Real>
    void vector(std::string_view name, const core::Vec3<Real>& value) {
        key(name) << "[";
        file_.list(value, ", ") << "]";
    }
    template <class Real>
    void vectors(std::string_view name, std::initializer_list<core::Vec3<Real>> values) {
        key(name) << "[";
        bool first = true;
        for (const core::Vec3<Real>& value : values) {
            file_ << (std::exchange(first, false) ? "[" : ", [");
            file_.list(value, ", ") << "]";
        }
        file_ << "]";
    }

  private:
    TextFile& file_;
    const char* separator_;
    bool first_ = true;
};

} // namespace raylane::scenes
