#pragma once

#include "simd/kernel/certify/gathered_rays.hpp"
#include "simd/kernel/certify/slot_reader.hpp"
#include "simd/kernel/certify/slots.hpp"
#include "simd/kernel/shapes/certified_solver.hpp"
#include "simd/kernel/shapes/shapes.hpp"
#include "simd/units/kernels.hpp"

#include <type_traits>

namespace raylane::simd {

/// Solves rays again that the certified solvers left in doubt. Most of these just miss a shape,
/// start beside its surface or touch it. The solvers' own formulas run in numbers with bounds,
/// which takes several times as long: first in double, then with twice as many digits.
///
/// Rays are exactly their doubles, or the exact rays that these stand for. (The certified solvers'
/// bounds cover the error of bringing directions to unit length.)
template <class Arch>
class Refine {
  public:
    Refine(const SceneView& scene, const Found& found) : scene_(scene), found_(found) {}

    void doubtful_rays() {
        for (std::size_t i = 0; i < found_.count; ++i)
            if (is_doubtful(i)) add<D>(in_double_[index_of(i)], i);
        for (Packet& packet : in_double_)
            solve<D>(packet);
        for (Packet& packet : wide_)
            solve<Wide<D>>(packet);
    }

    /// Implements RefineKernels::widen.
    void widen(const std::size_t* places, std::size_t count, const WideCrossings& wide) {
        for (std::size_t k = 0; k < count; ++k) {
            wide.error[k] = __builtin_inf();
            if (wide.rounded != nullptr) wide.rounded[k] = 0;
            if (starts_on_shape(places[k])) continue;
            Packet& packet = wide_[index_of(places[k])];
            packet.indices[packet.count] = k;
            packet.rays[packet.count++] = places[k];
            if (packet.count == width) widen(packet, wide);
        }
        for (Packet& packet : wide_)
            widen(packet, wide);
    }

  private:
    using D = Double<Arch>;
    using S = Slots<Arch>;
    using F = Floats<D>;
    using M = Mask<D>;
    static constexpr std::size_t width = F::size;

    /// Rays that found shapes of one kind.
    struct Packet {
        std::size_t rays[width];
        std::size_t indices[width]; ///< the caller's indices of these
        std::size_t count = 0;
    };

    bool is_doubtful(std::size_t i) const {
        return found_.slot[i] != no_slot && (found_.hit[i] & hit_doubtful) != 0 &&
               !starts_on_shape(i);
    }
    bool starts_on_shape(std::size_t i) const {
        const std::uint32_t slot = found_.slot[i];
        const TableView& table = S::table_of(scene_, S::kind_of(scene_, slot));
        const std::uint32_t id = S::id(table, slot);
        const std::uint32_t first = found_.origin_first[i];
        return id - first <= found_.origin_last[i] - first;
    }

    int index_of(std::size_t ray) const {
        return static_cast<int>(S::kind_of(scene_, found_.slot[ray]));
    }

    template <class Number>
    void add(Packet& packet, std::size_t ray) {
        packet.rays[packet.count++] = ray;
        if (packet.count == width) solve<Number>(packet);
    }

    using Reader = SlotReader<D>;
    template <class Number>
    using ExactReader = CertifiedSlotReader<D, Number>;

    /// The exact rays of a packet, with the readers of their shapes.
    struct Loaded : GatheredRays<Arch> {
        Reader reader;
        explicit Loaded(const TableView& table) : reader(table) {}
    };

    Loaded load(const Packet& packet, core::Kind kind) const {
        Loaded loaded(S::table_of(scene_, kind));
        loaded.gather(found_, packet.rays, packet.count);
        for (std::size_t lane = 0; lane < width; ++lane)
            loaded.reader.set(lane, found_.slot[packet.rays[lane < packet.count ? lane : 0]]);
        return loaded;
    }

    core::Kind kind_of(const Packet& packet) const {
        return S::kind_of(scene_, found_.slot[packet.rays[0]]);
    }

    template <class Number>
    void solve(Packet& packet) {
        if (packet.count == 0) return;
        const core::Kind kind = kind_of(packet);
        const Loaded loaded = load(packet, kind);
        std::uint32_t certain = 0, misses = 0;
        with_solver<Certified<Number>>(kind, [&]<class Solver>() {
            const CertifiedCrossing<D> crossing =
                first_crossing<Solver, Number>(loaded, found_.holds_points);
            certain = Lanes<D>::bits(crossing.certain);
            misses = Lanes<D>::bits(crossing.misses);
            if (certain != 0) store(crossing, packet, certain);
        });
        for (std::size_t lane = 0; lane < packet.count; ++lane) {
            if ((misses >> lane & 1) != 0)
                found_.hit[packet.rays[lane]] = hit_none;
            else if ((certain >> lane & 1) == 0 && std::is_same_v<Number, D>)
                add<Wide<D>>(wide_[static_cast<int>(kind)], packet.rays[lane]);
        }
        packet.count = 0;
    }

    template <class Number, class Solver>
    static Crossing<Certified<Number>> crossing_of(const Solver& solver, const Loaded& loaded) {
        using C = Certified<Number>;
        Crossings<C> crossings =
            solver.crossings(certified<Number>(loaded.rays), starts_nowhere<C>());
        for (Crossing<C>* const crossing : {&crossings.first, &crossings.second})
            crossing->exists = crossing->exists & is_after<C>(crossing->t, loaded);
        return first_ahead<C>(crossings, none<C>());
    }

    /// Returns the crossings that enter or leave the shape as those that were found. A line enters
    /// a shape at most once, and leaves it at most once.
    template <class Solver>
    Crossing<Certified<Wide<D>>> crossing_like(const Solver& solver, const Loaded& loaded,
                                               const Packet& packet) const {
        using C = Certified<Wide<D>>;
        const auto [first, second] =
            solver.crossings(certified<Wide<D>>(loaded.rays), starts_nowhere<C>());
        std::uint32_t entering = 0;
        for (std::size_t lane = 0; lane < packet.count; ++lane)
            entering |= ((found_.hit[packet.rays[lane]] & hit_entering) != 0 ? 1U : 0U) << lane;
        const M is_first =
            first.exists.answer & ~differ(first.entering.answer, Lanes<D>::from_bits(entering));
        const auto chosen_of = [&](const Floats<C>& a, const Floats<C>& b) {
            return Floats<C>(select(is_first, a.value, b.value),
                             select(is_first, a.error, b.error));
        };
        const auto either = [&](const Mask<C>& a, const Mask<C>& b) {
            return Mask<C>((is_first & a.answer) | (~is_first & b.answer),
                           (is_first & a.known) | (~is_first & b.known));
        };
        return {either(first.exists, second.exists), chosen_of(first.t, second.t),
                chosen_of(first.face, second.face), either(first.entering, second.entering)};
    }

    /// Returns whether t is after the limit. The answer is unknown if t is certainly at a
    /// limit > 0.
    template <class C>
    static Mask<C> is_after(const Floats<C>& t, const Loaded& loaded) {
        const Floats<C> limit = Floats<C>(loaded.t_after) + Floats<C>(loaded.half_ulp);
        Mask<C> is_after = t > limit;
        is_after.known = is_after.known & ~((t == limit).surely() & (loaded.t_after > zero<D>()));
        return is_after;
    }

    void widen(Packet& packet, const WideCrossings& wide) {
        if (packet.count == 0) return;
        const core::Kind kind = kind_of(packet);
        const Loaded loaded = load(packet, kind);
        with_solver<Certified<Wide<D>>>(
            kind, [&]<class Solver>() { store<Solver>(loaded, packet, wide); });
        packet.count = 0;
    }

    /// Stores the crossings whose face and direction match the ones that were found.
    template <class Solver>
    [[gnu::noinline]] void store(const Loaded& loaded, const Packet& packet,
                                 const WideCrossings& wide) const {
        const Solver solver(ExactReader<Wide<D>>{loaded.reader});
        const Crossing<Certified<Wide<D>>> first = crossing_like(solver, loaded, packet);
        const std::uint32_t known = Lanes<D>::bits(
            first.exists.surely() & (first.face.error == zero<D>()) & first.entering.known);
        const std::uint32_t entering = Lanes<D>::bits(first.entering.answer);
        double face[width], high[width], low[width], error[width];
        first.face.in_double().store_unaligned(face);
        first.t.value.high.store_unaligned(high);
        first.t.value.low.store_unaligned(low);
        first.t.error.store_unaligned(error);
        std::uint32_t those = 0;
        for (std::size_t lane = 0; lane < packet.count; ++lane) {
            const std::uint32_t hit = found_.hit[packet.rays[lane]];
            const bool is_it = (known >> lane & 1) != 0 &&
                               static_cast<std::uint32_t>(face[lane]) == (hit & hit_face) &&
                               (entering >> lane & 1) == ((hit & hit_entering) != 0 ? 1U : 0U);
            if (!is_it) continue;
            those |= 1U << lane;
            const std::size_t k = packet.indices[lane];
            wide.high[k] = high[lane];
            wide.low[k] = low[lane];
            wide.error[k] = error[lane];
        }
        if (wide.rounded != nullptr && those != 0)
            store_normals(normal_of<Wide<D>>(solver, loaded, first), packet, those, wide);
    }

    template <class Number, class Solver>
    static Vectors<Certified<Number>> normal_of(const Solver& solver, const Loaded& loaded,
                                                const Crossing<Certified<Number>>& crossing) {
        using C = Certified<Number>;
        const Rays<C> rays = certified<Number>(loaded.rays);
        return solver.outward_normal(mul_add<C>(crossing.t, rays.direction, rays.origin),
                                     crossing.face);
    }

    /// Stores a normal in double, with its error.
    template <class Number>
    static void store(const Vectors<Certified<Number>>& normal, CertifiedCrossing<D>& crossing) {
        const auto error = [](const Floats<Certified<Number>>& component) {
            const F off = component.error + Digits<Number>::lost_in_double(component.value);
            // This sum is rounded, and so are the sums of the component and it.
            return select(off == zero<D>(), off, off + F(0x1p-50) * (off + component.magnitude()));
        };
        crossing.normal = {normal.x.in_double(), normal.y.in_double(), normal.z.in_double()};
        crossing.normal_error = {error(normal.x), error(normal.y), error(normal.z)};
    }

    /// Stores the normals of `lanes` of the packet.
    static void store_normals(const Vectors<Certified<Wide<D>>>& normal, const Packet& packet,
                              std::uint32_t lanes, const WideCrossings& wide) {
        CertifiedCrossing<D> crossing;
        store(normal, crossing);
        const F* const values[] = {&crossing.normal.x, &crossing.normal.y, &crossing.normal.z};
        const F* const errors[] = {&crossing.normal_error.x, &crossing.normal_error.y,
                                   &crossing.normal_error.z};
        for (int axis = 0; axis < 3; ++axis) {
            const std::uint32_t rounded =
                lanes & Lanes<D>::bits(round_alike<D>(*values[axis], *errors[axis]));
            double numbers[width];
            values[axis]->store_unaligned(numbers);
            for (std::size_t lane = 0; lane < packet.count; ++lane) {
                const std::size_t k = packet.indices[lane];
                wide.normal[axis][k] = static_cast<float>(numbers[lane]);
                wide.rounded[k] =
                    static_cast<std::uint8_t>(wide.rounded[k] | (rounded >> lane & 1) << axis);
            }
        }
    }

    /// Returns the first crossing of rays that do not start on the shape. Unless `holds_points`,
    /// also returns its normal.
    template <class Solver, class Number>
    [[gnu::noinline]] static CertifiedCrossing<D> first_crossing(const Loaded& loaded,
                                                                 bool holds_points) {
        const F& length = loaded.length;
        const Solver solver(ExactReader<Number>{loaded.reader});
        const Crossing<Certified<Number>> first = crossing_of<Number>(solver, loaded);
        using Its = Digits<Number>;
        const F t = first.t.in_double();
        const F error = (first.t.error + Its::lost_in_double(first.t.value)) * F(1.0 + 0x1p-50);
        M certain = first.exists.surely() & (first.face.error == zero<D>()) & first.entering.known &
                    is_result<D>(t, error);
        if (holds_points) certain = certain & holds_point(loaded.rays, t, error);
        // If rays stand for others, their length is off by a few ulps, and so is the product.
        const F unit_t = t * length, rounding = select(length == F(1.0), zero<D>(), F(0x1p-50));
        CertifiedCrossing<D> crossing = {certain,
                                         unit_t,
                                         error * length + rounding * unit_t,
                                         first.face.in_double(),
                                         first.entering.answer,
                                         {},
                                         first.exists.surely_not()};
        if (!holds_points && any<D>(certain))
            store(normal_of<Number>(solver, loaded, first), crossing);
        return crossing;
    }

    void store(const CertifiedCrossing<D>& crossing, const Packet& packet,
               std::uint32_t certain) const {
        double t[width], error[width], face[width];
        crossing.t.store_unaligned(t);
        crossing.error.store_unaligned(error);
        crossing.face.store_unaligned(face);
        const std::uint32_t entering = Lanes<D>::bits(crossing.entering);
        std::uint32_t with_normal = 0;
        double normal[3][width];
        if (!found_.holds_points) {
            with_normal = Lanes<D>::bits(is_rounded(crossing));
            crossing.normal.x.store_unaligned(normal[0]);
            crossing.normal.y.store_unaligned(normal[1]);
            crossing.normal.z.store_unaligned(normal[2]);
        }
        for (std::size_t lane = 0; lane < packet.count; ++lane) {
            if ((certain >> lane & 1) == 0) continue;
            const std::size_t ray = packet.rays[lane];
            const bool has_normal = (with_normal >> lane & 1) != 0;
            for (int axis = 0; has_normal && axis < 3; ++axis)
                found_.normal[axis][ray] = normal[axis][lane];
            found_.t[ray] = t[lane];
            found_.error[ray] = error[lane];
            found_.hit[ray] = static_cast<std::uint32_t>(face[lane]) |
                              (has_normal ? 0 : hit_normal_unknown) |
                              ((entering >> lane & 1) != 0 ? hit_entering : 0);
        }
    }

    const SceneView& scene_;
    const Found& found_;
    Packet in_double_[core::kind_count], wide_[core::kind_count];
};

template <class Arch>
void refine(const SceneView& scene, const Found& found) {
    Refine<Arch>(scene, found).doubtful_rays();
}

template <class Arch>
void widen(const SceneView& scene, const Found& found, const std::size_t* places, std::size_t count,
           const WideCrossings& wide) {
    Refine<Arch>(scene, found).widen(places, count, wide);
}

} // namespace raylane::simd
