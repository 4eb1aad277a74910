#pragma once

#include "simd/kernel/certify/slot_reader.hpp"
#include "simd/kernel/certify/slots.hpp"
#include "simd/kernel/certify/solve.hpp"
#include "simd/kernel/shapes/shapes.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

/// Finds all crossings of rays with shapes, by the solvers' formulas in double-doubles with bounds.
/// Implements RefineKernels::cross_all.
template <class Arch>
class CrossAll {
  public:
    CrossAll(const SceneView& scene, const CrossingPairs& pairs) : scene_(scene), pairs_(pairs) {}

    void all_pairs() {
        for (std::size_t k = 0, end = 0; k < pairs_.count;) {
            while (end < pairs_.count && pairs_.ray[end] == pairs_.ray[k])
                ++end;
            for (const bool are_many = end - k > few; k < end; ++k) {
                const int kind = static_cast<int>(S::kind_of(scene_, pairs_.slot[k]));
                are_many ? add_to_sift(sifted_[kind], k) : add(packets_[kind], k);
            }
        }
        for (Packet& packet : sifted_)
            sift(packet);
        for (Packet& packet : packets_)
            cross(packet);
    }

  private:
    using D = Double<Arch>;
    using S = Slots<Arch>;
    using F = Floats<D>;
    using C = Certified<Wide<D>>;
    static constexpr std::size_t width = F::size;

    /// Pairs of a ray and a shape. All shapes of a packet are of one kind.
    struct Packet {
        std::size_t pair[width];
        std::size_t count = 0;
    };

    /// Sifting does not pay for a ray with at most this number of pairs.
    static constexpr std::size_t few = 16;

    void add(Packet& packet, std::size_t pair) {
        packet.pair[packet.count++] = pair;
        if (packet.count == width) cross(packet);
    }
    void add_to_sift(Packet& packet, std::size_t pair) {
        packet.pair[packet.count++] = pair;
        if (packet.count == width) sift(packet);
    }

    core::Kind kind_of(const Packet& packet) const {
        return S::kind_of(scene_, pairs_.slot[packet.pair[0]]);
    }

    /// The rays of a packet, with the directions passed to load(), and a reader of the shapes with
    /// which the rays are paired.
    struct Loaded {
        SlotReader<D> reader;
        Rays<D> rays;
    };
    Loaded load(const Packet& packet, const double* const (&directions)[3]) const {
        const TableView& table = S::table_of(scene_, kind_of(packet));
        Loaded loaded{SlotReader<D>(table), {}};
        double numbers[6][width];
        for (std::size_t lane = 0; lane < width; ++lane) {
            // Unused lanes repeat the first one.
            const std::size_t pair = packet.pair[lane < packet.count ? lane : 0];
            loaded.reader.set(lane, pairs_.slot[pair]);
            for (int axis = 0; axis < 3; ++axis) {
                numbers[axis][lane] = pairs_.origin[axis][pairs_.ray[pair]];
                numbers[3 + axis][lane] = directions[axis][pairs_.ray[pair]];
            }
        }
        const auto vectors = [&](double(*from)[width]) {
            return Vectors<D>{F::load_unaligned(from[0]), F::load_unaligned(from[1]),
                              F::load_unaligned(from[2])};
        };
        loaded.rays = {vectors(numbers), vectors(numbers + 3)};
        return loaded;
    }

    /// Removes the pairs of a packet whose rays certainly miss their shapes, by double arithmetic.
    /// (The certified solvers' bounds cover the error of bringing directions to unit length.)
    void sift(Packet& packet) {
        if (packet.count == 0) return;
        const core::Kind kind = kind_of(packet);
        const Loaded loaded = load(packet, pairs_.unit_direction);
        std::uint32_t misses = 0;
        with_certified_solver<D>(
            kind, [&]<class CertifiedSolver>() { misses = missed<CertifiedSolver>(loaded); });
        for (std::size_t lane = 0; lane < packet.count; ++lane) {
            const std::size_t pair = packet.pair[lane];
            if ((misses >> lane & 1) == 0)
                add(packets_[static_cast<int>(kind)], pair);
            else
                pairs_.hit[2 * pair] = pairs_.hit[2 * pair + 1] = hit_none;
        }
        packet.count = 0;
    }
    template <class CertifiedSolver>
    [[gnu::noinline]] static std::uint32_t missed(const Loaded& loaded) {
        const CertifiedSolver solver{loaded.reader};
        const CertifiedCrossing<D> crossing =
            solver.template solve<Wanted::all>(loaded.rays, starts_nowhere<D>());
        return Lanes<D>::bits(crossing.misses & ~crossing.certain);
    }

    void cross(Packet& packet) {
        if (packet.count == 0) return;
        const core::Kind kind = kind_of(packet);
        const Loaded loaded = load(packet, pairs_.direction);
        with_solver<C>(kind,
                       [&]<class Solver>() { cross<Solver>(loaded.reader, loaded.rays, packet); });
        packet.count = 0;
    }

    template <class Solver>
    [[gnu::noinline]] void cross(const SlotReader<D>& reader, const Rays<D>& rays,
                                 const Packet& packet) const {
        const Solver solver(CertifiedSlotReader<D, Wide<D>>{reader});
        const Crossings<C> found = solver.crossings(certified<Wide<D>>(rays), starts_nowhere<C>());
        store(found.first, packet, 0);
        store(found.second, packet, 1);
        if (pairs_.normal[0] == nullptr) return;
        with_solver<Certified<D>>(kind_of(packet), [&]<class InDouble>() {
            store_normals<InDouble>(reader, rays, found, packet);
        });
    }

    /// Stores normals. They need no more digits than double has.
    template <class Solver>
    [[gnu::noinline]] void store_normals(const SlotReader<D>& reader, const Rays<D>& rays,
                                         const Crossings<C>& found, const Packet& packet) const {
        using InDouble = Certified<D>;
        const Solver solver(CertifiedSlotReader<D, D>{reader});
        const Rays<InDouble> exact = certified<D>(rays);
        const Crossing<C>* const crossings[] = {&found.first, &found.second};
        for (std::size_t which = 0; which < 2; ++which) {
            const Crossing<C>& crossing = *crossings[which];
            const Floats<InDouble> t(crossing.t.value.high,
                                     (crossing.t.error + abs(crossing.t.value.low)) *
                                         F(1.0 + 0x1p-50));
            const Vectors<InDouble> normal =
                solver.outward_normal(mul_add<InDouble>(t, exact.direction, exact.origin),
                                      Floats<InDouble>(crossing.face.in_double()));
            const Floats<InDouble>* const components[] = {&normal.x, &normal.y, &normal.z};
            for (int axis = 0; axis < 3; ++axis) {
                double numbers[width];
                select(round_alike<D>(components[axis]->value, components[axis]->error),
                       components[axis]->value, F(__builtin_nan("")))
                    .store_unaligned(numbers);
                for (std::size_t lane = 0; lane < packet.count; ++lane)
                    pairs_.normal[axis][2 * packet.pair[lane] + which] =
                        static_cast<float>(numbers[lane]) + 0.0F; // no -0
            }
        }
    }

    void store(const Crossing<C>& crossing, const Packet& packet, int which) const {
        const auto exists = crossing.exists & (crossing.t > Floats<C>(0.0));
        const std::uint32_t none = Lanes<D>::bits(exists.surely_not());
        const std::uint32_t known = Lanes<D>::bits(
            exists.surely() & (crossing.face.error == zero<D>()) & crossing.entering.known);
        const std::uint32_t entering = Lanes<D>::bits(crossing.entering.answer);
        double face[width], high[width], low[width], error[width];
        crossing.face.in_double().store_unaligned(face);
        crossing.t.value.high.store_unaligned(high);
        crossing.t.value.low.store_unaligned(low);
        crossing.t.error.store_unaligned(error);
        for (std::size_t lane = 0; lane < packet.count; ++lane) {
            const std::size_t to = 2 * packet.pair[lane] + static_cast<std::size_t>(which);
            pairs_.high[to] = high[lane];
            pairs_.low[to] = low[lane];
            pairs_.error[to] = error[lane];
            pairs_.hit[to] = (none >> lane & 1) != 0 ? hit_none
                             : (known >> lane & 1) == 0
                                 ? hit_doubtful
                                 : static_cast<std::uint32_t>(face[lane]) |
                                       ((entering >> lane & 1) != 0 ? hit_entering : 0);
        }
    }

    const SceneView& scene_;
    const CrossingPairs& pairs_;
    Packet sifted_[core::kind_count], packets_[core::kind_count];
};

template <class Arch>
void cross_all(const SceneView& scene, const CrossingPairs& pairs) {
    CrossAll<Arch>(scene, pairs).all_pairs();
}

} // namespace raylane::simd
