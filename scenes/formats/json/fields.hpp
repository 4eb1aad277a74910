#pragma once

#include "core/scene/fields.hpp"
#include "core/scene/surroundings.hpp"
#include "scenes/formats/json/value.hpp"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <type_traits>
#include <vector>

/// Readers of the objects whose keys core/scene/fields.hpp lists. They leave the checks of numbers
/// to core::validate().
namespace raylane::scenes {

/// Returns the index of a word. `other`: a further word, whose index is the number of words.
std::size_t read_word(const JsonValue& value, const core::fields::Valid& valid,
                      const char* other = nullptr);

/// Returns the former name of a key, which works for one version, or an empty text.
constexpr std::string_view former_key(std::string_view key) {
    return key == "max_transparent" ? "max_see_through" : "";
}

void read_field(const JsonValue& value, const core::fields::Field& field, float& to);
void read_field(const JsonValue& value, const core::fields::Field& field, int& to);
void read_field(const JsonValue& value, const core::fields::Field& field, bool& to);
void read_field(const JsonValue& value, const core::fields::Field& field, core::Vec3f& to);
void read_field(const JsonValue& value, const core::fields::Field& field,
                std::array<core::Color, 2>& to);
void read_field(const JsonValue& value, const core::fields::Field& field,
                std::array<double, 3>& to);
/// Reads three formulas, or numbers in place of some of them. `point`: see core::Formula.
core::Formula formula_of(const JsonValue& value, const core::FormulaTexts& point = {});
inline void read_field(const JsonValue& value, const core::fields::Field&, core::Formula& to) {
    to = formula_of(value);
}
/// Leaves the image to PatternImages.
void read_field(const JsonValue& value, const core::fields::Field& field, core::Texture& to);
/// Reads a checker's axes.
void read_field(const JsonValue& value, const core::fields::Field& field, std::uint8_t& to);
void read_field(const JsonValue& value, const core::fields::Field& field, core::Pattern& to);
void read_field(const JsonValue& value, const core::fields::Field& field, core::Sellmeier& to);
template <class Enum>
requires std::is_enum_v<Enum>
void read_field(const JsonValue& value, const core::fields::Field& field, Enum& to) {
    to = static_cast<Enum>(read_word(value, field.valid));
}

/// Throws if the object has keys other than `others` and those of the struct's kind. `group`: only
/// fields of this group.
template <class Of>
void allow_fields(const JsonValue& value, const Of& object,
                  std::initializer_list<std::string_view> others = {},
                  std::string_view group = "") {
    std::vector<std::string_view> keys(others);
    core::fields::for_each_field(
        [&, kind = core::fields::kind_of(object)](const core::fields::Field& field, const auto&) {
            if (!field.is_in(group, kind)) return;
            keys.push_back(field.key());
            if (!former_key(field.key()).empty()) keys.push_back(former_key(field.key()));
        },
        object);
    value.allow_only(keys);
}

/// Reads the fields of a struct whose kind is set.
template <class Of>
void read_fields(const JsonValue& value, Of& object, std::string_view group = "") {
    core::fields::for_each_field(
        [&, kind = core::fields::kind_of(object)]<class Member>(const core::fields::Field& field,
                                                                Member& member) {
            if (!field.is_in(group, kind) || field.use.selects_kind) return;
            if constexpr (!core::fields::OutlineLike<Member>) { // an object of its own
                if ((field.use.required & kind) != 0)
                    read_field(value.at(field.key()), field, member);
                else if (const auto found = value.find(field.key()))
                    read_field(*found, field, member);
                else if (const auto former = value.find(former_key(field.key())))
                    read_field(*former, field, member);
            }
        },
        object);
}

/// Reads an object that has only these fields.
template <class Of>
void read_only_fields(const JsonValue& value, Of& object, std::string_view group = "") {
    allow_fields(value, object, {}, group);
    read_fields(value, object, group);
}

} // namespace raylane::scenes
