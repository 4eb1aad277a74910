#pragma once

#include "simd/kernel/bounded.hpp"
#include "simd/kernel/finishers/finisher.hpp"
#include "simd/kernel/slots.hpp"
#include "simd/kernel/solvers/solvers.hpp"
#include "simd/kernels.hpp"

#include <type_traits>

namespace raylane::simd {

/// What the finishers have left in doubt: most of it rays that just miss a shape, that start beside
/// its surface or touch it. Here the solvers' formulas themselves are asked, in numbers with
/// bounds, which takes several times as long: in double, and then with twice as many digits.
///
/// Rays are what their doubles say, or those that they stand for. (The finishers' bounds grant
/// directions the error of bringing them to unit length.)
template <class Arch>
class FinishAgain {
  public:
    FinishAgain(const SceneView& scene, const Found& found) : scene_(scene), found_(found) {}

    void doubtful_rays() {
        for (std::size_t i = 0; i < found_.count; ++i)
            if (is_doubtful(i)) add<D>(in_double_[S::kind_of(scene_, found_.slot[i])], i);
        for (Packet& packet : in_double_)
            finish<D>(packet);
        for (Packet& packet : wide_)
            finish<Wide<D>>(packet);
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
        std::size_t count = 0;
    };

    /// And do not start on the shape.
    bool is_doubtful(std::size_t i) const {
        const std::uint32_t slot = found_.slot[i];
        if (slot == no_slot || (found_.hit[i] & hit_doubtful) == 0) return false;
        const TableView& table = scene_.tables[S::kind_of(scene_, slot)];
        const float* const ids = table.blocks + 16 * static_cast<std::size_t>(table.values);
        const auto id = __builtin_bit_cast(std::uint32_t, ids[S::offset(table, slot)]);
        const std::uint32_t first = found_.departed_first[i];
        return id - first > found_.departed_last[i] - first;
    }

    template <class Number>
    void add(Packet& packet, std::size_t ray) {
        packet.rays[packet.count++] = ray;
        if (packet.count == width) finish<Number>(packet);
    }

    /// Reads the floats of a shape per lane.
    struct Reader {
        const float* from[width];
        std::size_t row = 0;

        F next() {
            double values[width];
            for (std::size_t lane = 0; lane < width; ++lane)
                values[lane] = static_cast<double>(from[lane][row]);
            row += 16;
            return F::load_unaligned(values);
        }
    };

    template <class Number>
    struct ExactReader {
        Reader reader;
        Floats<Certified<Number>> next() { return Floats<Certified<Number>>(reader.next()); }
    };

    template <class Number>
    void finish(Packet& packet) {
        if (packet.count == 0) return;
        const auto kind = static_cast<KindNumber>(S::kind_of(scene_, found_.slot[packet.rays[0]]));
        const TableView& table = scene_.tables[kind];
        Reader reader;
        const bool stand_for_others = found_.meant_length != nullptr;
        const double* const* const directions =
            stand_for_others ? found_.meant_direction : found_.direction;
        double numbers[7][width];
        for (std::size_t lane = 0; lane < width; ++lane) {
            // Those that are not in use do what the first one does.
            const std::size_t ray = packet.rays[lane < packet.count ? lane : 0];
            reader.from[lane] = table.blocks + S::offset(table, found_.slot[ray]);
            for (int axis = 0; axis < 3; ++axis) {
                numbers[axis][lane] = found_.origin[axis][ray];
                numbers[3 + axis][lane] = directions[axis][ray];
            }
            numbers[6][lane] = stand_for_others ? found_.meant_length[ray] : 1.0;
        }
        const auto load = [&](double(*from)[width]) {
            return Vectors<D>{F::load_unaligned(from[0]), F::load_unaligned(from[1]),
                              F::load_unaligned(from[2])};
        };
        const Rays<D> rays = {load(numbers), load(numbers + 3)};
        std::uint32_t certain = 0, misses = 0;
        with_lanes<Certified<Number>>(kind, [&]<class Solver>() {
            const Finished<D> finished = first_crossing<Solver, Number>(
                reader, rays, F::load_unaligned(numbers[6]), found_.holds_points);
            certain = Lanes<D>::bits(finished.certain);
            misses = Lanes<D>::bits(finished.misses);
            if (certain != 0) store(finished, packet, certain);
        });
        for (std::size_t lane = 0; lane < packet.count; ++lane) {
            if ((misses >> lane & 1) != 0)
                found_.hit[packet.rays[lane]] = hit_none;
            else if ((certain >> lane & 1) == 0 && std::is_same_v<Number, D>)
                add<Wide<D>>(wide_[kind], packet.rays[lane]);
        }
        packet.count = 0;
    }

    /// Where rays that do not start on it first cross a shape. The normal is not known.
    template <class Solver, class Number>
    [[gnu::noinline]] static Finished<D> first_crossing(const Reader& reader, const Rays<D>& rays,
                                                        const F& length, bool holds_points) {
        using C = Certified<Number>;
        const auto exact = [](const Vectors<D>& v) {
            return Vectors<C>{Floats<C>(v.x), Floats<C>(v.y), Floats<C>(v.z)};
        };
        const Solver solver(ExactReader<Number>{reader});
        const Crossing<C> first = first_ahead<C>(
            solver.crossings({exact(rays.origin), exact(rays.direction)}, starts_nowhere<C>()),
            none<C>());
        using Its = Digits<Number>;
        const F t = first.t.in_double();
        const F error = (first.t.error + Its::lost_in_double(first.t.value)) * F(1.0 + 0x1p-50);
        M certain = first.exists.surely() & (first.face.error == zero<D>()) & first.entering.known &
                    is_result<D>(t, error);
        if (holds_points) certain = certain & holds_point(rays, t, error);
        // Of rays that stand for others the length is off by a few ulps, and so is the product.
        const F unit_t = t * length, rounding = select(length == F(1.0), zero<D>(), F(0x1p-50));
        return {certain,
                unit_t,
                error * length + rounding * unit_t,
                first.face.in_double(),
                first.entering.answer,
                {},
                first.exists.surely_not()};
    }

    void store(const Finished<D>& finished, const Packet& packet, std::uint32_t certain) const {
        double t[width], error[width], face[width];
        finished.t.store_unaligned(t);
        finished.error.store_unaligned(error);
        finished.face.store_unaligned(face);
        const std::uint32_t entering = Lanes<D>::bits(finished.entering);
        for (std::size_t lane = 0; lane < packet.count; ++lane) {
            if ((certain >> lane & 1) == 0) continue;
            const std::size_t ray = packet.rays[lane];
            found_.t[ray] = t[lane];
            found_.error[ray] = error[lane];
            found_.hit[ray] = static_cast<std::uint32_t>(face[lane]) | hit_normal_unknown |
                              ((entering >> lane & 1) != 0 ? hit_entering : 0);
        }
    }

    const SceneView& scene_;
    const Found& found_;
    Packet in_double_[kinds], wide_[kinds];
};

template <class Arch>
void finish_again(const SceneView& scene, const Found& found) {
    FinishAgain<Arch>(scene, found).doubtful_rays();
}

} // namespace raylane::simd
