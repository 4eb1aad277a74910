#pragma once

#include "simd/kernel/shapes/shapes.hpp"
#include "tests/simd/kernel/shapes/filter_check.hpp"

#include <limits>

namespace raylane::simd {

template <class Arch>
struct FilterChecksOf {
    using F = Floats<Arch>;

    static F load(const float* from) { return F::load_unaligned(from); }

    template <class Filter>
    static void store(const Filter& filter, const FilterRays<Arch>& rays,
                      const FilterStream& stream, std::size_t i) {
        const Bounds<Arch> bounds = filter.bounds(rays);
        F may_meet(1.0F);
        if constexpr (has_may_meet<Filter, FilterRays<Arch>>)
            may_meet = select(filter.may_meet(rays), F(1.0F), F(0.0F));
        may_meet.store_unaligned(stream.may_meet + i);
        for (std::size_t lane = 0; lane < F::size; ++lane)
            stream.contradicts[i + lane] = contradicts(filter, rays, bounds, lane) ? 1.0F : 0.0F;
        select(bounds.possible, F(1.0F), F(0.0F)).store_unaligned(stream.possible + i);
        bounds.lower.store_unaligned(stream.lower + i);
        select(bounds.certain, F(1.0F), F(0.0F)).store_unaligned(stream.certain + i);
        bounds.upper.store_unaligned(stream.upper + i);
    }

    /// Returns whether the obstacle in one lane differs from the bounds, if only that lane is
    /// requested.
    template <class Filter>
    static bool contradicts(const Filter& filter, const FilterRays<Arch>& rays,
                            const Bounds<Arch>& bounds, std::size_t lane) {
        if constexpr (requires { filter.obstacle(rays, 0U, bounds.lower, bounds.upper); }) {
            std::uint32_t differs = 0;
            const F infinity(std::numeric_limits<float>::infinity());
            for (const F& t :
                 {bounds.lower * F(0.9F), bounds.lower * F(1.1F), bounds.upper * F(0.9F),
                  bounds.upper * F(1.1F), bounds.upper * F(3.0F), infinity}) {
                const F perhaps_before = t * F(1.0F + 0x1p-22F);
                const F surely_before = t * F(1.0F - 0x1p-22F);
                const Obstacle<Arch> obstacle =
                    filter.obstacle(rays, 1U << lane, perhaps_before, surely_before);
                const Mask<Arch> possible = bounds.possible & (bounds.lower < perhaps_before);
                const Mask<Arch> certain =
                    possible & bounds.certain & (bounds.upper < surely_before);
                differs |= Lanes<Arch>::bits(obstacle.possible) ^ Lanes<Arch>::bits(possible);
                differs |= Lanes<Arch>::bits(obstacle.possible & obstacle.certain) ^
                           Lanes<Arch>::bits(certain);
            }
            return (differs >> lane & 1) != 0;
        }
        return false;
    }

    static void bound_rays(core::Kind kind, const ShapeBlock& block, int lane,
                           const FilterStream& stream) {
        with_filter<Arch>(kind, [&]<class Filter>() {
            const Filter filter(BroadcastReader<Arch>(block.values, lane));
            for (std::size_t i = 0; i < stream.count; i += F::size)
                store(filter,
                      {{load(stream.origin[0] + i), load(stream.origin[1] + i),
                        load(stream.origin[2] + i)},
                       {load(stream.direction[0] + i), load(stream.direction[1] + i),
                        load(stream.direction[2] + i)},
                       load(stream.slack + i)},
                      stream, i);
        });
    }

    static void bound_block(core::Kind kind, const ShapeBlock& block, const FilterStream& stream,
                            std::size_t ray) {
        with_filter<Arch>(kind, [&]<class Filter>() {
            const auto broadcast = [&](const float* const from[3]) {
                return Vectors<Arch>{F(from[0][ray]), F(from[1][ray]), F(from[2][ray])};
            };
            const FilterRays<Arch> rays = {broadcast(stream.origin), broadcast(stream.direction),
                                           F(stream.slack[ray])};
            for (std::size_t lane = 0; lane < 16; lane += F::size)
                store(Filter(BlockReader<Arch>(block.values, static_cast<int>(lane))), rays, stream,
                      lane);
        });
    }

    static constexpr FilterChecks table() { return {bound_rays, bound_block}; }
};

} // namespace raylane::simd
