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

} // namespace raylane::simd
