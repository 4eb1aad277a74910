#include "scenes/formats/json/value.hpp"

#include "core/scene/transfer.hpp"
#include "core/shapes/checks.hpp"
#include "scenes/files/number.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace raylane::scenes {

namespace {

/// Returns the float nearest to a decimal number, or infinity if the number is too large. `rounded`
/// is the nearest double; converting it would round twice.
float nearest_float(std::string_view text, double rounded) {
    float number = 0.0F;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc::result_out_of_range) return number;
    const float limit = std::abs(rounded) > 1.0 ? std::numeric_limits<float>::infinity() : 0.0F;
    return std::copysign(limit, static_cast<float>(rounded));
}

std::string in_quotes(std::string_view text) {
    return '"' + printable(text) + '"';
}

/// `"a", "b" or "c"`
std::string quoted_alternatives(const std::vector<std::string_view>& names) {
    std::vector<std::string> quoted;
    quoted.reserve(names.size());
    for (const std::string_view name : names)
        quoted.push_back(in_quotes(name));
    return alternatives(quoted);
}

} // namespace

std::string_view name_of(JsonType type) {
    switch (type) {
    case JsonType::null:
        return "null";
    case JsonType::boolean:
        return "true or false";
    case JsonType::number:
        return "a number";
    case JsonType::string:
        return "a string";
    case JsonType::array:
        return "an array";
    case JsonType::object:
        break;
    }
    return "an object";
}

std::string pointer_token(std::string_view key) {
    std::string token = "/";
    for (const char c : printable(key)) {
        if (c == '~')
            token += "~0";
        else if (c == '/')
            token += "~1";
        else
            token += c;
    }
    return token;
}

std::string unknown_key(std::string_view key, const std::vector<std::string_view>& known) {
    const std::string near = suggestion(key, known);
    return "unknown key " + in_quotes(key) +
           (near.empty() ? ", must be " + quoted_alternatives(known) : near);
}

void JsonDocument::begin(std::string_view file, std::string pointer) {
    file_ = file;
    pointer_ = std::move(pointer);
    nodes_.clear();
    open_.clear();
    text_.clear();
}

void JsonDocument::add(JsonType type, const JsonPositions& positions, std::string_view key,
                       std::string_view text, double number) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    const std::uint32_t parent = open_.empty() ? 0 : open_.back();
    const bool named = !open_.empty() && nodes_[parent].type == JsonType::object;
    const bool opens = type == JsonType::array || type == JsonType::object;
    nodes_.push_back({type, parent, opens ? 0 : index + 1, keep(named ? key : ""), keep(text),
                      number, positions});
    if (opens) open_.push_back(index);
}

void JsonDocument::close() {
    nodes_[open_.back()].end = static_cast<std::uint32_t>(nodes_.size());
    open_.pop_back();
}

JsonDocument::Text JsonDocument::keep(std::string_view text) {
    const Text kept{static_cast<std::uint32_t>(text_.size()),
                    static_cast<std::uint32_t>(text.size())};
    text_.append(text);
    return kept;
}

JsonValue JsonDocument::root() const {
    return {*this, 0};
}
JsonValue JsonDocument::innermost() const {
    return {*this, open_.back()};
}
JsonValue JsonDocument::latest() const {
    return {*this, static_cast<std::uint32_t>(nodes_.size() - 1)};
}

std::vector<JsonValue> JsonValue::children() const {
    std::vector<JsonValue> values;
    for (std::uint32_t i = node_ + 1; i < document_->end_of(node_); i = document_->end_of(i))
        values.emplace_back(*document_, i);
    return values;
}

std::string JsonValue::pointer() const {
    if (node_ == 0) return document_->pointer_;
    const JsonValue parent(*document_, node().parent);
    if (parent.type() == JsonType::object) return parent.pointer() + pointer_token(key());
    std::size_t index = 0;
    for (std::uint32_t i = node().parent + 1; i < node_; i = document_->end_of(i))
        ++index;
    return parent.pointer() + '/' + std::to_string(index);
}

std::string JsonValue::quoted() const {
    const std::string_view text = document_->get(node().text);
    switch (type()) {
    case JsonType::null:
        return "null";
    case JsonType::boolean:
        return boolean() ? "true" : "false";
    case JsonType::number:
        return printable(text);
    case JsonType::string:
        return in_quotes(text);
    case JsonType::array:
        return "an array";
    case JsonType::object:
        break;
    }
    return "an object";
}

bool JsonValue::is_number() const {
    return type() == JsonType::number ||
           (type() == JsonType::string && is_reference(document_->get(node().text)));
}

template <class Use>
auto JsonValue::with_number(const Use& use) const {
    if (type() == JsonType::number) return use(document_->get(node().text), node().number);
    const Parameters::Number number = referred();
    return use(std::string_view(number.text), number.value);
}

Parameters::Number JsonValue::referred() const {
    if (!is_number()) fail_expecting("a number");
    return number_of(document_->get(node().text));
}

Parameters::Number JsonValue::number_of(std::string_view text) const {
    Parameters& parameters = document_->parameters_;
    if (auto number = parameters.find(text)) return *std::move(number);
    if (parameters.is_wrong(text)) throw consequence();
    const std::string_view name = text.substr(text.find('$') + 1);
    if (!is_parameter_name(name))
        fail_expecting("a number, or $ and a name of letters, digits and underscores");
    const BadInput missing({error("must have a value, by \"parameters\" or --set, got " +
                                  in_quotes(text) + suggestion(name, parameters.names(), "$"))});
    if (parameters.may_lack_some) throw consequence();
    if (parameters.expects_more) throw LateParameter{missing};
    if (parameters.note_missing(name)) throw consequence();
    throw missing;
}

JsonValue JsonValue::toward(std::string_view path) const {
    const std::size_t slash = std::min(path.find('/'), path.size());
    const std::string_view step = path.substr(0, slash);
    const std::vector<JsonValue> values = children();
    std::size_t index = values.size();
    if (type() == JsonType::array)
        std::from_chars(step.data(), step.data() + step.size(), index);
    else
        for (index = 0; index < values.size() && values[index].key() != step;)
            ++index;
    if (index >= values.size()) return *this;
    return slash == path.size() ? values[index] : values[index].toward(path.substr(slash + 1));
}

InputError JsonValue::error(std::string_view message) const {
    return {std::string(file()), positions().value, pointer(), std::string(message)};
}

InputError JsonValue::error_expecting(std::string_view expected) const {
    return error("must be " + std::string(expected) + ", got " + quoted());
}

void JsonValue::fail(std::string_view message) const {
    throw BadInput({error(message)});
}

void JsonValue::fail_expecting(std::string_view expected) const {
    throw BadInput({error_expecting(expected)});
}

void JsonValue::fail(const core::InvalidValue& invalid) const {
    InputError wrong = error(invalid.expectation);
    if (!invalid.field.empty()) wrong.place.append("/").append(invalid.field);
    const JsonValue at = toward(invalid.field);
    wrong.position = at.positions().value;
    if (at.type() == JsonType::number && invalid.expectation.ends_with("got 0") &&
        vanishes_in_float(at.quoted()))
        wrong.message.append(", the float nearest to ").append(at.quoted());
    throw BadInput({wrong});
}

void JsonValue::fail_choice(const std::vector<std::string_view>& names) const {
    fail("must be " + quoted_alternatives(names) + ", got " + quoted() +
         suggestion(string(), names));
}

void JsonValue::require(JsonType wanted) const {
    if (type() != wanted) fail_expecting(name_of(wanted));
}

void JsonValue::allow_only(std::span<const std::string_view> keys) const {
    require(JsonType::object);
    std::vector<InputError> errors;
    for (const JsonValue& child : children()) {
        if (std::find(keys.begin(), keys.end(), child.key()) != keys.end()) continue;
        errors.push_back(error(unknown_key(child.key(), {keys.begin(), keys.end()})));
        errors.back().position = child.positions().key;
    }
    if (!errors.empty()) throw BadInput(std::move(errors));
}

std::optional<JsonValue> JsonValue::find(std::string_view wanted) const {
    require(JsonType::object);
    for (std::uint32_t i = node_ + 1; i < document_->end_of(node_); i = document_->end_of(i))
        if (document_->get(document_->nodes_[i].key) == wanted) return JsonValue(*document_, i);
    return std::nullopt;
}

JsonValue JsonValue::at(std::string_view wanted) const {
    const std::optional<JsonValue> value = find(wanted);
    if (!value) fail("must have the key " + in_quotes(wanted));
    return *value;
}

void JsonValue::exclude(std::string_view one, std::string_view other) const {
    const std::optional<JsonValue> first = find(one), second = find(other);
    if (!first || !second) return;
    InputError both = error("must not have both " + in_quotes(one) + " and " + in_quotes(other));
    both.position = (first->node_ < second->node_ ? second : first)->positions().key;
    throw BadInput({both});
}

std::vector<JsonValue> JsonValue::array(std::size_t count, std::string_view elements) const {
    const std::string expected =
        "an array of " + std::to_string(count) + ' ' + std::string(elements);
    if (type() != JsonType::array) fail_expecting(expected);
    std::vector<JsonValue> values = children();
    if (values.size() != count)
        fail("must be " + expected + ", got " + std::to_string(values.size()));
    return values;
}

std::vector<JsonValue> JsonValue::array(std::string_view elements) const {
    if (type() != JsonType::array) fail_expecting("an array of " + std::string(elements));
    return children();
}

float JsonValue::number() const {
    return with_number([this](std::string_view text, double rounded) {
        const float number = nearest_float(text, rounded);
        if (std::isinf(number)) fail_expecting("a number from -1e30 to 1e30");
        return number;
    });
}

double JsonValue::real() const {
    return with_number([this](std::string_view text, double number) {
        if (std::isinf(number)) fail_expecting("a number from -1e30 to 1e30");
        if (std::abs(number) < core::min_double)
            return static_cast<double>(nearest_float(text, number));
        return number;
    });
}

int JsonValue::integer() const {
    if (!is_number()) fail_expecting("a whole number");
    return with_number([this](std::string_view text, double) {
        double value = 0.5;
        std::from_chars(text.data(), text.data() + text.size(), value);
        if (std::trunc(value) != value) fail("must be a whole number, got " + printable(text));
        if (std::abs(value) > std::numeric_limits<int>::max())
            fail_expecting("a whole number of at most " +
                           std::to_string(std::numeric_limits<int>::max()));
        return static_cast<int>(value);
    });
}

bool JsonValue::boolean() const {
    require(JsonType::boolean);
    return node().number != 0.0;
}

std::string_view JsonValue::string() const {
    require(JsonType::string);
    return document_->get(node().text);
}

core::Vec3f JsonValue::vector() const {
    const std::vector<JsonValue> values = array(3, "numbers");
    return {values[0].number(), values[1].number(), values[2].number()};
}

core::Vec3d JsonValue::real_vector() const {
    const std::vector<JsonValue> values = array(3, "numbers");
    return {values[0].real(), values[1].real(), values[2].real()};
}

core::Color JsonValue::color() const {
    if (type() == JsonType::array) return vector();
    const std::string_view text = type() == JsonType::string ? string() : "";
    const auto color = core::color_from_srgb(text);
    if (!color) fail_expecting("[red, green, blue] or \"#rrggbb\"");
    return *color;
}

} // namespace raylane::scenes
