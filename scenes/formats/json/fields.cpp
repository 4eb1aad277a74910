#include "scenes/formats/json/fields.hpp"

#include <utility>

namespace raylane::scenes {

using core::fields::Field;

std::size_t read_word(const JsonValue& value, const core::fields::Valid& valid, const char* other) {
    std::vector<std::pair<std::string_view, std::size_t>> choices;
    for (auto i = static_cast<std::size_t>(valid.hidden_words); i < valid.words.size(); ++i)
        choices.emplace_back(valid.words[i], i);
    if (other != nullptr) choices.emplace_back(other, valid.words.size());
    return value.choice(JsonValue::Choices<std::size_t>(choices));
}

void read_field(const JsonValue& value, const Field&, float& to) {
    to = value.number();
}

void read_field(const JsonValue& value, const Field&, int& to) {
    to = value.integer();
}

void read_field(const JsonValue& value, const Field&, bool& to) {
    to = value.boolean();
}

void read_field(const JsonValue& value, const Field& field, core::Vec3f& to) {
    to = field.valid.is_color ? value.color() : value.vector();
}

void read_field(const JsonValue& value, const Field&, std::array<core::Color, 2>& to) {
    const std::vector<JsonValue> colors = value.array(2, "colors");
    to = {colors[0].color(), colors[1].color()};
}

void read_field(const JsonValue& value, const Field&, std::array<double, 3>& to) {
    const std::vector<JsonValue> numbers = value.array(3, "numbers");
    to = {numbers[0].real(), numbers[1].real(), numbers[2].real()};
}

core::Formula formula_of(const JsonValue& value, const core::FormulaTexts& point) {
    const std::vector<JsonValue> channels = value.array(3, "formulas");
    core::FormulaTexts texts;
    for (int i = 0; i < 3; ++i)
        texts[i] = channels[i].type() == JsonType::number ? channels[i].quoted()
                                                          : std::string(channels[i].string());
    const auto parameter_of = [&](int channel, std::string_view name) {
        return channels[channel].parameter("$" + std::string(name));
    };
    return core::Formula(texts, parameter_of, point);
}

void read_field(const JsonValue& value, const Field&, core::Texture&) {
    static_cast<void>(value.string());
}

void read_field(const JsonValue& value, const Field& field, std::uint8_t& to) {
    static constexpr std::uint8_t x = 1, y = 2, z = 4;
    const auto axes = value.choice<std::uint8_t>({{"x", x},
                                                  {"y", y},
                                                  {"z", z},
                                                  {"xy", x | y},
                                                  {"xz", x | z},
                                                  {"yz", y | z},
                                                  {"xyz", x | y | z}});
    const int bit = field.spelling.first_bit;
    to = static_cast<std::uint8_t>((to & ~(7 << bit)) | axes << bit);
}

} // namespace raylane::scenes
