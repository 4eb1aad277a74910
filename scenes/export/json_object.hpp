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

    TextFile& key(const char* name) {
        if (!std::exchange(first_, false)) file_ << separator_;
        return file_ << "\"" << name << "\": ";
    }
    void text(const char* name, std::string_view value) { key(name) << "\"" << value << "\""; }
    void number(const char* name, auto value) { key(name) << value; }
    template <class Real>
    void vector(const char* name, const core::Vec3<Real>& value) {
        key(name) << "[";
        file_.list(value, ", ") << "]";
    }
    template <class Real>
    void vectors(const char* name, std::initializer_list<core::Vec3<Real>> values) {
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
