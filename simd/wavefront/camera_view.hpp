#pragma once

#include "core/scene/camera_rays.hpp"
#include "simd/units/trace_kernels.hpp"

namespace raylane::simd {

/// Returns the data of a camera with which kernels make its rays.
inline CameraView view_of(const core::CameraRays<double>& rays) {
    CameraView view{};
    for (int axis = 0; axis < 3; ++axis) {
        view.from[axis] = rays.from()[axis];
        view.forward[axis] = rays.forward()[axis];
        view.right[axis] = rays.right()[axis];
        view.up[axis] = rays.up()[axis];
        view.lens_right[axis] = rays.lens_right()[axis];
        view.lens_up[axis] = rays.lens_up()[axis];
    }
    view.focus = rays.focus();
    view.orthographic = rays.orthographic();
    return view;
}

} // namespace raylane::simd
