#include "core/numbers/elementary.hpp"
#include "core/numbers/more_functions.hpp"
#include "scenes/formats/pov/expressions.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace raylane::scenes::pov {

namespace {

using core::Vec3d;

constexpr double degree = std::numbers::pi / 180.0;

struct Constant {
    std::string_view name;
    Tuple value;
};

/// The size of the image, which a scene does not have: that of POV-Ray's own examples.
constexpr double usual_width = 640.0, usual_height = 480.0;

const Constant constants[] = {
    {"x", {{1.0, 0.0, 0.0}, 3}},
    {"y", {{0.0, 1.0, 0.0}, 3}},
    {"z", {{0.0, 0.0, 1.0}, 3}},
    {"u", {{1.0, 0.0}, 2}},
    {"v", {{0.0, 1.0}, 2}},
    {"t", {{0.0, 0.0, 0.0, 1.0}, 4}},
    {"pi", {{std::numbers::pi}, 1}},
    {"true", {{1.0}, 1}},
    {"on", {{1.0}, 1}},
    {"yes", {{1.0}, 1}},
    {"false", {{0.0}, 1}},
    {"off", {{0.0}, 1}},
    {"no", {{0.0}, 1}},
    {"clock", {{0.0}, 1}},
    {"initial_clock", {{0.0}, 1}},
    {"final_clock", {{0.0}, 1}},
    {"clock_delta", {{0.0}, 1}},
    {"clock_on", {{0.0}, 1}},
    {"frame_number", {{0.0}, 1}},
    {"initial_frame", {{0.0}, 1}},
    {"final_frame", {{0.0}, 1}},
    {"image_width", {{usual_width}, 1}},
    {"image_height", {{usual_height}, 1}},
};

using OfOne = double (*)(double);
using OfTwo = double (*)(double, double);

// Returns NaN for an argument that is not finite. A scene with that value is refused.
double sine(double a) {
    return std::isfinite(a) ? core::sin(a) : a - a;
}
double cosine(double a) {
    return std::isfinite(a) ? core::cos(a) : a - a;
}

struct FunctionOfOne {
    std::string_view name;
    OfOne call;
};
const FunctionOfOne functions_of_one[] = {
    {"abs", [](double a) { return std::abs(a); }},
    {"acos", [](double a) { return core::acos(a); }},
    {"acosh", [](double a) { return core::acosh(a); }},
    {"asin", [](double a) { return core::asin(a); }},
    {"asinh", [](double a) { return core::asinh(a); }},
    {"atan", [](double a) { return core::atan(a); }},
    {"atanh", [](double a) { return core::atanh(a); }},
    {"ceil", [](double a) { return std::ceil(a); }},
    {"cos", cosine},
    {"cosh", [](double a) { return core::cosh(a); }},
    {"degrees", [](double a) { return a / degree; }},
    {"exp", [](double a) { return std::isnan(a) ? a : core::exp(a); }},
    {"floor", [](double a) { return std::floor(a); }},
    {"int", [](double a) { return std::trunc(a); }},
    {"ln", [](double a) { return core::log(a); }},
    {"log", [](double a) { return core::log10(a); }},
    {"radians", [](double a) { return a * degree; }},
    {"sin", sine},
    {"sinh", [](double a) { return core::sinh(a); }},
    {"sqr", [](double a) { return a * a; }},
    {"sqrt", [](double a) { return std::sqrt(a); }},
    {"tan", [](double a) { return core::tan(a); }},
    {"tanh", [](double a) { return core::tanh(a); }},
};

struct FunctionOfTwo {
    std::string_view name;
    OfTwo call;
};
const FunctionOfTwo functions_of_two[] = {
    {"atan2", [](double a, double b) { return core::atan2(a, b); }},
    {"div", [](double a, double b) { return std::trunc(a / b); }},
    {"max", [](double a, double b) { return std::max(a, b); }},
    {"min", [](double a, double b) { return std::min(a, b); }},
    {"mod", [](double a, double b) { return std::fmod(a, b); }},
    {"pow", [](double a, double b) { return core::power(a, b); }},
};

constexpr std::string_view of_vectors[] = {"vlength", "vnormalize",   "vdot",    "vcross",
                                           "vrotate", "vaxis_rotate", "defined", "dimension_size",
                                           "version", "strlen",       "strcmp",  "asc",
                                           "val",     "select",       "seed",    "rand"};

template <class Table>
auto* entry(Table& table, std::string_view name) {
    const auto found = std::find_if(std::begin(table), std::end(table),
                                    [&](const auto& entry) { return entry.name == name; });
    return found == std::end(table) ? nullptr : found;
}

/// Rotates by Rodrigues' formula.
Vec3d turned(const Vec3d& v, const Vec3d& axis, double degrees) {
    if (axis == Vec3d(0.0)) return v;
    const Vec3d k = core::normalized(axis);
    const double c = cosine(degrees * degree), s = sine(degrees * degree);
    return c * v + s * core::cross(k, v) + ((1.0 - c) * core::dot(k, v)) * k;
}

/// Reads the arguments of "dimension_size(ARRAY, NUMBER)".
Tuple read_dimension_size(Tokens& tokens) {
    tokens.expect("(");
    const Token name = tokens.next();
    const Value* value = tokens.value_of(name);
    const auto* found = value != nullptr ? value->get_if<std::shared_ptr<Array>>() : nullptr;
    // Keeps the array alive while the number is read, which may declare the array's name again.
    const std::shared_ptr<Array> array = found != nullptr ? *found : nullptr;
    if (array == nullptr) fail(name.place, "must be the name of an array, got " + name.quoted());
    tokens.expect(",");
    const double which = read_number(tokens);
    const auto& sizes = array->sizes;
    if (!(which >= 1.0 && which <= static_cast<double>(sizes.size())))
        fail(name.place, "must have a dimension of that number, got " + name.quoted());
    tokens.expect(")");
    return Tuple::of(static_cast<double>(sizes[static_cast<std::size_t>(which) - 1]));
}

/// Reads the arguments of "select(A, BELOW, AT, ABOVE)", which compares A with 0. Without ABOVE, AT
/// applies above 0, too.
Tuple read_select(Tokens& tokens) {
    const double by = read_number(tokens);
    Tuple values[3];
    for (Tuple& value : values) {
        if (&value == &values[2] && !tokens.at(",")) {
            value = values[1];
            break;
        }
        tokens.expect(",");
        value = read_relation(tokens);
    }
    return values[by < 0.0 ? 0 : by == 0.0 ? 1 : 2];
}

/// Returns the number that a text begins with, or 0.
double leading_value(std::string_view text) {
    const std::string_view number =
        text.substr(std::min(text.find_first_not_of(" \t\n"), text.size()));
    double value = 0.0;
    const char* first = number.data() + (number.starts_with('+') ? 1 : 0);
    std::from_chars(first, number.data() + number.size(), value);
    return std::isfinite(value) ? value : 0.0;
}

/// Evaluates a function of strings, or of a stream of random numbers that seed() has begun.
Tuple of_strings_or_streams(Tokens& tokens, const Token& name) {
    if (name.is("seed")) {
        const double seed = std::fmod(std::trunc(read_number(tokens)), 4294967296.0);
        return Tuple::of(
            tokens.begin_random(static_cast<std::uint32_t>(static_cast<std::int64_t>(seed))));
    }
    if (name.is("rand")) {
        const Place place = tokens.peek().place;
        return Tuple::of(tokens.next_random(read_number(tokens), place));
    }
    const Place place = tokens.peek().place;
    const std::string text = read_string(tokens);
    if (name.is("strlen")) return Tuple::of(static_cast<double>(text.size()));
    if (name.is("asc")) {
        if (text.empty()) fail(place, "must be a string that is not empty");
        return Tuple::of(static_cast<double>(static_cast<unsigned char>(text[0])));
    }
    if (name.is("val")) return Tuple::of(leading_value(text));
    tokens.expect(",");
    const int order = text.compare(read_string(tokens));
    return Tuple::of(order < 0 ? -1.0 : order > 0 ? 1.0 : 0.0);
}

Tuple of_vectors_named(Tokens& tokens, const Token& name) {
    if (name.is("version")) return Tuple::of(tokens.version.value_or(3.7));
    if (name.is("defined")) return Tuple::of(tokens.read_is_declared() ? 1.0 : 0.0);
    if (name.is("dimension_size")) return read_dimension_size(tokens);
    tokens.expect("(");
    Tuple result;
    if (name.is("select")) {
        result = read_select(tokens);
    } else if (name.is("val") || !name.text.starts_with('v')) {
        result = of_strings_or_streams(tokens, name);
    } else {
        const Vec3d a = read_vector(tokens);
        const bool of_one = name.is("vlength") || name.is("vnormalize");
        Vec3d b(0.0);
        if (!of_one) {
            tokens.accept(",");
            b = read_vector(tokens);
        }
        const double size = core::length(a);
        if (name.is("vlength")) result = Tuple::of(size);
        if (name.is("vnormalize")) result = Tuple::of(size > 0.0 ? a / size : a);
        if (name.is("vdot")) result = Tuple::of(core::dot(a, b));
        if (name.is("vcross")) result = Tuple::of(core::cross(a, b));
        if (name.is("vrotate")) {
            Vec3d v = turned(a, {1.0, 0.0, 0.0}, b.x);
            v = turned(v, {0.0, 1.0, 0.0}, b.y);
            result = Tuple::of(turned(v, {0.0, 0.0, 1.0}, b.z));
        }
        if (name.is("vaxis_rotate")) {
            tokens.accept(",");
            result = Tuple::of(turned(a, b, read_number(tokens)));
        }
    }
    tokens.expect(")");
    return result;
}

} // namespace

double Tokens::begin_random(std::uint32_t seed) {
    if (random_.size() < max_elements) random_.push_back(seed);
    random_.back() = seed;
    return static_cast<double>(random_.size() - 1);
}

/// Uses POV-Ray's generator, so that the scene is the same.
double Tokens::next_random(double stream, const Place& place) {
    if (!(stream >= 0.0 && stream < static_cast<double>(random_.size())))
        fail(place, "must be a result of seed()");
    std::uint32_t& state = random_[static_cast<std::size_t>(stream)];
    state = state * 1812433253U + 12345U;
    return static_cast<double>(state) / 4294967295.0;
}

bool is_function(std::string_view name) {
    return entry(constants, name) != nullptr || entry(functions_of_one, name) != nullptr ||
           entry(functions_of_two, name) != nullptr ||
           std::find(std::begin(of_vectors), std::end(of_vectors), name) != std::end(of_vectors);
}

std::optional<Tuple> read_function(Tokens& tokens, const Token& name) {
    if (const Constant* constant = entry(constants, name.text)) return constant->value;
    if (const FunctionOfOne* function = entry(functions_of_one, name.text)) {
        tokens.expect("(");
        const double a = read_relation(tokens).at[0];
        tokens.expect(")");
        return Tuple::of(function->call(a));
    }
    if (const FunctionOfTwo* function = entry(functions_of_two, name.text)) {
        tokens.expect("(");
        double result = read_relation(tokens).at[0];
        do {
            tokens.expect(",");
            result = function->call(result, read_relation(tokens).at[0]);
        } while (tokens.at(","));
        tokens.expect(")");
        return Tuple::of(result);
    }
    if (std::find(std::begin(of_vectors), std::end(of_vectors), name.text) == std::end(of_vectors))
        return std::nullopt;
    return of_vectors_named(tokens, name);
}

} // namespace raylane::scenes::pov
