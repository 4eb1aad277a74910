#include "scenes/formats/tachyon/clip.hpp"

#include "core/shapes/checks.hpp"

namespace raylane::scenes {

namespace {

using core::Vec3d, core::Vec3f;

struct Corner {
    Vec3d position, normal;
};

/// Clips a convex polygon by one plane (Sutherland and Hodgman).
std::vector<Corner> clipped(const std::vector<Corner>& polygon, const TachyonClip& clip) {
    const auto beyond = [&](const Corner& corner) {
        return core::dot(core::convert<double>(clip.normal), corner.position) -
               static_cast<double>(clip.offset);
    };
    std::vector<Corner> left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner& from = polygon[i];
        const Corner& to = polygon[(i + 1) % polygon.size()];
        const double a = beyond(from), b = beyond(to);
        if (a <= 0.0) left.push_back(from);
        if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)) {
            const double s = a / (a - b);
            left.push_back({from.position + s * (to.position - from.position),
                            from.normal + s * (to.normal - from.normal)});
        }
    }
    return left;
}

std::vector<Corner> clipped(std::vector<Corner> polygon, std::span<const TachyonClip> clips) {
    for (const TachyonClip& clip : clips)
        polygon = clipped(polygon, clip);
    return polygon;
}

/// Calls use(a, b, c) with the corners of each triangle of the fan whose area is not 0 in floats.
template <class Use>
void for_each_of_fan(const std::vector<Corner>& polygon, const Use& use) {
    const auto point = [](const Corner& corner) { return core::convert<float>(corner.position); };
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const Corner &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
        if (!core::checks::are_collinear(point(a), point(b), point(c))) use(a, b, c);
    }
}

} // namespace

core::Solid half_space_of(const TachyonClip& clip) {
    const auto normal = core::convert<double>(clip.normal);
    const double share = static_cast<double>(clip.offset) / core::squared_length(normal);
    return {.shape = core::PlaneOf<double>{share * normal, normal}};
}

std::vector<core::Triangle> clipped(const core::Triangle& triangle,
                                    std::span<const TachyonClip> clips) {
    std::vector<Corner> corners;
    for (const Vec3f& corner : {triangle.a, triangle.b, triangle.c})
        corners.push_back({core::convert<double>(corner), Vec3d(0.0)});
    std::vector<core::Triangle> triangles;
    for_each_of_fan(
        clipped(std::move(corners), clips), [&](const Corner& a, const Corner& b, const Corner& c) {
            triangles.push_back({core::convert<float>(a.position), core::convert<float>(b.position),
                                 core::convert<float>(c.position)});
        });
    return triangles;
}

std::vector<core::SmoothTriangle> clipped(const core::SmoothTriangle& triangle,
                                          std::span<const TachyonClip> clips) {
    std::vector<Corner> corners = {
        {core::convert<double>(triangle.a), core::convert<double>(triangle.normal_a)},
        {core::convert<double>(triangle.b), core::convert<double>(triangle.normal_b)},
        {core::convert<double>(triangle.c), core::convert<double>(triangle.normal_c)}};
    std::vector<core::SmoothTriangle> triangles;
    for_each_of_fan(
        clipped(std::move(corners), clips), [&](const Corner& a, const Corner& b, const Corner& c) {
            triangles.push_back({core::convert<float>(a.position), core::convert<float>(b.position),
                                 core::convert<float>(c.position), core::convert<float>(a.normal),
                                 core::convert<float>(b.normal), core::convert<float>(c.normal)});
        });
    return triangles;
}

} // namespace raylane::scenes
