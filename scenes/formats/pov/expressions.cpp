#include "scenes/formats/pov/expressions.hpp"

#include "core/scene/transfer.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::scenes::pov {

namespace {

Tuple read_unary(Tokens& tokens);

template <class Operation>
Tuple combined(const Tuple& a, const Tuple& b, const Operation& operation) {
    Tuple result{{}, std::max(a.size, b.size)};
    for (std::size_t i = 0; i < static_cast<std::size_t>(result.size); ++i)
        result.at[i] = operation(a.size == 1 ? a.at[0] : a.at[i], b.size == 1 ? b.at[0] : b.at[i]);
    return result;
}

/// Returns the colour of "rgbt" and the like from numbers: red, green, blue, filter, transmit.
Tuple color_by(std::string_view word, const Tuple& given) {
    Tuple color{{}, 5};
    const bool is_srgb = word.starts_with("s");
    const std::string_view channels = word.substr(word.find('b') + 1);
    const std::size_t count = std::min<std::size_t>(3, 3 + channels.size());
    for (std::size_t i = 0; i < count; ++i) {
        color.at[i] = given.size == 1 ? given.at[0] : given.at[i];
        if (is_srgb) color.at[i] = core::linear_of_srgb(color.at[i]);
    }
    const bool is_color = given.size == 5;
    std::size_t next = 3;
    for (const char channel : channels) {
        const std::size_t at = channel == 'f' ? 3 : 4;
        color.at[at] = given.size == 1 ? given.at[0] : given.at[is_color ? at : next++];
    }
    return color;
}

constexpr std::string_view color_words[] = {"rgb",  "rgbf",  "rgbt",  "rgbft",
                                            "srgb", "srgbf", "srgbt", "srgbft"};
constexpr std::string_view channel_words[] = {"red", "green", "blue", "filter", "transmit"};

template <std::size_t count>
std::size_t place_in(const std::string_view (&words)[count], const Token& token) {
    if (token.kind != TokenKind::word) return count;
    return static_cast<std::size_t>(std::find(words, words + count, token.text) - words);
}
bool is_color_word(const Token& token) {
    return place_in(color_words, token) < std::size(color_words);
}
bool is_channel(const Token& token) {
    return place_in(channel_words, token) < std::size(channel_words);
}

Tuple read_vector_literal(Tokens& tokens, const Place& place) {
    Tuple vector{{}, 0};
    ++tokens.open_brackets;
    do {
        if (vector.size == 5) fail(place, "must be a vector of at most five numbers");
        const Place component_place = tokens.peek().place;
        const Tuple component = read_tuple(tokens);
        if (component.size != 1) fail(component_place, "must be a number, got a vector");
        vector.at[static_cast<std::size_t>(vector.size++)] = component.at[0];
        tokens.accept(",");
    } while (!tokens.at(">"));
    tokens.expect(">");
    --tokens.open_brackets;
    return vector;
}

/// Reads a number, a name, a function, or an expression in brackets.
Tuple read_primary(Tokens& tokens) {
    const Token token = tokens.next();
    if (token.kind == TokenKind::number) return Tuple::of(token.number);
    if (token.is("<")) return read_vector_literal(tokens, token.place);
    if (token.is("(")) {
        const Tuple inner = read_relation(tokens);
        tokens.expect(")");
        return inner;
    }
    if (is_color_word(token)) return color_by(token.text, read_unary(tokens));
    if (token.is("color") || token.is("colour")) return read_color(tokens);
    if (const Value* value = tokens.value_of(token)) {
        if (const auto* tuple = value->get_if<Tuple>()) return *tuple;
        fail(token.place, "must be the name of a number, vector or colour, got " + token.quoted());
    }
    if (token.kind == TokenKind::word) {
        if (const std::optional<Tuple> made = read_function(tokens, token)) return *made;
    }
    if (token.kind == TokenKind::word)
        fail(token.place,
             "must be a number, got the unknown name " + token.quoted() + tokens.origin_of(token));
    fail(token.place, "must be a number, got " + token.quoted());
}

/// Reads the name in ".x" or ".red", and returns that component.
Tuple component_of(Tokens& tokens, const Tuple& tuple) {
    const Token name = tokens.next();
    static constexpr std::string_view axes[] = {"x", "y", "z", "u", "v"};
    const std::size_t channel = place_in(channel_words, name);
    std::size_t index = channel;
    if (channel == std::size(channel_words)) {
        index = place_in(axes, name);
        if (index >= 3 && index < std::size(axes)) index -= 3; // u and v are the first two
        if (name.is("t")) index = 3;
        if (name.is("gray"))
            return Tuple::of(0.297 * tuple.at[0] + 0.589 * tuple.at[1] + 0.114 * tuple.at[2]);
    }
    if (index >= 5) fail(name.place, "must be a component, got " + name.quoted());
    return Tuple::of(tuple.size == 1 ? tuple.at[0] : tuple.at[index]);
}

Tuple read_unary(Tokens& tokens) {
    const Token& sign = tokens.peek();
    const Level level(tokens.depth, sign.place);
    if (tokens.accept("+")) return read_unary(tokens);
    if (tokens.accept("-"))
        return combined(Tuple::of(0.0), read_unary(tokens),
                        [](double a, double b) { return a - b; });
    if (tokens.accept("!")) return Tuple::of(read_unary(tokens).at[0] == 0.0 ? 1.0 : 0.0);
    Tuple value = read_primary(tokens);
    while (tokens.ahead().is(".")) {
        tokens.next();
        value = component_of(tokens, value);
    }
    return value;
}

Tuple read_product(Tokens& tokens) {
    Tuple value = read_unary(tokens);
    for (;;) {
        const Token& sign = tokens.ahead();
        if (sign.is("*")) {
            tokens.next();
            value = combined(value, read_unary(tokens), [](double a, double b) { return a * b; });
        } else if (sign.is("/")) {
            const Place place = tokens.next().place;
            value = combined(value, read_unary(tokens), [&](double a, double b) {
                if (b == 0.0) fail(place, "must not be divided by 0");
                return a / b;
            });
        } else {
            return value;
        }
    }
}

double comparison(std::string_view sign, double a, double b) {
    const bool holds = sign == "<"    ? a < b
                       : sign == "<=" ? a <= b
                       : sign == ">"  ? a > b
                       : sign == ">=" ? a >= b
                       : sign == "="  ? a == b
                                      : a != b;
    return holds ? 1.0 : 0.0;
}

bool is_comparison(const Token& sign) {
    static constexpr std::string_view signs[] = {"<", "<=", ">", ">=", "=", "!="};
    return sign.is_one_of(signs);
}

/// Compares two strings by their bytes.
Tuple read_comparison_of_strings(Tokens& tokens) {
    const std::string first = read_string(tokens);
    const Token sign = tokens.next();
    if (!is_comparison(sign))
        fail(sign.place, "must compare the string with another, got " + sign.quoted());
    return Tuple::of(comparison(sign.text, first.compare(read_string(tokens)), 0.0));
}

Tuple read_comparison(Tokens& tokens) {
    if (at_string(tokens)) return read_comparison_of_strings(tokens);
    Tuple value = read_tuple(tokens);
    for (;;) {
        const Token sign = tokens.ahead();
        if (!is_comparison(sign)) return value;
        tokens.next();
        value = Tuple::of(comparison(sign.text, value.at[0], read_tuple(tokens).at[0]));
    }
}

} // namespace

bool at_string(Tokens& tokens) {
    const Token& token = tokens.peek();
    if (begins_string(token)) return true;
    const Value* value = tokens.value_of(token);
    return value != nullptr && value->get_if<std::string>() != nullptr;
}

Tuple read_tuple(Tokens& tokens) {
    Tuple value = read_product(tokens);
    for (;;) {
        const Token& sign = tokens.ahead();
        if (sign.is("+")) {
            tokens.next();
            value = combined(value, read_product(tokens), [](double a, double b) { return a + b; });
        } else if (sign.is("-")) {
            tokens.next();
            value = combined(value, read_product(tokens), [](double a, double b) { return a - b; });
        } else {
            return value;
        }
    }
}

Tuple read_relation(Tokens& tokens) {
    const Level level(tokens.depth, tokens.peek().place);
    Tuple value = read_comparison(tokens);
    while (tokens.ahead().is("&") || tokens.ahead().is("|")) {
        const bool both = tokens.next().text == "&";
        const bool other = read_comparison(tokens).at[0] != 0.0, first = value.at[0] != 0.0;
        value = Tuple::of((both ? first && other : first || other) ? 1.0 : 0.0);
    }
    if (!tokens.ahead().is("?")) return value;
    tokens.next();
    const Tuple yes = read_relation(tokens);
    tokens.expect(":");
    const Tuple no = read_relation(tokens);
    return value.at[0] != 0.0 ? yes : no;
}

double read_number(Tokens& tokens) {
    const Place place = tokens.peek().place;
    const Tuple tuple = read_tuple(tokens);
    if (tuple.size != 1) fail(place, "must be a number, got a vector");
    if (!std::isfinite(tuple.at[0])) fail(place, "must be a finite number");
    return tuple.at[0];
}

core::Vec3d read_vector(Tokens& tokens) {
    const Place place = tokens.peek().place;
    const core::Vec3d vector = read_tuple(tokens).vector();
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(vector[axis])) fail(place, "must be of finite numbers");
    return vector;
}

bool begins_color(const Token& token) {
    return is_color_word(token) || is_channel(token) || token.is("color") || token.is("colour");
}

Tuple read_color(Tokens& tokens) {
    while (tokens.at("color") || tokens.at("colour"))
        tokens.next();
    const Place place = tokens.peek().place;
    Tuple color{{}, 5};
    if (!is_channel(tokens.peek())) {
        const Tuple given = read_tuple(tokens);
        color = given.size == 5 ? given : color_by(given.size == 4 ? "rgbf" : "rgb", given);
    }
    while (is_channel(tokens.peek())) {
        const std::size_t channel = place_in(channel_words, tokens.next());
        color.at[channel] = read_number(tokens);
    }
    for (const double value : color.at)
        if (!std::isfinite(value)) fail(place, "must be of finite numbers");
    return color;
}

bool at_tuple(Tokens& tokens) {
    const Token& token = tokens.peek();
    if (token.kind == TokenKind::number || begins_color(token)) return true;
    if (token.kind == TokenKind::symbol)
        return token.is("<") || token.is("(") || token.is("-") || token.is("+") || token.is("!");
    if (const Value* value = tokens.value_of(token)) return value->get_if<Tuple>() != nullptr;
    return token.kind == TokenKind::word && is_function(token.text);
}

std::vector<std::size_t> read_indices(Tokens& tokens, std::size_t most) {
    std::vector<std::size_t> indices;
    // A directive after an array in a #declare runs after the array is declared.
    while (indices.size() < most && tokens.ahead().is("[")) {
        const Place place = tokens.next().place;
        const double index = read_number(tokens);
        if (!(index > -1.0 && index < static_cast<double>(max_elements)))
            fail(place, "must be an index of an array");
        indices.push_back(static_cast<std::size_t>(index));
        tokens.expect("]");
    }
    return indices;
}

std::size_t index_in(const Array& array, const Token& name, std::span<const std::size_t> indices) {
    if (indices.size() != array.sizes.size())
        fail(name.place, "must have " + std::to_string(array.sizes.size()) + " indices, got " +
                             std::to_string(indices.size()));
    std::size_t at = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] >= array.sizes[i])
            fail(name.place, "must have an index below " + std::to_string(array.sizes[i]) +
                                 ", got " + std::to_string(indices[i]));
        at = at * array.sizes[i] + indices[i];
    }
    return at;
}

} // namespace raylane::scenes::pov
