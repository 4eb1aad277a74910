#pragma once

#include "simd/kernel/lanes/doubles.hpp"
#include "simd/kernel/shapes/crossings.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

/// A register's worth of exact rays of a Found, from any of its lanes.
template <class Arch>
struct GatheredRays {
    using D = Double<Arch>;
    using F = Floats<D>;
    static constexpr std::size_t width = F::size;

    Rays<D> rays;
    Vectors<D> unit; ///< directions of length 1 +- 2^-48
    F length;
    F t_after, half_ulp; ///< the lower limit is the sum

    /// Unused lanes repeat the first one.
    template <class Index>
    void gather(const Found& found, const Index* lanes, std::size_t count) {
        const bool stand_for_others = found.exact_length != nullptr;
        const double* const* const directions =
            stand_for_others ? found.exact_direction : found.direction;
        double numbers[12][width];
        leaves_ = false;
        for (std::size_t lane = 0; lane < width; ++lane) {
            const std::size_t ray = lanes[lane < count ? lane : 0];
            for (int axis = 0; axis < 3; ++axis) {
                numbers[axis][lane] = found.origin[axis][ray];
                numbers[3 + axis][lane] = directions[axis][ray];
                numbers[8 + axis][lane] = found.direction[axis][ray];
            }
            numbers[6][lane] = stand_for_others ? found.exact_length[ray] : 1.0;
            numbers[7][lane] = found.t_after != nullptr ? found.t_after[ray] : 0.0;
            numbers[11][lane] = half_ulp_of(numbers[7][lane], found.origin_bits[ray]);
            first_[lane] = found.origin_first[ray];
            last_[lane] = found.origin_last[ray];
            bits_[lane] = found.origin_bits[ray];
            leaves_ |= first_[lane] != ~0U;
        }
        const auto vectors = [&](double(*from)[width]) {
            return Vectors<D>{F::load_unaligned(from[0]), F::load_unaligned(from[1]),
                              F::load_unaligned(from[2])};
        };
        rays = {vectors(numbers), vectors(numbers + 3)};
        unit = vectors(numbers + 8);
        length = F::load_unaligned(numbers[6]);
        t_after = F::load_unaligned(numbers[7]);
        half_ulp = F::load_unaligned(numbers[11]);
    }

    /// Returns the starts of the rays, as the shape with this id sees them.
    Starts<D> starts_on(std::uint32_t id) const {
        if (!leaves_) return starts_nowhere<D>();
        std::uint32_t ids[width];
        for (std::uint32_t& it : ids)
            it = id;
        return {Lanes<D>::in_range(ids, first_, last_),
                Lanes<D>::from_numbers(bits_, origin_inward) > zero<D>(),
                Lanes<D>::from_numbers(bits_, origin_face)};
    }

  private:
    /// Returns half the distance from a limit to the next double if its ray needs that.
    static double half_ulp_of(double t_after, std::uint32_t bits) {
        if (!(t_after > 0.0) || (bits & stream_half_ulp) == 0) return 0.0;
        const auto next = __builtin_bit_cast(std::uint64_t, t_after) + 1;
        return 0.5 * (__builtin_bit_cast(double, next) - t_after);
    }

    std::uint32_t first_[width], last_[width], bits_[width];
    bool leaves_ = false;
};

} // namespace raylane::simd
