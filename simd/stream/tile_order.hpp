#pragma once

#include "simd/stream/streams.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace raylane::simd {

/// An order of rays that start at one point, or are parallel, in which consecutive rays are
/// neighbours in space: cells of about 16 rays, along a Morton curve. Rays that come line by line
/// are neighbours in one direction only, and often twice as expensive.
class TileOrder {
  public:
    /// Largest number of rays that are ordered together.
    static constexpr std::size_t most = 8192;
    /// Fewer are not worth it.
    static constexpr std::size_t least = 2048;

    /// Finds an order for `least` to `most` rays. Returns false if their own order is about as
    /// good.
    template <class Real>
    bool find(const RayStream<Real>& rays, bool parallel);

    /// Returns the indices of the rays in that order.
    std::span<const std::uint32_t> order() const { return order_; }

  private:
    bool find_cells(std::size_t count);
    void sort(std::size_t count, unsigned keys);

    std::vector<float> u_, v_; // by ray, in a plane before them
    std::vector<std::uint16_t> key_;
    std::vector<std::uint32_t> ends_, order_;
};

/// Rays and hits in another order than the caller's.
class TileColumns {
  public:
    template <class Real>
    struct Sorted {
        RayStream<Real> rays;
        HitStream hits;
    };

    /// Puts rays in this order, and provides columns for the requested hits.
    template <class Real>
    Sorted<Real> take(const RayStream<Real>& rays, const HitStream& hits,
                      std::span<const std::uint32_t> order) {
        bytes_.resize(TileOrder::most * bytes_a_ray);
        next_ = bytes_.data();
        Sorted<Real> sorted{};
        sorted.rays.count = order.size();
        sorted.hits.t_double = room_for(hits.t_double, order.size());
        for (int axis = 0; axis < 3; ++axis) {
            sorted.rays.origin[axis] = gathered(rays.origin[axis], order);
            sorted.rays.direction[axis] = gathered(rays.direction[axis], order);
        }
        sorted.rays.t_min = gathered(rays.t_min, order);
        sorted.rays.t_max = gathered(rays.t_max, order);
        sorted.hits.t = room_for(hits.t, order.size());
        for (int axis = 0; axis < 3; ++axis)
            sorted.hits.normal[axis] = room_for(hits.normal[axis], order.size());
        sorted.hits.shape = room_for(hits.shape, order.size());
        sorted.hits.entering = room_for(hits.entering, order.size());
        sorted.hits.face = room_for(hits.face, order.size());
        sorted.hits.touching = room_for(hits.touching, order.size());
        return sorted;
    }

    /// Writes hits to the caller's places.
    static void hand_back(const HitStream& sorted, std::span<const std::uint32_t> order,
                          const HitStream& hits) {
        scatter(sorted.t, order, hits.t);
        for (int axis = 0; axis < 3; ++axis)
            scatter(sorted.normal[axis], order, hits.normal[axis]);
        scatter(sorted.shape, order, hits.shape);
        scatter(sorted.entering, order, hits.entering);
        scatter(sorted.face, order, hits.face);
        scatter(sorted.t_double, order, hits.t_double);
        scatter(sorted.touching, order, hits.touching);
    }

  private:
    /// Size of 8 columns of rays and all columns of hits.
    static constexpr std::size_t bytes_a_ray = 9 * sizeof(double) + 5 * sizeof(float) + 3;

    template <class Value>
    Value* room(std::size_t count) {
        auto* const values = reinterpret_cast<Value*>(next_);
        next_ += count * sizeof(Value);
        return values;
    }
    template <class Value>
    Value* room_for(const Value* wanted, std::size_t count) {
        return wanted != nullptr ? room<Value>(count) : nullptr;
    }
    template <class Value>
    const Value* gathered(const Value* from, std::span<const std::uint32_t> order) {
        if (from == nullptr) return nullptr;
        auto* const to = room<Value>(order.size());
        for (std::size_t k = 0; k < order.size(); ++k)
            to[k] = from[order[k]];
        return to;
    }
    template <class Value>
    static void scatter(const Value* from, std::span<const std::uint32_t> order, Value* to) {
        if (to == nullptr) return;
        for (std::size_t k = 0; k < order.size(); ++k)
            to[order[k]] = from[k];
    }

    std::vector<std::byte> bytes_;
    std::byte* next_ = nullptr;
};

} // namespace raylane::simd
