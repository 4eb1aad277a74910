#include "values.hpp"

#include "core/scene/fields.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <pybind11/stl.h>
#include <string>
#include <string_view>

namespace raylane::python {

namespace {

using core::fields::Field, core::fields::for_each_field, core::fields::Words;

constexpr const char* precision_words[] = {"fast", "robust", "exact", "double"};

/// Returns Python's repr() of a value on one line, truncated to about 80 bytes.
std::string shown(const py::handle& value) {
    constexpr std::size_t most = 80;
    std::string text;
    try {
        text = py::cast<std::string>(py::repr(value));
    } catch (const std::exception&) { // such as a whole number of too many digits
        text = "a value of the type " + std::string(Py_TYPE(value.ptr())->tp_name);
    }
    std::replace(text.begin(), text.end(), '\n', ' ');
    if (text.size() <= most) return text;
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
        --end; // UTF-8
    return text.substr(0, end) + "...";
}

[[noreturn]] void refuse(const std::string& field, const std::string& what, const py::handle& got) {
    throw InvalidValue(field, "must be " + what + ", got " + shown(got));
}

/// Returns a word of JSON as in Python, where names have no hyphens.
std::string word_in_python(std::string word) {
    std::replace(word.begin(), word.end(), '-', '_');
    return word;
}

template <class Enum>
Enum enum_from(const py::handle& from, const std::string& field, Words words) {
    std::string names;
    const bool is_text = PyUnicode_Check(from.ptr()) != 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string word = word_in_python(words[i]);
        if (is_text && PyUnicode_CompareWithASCIIString(from.ptr(), word.c_str()) == 0)
            return static_cast<Enum>(i);
        names += (i == 0 ? "\"" : ", \"") + word + "\"";
    }
    refuse(field, "one of " + names, from);
}

/// Returns a whole number of Python or NumPy that Python accepts as an index. Throws InvalidValue
/// outside of `least` to `most`.
template <class Int>
Int whole_from(const py::handle& from, const std::string& field, Int least, Int most) {
    const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(from.ptr()));
    if (!number) {
        PyErr_Clear();
        refuse(field, "a whole number", from);
    }
    if (number < py::int_(least) || number > py::int_(most))
        refuse(field,
               "a whole number from " + std::to_string(least) + " to " + std::to_string(most),
               from);
    return py::cast<Int>(number);
}

template <class Value>
Value cast(const py::handle& from, const std::string& field, const char* what) {
    try {
        return py::cast<Value>(from);
    } catch (const py::cast_error&) {
        refuse(field, what, from);
    }
}

void take(const py::handle& from, const std::string& field, float& to) {
    to = cast<float>(from, field, "a number");
}
void take(const py::handle& from, const std::string& field, int& to) {
    using Limits = std::numeric_limits<int>;
    to = whole_from(from, field, Limits::min(), Limits::max());
}
void take(const py::handle& from, const std::string& field, bool& to) {
    to = cast<bool>(from, field, "True or False");
}
template <class Number>
std::array<Number, 3> three(const py::handle& from, const std::string& field) {
    refuse_masked(from, field);
    try {
        return py::cast<std::array<Number, 3>>(py::tuple(py::reinterpret_borrow<py::object>(from)));
    } catch (const std::exception&) {
        refuse(field, "three numbers", from);
    }
}
void take(const py::handle& from, const std::string& field, Vec3& to) {
    const auto [x, y, z] = three<float>(from, field);
    to = {x, y, z};
}
/// Reads three numbers, or a text such as "#ff8000".
void take_color(const py::handle& from, const std::string& field, Color& to) {
    if (PyUnicode_Check(from.ptr()) == 0) return take(from, field, to);
    try {
        to = color_from_srgb(py::cast<std::string>(from));
    } catch (const InvalidValue& error) {
        throw InvalidValue(field, error.expectation);
    }
}
void take(const py::handle& from, const std::string& field, std::array<double, 3>& to) {
    to = three<double>(from, field);
}
/// Reads the bits of a checker's axes from a text such as "xz".
void take_axes(const py::handle& from, const std::string& field, int first_bit, std::uint8_t& to) {
    to = static_cast<std::uint8_t>(to & ~(7 << first_bit));
    for (const char axis : cast<std::string>(from, field, "a text as \"xz\"")) {
        if (axis < 'x' || axis > 'z') refuse(field, "a text as \"xz\"", from);
        to = static_cast<std::uint8_t>(to | 1 << (axis - 'x' + first_bit));
    }
}

template <class Value>
void take_fields(const py::handle& from, const std::string& prefix, Value& to);
/// Reads a glass: its coefficients, or its name in the catalogue.
void take(const py::handle& from, const std::string& field, Sellmeier& to) {
    if (PyUnicode_Check(from.ptr()) != 0)
        to = catalogue_glass(py::cast<std::string>(from));
    else
        take_fields(from, field + "/", to);
}
void take(const py::handle& from, const std::string& field, Outline& to) {
    take_fields(from, field + "/", to);
}
void take(const py::handle& from, const std::string& field, Color (&to)[2]) {
    py::tuple both;
    try {
        both = py::tuple(py::reinterpret_borrow<py::object>(from));
    } catch (
        const py::error_already_set&) { // not a sequence: rejected below like one of a wrong length
    }
    if (both.size() != 2) throw InvalidValue(field, "must be two colours");
    take_color(both[0], field + "/0", to[0]);
    take_color(both[1], field + "/1", to[1]);
}
void take(const py::handle& from, const std::string& field, ChannelTexts& to) {
    if (py::isinstance<py::str>(from)) // its letters would be formulas
        throw InvalidValue(field, "must be three formulas");
    const auto texts = cast<std::array<std::string, 3>>(from, field, "three formulas");
    to = {texts[0], texts[1], texts[2]};
}
/// Reads an image: a Texture, or anything that one can be made of.
void take(const py::handle& from, const std::string& field, Texture& to) {
    to = from.is_none() ? Texture() : texture_from(from, field);
}
/// Reads a material's colour: a single colour or a pattern.
void take(const py::handle& from, const std::string& field, Pattern& to) {
    if (py::hasattr(from, "kind"))
        take_fields(from, field + "/", to);
    else
        take_color(from, field, to.colors[0]);
}
template <class Value>
void take_fields(const py::handle& from, const std::string& prefix, Value& to) {
    for_each_field(
        [&]<class Member>(const Field& field, Member& member) {
            const std::string name = prefix + field.python();
            if (!py::hasattr(from, field.python()))
                throw InvalidValue(name, "is missing in " + shown(from));
            const py::object value = from.attr(field.python());
            if constexpr (std::is_enum_v<Member>)
                member = enum_from<Member>(value, name, field.valid.words);
            else if constexpr (std::is_same_v<Member, std::uint8_t>)
                take_axes(value, name, field.spelling.first_bit, member);
            else if constexpr (std::is_same_v<Member, Color>)
                field.valid.is_color ? take_color(value, name, member) : take(value, name, member);
            else
                take(value, name, member);
        },
        to);
}
template <class Value>
Value value_from(const py::handle& from) {
    Value value;
    take_fields(from, "", value);
    return value;
}
/// Reads an argument or attribute called `name`, which also begins the fields in errors. Throws
/// InvalidValue if the object has none of the fields of `type`.
template <class Value>
Value value_from(const py::handle& from, const char* type, const std::string& name) {
    Value value;
    bool is_other = true; // true if `from` has no field of Value
    for_each_field([&](const Field& field,
                       const auto&) { is_other = is_other && !py::hasattr(from, field.python()); },
                   value);
    if (is_other) refuse(name, std::string("a ") + type, from);
    take_fields(from, name + "/", value);
    return value;
}

py::object module_of_values() {
    return py::module_::import("raylane._values");
}
template <class Number>
requires std::is_arithmetic_v<Number> py::object give(Number number) {
    return py::cast(number);
}
/// Returns the shortest decimal number that rounds to this float: 0.1, where Python would show
/// 0.10000000149011612.
py::object give(float number) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, number).ptr;
    double shortest = 0.0;
    std::from_chars(text, end, shortest);
    return py::cast(shortest);
}
py::object give(const Vec3& v) {
    return to_python(v);
}
py::object give(const std::array<double, 3>& v) {
    return py::make_tuple(v[0], v[1], v[2]);
}
py::object give(const ChannelTexts& texts) {
    return py::make_tuple(texts[0], texts[1], texts[2]);
}
py::object give(const Texture& texture) {
    return texture.any() ? py::cast(texture) : py::none();
}
py::object give(const Color (&colors)[2]) {
    return py::make_tuple(to_python(colors[0]), to_python(colors[1]));
}
py::object give_axes(std::uint8_t bits, int first_bit) {
    std::string text;
    for (int axis = 0; axis < 3; ++axis)
        if ((bits >> (axis + first_bit) & 1) != 0) text += static_cast<char>('x' + axis);
    return py::str(text);
}
template <class Value>
py::object give_fields(const char* name, const Value& value);
py::object give(const Sellmeier& glass) {
    return give_fields("Sellmeier", glass);
}
py::object give(const Outline& outline) {
    return give_fields("Outline", outline);
}
py::object give(const Pattern& pattern) {
    if (pattern.kind == PatternKind::solid) return to_python(pattern.colors[0]);
    return give_fields("Pattern", pattern);
}
template <class Value>
py::object give_fields(const char* name, const Value& value) {
    py::dict values;
    for_each_field(
        [&]<class Member>(const Field& field, const Member& member) {
            py::object object;
            if constexpr (std::is_enum_v<Member>)
                object =
                    py::str(word_in_python(field.valid.words[static_cast<std::size_t>(member)]));
            else if constexpr (std::is_same_v<Member, std::uint8_t>)
                object = give_axes(member, field.spelling.first_bit);
            else
                object = give(member);
            values[field.python()] = object;
        },
        value);
    return module_of_values().attr(name)(**values);
}

} // namespace

InvalidValue named_as_in_python(const InvalidValue& error) {
    // The fields whose names differ in Python. A field follows the fields inside of it.
    struct Renamed {
        std::string_view from, to;
        std::string_view word, other; // another field's name in the expectation
    };
    constexpr Renamed renamed_words[] = {
        {"auto_camera/direction", "camera/view", "", ""},
        {"auto_camera", "camera", "", ""},
        {"view", "camera/view", "", ""},
        {"camera/from", "camera/position", "", ""},
        {"camera/at", "camera/at", "\"from\"", "\"position\""},
        {"pattern/from", "color/start", "", ""},
        {"pattern/to", "color/end", "\"from\"", "\"start\""},
        {"pattern", "color", "", ""},
        {"spectrum/wavelengths", "wavelengths", "", ""},
    };
    for (const Renamed& renamed : renamed_words) {
        const std::string_view rest =
            std::string_view(error.field).substr(std::min(error.field.size(), renamed.from.size()));
        if (!error.field.starts_with(renamed.from) || !(rest.empty() || rest[0] == '/')) continue;
        std::string expectation = error.expectation;
        const std::size_t at = expectation.find(renamed.word);
        if (at != std::string::npos) expectation.replace(at, renamed.word.size(), renamed.other);
        return {std::string(renamed.to).append(rest), expectation};
    }
    return error;
}

Material material_from(const py::handle& material) {
    return value_from<Material>(material);
}
Light light_from(const py::handle& light) {
    return value_from<Light>(light);
}
Fog fog_from(const py::handle& fog) {
    return value_from<Fog>(fog, "Fog", "fog");
}
Camera camera_from(const py::handle& camera) {
    return value_from<Camera>(camera, "Camera", "camera");
}
std::optional<AutoCamera> auto_camera_from(const py::handle& camera) {
    if (!py::hasattr(camera, "view")) return std::nullopt;
    const py::object view = camera.attr("view"), up = camera.attr("up");
    AutoCamera result;
    if (PyUnicode_Check(view.ptr()) != 0)
        result = named_view(py::cast<std::string>(view));
    else
        take(view, "camera/view", result.direction);
    if (!up.is_none()) {
        take(up, "camera/up", result.up);
        if (result.up == Vec3()) throw InvalidValue("camera/up", "must not be the zero vector");
    }
    result.projection = enum_from<Projection>(camera.attr("projection"), "camera/projection",
                                              core::fields::projection_words);
    take(camera.attr("field_of_view"), "camera/field_of_view", result.field_of_view);
    take(camera.attr("zoom"), "camera/zoom", result.zoom);
    take(camera.attr("depth_cue"), "camera/depth_cue", result.depth_cue);
    return result;
}
Settings settings_from(const py::handle& settings) {
    return value_from<Settings>(settings, "Settings", "settings");
}
std::vector<double> wavelengths_from(const py::handle& wavelengths) {
    const py::array_t<double, py::array::forcecast> numbers =
        array_of<double>(wavelengths, "wavelengths");
    if (numbers.ndim() != 1) refuse("wavelengths", "a list of numbers", wavelengths);
    std::vector<double> result;
    for (py::ssize_t i = 0; i < numbers.size(); ++i)
        result.push_back(numbers.at(i));
    return result;
}
Color color_from(const py::handle& color, const std::string& field) {
    Color result;
    take_color(color, field, result);
    return result;
}
Vec3 vector_from(const py::handle& vector, const std::string& field) {
    Vec3 result;
    take(vector, field, result);
    return result;
}
float number_from(const py::handle& number, const std::string& field) {
    float result = 0.0F;
    take(number, field, result);
    return result;
}
int int_from(const py::handle& number, const std::string& field) {
    int result = 0;
    take(number, field, result);
    return result;
}
bool bool_from(const py::handle& value, const std::string& field) {
    bool result = false;
    take(value, field, result);
    return result;
}
int threads_from(const py::handle& threads) {
    return whole_from(threads, "threads", 0, 4096);
}
std::size_t count_from(const py::handle& count, const std::string& field) {
    return whole_from<std::size_t>(count, field, 0, std::numeric_limits<std::size_t>::max());
}
Precision precision_from(const py::handle& precision) {
    return enum_from<Precision>(precision, "precision", precision_words);
}
Transfer transfer_from(const py::handle& transfer) {
    return enum_from<Transfer>(transfer, "transfer", core::fields::transfer_words);
}
MaterialIndex one_material(const py::object& index, const char* field) {
    // The largest value means "no material" and is not a valid index.
    constexpr auto most = std::numeric_limits<MaterialIndex>::max() - 1;
    return Values<MaterialIndex>(whole_numbers(index, field, most), 1, field)[0];
}

py::object to_python(const Material& material) {
    return give_fields("Material", material);
}
py::object to_python(const Sellmeier& glass) {
    return give(glass);
}
py::object to_python(const Light& light) {
    return give_fields("Light", light);
}
py::object to_python(const Fog& fog) {
    return give_fields("Fog", fog);
}
py::object to_python(const Camera& camera) {
    return give_fields("Camera", camera);
}
py::object to_python(const Settings& settings) {
    return give_fields("Settings", settings);
}
py::tuple to_python(const Vec3& vector) {
    return py::make_tuple(give(vector.x), give(vector.y), give(vector.z));
}

} // namespace raylane::python
