#pragma once

#include "core/scene/material.hpp"
#include "core/shapes/invalid_value.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/json/parameters.hpp"

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace raylane::scenes {

enum class JsonType : std::uint8_t { null, boolean, number, string, array, object };

/// "an object", "a number", ...
std::string_view name_of(JsonType type);

/// Positions of a value and of its key, if any, in the file.
struct JsonPositions {
    TextPosition value, key;
};

class JsonValue;

/// Returns an error without a line, for a reference to a value whose own error has been reported.
inline BadInput consequence() {
    return BadInput(std::vector<InputError>());
}

/// Thrown, in place of `error`, for a parameter without a value that may still get one later in the
/// file.
struct LateParameter {
    BadInput error;
};

/// One value of a file with all its contents, in the order of the file. Its nodes are in one vector
/// and its texts in one string, as a scene may hold millions of them.
class JsonDocument {
  public:
    /// `parameters`: the values of "$name"; must outlive the document.
    explicit JsonDocument(Parameters& parameters) : parameters_(parameters) {}

    /// Empties the document for a value at `pointer` (a JSON pointer, printable) in `file`, which
    /// must outlive the document.
    void begin(std::string_view file, std::string pointer);

    /// Adds a value after the others in the innermost open array or object. `key` is only used in
    /// an object. `text`: a string's content, or a number as messages quote it. `number` may be
    /// infinite.
    void add(JsonType type, const JsonPositions& positions, std::string_view key,
             std::string_view text = {}, double number = 0.0);
    /// Closes the array or object that was added last and is still open.
    void close();

    bool empty() const { return nodes_.empty(); }
    /// Number of arrays and objects that are open.
    std::size_t depth() const { return open_.size(); }
    std::size_t values() const { return nodes_.size(); }
    std::size_t text_bytes() const { return text_.size(); }

    JsonValue root() const;
    /// Returns the innermost array or object that is open; there must be one.
    JsonValue innermost() const;
    JsonValue latest() const;

  private:
    friend class JsonValue;

    struct Text {
        std::uint32_t first, size;
    };
    struct Node {
        JsonType type;
        std::uint32_t parent;
        std::uint32_t end; // one past the last node inside, the next sibling's index; 0 while open
        Text key, text;
        double number;
        JsonPositions positions;
    };

    Text keep(std::string_view text);
    std::uint32_t end_of(std::uint32_t node) const {
        return nodes_[node].end != 0 ? nodes_[node].end : static_cast<std::uint32_t>(nodes_.size());
    }
    std::string_view get(Text text) const {
        return std::string_view(text_).substr(text.first, text.size);
    }

    Parameters& parameters_;
    std::string_view file_;
    std::string pointer_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> open_;
    std::string text_;
};

/// A value inside a document, which must outlive it. Accessors throw BadInput with the file, the
/// value's position and its JSON pointer if the value is not as requested.
class JsonValue {
  public:
    JsonValue(const JsonDocument& document, std::uint32_t node)
        : document_(&document), node_(node) {}

    JsonType type() const { return node().type; }
    std::string_view key() const { return document_->get(node().key); }
    std::string_view file() const { return document_->file_; }
    std::string pointer() const;
    const JsonPositions& positions() const { return node().positions; }
    /// Returns the value at the end of a path such as "edges/2", or the last value on the way there
    /// that exists.
    JsonValue toward(std::string_view path) const;
    /// Returns the value if it is a short text, otherwise its type: `-1`, `"red"`, `an array`.
    std::string quoted() const;

    InputError error(std::string_view message) const;
    /// "must be `expected`, got ..."
    InputError error_expecting(std::string_view expected) const;
    [[noreturn]] void fail(std::string_view message) const;
    [[noreturn]] void fail_expecting(std::string_view expected) const;
    /// Throws for a part of the value that core refused.
    [[noreturn]] void fail(const core::InvalidValue& invalid) const;

    /// Throws one error for each key of an object that is not among these.
    void allow_only(std::span<const std::string_view> keys) const;
    void allow_only(std::initializer_list<std::string_view> keys) const {
        allow_only(std::span(keys.begin(), keys.size()));
    }
    std::optional<JsonValue> find(std::string_view key) const;
    JsonValue at(std::string_view key) const;

    /// Throws if the object has both keys.
    void exclude(std::string_view key, std::string_view other) const;

    /// Returns the elements of an array, which must have `count` of them. `elements` names these in
    /// messages ("numbers").
    std::vector<JsonValue> array(std::size_t count, std::string_view elements) const;
    /// Returns the elements of an array of any length.
    std::vector<JsonValue> array(std::string_view elements) const;

    /// Returns true for a number, and for a reference to one.
    bool is_number() const;
    /// Returns the nearest float.
    float number() const;
    /// Returns the nearest double; or the nearest float, if the number is too small for shapes in
    /// double.
    double real() const;
    /// Returns a whole number in the range of int, in any notation.
    int integer() const;
    bool boolean() const;
    std::string_view string() const;
    /// Returns the number that "$name" inside of a text stands for.
    double parameter(std::string_view reference) const { return number_of(reference).value; }
    core::Vec3f vector() const;
    core::Vec3d real_vector() const;
    /// Reads [r, g, b], linear, or "#rrggbb", sRGB.
    core::Color color() const;

    template <class Value>
    using Choices = std::span<const std::pair<std::string_view, Value>>;

    /// Returns the value that belongs to this string.
    template <class Value>
    Value choice(std::initializer_list<std::pair<std::string_view, Value>> choices) const {
        return choice(Choices<Value>(choices.begin(), choices.size()));
    }
    template <class Value>
    Value choice(Choices<Value> choices) const {
        const std::string_view text = string();
        std::vector<std::string_view> names;
        for (const auto& [name, value] : choices) {
            if (name == text) return value;
            names.push_back(name);
        }
        fail_choice(names);
    }

  private:
    const JsonDocument::Node& node() const { return document_->nodes_[node_]; }
    /// Calls use(text, value) for a number, or for the number that "$name" stands for.
    template <class Use>
    auto with_number(const Use& use) const;
    /// Returns the number that "$name" stands for. Throws BadInput if the value is not a number.
    Parameters::Number referred() const;
    Parameters::Number number_of(std::string_view reference) const;
    void require(JsonType type) const;
    std::vector<JsonValue> children() const;
    [[noreturn]] void fail_choice(const std::vector<std::string_view>& names) const;

    const JsonDocument* document_;
    std::uint32_t node_;
};

/// Runs `action`. Rethrows core::InvalidValue as BadInput with the place of `value`.
template <class Action>
auto checked(const JsonValue& value, Action action) {
    try {
        return action();
    } catch (const core::InvalidValue& invalid) {
        value.fail(invalid);
    }
}

/// Returns a reference token of a JSON pointer (RFC 6901), with its slash, printable in a message.
std::string pointer_token(std::string_view key);

/// Returns `unknown key "raduis", did you mean "radius"?`, or lists all known keys if none is near.
std::string unknown_key(std::string_view key, const std::vector<std::string_view>& known);

} // namespace raylane::scenes
