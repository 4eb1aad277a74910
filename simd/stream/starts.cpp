#include "simd/stream/starts.hpp"

#include <string>

namespace raylane::simd {

namespace {

/// The start of a ray on a face of a shape, as the caller gives it.
struct GivenStart {
    core::Ray<double> ray;
    core::Face face;
    const std::uint8_t* inward; ///< to the inside of the solid; null: the direction tells
    bool reversed;              ///< the shape is a reversed part of the solid
    double rounding;            ///< share of the shape's size
};

constexpr std::uint8_t by_direction = 2;

/// Returns the number that tells to which side a ray goes; null if the direction tells.
const std::uint8_t* checked_side(const std::uint8_t* inward) {
    if (inward == nullptr || *inward == by_direction) return nullptr;
    if (*inward > by_direction)
        throw core::InvalidValue("origin_inward",
                                 "must be 0, 1, or 2 if the direction decides, got " +
                                     std::to_string(*inward));
    return inward;
}

/// Returns true if a ray goes to the inside of the shape that it starts on. Throws InvalidValue if
/// it cannot start there, or clearly goes to the other side than it says.
template <class Shape>
bool goes_inside(const Shape& shape, const GivenStart& start) {
    constexpr int faces = core::face_count<Shape>();
    if (start.face >= faces)
        throw core::InvalidValue("origin_face", "must be less than the shape's number of faces, " +
                                                    std::to_string(faces) + ", got " +
                                                    std::to_string(start.face));
    const bool inward = start.inward != nullptr && (*start.inward != 0) != start.reversed;
    const int clear_side =
        core::clear_side_of_departure(shape, start.ray, start.face, start.rounding);
    if (clear_side != 0 && (start.inward == nullptr || inward == (clear_side < 0)))
        return clear_side < 0;
    if (!core::may_start_on(shape, start.ray.origin, start.face, start.rounding))
        throw core::InvalidValue("origin_shape",
                                 "must be a shape that the origin is on, within rounding");
    const int side = core::side_of_departure(shape, start.ray, start.face);
    if (start.inward == nullptr) return side < 0;
    if (side == (inward ? 1 : -1) &&
        core::certain_side(shape, start.ray, start.face, start.rounding) == side)
        throw core::InvalidValue(
            "origin_inward", *start.inward != 0 ? "must be 0 for a direction to the outside, got 1"
                                                : "must be 1 for a direction to the inside, got 0");
    return inward;
}

bool goes_inside(const core::Scene& scene, core::Kind kind, core::Place place,
                 const GivenStart& start) {
    return core::with_table(scene.shapes(), kind, [&](const auto& table) {
        return goes_inside(table.get(place), start);
    });
}

} // namespace

template <class Real>
void Starts::start_on_any(const Paths& paths, std::size_t lane, const RayStream<Real>& rays,
                          std::size_t i) const {
    const core::ShapeId shape = rays.origin_shape[i];
    const std::uint32_t slot = slots_[shape];
    if (slot == no_slot) return paths.start_nowhere(lane, lane + 1);
    const SceneData::NamedShape named = scene_.shape_named(shape, slot);
    try {
        const GivenStart start{ray_in_double(rays, i),
                               rays.origin_face != nullptr ? rays.origin_face[i] : core::body,
                               checked_side(from(rays.origin_inward, i)),
                               solids_.is_reversed(shape), rounding_in<Real>};
        const bool is_inward =
            goes_inside(scene_.scene(), named.kind, scene_.place_of(slot), start);
        paths.start_on(lane, slot, named,
                       std::uint32_t{start.face} | (is_inward ? hit_entering : 0),
                       /*through=*/true);
    } catch (const core::InvalidValue& invalid) {
        throw InvalidStart(invalid, &rays.origin_shape[i]);
    }
}

template void Starts::start_on_any(const Paths&, std::size_t, const RayStream<float>&,
                                   std::size_t) const;
template void Starts::start_on_any(const Paths&, std::size_t, const RayStream<double>&,
                                   std::size_t) const;

} // namespace raylane::simd
