#include "scenes/formats/json/items.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/formats/json/reader.hpp"
#include "scenes/formats/json/text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace raylane::scenes {

namespace {

using nlohmann::json;

// Limits of one item.
struct Most {
    std::size_t depth, values;
    std::size_t text; // bytes of keys, strings and numbers
};
constexpr Most max_of_plain = {16, 4096, 1 << 20};
constexpr Most max_of_nested = {max_levels, 1 << 27, std::size_t{1} << 31};

// Wording of the parser's errors: "... - REASON; last read: '...'" if it could not make a token of
// its input, followed by "; expected ...".
constexpr std::string_view before_reason = " - ", behind_reason = "; last read: ";

bool is_within_token(std::string_view error) {
    return error.find(behind_reason) != std::string_view::npos;
}

/// Returns "must be ..." with the parser's reason if the error is inside of a token. Otherwise,
/// names the token that the parser expected.
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

/// Receives the parser's events. Skips the contents of a value whose start is an error.
class ItemParser {
  public:
    ItemParser(std::string_view file, JsonText& text, std::span<const RootKey> keys,
               const TakeItem& take, const MissItems& miss, InputErrors& errors,
               Parameters& parameters)
        : file_(file), text_(text), keys_(keys), take_(take), miss_(miss), errors_(errors),
          item_(parameters) {}

    /// Reports missing required keys, and returns the outline.
    Outline finish();

    // Callbacks of nlohmann::json's parser. They return true to continue.
    bool null() { return scalar(JsonType::null, "", 0.0); }
    bool boolean(bool value) { return scalar(JsonType::boolean, "", value ? 1.0 : 0.0); }
    bool number_integer(json::number_integer_t value) {
        return scalar(JsonType::number, std::to_string(value), static_cast<double>(value));
    }
    bool number_unsigned(json::number_unsigned_t value) {
        return scalar(JsonType::number, std::to_string(value), static_cast<double>(value));
    }
    bool number_float(json::number_float_t value, const std::string& digits);
    bool string(const std::string& value) { return scalar(JsonType::string, value, 0.0); }
    bool binary(json::binary_t& /*never in a text*/) { return false; }
    bool key(const std::string& key);
    bool start_object(std::size_t /*unknown*/) { return open(JsonType::object); }
    bool end_object() { return close(); }
    bool start_array(std::size_t /*unknown*/) { return open(JsonType::array); }
    bool end_array() { return close(); }
    bool parse_error(std::size_t read, const std::string& token, const json::exception& error);

  private:
    bool scalar(JsonType type, std::string_view text, double number);
    bool open(JsonType type);
    bool close();
    /// Adds a value to the item. Returns false if the value is that of a root key (a key of the
    /// outermost object) and has the wrong type.
    bool add(JsonType type, std::string_view text, double number);
    void root_key(std::string_view key);
    /// Returns the type that the file's outermost value or, inside of it, the value of the latest
    /// root key must have. Returns nothing for a root key with a single item, whose type take_
    /// checks.
    std::optional<JsonType> expected_type() const;
    std::string next_pointer() const;
    JsonPositions next_positions(JsonType type) const;
    bool is_named() const { return in_collection_ && root_key_->holds == Holds::named_items; }
    /// Returns true if the next value belongs to a root key that was refused.
    bool is_refused() const { return in_root_ && root_key_ == nullptr; }
    void hand_over();
    void miss(std::string_view key) {
        missed_.insert(key);
        miss_(key);
    }
    bool go_on() const { return !errors_.overflowed(); }
    InputError error(const TextPosition& position, std::string_view pointer,
                     std::string_view message) const {
        return {std::string(file_), position, std::string(pointer), std::string(message)};
    }

    std::string_view file_;
    JsonText& text_;
    std::span<const RootKey> keys_;
    const TakeItem& take_;
    const MissItems& miss_;
    InputErrors& errors_;

    Outline outline_;
    std::set<std::string_view> missed_; // root keys
    bool in_root_ = false;
    const RootKey* root_key_ = nullptr; // the latest; null if it was refused
    bool in_collection_ = false;        // inside the root key's value, a list or an object of items
    std::size_t skipped_ = 0;           // open arrays and objects that are skipped
    std::size_t item_count_ = 0;
    std::string name_;          // of the latest item in an object of items
    std::string key_;           // the latest in an item
    TextPosition key_position_; // of the latest key of any kind
    JsonDocument item_;
};

Outline ItemParser::finish() {
    for (const RootKey& key : keys_)
        if (key.required && !outline_.values.contains(key.name) && !missed_.contains(key.name))
            errors_.add(
                error(outline_.root, "", "must have the key \"" + std::string(key.name) + '"'));
    return std::move(outline_);
}

bool ItemParser::number_float(json::number_float_t value, const std::string& digits) {
    std::string text = digits;
    // The parser writes the decimal point of the C locale.
    for (char& c : text)
        if ((c < '0' || c > '9') && c != '-' && c != '+' && c != 'e' && c != 'E') c = '.';
    return scalar(JsonType::number, text, value);
}

bool ItemParser::key(const std::string& key) {
    if (skipped_ > 0) return true;
    key_position_ = text_.position_of_parsed(false);
    if (item_.depth() > 0) {
        if (item_.innermost().find(key))
            errors_.add(error(key_position_, item_.innermost().pointer() + pointer_token(key),
                              "must be given only once"));
        key_ = key;
    } else if (in_collection_) {
        name_ = key;
    } else {
        root_key(key);
    }
    return go_on();
}

void ItemParser::root_key(std::string_view key) {
    std::vector<std::string_view> names;
    for (const RootKey& known : keys_)
        names.push_back(known.name);
    const std::size_t index =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), key) - names.begin());
    root_key_ = nullptr;
    if (index == names.size()) {
        errors_.add(error(key_position_, "", unknown_key(key, names)));
        if (const auto meant = nearest_to(key, names)) miss(*meant);
    } else if (outline_.values.contains(key)) {
        errors_.add(error(key_position_, pointer_token(key), "must be given only once"));
        miss(names[index]);
    } else {
        root_key_ = &keys_[index];
    }
}

bool ItemParser::scalar(JsonType type, std::string_view text, double number) {
    if (skipped_ > 0 || is_refused()) return true;
    if (add(type, text, number) && item_.depth() == 0) hand_over();
    return go_on();
}

bool ItemParser::open(JsonType type) {
    if (skipped_ > 0 || is_refused()) {
        ++skipped_;
    } else if (item_.depth() > 0 || in_collection_ || expected_type() != type) {
        if (!add(type, "", 0.0)) {
            item_.close();
            ++skipped_;
        }
    } else if (in_root_) {
        outline_.values[root_key_->name] = text_.position_of_parsed(false);
        in_collection_ = true;
        item_count_ = 0;
    } else {
        outline_.root = text_.position_of_parsed(false);
        in_root_ = true;
    }
    return go_on();
}

bool ItemParser::close() {
    if (skipped_ > 0) {
        --skipped_;
    } else if (item_.depth() > 0) {
        item_.close();
        if (item_.depth() == 0) hand_over();
    } else {
        in_collection_ = false;
    }
    return go_on();
}

void ItemParser::hand_over() {
    try {
        take_(*root_key_, is_named() ? std::string_view(name_) : "", item_);
    } catch (const BadInput& bad) {
        errors_.add(bad);
    }
    ++item_count_;
}

bool ItemParser::add(JsonType type, std::string_view text, double number) {
    const bool starts = item_.depth() == 0;
    const JsonPositions positions = next_positions(type);
    if (starts) item_.begin(file_, next_pointer());
    if (starts && in_root_ && !in_collection_)
        outline_.values.try_emplace(root_key_->name, positions.value);
    item_.add(type, positions, key_, text, number);
    // Reports the error here, before the rest of a list of the wrong type is read.
    const auto expected = expected_type();
    if (starts && !in_collection_ && expected && *expected != type) {
        const InputError wrong = item_.root().error_expecting(name_of(*expected));
        if (!in_root_) throw BadInput({wrong});
        errors_.add(wrong);
        miss(root_key_->name);
        return false;
    }
    const auto refuse = [&](const std::string& message) {
        throw BadInput({error(item_.root().positions().value, item_.root().pointer(), message)});
    };
    const bool nested = in_root_ && root_key_->items == Items::nested;
    const Most& most = nested ? max_of_nested : max_of_plain;
    if (item_.depth() > most.depth)
        refuse("must not be nested more than " + std::to_string(most.depth) + " deep");
    if (item_.values() > most.values || item_.text_bytes() > most.text)
        refuse("must not hold more than " + std::to_string(most.values) + " values or " +
               std::to_string(most.text) + " bytes of text");
    return true;
}

JsonPositions ItemParser::next_positions(JsonType type) const {
    return {text_.position_of_parsed(type == JsonType::number), key_position_};
}

std::optional<JsonType> ItemParser::expected_type() const {
    if (!in_root_) return JsonType::object;
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
        if (skipped_ > 0 || is_refused())
            text_.fail(text_.token_at(read - 2),
                       "must be a number that fits a double, got " + printable(token));
        add(JsonType::number, token, std::numeric_limits<double>::infinity());
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
    // A structural character that cuts a number or a literal short is itself valid.
    if (is_structural() && is_within_token(error.what()) && read > 1)
        found = text_.token_at(read - 2);
    text_.fail(found,
               expectation + ", got " + (is_structural() ? "'" + found.start + "'" : found.start));
}

} // namespace

Outline read_items(InputFile& file, std::span<const RootKey> keys, const TakeItem& take,
                   const MissItems& miss, InputErrors& errors, Parameters& parameters) {
    try {
        JsonText text(file);
        ItemParser parser(file.name(), text, keys, take, miss, errors, parameters);
        if (json::sax_parse(JsonTextIterator(text), JsonTextIterator(), &parser))
            return parser.finish();
    } catch (const BadInput& fatal) {
        errors.add(fatal);
    }
    errors.report();
    return {};
}

} // namespace raylane::scenes
