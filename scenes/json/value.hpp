#pragma once

#include "core/scene/material.hpp"
#include "core/shapes/invalid_value.hpp"
#include "scenes/errors.hpp"
#include "scenes/json/parameters.hpp"

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

/// Where a value begins in its file, and its key if it has one.
struct JsonPositions {
    TextPosition value, key;
};

class JsonValue;

/// Returns an error without a line, for a reference to a value whose own error has been reported.
inline BadInput consequence() {
    return BadInput(std::vector<InputError>());
}

/// Thrown for a parameter without a value where one may come further on, in place of `error`.
struct LateParameter {
    BadInput error;
};

/// One value of a file with all that is in it, in the order of the file. Its nodes lie in one
/// vector, and their texts in one string: a scene may have to hold millions of these.
class JsonDocument {
  public:
    /// `parameters`: what "$name" stands for, for as long as this is used.
    explicit JsonDocument(Parameters* parameters = nullptr) : parameters_(parameters) {}

    /// Empties it for a value at `pointer` (a JSON pointer, printable) in `file`, which must
    /// outlive it.
    void begin(std::string_view file, std::string pointer);

    /// Adds a value behind the others in the innermost open array or object. `key` counts in an
    /// object alone. `text`: a string's content, or as what a message quotes a number. `number` may
    /// be infinite.
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
    /// The innermost array or object that is open; there must be one.
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
        std::uint32_t end; // one past the last node inside: where the next sibling is; 0 while open
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

    Parameters* parameters_;
    std::string_view file_;
    std::string pointer_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> open_;
    std::string text_;
};

/// A value inside a document, which must outlive it. What is asked of it and is not so throws
/// BadInput with the file, the value's position and its JSON pointer.
class JsonValue {
  public:
    JsonValue(const JsonDocument& document, std::uint32_t node)
        : document_(&document), node_(node) {}

    JsonType type() const { return node().type; }
    std::string_view key() const { return document_->get(node().key); }
    std::string_view file() const { return document_->file_; }
    std::string pointer() const;
    const JsonPositions& positions() const { return node().positions; }
    /// The value at the end of a path such as "edges/2", or as far on the way there as there are
    /// values.
    JsonValue toward(std::string_view path) const;
    /// The value if it is a short text, or else what it is: `-1`, `"red"`, `an array`.
    std::string quoted() const;

    InputError error(std::string_view message) const;
    /// "must be `expected`, got ..."
    InputError error_expecting(std::string_view expected) const;
    [[noreturn]] void fail(std::string_view message) const;
    [[noreturn]] void fail_expecting(std::string_view expected) const;
    /// For what core says of a part of the value.
    [[noreturn]] void fail(const core::InvalidValue& invalid) const;

    /// Refuses every key of an object but these, each with an error of its own.
    void allow_only(std::span<const std::string_view> keys) const;
    void allow_only(std::initializer_list<std::string_view> keys) const {
        allow_only(std::span(keys.begin(), keys.size()));
    }
    std::optional<JsonValue> find(std::string_view key) const;
    JsonValue at(std::string_view key) const;

    /// Refuses both at once.
    void exclude(std::string_view key, std::string_view other) const;

    /// Elements of an array, of which there must be `count`; `elements` is what they should be
    /// ("numbers").
    std::vector<JsonValue> array(std::size_t count, std::string_view elements) const;
    /// However many there are.
    std::vector<JsonValue> array(std::string_view elements) const;

    /// True of a number, and of what stands for one.
    bool is_number() const;
    /// The nearest float.
    float number() const;
    /// The nearest double; or float, where that is below what shapes in double are made of.
    double real() const;
    /// A whole number in the range of int, however written.
    int integer() const;
    bool boolean() const;
    std::string_view string() const;
    core::Vec3f vector() const;
    core::Vec3d real_vector() const;
    /// [r, g, b], linear, or "#rrggbb", sRGB.
    core::Color color() const;

    template <class Value>
    using Choices = std::span<const std::pair<std::string_view, Value>>;

    /// The value that belongs to this string.
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
    /// Calls use(text, value) for a number, or what "$name" stands for.
    template <class Use>
    auto with_number(const Use& use) const;
    /// What "$name" stands for; throws BadInput for what is no number.
    Parameters::Number referred() const;
    void require(JsonType type) const;
    std::vector<JsonValue> children() const;
    [[noreturn]] void fail_choice(const std::vector<std::string_view>& names) const;

    const JsonDocument* document_;
    std::uint32_t node_;
};

/// Runs `action`, and gives what core::InvalidValue it throws the place of `value`.
template <class Action>
auto checked(const JsonValue& value, Action action) {
    try {
        return action();
    } catch (const core::InvalidValue& invalid) {
        value.fail(invalid);
    }
}

/// A reference token of a JSON pointer (RFC 6901), with its slash, fit for a message.
std::string pointer_token(std::string_view key);

/// `unknown key "raduis", did you mean "radius"?`, or with all known keys if none is near.
std::string unknown_key(std::string_view key, const std::vector<std::string_view>& known);

} // namespace raylane::scenes
