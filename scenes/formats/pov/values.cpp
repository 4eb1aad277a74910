#include "scenes/formats/pov/expressions.hpp"
#include "scenes/formats/pov/finishes.hpp"
#include "scenes/formats/pov/objects.hpp"
#include "scenes/formats/pov/surroundings.hpp"

#include <algorithm>
#include <utility>

namespace raylane::scenes::pov {

namespace {

template <class T>
Value shared(T value) {
    return {std::make_shared<const T>(std::move(value))};
}

/// Reads the braces of "array[2][3] { {1, 2, 3}, {4, 5, 6} }", which may be empty.
void read_elements(Tokens& tokens, Array& array, std::size_t dimension, std::size_t& at) {
    const std::vector<std::size_t>& sizes = array.sizes;
    const Place place = tokens.peek().place;
    tokens.expect("{");
    for (std::size_t i = 0; i < sizes[dimension] && !tokens.at("}"); ++i) {
        if (dimension + 1 < sizes.size())
            read_elements(tokens, array, dimension + 1, at);
        else
            set_element(tokens.budget, array, at++, tokens.copied(read_value(tokens), place),
                        place);
        tokens.accept(",");
    }
    tokens.expect("}");
}

Value read_array(Tokens& tokens, const Place& place) {
    auto array = std::make_shared<Array>();
    array->sizes = read_indices(tokens);
    std::size_t count = array->sizes.empty() ? 0 : 1;
    for (const std::size_t size : array->sizes)
        if ((count *= size) > max_elements) break;
    if (count == 0 || count > max_elements || array->sizes.size() > 4)
        fail(place, "must be an array of 1 to " + std::to_string(max_elements) + " elements");
    array->room = tokens.budget.reserve(count * sizeof(Value), place);
    array->values.resize(count);
    std::size_t at = 0;
    if (tokens.ahead().is("{")) read_elements(tokens, *array, 0, at);
    return {std::move(array)};
}

} // namespace

void set_element(Budget& budget, Array& array, std::size_t index, Value value, const Place& place) {
    constexpr std::size_t large = 512; // bytes, such as of a texture or an object
    if (value.get_if<Tuple>() == nullptr && value.get_if<std::string>() == nullptr)
        budget.keep(large, place);
    if (const auto* inner = value.get_if<std::shared_ptr<Array>>()) {
        array.depth = std::max(array.depth, (*inner)->depth + 1);
        if (array.depth > deepest)
            fail(place, "must not nest arrays more than " + std::to_string(deepest) + " deep");
    }
    array.values[index] = std::move(value);
}

Value read_value(Tokens& tokens) {
    const Token word = tokens.peek();
    const Level level(tokens.depth, word.place);
    if (at_tuple(tokens)) return {begins_color(word) ? read_color(tokens) : read_tuple(tokens)};
    if (begins_string(word)) return {read_string(tokens)};
    if (tokens.accept("array")) return read_array(tokens, word.place);
    if (tokens.accept("texture")) return {read_layers(tokens)};
    if (tokens.accept("pigment"))
        return shared(read_pigment(tokens, tokens.default_texture->pigment));
    if (tokens.accept("finish")) return shared(read_finish(tokens, tokens.default_texture->finish));
    if (tokens.accept("material")) return shared(read_material(tokens));
    if (tokens.accept("interior")) return shared(read_interior(tokens));
    if (tokens.accept("transform")) return {read_transform(tokens)};
    if (tokens.accept("fog")) return shared(read_fog(tokens));
    if (tokens.accept("sky_sphere")) return shared(read_sky(tokens));
    if (tokens.accept("camera")) return shared(read_camera(tokens));
    if (const std::optional<MapOf> kind = map_of(word)) {
        tokens.next();
        return shared(read_map(tokens, *kind));
    }
    if (tokens.accept("function")) return tokens.read_function_value();
    static constexpr std::string_view not_drawn[] = {"density",   "density_map", "media",
                                                     "normal",    "normal_map",  "rainbow",
                                                     "slope_map", "spline"};
    if (word.is_one_of(not_drawn)) {
        tokens.next();
        tokens.skip_braces();
        return {NotDrawn{}};
    }
    if (begins_object(tokens, word)) return {read_object(tokens)};
    if (const Value* value = tokens.value_of(word)) {
        Value copy = *value;
        tokens.next();
        return copy;
    }
    if (word.kind == TokenKind::word) return {read_object(tokens)}; // fails
    fail(word.place, "must be a supported value, got " + word.quoted());
}

} // namespace raylane::scenes::pov
