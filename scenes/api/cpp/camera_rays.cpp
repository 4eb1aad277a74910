#include "raylane/camera_rays.hpp"

#include "core/scene/camera_rays.hpp"
#include "core/scene/validate.hpp"
#include "scenes/api/cpp/convert.hpp"
#include "scenes/api/cpp/translate.hpp"

namespace raylane {

PixelRays camera_rays(const Camera& camera, int width, int height) {
    return library::translated([&] {
        core::Settings settings;
        settings.width = width;
        settings.height = height;
        core::validate(settings);
        const auto from = library::converted<core::Camera>(camera);
        core::validate_in("camera", from);

        const std::size_t count = std::size_t(width) * std::size_t(height);
        PixelRays rays{std::vector<double>(3 * count), std::vector<double>(3 * count)};
        const core::CameraRays<double> camera_rays(from, settings);
        for (int y = 0, i = 0; y < height; ++y)
            for (int x = 0; x < width; ++x, ++i) {
                const core::Ray<double> ray = camera_rays.ray(x, y, 0);
                for (int axis = 0; axis < 3; ++axis) {
                    const std::size_t at = std::size_t(axis) * count + std::size_t(i);
                    rays.origins[at] = ray.origin[axis];
                    rays.directions[at] = ray.direction[axis];
                }
            }
        return rays;
    });
}

} // namespace raylane
