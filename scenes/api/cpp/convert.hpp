#pragma once

#include "core/scene/fields.hpp"

#include <bit>
#include <cstddef>
#include <iterator>
#include <type_traits>

struct raylane_texture;
namespace raylane {
class Texture;
namespace core {
class Texture;
}
} // namespace raylane

/// Conversions between the plain structs of core, of the library and of C, whose members have the
/// same names.
namespace raylane::library {

/// Copy the images of patterns, without their pixels. A pointer of C points to the library's
/// object, see raylane_texture.
void copy_texture(const core::Texture& from, Texture& to);
void copy_texture(const Texture& from, core::Texture& to);
void copy_texture(const Texture& from, const raylane_texture*& to);
void copy_texture(const raylane_texture* from, Texture& to);

template <class From, class To>
void copy(const From& from, To& to) {
    if constexpr (std::is_same_v<From, To>)
        to = from;
    else if constexpr (std::is_enum_v<From> || std::is_enum_v<To> || std::is_same_v<From, bool> ||
                       std::is_same_v<To, bool>)
        to = static_cast<To>(from);
    else if constexpr (requires { copy_texture(from, to); })
        copy_texture(from, to);
    else if constexpr (std::is_same_v<From, const char*>)
        to = from != nullptr ? from : "";
    else if constexpr (std::is_same_v<To, const char*>)
        to = from.empty() ? nullptr : from.c_str(); // valid as long as `from`
    else if constexpr (requires { from.texts(); })
        copy(from.texts(), to);
    else if constexpr (requires { to.texts(); }) {
        std::remove_cvref_t<decltype(to.texts())> texts;
        copy(from, texts);
        to = from == From{} ? To{} : To(texts);
    } else if constexpr (requires { from.x; })
        to = {from.x, from.y, from.z};
    else if constexpr (requires { from[0]; })
        for (std::size_t i = 0; i < std::size(from); ++i)
            copy(from[i], to[i]);
    else
        core::fields::for_each_field(
            [](const core::fields::Field&, const auto& one, auto& other) { copy(one, other); },
            from, to);
}

template <class To, class From>
To converted(const From& from) {
    To to{};
    copy(from, to);
    return to;
}

/// Converts a shape. Both structs hold the same numbers in the same order.
template <class CoreShape, class Shape>
CoreShape core_shape(const Shape& shape) {
    return std::bit_cast<CoreShape>(shape);
}

} // namespace raylane::library
