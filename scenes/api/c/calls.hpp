#pragma once

#include "raylane/raylane.h"
#include "raylane/raylane.hpp"

#include <memory>
#include <new>
#include <span>
#include <string>
#include <type_traits>
#include <variant>

/// Shared by all calls of the C interface: handles, errors and checks of arguments.

struct raylane_builder {
    raylane::SceneBuilder builder;
};
struct raylane_scene {
    raylane::Scene scene;
};
struct raylane_transform {
    raylane::Transform transform;
};
struct raylane_solid {
    raylane::Solid solid;
};
struct raylane_group {
    raylane::Group group;
};
struct raylane_texture { // library::copy_texture() relies on its only member
    raylane::Texture texture;
};
struct raylane_tracer {
    raylane::Tracer tracer;
};
struct raylane_rows {
    std::variant<raylane::CrossingRows, raylane::SolidRows, raylane::LengthRows,
                 raylane::SolidLengthRows>
        rows;
    raylane_crossing_statistics statistics{};
};

namespace raylane::c {

/// Stores the text for raylane_error_text() and returns `status`. If memory runs out, the text is
/// empty.
RAYLANE_API raylane_status failed(raylane_status status, const char* text) noexcept;

/// Clears the remarks of raylane_remarks(), and returns a callback that keeps those of a call.
RAYLANE_API OnRemark keeping_remarks();

/// Runs `call` and converts its exceptions to a status.
template <class Call>
raylane_status guarded(const Call& call) noexcept {
    try {
        if constexpr (std::is_void_v<decltype(call())>) {
            call();
            return RAYLANE_OK;
        } else {
            return call();
        }
    } catch (const InvalidValue& error) {
        return failed(RAYLANE_INVALID_VALUE, error.what());
    } catch (const BadInput& error) {
        return failed(RAYLANE_BAD_INPUT, error.what());
    } catch (const SystemRefused& error) {
        return failed(RAYLANE_SYSTEM_REFUSED, error.what());
    } catch (const std::bad_alloc&) {
        return failed(RAYLANE_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& error) {
        return failed(RAYLANE_UNKNOWN, error.what());
    } catch (...) {
        return failed(RAYLANE_UNKNOWN, "unknown");
    }
}

/// Returns the value that a pointer points to. Throws InvalidValue for a null pointer.
template <class Value>
Value& checked(const char* name, Value* pointer) {
    if (pointer == nullptr) throw InvalidValue(name, "must not be NULL");
    return *pointer;
}

template <class Value>
std::span<Value> span_of(Value* values, std::size_t count) {
    return values == nullptr ? std::span<Value>() : std::span<Value>(values, count);
}

/// Returns a required array of rays or hits. Throws InvalidValue for a null pointer, unless `count`
/// is 0.
template <class Value>
std::span<Value> span_of(const char* name, Value* values, std::size_t count) {
    if (count == 0) return {};
    return {&checked(name, values), count};
}

/// Stores the value that `make` returns in a new handle.
template <class Handle, class Make>
raylane_status handle_of(const char* name, Handle** handle, const Make& make) noexcept {
    return guarded([&] {
        Handle*& to = checked(name, handle);
        to = nullptr;
        to = std::make_unique<Handle>(Handle{make()}).release();
    });
}

/// Calls add(shape) for each of an array's shapes, and names the one that is invalid.
template <class CShape, class Add>
void add_all(const char* name, const CShape* shapes, std::size_t count, const Add& add) {
    const std::span<const CShape> given = span_of(name, shapes, count);
    for (std::size_t i = 0; i < given.size(); ++i)
        try {
            add(given[i]);
        } catch (const InvalidValue& error) {
            std::string field = std::to_string(i);
            if (!error.field.empty()) field.append("/").append(error.field);
            throw InvalidValue(field, error.expectation);
        }
}

/// Stores the first id that add(builder) returns, unless `first` is null.
template <class Add>
raylane_status added(raylane_builder* builder, std::uint32_t* first, const Add& add) noexcept {
    return guarded([&] {
        const ShapeId id = add(checked("builder", builder).builder);
        if (first != nullptr) *first = id;
    });
}

template <class Make>
raylane_status scene_of(raylane_scene** scene, const Make& make) noexcept {
    return handle_of("scene", scene, make);
}

} // namespace raylane::c
