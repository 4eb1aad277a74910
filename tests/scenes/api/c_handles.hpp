#pragma once

#include "raylane/raylane.h"
#include "tests/support/catch.hpp"

#include <memory>

/// Handles of the C interface that release themselves, for its tests.
namespace raylane::tests {

template <auto release>
struct Release {
    template <class Handle>
    void operator()(Handle* handle) const {
        release(handle);
    }
};
using Builder = std::unique_ptr<raylane_builder, Release<raylane_builder_release>>;
using SolidHandle = std::unique_ptr<raylane_solid, Release<raylane_solid_release>>;
using SceneHandle = std::unique_ptr<raylane_scene, Release<raylane_scene_release>>;
using TracerHandle = std::unique_ptr<raylane_tracer, Release<raylane_tracer_release>>;
using RowsHandle = std::unique_ptr<raylane_rows, Release<raylane_rows_release>>;

inline Builder builder_in_c() {
    raylane_builder* builder = nullptr;
    REQUIRE(raylane_builder_create(&builder) == RAYLANE_OK);
    return Builder(builder);
}

inline SceneHandle built(const Builder& builder) {
    raylane_scene* scene = nullptr;
    CHECK(raylane_build(builder.get(), &scene) == RAYLANE_OK);
    return SceneHandle(scene);
}

inline TracerHandle tracer_of(const SceneHandle& scene) {
    raylane_tracer* tracer = nullptr;
    CHECK(raylane_tracer_create(scene.get(), 1, RAYLANE_EXACT, &tracer) == RAYLANE_OK);
    return TracerHandle(tracer);
}

/// Calls make(&handle), which must succeed, and returns the handle.
template <class Handle, class Make>
Handle made(const Make& make) {
    typename Handle::pointer handle = nullptr;
    const raylane_status status = make(&handle);
    INFO(raylane_error_text());
    REQUIRE(status == RAYLANE_OK);
    return Handle(handle);
}

} // namespace raylane::tests
