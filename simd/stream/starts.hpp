#pragma once

#include "core/shapes/departure.hpp"
#include "simd/query/paths.hpp"
#include "simd/stream/shapes_by_name.hpp"
#include "simd/stream/streams.hpp"

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

namespace raylane::simd {

template <class Real>
core::Ray<double> ray_in_double(const RayStream<Real>& rays, std::size_t i) {
    const auto vector = [i](const Real* const(&columns)[3]) {
        return core::convert<double>(core::Vec3<Real>(columns[0][i], columns[1][i], columns[2][i]));
    };
    return {vector(rays.origin), vector(rays.direction)};
}

/// Starts lanes on the shapes that rays name. Most rays name spheres that are no parts of solids:
/// few operations decide to which side of these they go. To be made for the rays of one call.
class Starts {
  public:
    /// `slots`: of the shapes, by id.
    Starts(const SceneData& scene, const SlotsByName& slots)
        : scene_(scene), slots_(slots),
          spheres_(std::get<core::Table<core::Sphere>>(scene.scene().shapes())),
          solids_(scene.scene().solids()), first_sphere_(scene.slot_of(core::Kind::sphere, {0, 0})),
          sphere_slots_((spheres_.block_count() + spheres_.copied_blocks()) * core::block_size),
          are_floats_(!spheres_.is_packed() && spheres_.doubles().data() == nullptr) {}

    /// Fetches the slot of a shape into the cache.
    void prefetch_slot(core::ShapeId shape) const { slots_.prefetch(shape); }
    /// Fetches the block of a sphere into the cache.
    void prefetch_sphere(core::ShapeId shape) const {
        const std::uint32_t place = slots_[shape] - first_sphere_;
        if (place >= sphere_slots_) return;
        const std::size_t block = place / core::block_size;
        if (spheres_.is_packed())
            prefetch(spheres_.packed()->blocks[block]);
        else
            prefetch(spheres_.plain_blocks()[block].values);
    }

    /// Starts a lane on the shape that ray i names, if it is a shape of the scene. The ray must not
    /// be refused. Throws InvalidStart if the ray cannot start there.
    template <class Real>
    void start(const Paths& paths, std::size_t lane, const RayStream<Real>& rays,
               std::size_t i) const {
        if (!start_on_sphere(paths, lane, rays, i)) start_on_any(paths, lane, rays, i);
    }

    /// Puts the sphere that ray i names at a place of `spheres`, and returns its slot. Returns
    /// no_slot, and does nothing, for any other shape and for a part of a solid.
    template <class Real>
    std::uint32_t find_sphere(const RayStream<Real>& rays, std::size_t i, LeftSpheres& spheres,
                              std::size_t at) const {
        const std::uint32_t slot = slot_of_sphere(rays, i);
        if (slot == no_slot) return no_slot;
        const std::uint32_t place = slot - first_sphere_;
        const auto put = [&](int number, double value) {
            (number < 3 ? spheres.center[number] : spheres.radius)[at] = value;
        };
        if (are_floats_) { // without a sphere between, whose copy would wait for its parts
            const auto& values = spheres_.plain_blocks()[place / core::block_size].values;
            for (int number = 0; number < 4; ++number)
                put(number, static_cast<double>(values[number][place % core::block_size]));
        } else {
            const core::InDouble<core::Sphere> sphere = sphere_in(slot);
            for (int axis = 0; axis < 3; ++axis)
                put(axis, sphere.center[axis]);
            put(3, sphere.radius);
        }
        return slot;
    }
    /// Starts a lane on a sphere that was found, to a side of it. Returns false, and does nothing,
    /// if ray i names the other side.
    template <class Real>
    static bool start_on_sphere(const Paths& paths, std::size_t lane, const RayStream<Real>& rays,
                                std::size_t i, std::uint32_t slot, bool inside) {
        if (rays.origin_inward != nullptr && rays.origin_inward[i] != (inside ? 1 : 0))
            return false;
        const core::ShapeId id = rays.origin_shape[i];
        const SceneData::NamedShape sphere{{id, id}, core::Kind::sphere, /*flat=*/false};
        paths.start_on(lane, slot, sphere, core::body | (inside ? hit_entering : 0U),
                       /*through=*/true);
        return true;
    }
    /// Does the same as start(), more slowly.
    template <class Real>
    void start_on_any(const Paths& paths, std::size_t lane, const RayStream<Real>& rays,
                      std::size_t i) const;
    /// How far the origin of a ray may be from the shape that it leaves, as a share of the shape's
    /// size.
    template <class Real>
    static constexpr double rounding_in = std::is_same_v<Real, float> ? 0x1p-6 : 0x1p-10;

  private:
    template <class Numbers>
    static void prefetch(const Numbers& numbers) {
        constexpr std::size_t line = 64;
        for (std::size_t byte = 0; byte < sizeof(numbers); byte += line)
            __builtin_prefetch(reinterpret_cast<const char*>(&numbers) + byte);
    }
    core::InDouble<core::Sphere> sphere_in(std::uint32_t slot) const {
        const std::uint32_t place = slot - first_sphere_;
        return spheres_.get(
            {place / core::block_size, static_cast<std::uint8_t>(place % core::block_size)});
    }
    /// Returns false, and does nothing, if few operations do not decide the ray's start.
    template <class Real>
    bool start_on_sphere(const Paths& paths, std::size_t lane, const RayStream<Real>& rays,
                         std::size_t i) const {
        const std::uint32_t slot = slot_of_sphere(rays, i);
        if (slot == no_slot) return false;
        const int side = core::clear_side_of_departure(sphere_in(slot), ray_in_double(rays, i),
                                                       core::body, rounding_in<Real>);
        return side != 0 && start_on_sphere(paths, lane, rays, i, slot, side < 0);
    }
    template <class Real>
    std::uint32_t slot_of_sphere(const RayStream<Real>& rays, std::size_t i) const {
        const core::ShapeId id = rays.origin_shape[i];
        const std::uint32_t slot = slots_[id];
        const bool is_sphere = slot - first_sphere_ < sphere_slots_ && !solids_.has(id) &&
                               (rays.origin_face == nullptr || rays.origin_face[i] == core::body);
        return is_sphere ? slot : no_slot;
    }

    const SceneData& scene_;
    const SlotsByName& slots_;
    const core::Table<core::Sphere>& spheres_;
    const core::Solids& solids_;
    std::uint32_t first_sphere_; // slot
    std::size_t sphere_slots_;
    bool are_floats_; // all spheres, and none are packed
};

} // namespace raylane::simd
