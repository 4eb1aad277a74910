#pragma once

#include "raylane/api.hpp"
#include "raylane/surroundings.hpp"
#include "raylane/tracer.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace RAYLANE_API raylane {

/// The rays of an image, one for each pixel. Ray y width + x belongs to pixel (x, y), which counts
/// from the upper left corner.
struct PixelRays {
    /// The x of all rays, then the y, then the z.
    std::vector<double> origins;
    std::vector<double> directions; ///< of length 1, up to rounding

    DoubleRaySpan span() const {
        const auto column = [](const std::vector<double>& values, std::size_t axis) {
            return std::span(values).subspan(axis * (values.size() / 3), values.size() / 3);
        };
        return {.origin_x = column(origins, 0),
                .origin_y = column(origins, 1),
                .origin_z = column(origins, 2),
                .direction_x = column(directions, 0),
                .direction_y = column(directions, 1),
                .direction_z = column(directions, 2)};
    }
};

/// Returns the rays that render() traces from a camera with one sample at the centre of each pixel:
/// Settings::grid 1, regular samples, the box filter and no quality. With a lens, each ray starts
/// at a point of the lens that depends on the pixel; with Camera::lens_radius 0 all start at the
/// centre. Throws InvalidValue, fields "width" and "height" for numbers of pixels beyond those of
/// Settings, and "camera/...".
RAYLANE_API PixelRays camera_rays(const Camera& camera, int width, int height);

} // namespace raylane
