#pragma once

#include "simd/kernel/certify/exact.hpp"
#include "simd/kernel/certify/in_double.hpp"
#include "simd/kernel/certify/plain.hpp"
#include "simd/kernel/shade/shade.hpp"
#include "simd/kernel/traverse/prepare.hpp"
#include "simd/kernel/traverse/traverse.hpp"
#include "simd/kernels.hpp"

namespace raylane::simd {

template <class Arch>
struct KernelsOf {
    using F = Floats<Arch>;
    using M = Mask<Arch>;
    static constexpr int lanes = static_cast<int>(F::size);

    struct Hits {
        F t, shape, face, entering;
    };

    static F load(const float* from) { return F::load_unaligned(from); }

    /// Whether id a is lower than b, in lanes where that matters.
    static M is_lower(const F& a, const F& b) {
        return Lanes<Arch>::in_range(a, zero<Arch>(), b) & ~Lanes<Arch>::in_range(a, b, b);
    }

    static Rays<Arch> rays_from(const PacketStream& stream, std::size_t i) {
        return {
            {load(stream.origin[0] + i), load(stream.origin[1] + i), load(stream.origin[2] + i)},
            {load(stream.direction[0] + i), load(stream.direction[1] + i),
             load(stream.direction[2] + i)}};
    }

    static Rays<Arch> broadcast_ray(const PacketStream& stream, std::size_t i) {
        return {{F(stream.origin[0][i]), F(stream.origin[1][i]), F(stream.origin[2][i])},
                {F(stream.direction[0][i]), F(stream.direction[1][i]), F(stream.direction[2][i])}};
    }

    static Starts<Arch> starts_from(const F& id, const PacketStream& stream, std::size_t i) {
        return {Lanes<Arch>::in_range(id, load(stream.departed_first + i),
                                      load(stream.departed_last + i)),
                load(stream.departed_inward + i) > zero<Arch>(), load(stream.departed_face + i)};
    }

    /// Empty lanes of a block have the id that stands for no departure; they start nowhere.
    static Starts<Arch> broadcast_start(const F& ids, const PacketStream& stream, std::size_t i) {
        const F no_id(__builtin_bit_cast(float, ~0U));
        return {
            Lanes<Arch>::in_range(ids, F(stream.departed_first[i]), F(stream.departed_last[i])) &
                ~Lanes<Arch>::in_range(ids, no_id, no_id),
            F(stream.departed_inward[i]) > zero<Arch>(), F(stream.departed_face[i])};
    }

    static void take(const Crossing<Arch>& crossing, const M& on_surface, const F& id, Hits& hits) {
        const M ties = crossing.t == hits.t;
        const M nearer = (crossing.t < hits.t) | (ties & is_lower(id, hits.shape));
        const M taken = ahead(crossing, on_surface) & nearer;
        hits.t = select(taken, crossing.t, hits.t);
        hits.shape = select(taken, id, hits.shape);
        hits.face = select(taken, crossing.face, hits.face);
        hits.entering = select(taken, select(crossing.entering, F(1.0F), F(0.0F)), hits.entering);
    }

    static M blocks(const Crossings<Arch>& found, const M& on_surface, const F& t_most) {
        return (ahead(found.first, on_surface) & (found.first.t < t_most)) |
               (ahead(found.second, on_surface) & (found.second.t < t_most));
    }

    [[gnu::flatten]] static void intersect_rays(KindNumber kind, const ShapeBlock& block, int lane,
                                                PacketStream& stream) {
        with_lanes<Arch>(kind, [&]<class Shape>() {
            const Shape shape(BroadcastReader<Arch>(block.values, lane));
            const F id(block.ids[lane]);
            for (std::size_t i = 0; i < stream.count; i += F::size) {
                const Starts<Arch> starts = starts_from(id, stream, i);
                const Crossings<Arch> found = shape.crossings(rays_from(stream, i), starts);
                Hits hits = {load(stream.t + i), load(stream.shape + i), load(stream.face + i),
                             load(stream.entering + i)};
                take(found.first, starts.on_surface, id, hits);
                take(found.second, starts.on_surface, id, hits);
                hits.t.store_unaligned(stream.t + i);
                hits.shape.store_unaligned(stream.shape + i);
                hits.face.store_unaligned(stream.face + i);
                hits.entering.store_unaligned(stream.entering + i);
            }
        });
    }

    [[gnu::flatten]] static void occlude_rays(KindNumber kind, const ShapeBlock& block, int lane,
                                              PacketStream& stream) {
        with_lanes<Arch>(kind, [&]<class Shape>() {
            const Shape shape(BroadcastReader<Arch>(block.values, lane));
            const F id(block.ids[lane]);
            for (std::size_t i = 0; i < stream.count; i += F::size) {
                const Starts<Arch> starts = starts_from(id, stream, i);
                const F t = load(stream.t + i);
                const M blocked =
                    blocks(shape.crossings(rays_from(stream, i), starts), starts.on_surface, t);
                select(blocked, F(-1.0F), t).store_unaligned(stream.t + i);
            }
        });
    }

    [[gnu::flatten]] static void intersect_block(KindNumber kind, const ShapeBlock& block,
                                                 PacketStream& stream, std::size_t ray) {
        with_lanes<Arch>(kind, [&]<class Shape>() {
            const Rays<Arch> rays = broadcast_ray(stream, ray);
            for (int lane = 0; lane < 16; lane += lanes) {
                const Shape shape(BlockReader<Arch>(block.values, lane));
                const F ids = load(block.ids + lane);
                const Starts<Arch> starts = broadcast_start(ids, stream, ray);
                const Crossings<Arch> found = shape.crossings(rays, starts);
                Hits hits = {F(stream.t[ray]), F(stream.shape[ray]), zero<Arch>(), zero<Arch>()};
                take(found.first, starts.on_surface, ids, hits);
                take(found.second, starts.on_surface, ids, hits);
                reduce(hits, stream, ray);
            }
        });
    }

    [[gnu::flatten]] static void occlude_block(KindNumber kind, const ShapeBlock& block,
                                               PacketStream& stream, std::size_t ray) {
        with_lanes<Arch>(kind, [&]<class Shape>() {
            const Rays<Arch> rays = broadcast_ray(stream, ray);
            const F t(stream.t[ray]);
            for (int lane = 0; lane < 16; lane += lanes) {
                const Shape shape(BlockReader<Arch>(block.values, lane));
                const Starts<Arch> starts = broadcast_start(load(block.ids + lane), stream, ray);
                const M blocked = blocks(shape.crossings(rays, starts), starts.on_surface, t);
                if (Lanes<Arch>::bits(blocked) != 0) stream.t[ray] = -1.0F;
            }
        });
    }

    /// The nearest of the lanes becomes the ray's hit.
    static void reduce(const Hits& hits, PacketStream& stream, std::size_t ray) {
        std::uint32_t better = Lanes<Arch>::bits(
            (hits.t < F(stream.t[ray])) |
            ((hits.t == F(stream.t[ray])) & is_lower(hits.shape, F(stream.shape[ray]))));
        if (better == 0) return;
        float t[F::size], shape[F::size], face[F::size], entering[F::size];
        hits.t.store_unaligned(t);
        hits.shape.store_unaligned(shape);
        hits.face.store_unaligned(face);
        hits.entering.store_unaligned(entering);
        for (; better != 0; better &= better - 1) {
            const int i = __builtin_ctz(better);
            const bool lower = __builtin_bit_cast(std::uint32_t, shape[i]) <
                               __builtin_bit_cast(std::uint32_t, stream.shape[ray]);
            if (!(t[i] < stream.t[ray] || (t[i] == stream.t[ray] && lower))) continue;
            stream.t[ray] = t[i];
            stream.shape[ray] = shape[i];
            stream.face[ray] = face[i];
            stream.entering[ray] = entering[i];
        }
    }

    static void outward_normals(KindNumber kind, const ShapeBlock& block, int lane,
                                std::size_t count, const float* const point[3], const float* face,
                                float* const normal[3]) {
        with_lanes<Arch>(kind, [&]<class Shape>() {
            const Shape shape(BroadcastReader<Arch>(block.values, lane));
            for (std::size_t i = 0; i < count; i += F::size) {
                const Vectors<Arch> n = shape.outward_normal(
                    {load(point[0] + i), load(point[1] + i), load(point[2] + i)}, load(face + i));
                n.x.store_unaligned(normal[0] + i);
                n.y.store_unaligned(normal[1] + i);
                n.z.store_unaligned(normal[2] + i);
            }
        });
    }

    template <class Method>
    static constexpr MethodKernels method() {
        return {Trace<Arch, Method>::table(), Method::finish, Method::finish_all, Method::refine()};
    }

    static constexpr Kernels table(const char* name) {
        return {name,
                lanes,
                intersect_rays,
                intersect_block,
                occlude_rays,
                occlude_block,
                outward_normals,
                Prepare<Arch>::table(),
                {method<PlainMethod<Arch, true>>(), method<PlainMethod<Arch, false>>(),
                 method<ExactMethod<Arch>>(), method<DoubleMethod<Arch>>()},
                {{Shading<Double<Arch>, false, false>::table(),
                  Shading<Double<Arch>, false, true>::table()},
                 {Shading<Double<Arch>, true, false>::table(),
                  Shading<Double<Arch>, true, true>::table()}}};
    }
};

} // namespace raylane::simd
