#pragma once

#include "core/scene/scene.hpp"
#include "raylane/material.hpp"
#include "raylane/shapes.hpp"
#include "raylane/surroundings.hpp"

#include <bit>
#include <type_traits>

/// Conversions between the library's plain structs and those of core. Both have the same field
/// names, so one list of fields serves both directions.
namespace raylane::library {

inline void copy(const Vec3& from, core::Vec3f& to) {
    to = {from.x, from.y, from.z};
}
inline void copy(const core::Vec3f& from, Vec3& to) {
    to = {from.x, from.y, from.z};
}
template <class Number>
requires std::is_arithmetic_v<Number>
void copy(const Number& from, Number& to) {
    to = from;
}
template <class From, class To>
requires std::is_enum_v<From> && std::is_enum_v<To>
void copy(const From& from, To& to) {
    to = static_cast<To>(from);
}

template <class Public, class Core, class From, class To>
concept BothWays = (std::is_same_v<From, Public> && std::is_same_v<To, Core>) ||
                   (std::is_same_v<From, Core> && std::is_same_v<To, Public>);

template <class From, class To>
requires BothWays<Pattern, core::Pattern, From, To>
void copy(const From& from, To& to) {
    copy(from.kind, to.kind);
    copy(from.colors[0], to.colors[0]);
    copy(from.colors[1], to.colors[1]);
    copy(from.size, to.size);
    copy(from.axes, to.axes);
    copy(from.direction, to.direction);
    copy(from.from, to.from);
    copy(from.to, to.to);
}

template <class From, class To>
requires BothWays<Material, core::Material, From, To>
void copy(const From& from, To& to) {
    copy(from.pattern, to.pattern);
    copy(from.ambient, to.ambient);
    copy(from.diffuse, to.diffuse);
    copy(from.specular, to.specular);
    copy(from.exponent, to.exponent);
    copy(from.reflection, to.reflection);
    copy(from.reflectivity, to.reflectivity);
    copy(from.transmission, to.transmission);
    copy(from.opacity, to.opacity);
    copy(from.index, to.index);
    to.glass.B = from.glass.B;
    to.glass.C = from.glass.C;
    copy(from.absorption, to.absorption);
    copy(from.visible, to.visible);
}

template <class From, class To>
requires BothWays<Light, core::Light, From, To>
void copy(const From& from, To& to) {
    copy(from.kind, to.kind);
    copy(from.position, to.position);
    copy(from.direction, to.direction);
    copy(from.color, to.color);
    copy(from.radius, to.radius);
    copy(from.edge_u, to.edge_u);
    copy(from.edge_v, to.edge_v);
    copy(from.ground, to.ground);
    copy(from.reach, to.reach);
}

template <class From, class To>
requires BothWays<Fog, core::Fog, From, To>
void copy(const From& from, To& to) {
    copy(from.kind, to.kind);
    copy(from.color, to.color);
    copy(from.start, to.start);
    copy(from.end, to.end);
    copy(from.density, to.density);
}

template <class From, class To>
requires BothWays<Camera, core::Camera, From, To>
void copy(const From& from, To& to) {
    copy(from.projection, to.projection);
    copy(from.from, to.from);
    copy(from.at, to.at);
    copy(from.up, to.up);
    copy(from.field_of_view, to.field_of_view);
    copy(from.height, to.height);
    copy(from.lens_radius, to.lens_radius);
    copy(from.focus_distance, to.focus_distance);
}

template <class From, class To>
requires BothWays<Outline, core::Outline, From, To>
void copy(const From& from, To& to) {
    copy(from.width, to.width);
    copy(from.color, to.color);
    copy(from.creases, to.creases);
}

template <class From, class To>
requires BothWays<Settings, core::Settings, From, To>
void copy(const From& from, To& to) {
    copy(from.width, to.width);
    copy(from.height, to.height);
    copy(from.grid, to.grid);
    copy(from.samples, to.samples);
    copy(from.quality, to.quality);
    copy(from.filter, to.filter);
    copy(from.light_samples, to.light_samples);
    copy(from.transfer, to.transfer);
    copy(from.alpha, to.alpha);
    copy(from.max_depth, to.max_depth);
    copy(from.min_weight, to.min_weight);
    copy(from.max_see_through, to.max_see_through);
    copy(from.outline, to.outline);
}

template <class To, class From>
To converted(const From& from) {
    To to;
    copy(from, to);
    return to;
}

/// Converts a shape. Both structs hold the same numbers in the same order.
template <class CoreShape, class Shape>
CoreShape core_shape(const Shape& shape) {
    return std::bit_cast<CoreShape>(shape);
}

} // namespace raylane::library
