#include "scenes/formats/structure/cut.hpp"

#include "core/shapes/shapes.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/lines.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace raylane::scenes {

namespace {

/// Returns the numbers of a list such as "1, 0, 2.5", or an empty list if it is malformed.
std::vector<double> numbers_in(std::string_view text, char separator) {
    std::vector<double> numbers;
    while (true) {
        const std::size_t end = text.find(separator);
        const std::optional<double> number = number_in(trimmed(text.substr(0, end)));
        if (!number) return {};
        numbers.push_back(*number);
        if (end == std::string_view::npos) return numbers;
        text.remove_prefix(end + 1);
    }
}

/// The last number of a plane.
struct Offset {
    double number;
    bool from_middle;
};

std::optional<Offset> offset_in(std::string_view text) {
    constexpr std::string_view middle = "middle";
    text = trimmed(text);
    const bool from_middle = text.starts_with(middle);
    if (from_middle) {
        text = trimmed(text.substr(middle.size()));
        if (text.empty()) return Offset{0.0, true};
        if (text[0] != '+' && text[0] != '-') return std::nullopt;
    }
    const double sign = from_middle && text[0] == '-' ? -1.0 : 1.0;
    const std::optional<double> number = number_in(trimmed(text.substr(from_middle ? 1 : 0)));
    if (!number) return std::nullopt;
    return Offset{sign * *number, from_middle};
}

std::optional<CutPlane> plane_in(std::string_view text) {
    const std::size_t last = std::min(text.rfind(','), text.size());
    if (const std::vector<double> list = numbers_in(text.substr(0, last), ','); list.size() == 3) {
        const std::optional<Offset> offset =
            offset_in(text.substr(std::min(last + 1, text.size())));
        if (!offset) return std::nullopt;
        const core::Vec3d normal(list[0], list[1], list[2]);
        const double largest =
            std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
        const CutPlane plane{1.0 / largest * normal, offset->number / largest, offset->from_middle};
        if (!std::isfinite(largest) || !std::isfinite(1.0 / largest) ||
            !std::isfinite(plane.offset))
            return std::nullopt;
        return plane;
    }
    const std::size_t sign = text.find_first_of("<>");
    if (sign == std::string_view::npos) return std::nullopt;
    const std::string_view axis = trimmed(text.substr(0, sign));
    const std::size_t behind = text.find_first_not_of('=', sign + 1);
    const std::optional<Offset> offset =
        offset_in(behind == std::string_view::npos ? "" : text.substr(behind));
    if (axis.size() != 1 || axis[0] < 'x' || axis[0] > 'z' || !offset) return std::nullopt;
    const double side = text[sign] == '<' ? 1.0 : -1.0;
    CutPlane plane{core::Vec3d(0.0), side * offset->number, offset->from_middle};
    plane.normal[axis[0] - 'x'] = side;
    return plane;
}

} // namespace

CutPlane cut_plane_of(const std::string& option, const std::string& text) {
    const std::optional<CutPlane> plane = plane_in(text);
    if (!plane)
        throw BadInput(option, "",
                       "must be a side of a plane, such as z<1.5, x>middle or 1,1,0,2.5 for x + y "
                       "<= 2.5, got \"" +
                           printable(text) + '"');
    return *plane;
}

std::pair<double, double> range_along(const core::Vec3d& normal, const core::Bounds& bounds) {
    double least = 0.0, most = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = normal[axis] * static_cast<double>(bounds.lower[axis]);
        const double b = normal[axis] * static_cast<double>(bounds.upper[axis]);
        least += std::min(a, b);
        most += std::max(a, b);
    }
    return {least, most};
}

std::optional<std::vector<CutPlane>> planes_through(const core::Bounds& bounds,
                                                    std::span<const CutPlane> planes) {
    std::vector<CutPlane> through;
    for (const CutPlane& plane : planes) {
        const auto [least, most] = range_along(plane.normal, bounds);
        if (least > plane.offset) return std::nullopt;
        if (most > plane.offset) through.push_back(plane);
    }
    return through;
}

bool keep_point(const core::Vec3d& point, std::span<const CutPlane> planes) {
    return std::all_of(planes.begin(), planes.end(), [&](const CutPlane& plane) {
        return core::dot(plane.normal, point) <= plane.offset;
    });
}

core::Solid cut_by(core::Solid solid, std::span<const CutPlane> planes) {
    core::Solid kept{.made = core::Made::by_intersection, .material = solid.material};
    kept.parts.push_back(std::move(solid));
    for (const CutPlane& plane : planes) {
        const double size = core::dot(plane.normal, plane.normal);
        kept.parts.push_back(core::of_shape(
            core::PlaneOf<double>{(plane.offset / size) * plane.normal, plane.normal}));
        kept.parts.back().material = kept.material;
    }
    return kept;
}

} // namespace raylane::scenes
