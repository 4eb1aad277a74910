#include "scenes/json/items.hpp"

#include "scenes/errors.hpp"
#include "scenes/json/text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace raylane::scenes {

namespace {

using nlohmann::json;

// Of one item:
constexpr std::size_t deepest = 16;
constexpr std::size_t most_values = 4096;
constexpr std::size_t most_text = 1 << 20; // bytes of keys, strings and numbers

/// The float nearest to a decimal number, infinite if there is none. `rounded` is the nearest
/// double: going by way of it would round twice.
float nearest_float(std::string_view text, double rounded) {
    float number = 0.0F;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc::result_out_of_range) return number;
    const float limit = std::abs(rounded) > 1.0 ? std::numeric_limits<float>::infinity() : 0.0F;
    return std::copysign(limit, static_cast<float>(rounded));
}

// Wording of the parser's errors: "... - REASON; last read: '...'" where it could not even make a
// token of what it read, and "; expected ..." behind that.
constexpr std::string_view before_reason = " - ", behind_reason = "; last read: ";

bool is_within_token(std::string_view error) {
    return error.find(behind_reason) != std::string_view::npos;
}

/// "must be ..." for what the parser says is wrong inside of a token or, failing that, what it
/// expected there.
std::string expectation_in(std::string_view error) {
    if (is_within_token(error) && error.find(before_reason) < error.find(behind_reason)) {
        const std::size_t first = error.find(before_reason) + before_reason.size();
        const std::string_view reason = error.substr(first, error.find(behind_reason) - first);
        if (reason != "invalid literal") return "must be JSON (" + printable(reason, 100) + ")";
    }
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 5> phrases = {{
        {"; expected ']'", "',' or ']'"},
        {"; expected '}'", "',' or '}'"},
        {"; expected ':'", "':'"},
        {"; expected string literal", "a key in double quotes"},
        {"; expected end of input", "the end of the file"},
    }};
    for (const auto& [expected, phrase] : phrases)
        if (error.rfind(expected) != std::string_view::npos)
            return "must be " + std::string(phrase);
    return "must be a value";
}

/// Receives the parser's events.
class ItemParser {
  public:
    ItemParser(std::string_view file, JsonText& text, std::span<const RootKey> keys,
               const TakeItem& take)
        : file_(file), text_(text), keys_(keys), seen_(keys.size()), take_(take) {}

    /// Throws for required keys that did not come.
    void finish() const {
        for (std::size_t i = 0; i < keys_.size(); ++i)
            if (keys_[i].required && !seen_[i])
                fail("", "must have the key \"" + std::string(keys_[i].name) + '"');
    }

    // Calls of nlohmann::json's parser. The answer true means: go on.
    bool null() { return scalar(JsonType::null, "", 0.0F); }
    bool boolean(bool value) { return scalar(JsonType::boolean, "", value ? 1.0F : 0.0F); }
    bool number_integer(json::number_integer_t value) {
        return scalar(JsonType::number, std::to_string(value), static_cast<float>(value));
    }
    bool number_unsigned(json::number_unsigned_t value) {
        return scalar(JsonType::number, std::to_string(value), static_cast<float>(value));
    }
    bool number_float(json::number_float_t value, const std::string& digits);
    bool string(const std::string& value) { return scalar(JsonType::string, value, 0.0F); }
    bool binary(json::binary_t& /*never in a text*/) { return false; }
    bool key(const std::string& key);
    bool start_object(std::size_t /*unknown*/) { return open(JsonType::object); }
    bool end_object() { return close(); }
    bool start_array(std::size_t /*unknown*/) { return open(JsonType::array); }
    bool end_array() { return close(); }
    bool parse_error(std::size_t read, const std::string& token, const json::exception& error);

  private:
    bool scalar(JsonType type, std::string_view text, float number);
    bool open(JsonType type);
    bool close();
    void add(JsonType type, std::string_view text, float number);
    void root_key(std::string_view key);
    /// Type that the value that comes next must have, unless that is for the taker to say.
    std::optional<JsonType> expected_type() const;
    std::string next_pointer() const;
    bool is_named() const { return in_collection_ && root_key_->holds == Holds::named_items; }
    void hand_over() {
        take_(*root_key_, is_named() ? std::string_view(name_) : "", item_);
        ++item_count_;
    }
    [[noreturn]] void fail(std::string_view pointer, std::string_view message) const {
        throw BadInput(file_, pointer, message);
    }

    std::string_view file_;
    JsonText& text_;
    std::span<const RootKey> keys_;
    std::vector<bool> seen_; // which of keys_
    const TakeItem& take_;

    bool in_root_ = false;
    const RootKey* root_key_ = nullptr; // the latest
    bool in_collection_ = false;        // inside of its value, a list or an object of items
    std::size_t item_count_ = 0;
    std::string name_; // of the latest item in an object of them
    std::string key_;  // the latest in an item
    JsonDocument item_;
};

bool ItemParser::number_float(json::number_float_t value, const std::string& digits) {
    std::string text = digits;
    // The parser writes the decimal point as the C locale has it.
    for (char& c : text)
        if ((c < '0' || c > '9') && c != '-' && c != '+' && c != 'e' && c != 'E') c = '.';
    return scalar(JsonType::number, text, nearest_float(text, value));
}

bool ItemParser::key(const std::string& key) {
    if (item_.depth() > 0) {
        if (item_.innermost().find(key))
            fail(item_.innermost().pointer() + pointer_token(key), "must be given only once");
        key_ = key;
    } else if (in_collection_) {
        name_ = key;
    } else {
        root_key(key);
    }
    return true;
}

void ItemParser::root_key(std::string_view key) {
    std::vector<std::string_view> names;
    for (const RootKey& known : keys_)
        names.push_back(known.name);
    const std::size_t index =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), key) - names.begin());
    if (index == names.size()) fail("", unknown_key(key, names));
    if (seen_[index]) fail(pointer_token(key), "must be given only once");
    seen_[index] = true;
    root_key_ = &keys_[index];
}

bool ItemParser::scalar(JsonType type, std::string_view text, float number) {
    add(type, text, number);
    if (item_.depth() == 0) hand_over();
    return true;
}

bool ItemParser::open(JsonType type) {
    if (item_.depth() > 0 || in_collection_ || expected_type() != type) {
        add(type, "", 0.0F);
    } else if (in_root_) {
        in_collection_ = true;
        item_count_ = 0;
    } else {
        in_root_ = true;
    }
    return true;
}

bool ItemParser::close() {
    if (item_.depth() > 0) {
        item_.close();
        if (item_.depth() == 0) hand_over();
    } else {
        in_collection_ = false;
    }
    return true;
}

void ItemParser::add(JsonType type, std::string_view text, float number) {
    const bool starts = item_.depth() == 0;
    if (starts) item_.begin(file_, next_pointer());
    item_.add(type, key_, text, number);
    // Said here, before all that is in a list of the wrong kind has been read.
    if (const auto expected = expected_type(); starts && expected && *expected != type)
        item_.root().fail_expecting(name_of(*expected));
    if (item_.depth() > deepest)
        fail(item_.root().pointer(),
             "must not be nested more than " + std::to_string(deepest) + " deep");
    if (item_.values() > most_values || item_.text_bytes() > most_text)
        fail(item_.root().pointer(), "must not hold more than " + std::to_string(most_values) +
                                         " values or " + std::to_string(most_text) +
                                         " bytes of text");
}

std::optional<JsonType> ItemParser::expected_type() const {
    if (!in_root_ || in_collection_) return JsonType::object;
    switch (root_key_->holds) {
    case Holds::item_list:
        return JsonType::array;
    case Holds::named_items:
        return JsonType::object;
    case Holds::one_item:
        break;
    }
    return std::nullopt;
}

std::string ItemParser::next_pointer() const {
    if (!in_root_) return "";
    std::string pointer = pointer_token(root_key_->name);
    if (!in_collection_) return pointer;
    return pointer + (is_named() ? pointer_token(name_) : '/' + std::to_string(item_count_));
}

bool ItemParser::parse_error(std::size_t read, const std::string& token,
                             const json::exception& error) {
    static constexpr int out_of_range = 406;
    if (error.id == out_of_range) {
        add(JsonType::number, token, std::numeric_limits<float>::infinity());
        static_cast<void>(item_.latest().number()); // throws
    }
    if (!text_.has_tokens()) text_.fail(text_.end(), "must be a scene, got an empty file");
    const std::string expectation = expectation_in(error.what());
    if (text_.at_end() && read > text_.end().index)
        text_.fail(text_.end(), expectation + ", got the end of the file");
    JsonText::Token found = text_.token_at(read - 1);
    const auto is_structural = [&] {
        return std::string_view("{}[]:,").find(found.start) != std::string_view::npos;
    };
    // What cuts a number or a literal short is well in itself.
    if (is_structural() && is_within_token(error.what()) && read > 1)
        found = text_.token_at(read - 2);
    text_.fail(found,
               expectation + ", got " + (is_structural() ? "'" + found.start + "'" : found.start));
}

} // namespace

void read_items(InputFile& file, std::span<const RootKey> keys, const TakeItem& take) {
    JsonText text(file);
    ItemParser parser(file.name(), text, keys, take);
    json::sax_parse(JsonTextIterator(text), JsonTextIterator(), &parser);
    parser.finish();
}

} // namespace raylane::scenes
