#include "scenes/formats/tachyon/clip.hpp"

#include "scenes/formats/polygon.hpp"

namespace raylane::scenes {

namespace {

Polygon clipped(Polygon polygon, std::span<const TachyonClip> clips) {
    for (const TachyonClip& clip : clips)
        polygon =
            clipped(polygon, core::convert<double>(clip.normal), static_cast<double>(clip.offset));
    return polygon;
}

} // namespace

core::Solid half_space_of(const TachyonClip& clip) {
    const auto normal = core::convert<double>(clip.normal);
    const double share = static_cast<double>(clip.offset) / core::squared_length(normal);
    return {.shape = core::PlaneOf<double>{share * normal, normal}};
}

std::vector<core::Triangle> clipped(const core::Triangle& triangle,
                                    std::span<const TachyonClip> clips) {
    Polygon polygon;
    for (const core::Vec3f& corner : {triangle.a, triangle.b, triangle.c})
        polygon.push_back({core::convert<double>(corner)});
    return triangles_of({clipped(std::move(polygon), clips)});
}

std::vector<core::SmoothTriangle> clipped(const core::SmoothTriangle& triangle,
                                          std::span<const TachyonClip> clips) {
    return smooth_triangles_of({clipped(polygon_of(triangle), clips)});
}

} // namespace raylane::scenes
