#pragma once

#include "simd/kernel/certify/slots.hpp"
#include "simd/kernel/lanes/doubles.hpp"
#include "simd/kernel/lanes/vectors.hpp"
#include "simd/kernel/traverse/rays.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

/// Implements StreamKernels: takes in a caller's rays, 16 at a time, and hands over the answers.
template <class Arch>
class CallerStream {
  public:
    template <class Real>
    static std::size_t take(const RayStream<Real>& rays, const StreamRays& taken) {
        std::size_t none = 0;
        for (std::size_t i = 0; i < rays.count; i += 16) {
            if (rays.count - i < 16) {
                const PaddedRays<Real> padded(rays, i);
                return none + take_16(padded.rays, 0, rays.count - i, taken, i);
            }
            none += take_16(rays, i, 16, taken, i);
        }
        return none;
    }

    static DepartureSides find_sides(std::size_t count, const StreamRays& rays,
                                     const LeftSpheres& spheres, double share_of_size) {
        DepartureSides sides;
        for (std::size_t i = 0; i < count; i += half) {
            Vectors<D> offset, direction;
            Number* const offsets[] = {&offset.x, &offset.y, &offset.z};
            Number* const directions[] = {&direction.x, &direction.y, &direction.z};
            for (int axis = 0; axis < 3; ++axis) {
                *offsets[axis] = Number::load_unaligned(rays.origin[axis] + i) -
                                 Number::load_unaligned(spheres.center[axis] + i);
                *directions[axis] = Number::load_unaligned(rays.exact_direction[axis] + i);
            }
            const Number radius = Number::load_unaligned(spheres.radius + i);
            const Number squared = radius * radius;
            const auto sum = [](const Vectors<D>& a, const Vectors<D>& b, const auto& of) {
                return of(a.x * b.x) + of(a.y * b.y) + of(a.z * b.z);
            };
            const auto same = [](const Number& term) { return term; };
            const auto size_of = [](const Number& term) { return abs(term); };
            const Number along = sum(offset, direction, same);
            const Number size = sum(offset, direction, size_of);
            // Directions have about length 1.
            const Mask<D> clear =
                (abs(sum(offset, offset, same) - squared) <= Number(share_of_size) * squared) &
                (size > Number(0x1p-600)) & (abs(along) > Number(0x1p-45) * size);
            const std::uint32_t decided = Lanes<D>::bits(clear & first_lanes(count - i));
            const std::uint32_t outside = Lanes<D>::bits(along > zero<D>()) & decided;
            sides.outside |= std::uint64_t{outside} << i;
            sides.inside |= std::uint64_t{decided & ~outside} << i;
        }
        return sides;
    }

    /// Finds the common properties of rays. Rays through one point or in one direction are coherent
    /// if consecutive ones are near each other. Rays that end at one point are always coherent, as
    /// they are sorted later. Rays that are only near each other are loosely coherent.
    /// `max_spread`: the mean step between their origins, in radii of the scene.
    static bool find_coherence(std::size_t count, const StreamRays& rays, float radius,
                               float max_spread, Coherence& coherence) {
        coherence = {};
        if (count < fewest) return false;
        const double short_move = max_move * static_cast<double>(radius);
        const Steps steps = steps_between(count, rays, short_move);
        const double most = static_cast<double>(count - 1);
        if (ends_at_one_point(count, rays, coherence)) {
            coherence.scattered = steps.near < 0.5 * most;
            return true;
        }
        if (!(steps.turn <= max_turn * most)) {
            coherence.loose = coherence.scattered = true;
            return count >= fewest_near &&
                   steps.is_near(static_cast<double>(max_spread) * static_cast<double>(radius),
                                 most);
        }
        if (steps.turn == 0.0) {
            coherence.parallel = steps.is_near(short_move, most);
            return coherence.parallel;
        }
        if (steps.move == 0.0) {
            for (int axis = 0; axis < 3; ++axis)
                coherence.apex[axis] = static_cast<float>(rays.origin[axis][0]);
            return true;
        }
        coherence.loose = true;
        return steps.is_near(short_move, most);
    }

    static void hand_over(const SceneView& scene, const UpperLimits& limits,
                          const StreamRays& taken, const Found& found, const HitStream& hits,
                          LeftOver& left) {
        const std::size_t count = found.count;
        left.doubtful_count = left.unsharp_count = 0;
        const TableView* table = scene.tables;
        for (std::size_t i = 0; i < count; i += F::size) {
            const std::size_t filled = least(count - i, F::size);
            const Answers answers = answers_to(limits, taken, found, hits, i, filled);
            if (hits.t != nullptr)
                store(select(answers.hit, answers.t, S::infinity()), hits.t + i, filled);
            for (int axis = 0; axis < 3; ++axis)
                if (hits.normal[axis] != nullptr)
                    // Adding 0 turns -0 into 0.
                    store(select(answers.hit,
                                 Lanes<Arch>::narrow(found.normal[axis] + i) + zero<Arch>(),
                                 zero<Arch>()),
                          hits.normal[axis] + i, filled);
            const std::uint32_t bits = answers.hit_bits;
            if (hits.shape != nullptr)
                store_shapes(scene, found.slot + i, bits, filled, hits.shape + i, table);
            if (hits.entering != nullptr)
                for (std::size_t lane = 0; lane < filled; ++lane)
                    hits.entering[i + lane] = static_cast<std::uint8_t>(
                        bits >> lane & 1 &
                        (found.hit[i + lane] / hit_entering ^ found.hit[i + lane] / hit_reversed));
            if (hits.face != nullptr)
                for (std::size_t lane = 0; lane < filled; ++lane)
                    hits.face[i + lane] = static_cast<std::uint8_t>(
                        (bits >> lane & 1) != 0 ? found.hit[i + lane] & hit_face : 0);
            if (hits.t_double != nullptr) {
                for (std::size_t lane = 0; lane < filled; ++lane)
                    hits.t_double[i + lane] = __builtin_inf();
                list(bits, i, left.unsharp, left.unsharp_count);
            }
            list(answers.doubtful, i, left.doubtful, left.doubtful_count);
        }
    }

    static constexpr StreamKernels table() {
        return {take<float>, take<double>, find_sides, find_coherence, hand_over};
    }

  private:
    using S = Streams<Arch>;
    using F = Floats<Arch>;
    using M = Mask<Arch>;
    using D = Double<Arch>;
    using Number = Floats<D>;
    static constexpr std::size_t half = Number::size;

    /// The smallest number of rays that is worth an examination.
    static constexpr std::size_t fewest = 16;
    /// The same, of rays that have nothing in common but near origins.
    static constexpr std::size_t fewest_near = 128;
    /// Mean steps from one ray to the next that count as small: of directions, and of origins in
    /// radii of the scene.
    static constexpr double max_turn = 0.25, max_move = 0.05;

    static std::size_t least(std::size_t a, std::size_t b) { return a < b ? a : b; }

    /// The last of a caller's rays, padded with invalid rays.
    template <class Real>
    struct PaddedRays {
        Real origin[3][16] = {}, direction[3][16] = {}, t_min[16] = {}, t_max[16] = {};
        RayStream<Real> rays;

        PaddedRays(const RayStream<Real>& from, std::size_t begin) : rays(from) {
            const std::size_t bytes = (from.count - begin) * sizeof(Real);
            for (int axis = 0; axis < 3; ++axis) {
                __builtin_memcpy(origin[axis], from.origin[axis] + begin, bytes);
                __builtin_memcpy(direction[axis], from.direction[axis] + begin, bytes);
                rays.origin[axis] = origin[axis];
                rays.direction[axis] = direction[axis];
            }
            if (from.t_min != nullptr) {
                __builtin_memcpy(t_min, from.t_min + begin, bytes);
                rays.t_min = t_min;
            }
            if (from.t_max != nullptr) {
                __builtin_memcpy(t_max, from.t_max + begin, bytes);
                rays.t_max = t_max;
            }
        }
    };

    static M is_finite(const F& value) { return abs(value) < S::infinity(); }

    /// Returns the next float above one that is not negative.
    static F next_above(const F& value) {
        const auto bits = bits_as<std::uint32_t>(value);
        return bits_as<float>(bits + decltype(bits)(std::uint32_t{1}));
    }

    /// Takes in the first `count` of 16 rays. Returns how many are invalid.
    [[gnu::always_inline]] static std::size_t take_16(const RayStream<float>& rays,
                                                      std::size_t from, std::size_t count,
                                                      const StreamRays& taken, std::size_t to) {
        std::uint32_t none = 0;
        for (std::size_t k = 0; k < 16; k += F::size) {
            F origin[3], direction[3];
            for (int axis = 0; axis < 3; ++axis) {
                origin[axis] = S::load(rays.origin[axis] + from + k);
                direction[axis] = S::load(rays.direction[axis] + from + k);
            }
            M is_ray = is_finite(origin[0]) & is_finite(origin[1]) & is_finite(origin[2]) &
                       is_finite(direction[0]) & is_finite(direction[1]) & is_finite(direction[2]);
            const F largest = max(max(abs(direction[0]), abs(direction[1])), abs(direction[2]));
            is_ray = is_ray & (largest > zero<Arch>());
            F t_min = zero<Arch>(), t_max = S::infinity();
            if (rays.t_min != nullptr) {
                const F asked = S::load(rays.t_min + from + k);
                t_min = select(asked > zero<Arch>(), asked, zero<Arch>());
                is_ray = is_ray & (asked == asked) & (t_min < F(largest_float));
            }
            if (rays.t_max != nullptr) t_max = S::load(rays.t_max + from + k);
            is_ray = is_ray & (t_min < t_max);
            const std::uint32_t valid = Lanes<Arch>::bits(is_ray);
            none |= (~valid & all_lanes) << k;
            for (int part = 0; part < 2; ++part) {
                const auto widened = [part](const F(&v)[3]) {
                    return Vectors<D>{Lanes<D>::widen(v[0], part), Lanes<D>::widen(v[1], part),
                                      Lanes<D>::widen(v[2], part)};
                };
                take_half(widened(origin), widened(direction), Lanes<D>::widen(largest, part),
                          Lanes<D>::from_bits(part_of(valid, part)), taken,
                          to + k + static_cast<std::size_t>(part) * half);
            }
            if (rays.t_min == nullptr && rays.t_max == nullptr)
                store_no_limits(valid, taken, to + k);
            else
                take_limits(t_min, t_max, rays.t_min != nullptr, valid, taken, to + k);
        }
        return static_cast<std::size_t>(__builtin_popcount(none & ((1U << count) - 1)));
    }

    [[gnu::always_inline]] static std::size_t take_16(const RayStream<double>& rays,
                                                      std::size_t from, std::size_t count,
                                                      const StreamRays& taken, std::size_t to) {
        std::uint32_t none = 0;
        for (std::size_t k = 0; k < 16; k += half) {
            const auto load =
                [ k, from ](const double* const(&v)[3]) __attribute__((always_inline)) {
                return Vectors<D>{Number::load_unaligned(v[0] + from + k),
                                  Number::load_unaligned(v[1] + from + k),
                                  Number::load_unaligned(v[2] + from + k)};
            };
            const Vectors<D> origin = load(rays.origin), direction = load(rays.direction);
            const Number least(min_double), most(too_large);
            const Number largest = max(max(abs(direction.x), abs(direction.y)), abs(direction.z));
            const Number min_turn = largest * Number(min_of_largest), any(max_length);
            Mask<D> is_ray = in_range(origin.x, least, most) & in_range(origin.y, least, most) &
                             in_range(origin.z, least, most) &
                             in_range(direction.x, min_turn, any) &
                             in_range(direction.y, min_turn, any) &
                             in_range(direction.z, min_turn, any) & (largest >= Number(min_length));
            Number t_min = zero<D>(), t_max(__builtin_inf());
            if (rays.t_min != nullptr) {
                const Number asked = Number::load_unaligned(rays.t_min + from + k);
                t_min = select(asked > zero<D>(), asked, zero<D>());
                is_ray = is_ray & (asked == asked) &
                         in_range(t_min, Number(min_limit), Number(max_limit));
            }
            if (rays.t_max != nullptr) {
                t_max = Number::load_unaligned(rays.t_max + from + k);
                is_ray = is_ray & (in_range(t_max, Number(min_limit), Number(max_limit)) |
                                   (t_max == Number(__builtin_inf())));
            }
            is_ray = is_ray & (t_min < t_max);
            none |= (~Lanes<D>::bits(is_ray) & all_halves) << k;
            take_half(origin, direction, largest, is_ray, taken, to + k);
            store_limits(t_min, t_max, is_ray, taken, to + k);
        }
        for (std::size_t k = 0; k < 16; k += F::size)
            S::store_bits(S::broadcast_bits(rays.t_min != nullptr ? stream_half_ulp : 0U),
                          taken.bits + to + k);
        return static_cast<std::size_t>(__builtin_popcount(none & ((1U << count) - 1)));
    }

    static constexpr float largest_float = 0x1.fffffep127F;
    /// Doubles must be in the range of floats, where no solver overflows or underflows. Directions
    /// are scaled, so their lengths need only leave room for limits.
    static constexpr double min_double = 0x1p-149, too_large = 0x1p128;
    static constexpr double min_of_largest = 0x1p-276;
    static constexpr double min_length = 0x1p-400, max_length = 0x1p400;
    static constexpr double min_limit = 0x1p-500, max_limit = 0x1p500;
    static constexpr std::uint32_t all_lanes = (std::uint64_t{1} << F::size) - 1;
    static constexpr std::uint32_t all_halves = (1U << half) - 1;

    static std::uint32_t part_of(std::uint32_t bits, int part) {
        return bits >> (static_cast<unsigned>(part) * half) & all_halves;
    }
    static Mask<D> in_range(const Number& value, const Number& least, const Number& most) {
        const Number size = abs(value);
        return ((size >= least) & (size < most)) | (size == zero<D>());
    }

    /// Takes in a register's worth of rays in double.
    [[gnu::always_inline]] static void take_half(const Vectors<D>& origin,
                                                 const Vectors<D>& direction, const Number& largest,
                                                 const Mask<D>& is_ray, const StreamRays& taken,
                                                 std::size_t at) {
        // If a number is not subnormal, the bits of infinity mask its exponent, which is a power of
        // two. Subtracted from twice the bits of 1, these bits give the reciprocal of the power.
        using Bits = decltype(bits_as<std::uint64_t>(largest));
        const Number unit =
            select(is_ray,
                   bits_as<double>(Bits(std::uint64_t{0x7FE} << 52) -
                                   bits_as<std::uint64_t>(largest & Number(__builtin_inf()))),
                   Number(1.0));
        const Number nothing = zero<D>();
        const Vectors<D> meant{select(is_ray, direction.x * unit, nothing),
                               select(is_ray, direction.y * unit, nothing),
                               select(is_ray, direction.z * unit, Number(1.0))};
        const Number length = sqrt(squared_length(meant)), inverse = Number(1.0) / length;
        const Number* const origins[] = {&origin.x, &origin.y, &origin.z};
        const Number* const directions[] = {&meant.x, &meant.y, &meant.z};
        for (int axis = 0; axis < 3; ++axis) {
            select(is_ray, *origins[axis], nothing).store_unaligned(taken.origin[axis] + at);
            directions[axis]->store_unaligned(taken.exact_direction[axis] + at);
            (*directions[axis] * inverse).store_unaligned(taken.direction[axis] + at);
        }
        length.store_unaligned(taken.exact_length + at);
        unit.store_unaligned(taken.unit + at);
        (unit * inverse).store_unaligned(taken.per_unit + at);
    }

    /// Takes in limits that are floats. They are compared with the float nearest to t, ties to
    /// even. So their bounds on t depend on the floats next to them.
    [[gnu::always_inline]] static void take_limits(const F& t_min, const F& t_max, bool has_t_min,
                                                   std::uint32_t valid, const StreamRays& taken,
                                                   std::size_t to) {
        const F after_t_min = next_above(t_min), after_t_max = next_above(t_max);
        const std::uint32_t endless = Lanes<Arch>::bits(~(t_max < F(largest_float)));
        for (int part = 0; part < 2; ++part) {
            const Number low = Lanes<D>::widen(t_min, part);
            const Number middle = Number(0.5) * (low + Lanes<D>::widen(after_t_min, part));
            const Number after = has_t_min ? select(low > zero<D>(), middle, low) : zero<D>();
            const Number most = select(Lanes<D>::from_bits(part_of(endless, part)),
                                       Number(__builtin_inf()), Lanes<D>::widen(after_t_max, part));
            store_limits(after, most, Lanes<D>::from_bits(part_of(valid, part)), taken,
                         to + static_cast<std::size_t>(part) * half);
        }
        if (has_t_min) {
            const auto bits = bits_as<std::uint32_t>(t_min);
            const auto odd = bits & decltype(bits)(std::uint32_t{1});
            static_assert(stream_tie_counts == 1U << 17);
            S::store_bits(bits_as<float>(odd << 17), taken.bits + to);
        } else {
            S::store_bits(zero<Arch>(), taken.bits + to);
        }
    }

    [[gnu::always_inline]] static void store_no_limits(std::uint32_t valid, const StreamRays& taken,
                                                       std::size_t to) {
        for (int part = 0; part < 2; ++part) {
            const std::size_t at = to + static_cast<std::size_t>(part) * half;
            zero<D>().store_unaligned(taken.t_after + at);
            zero<D>().store_unaligned(taken.start + at);
            select(Lanes<D>::from_bits(part_of(valid, part)), Number(__builtin_inf()), Number(-1.0))
                .store_unaligned(taken.t_limit + at);
        }
        S::store_bits(zero<Arch>(), taken.bits + to);
    }

    /// Stores the limits, in the caller's units, of rays that have been taken in.
    [[gnu::always_inline]] static void store_limits(const Number& after, const Number& most,
                                                    const Mask<D>& is_ray, const StreamRays& taken,
                                                    std::size_t at) {
        const Number unit = Number::load_unaligned(taken.unit + at);
        const Number length = Number::load_unaligned(taken.exact_length + at);
        const Number after_here = select(is_ray, after / unit, zero<D>());
        after_here.store_unaligned(taken.t_after + at);
        (after_here * length).store_unaligned(taken.start + at);
        // Rounded up.
        select(is_ray, most / unit * length * Number(1 + 0x1p-50), Number(-1.0))
            .store_unaligned(taken.t_limit + at);
    }

    /// Sums of the steps from each ray to the next, over the coordinates.
    struct Steps {
        double turn, move;
        double near; ///< number of short moves

        /// True if the mean move is at most `max_mean`.
        bool is_near(double max_mean, double count) const { return move <= max_mean * count; }
    };
    static Steps steps_between(std::size_t count, const StreamRays& rays, double short_move) {
        Number turn = zero<D>(), move = zero<D>(), near = zero<D>();
        for (std::size_t i = 0; i + 1 < count; i += half) {
            Number turned = zero<D>(), moved = zero<D>();
            for (int axis = 0; axis < 3; ++axis) {
                const double* const d = rays.direction[axis] + i;
                const double* const o = rays.origin[axis] + i;
                turned = turned + abs(Number::load_unaligned(d) - Number::load_unaligned(d + 1));
                moved = moved + abs(Number::load_unaligned(o) - Number::load_unaligned(o + 1));
            }
            const Mask<D> filled = first_lanes(count - 1 - i);
            turn = turn + select(filled, turned, zero<D>());
            move = move + select(filled, moved, zero<D>());
            near = near + select(filled & (moved <= Number(short_move)), Number(1.0), zero<D>());
        }
        return {sum_of(turn), sum_of(move), sum_of(near)};
    }

    static Mask<D> first_lanes(std::size_t count) {
        return Lanes<D>::from_bits(count < half ? (1U << count) - 1 : (1U << half) - 1);
    }
    static double sum_of(const Number& numbers) {
        double lanes[half], sum = 0.0;
        numbers.store_unaligned(lanes);
        for (const double lane : lanes)
            sum += lane;
        return sum;
    }
    static double greatest_of(const Number& numbers) {
        double lanes[half], most = 0.0;
        numbers.store_unaligned(lanes);
        for (const double lane : lanes)
            most = lane > most ? lane : most;
        return most;
    }

    /// True if all rays have an end, and all ends are one point within the accuracy of float.
    static bool ends_at_one_point(std::size_t count, const StreamRays& rays, Coherence& coherence) {
        std::size_t first = 0;
        while (first + 1 < count && rays.t_limit[first] < 0.0)
            ++first;
        const double end = rays.t_limit[first];
        if (!(end >= 0.0 && end < __builtin_inf())) return false;
        float apex[3];
        for (int axis = 0; axis < 3; ++axis)
            apex[axis] =
                static_cast<float>(rays.origin[axis][first] + end * rays.direction[axis][first]);
        Number off = zero<D>(), longest = zero<D>();
        for (std::size_t i = 0; i < count; i += half) {
            Number distance = zero<D>();
            const Number t = Number::load_unaligned(rays.t_limit + i);
            for (int axis = 0; axis < 3; ++axis) {
                const Number point = mul_add<D>(t, Number::load_unaligned(rays.direction[axis] + i),
                                                Number::load_unaligned(rays.origin[axis] + i));
                distance = distance + abs(point - Number(static_cast<double>(apex[axis])));
            }
            const Mask<D> are_there = first_lanes(count - i) & (t >= zero<D>());
            off = max(off, select(are_there, distance, zero<D>()));
            longest = max(longest, select(are_there, t, zero<D>()));
            // Most rays do not end at one point.
            if (i == 0 && !is_one_point(off, longest)) return false;
        }
        if (!is_one_point(off, longest)) return false;
        for (int axis = 0; axis < 3; ++axis)
            coherence.apex[axis] = apex[axis];
        coherence.converging = true;
        coherence.spread = static_cast<float>(greatest_of(off)) * (1 + 0x1p-20F);
        return true;
    }
    static bool is_one_point(const Number& off, const Number& longest) {
        constexpr double max_distance_off = 0x1p-18; // of the longest ray's length
        const double length = greatest_of(longest);
        return length < __builtin_inf() && greatest_of(off) <= max_distance_off * length;
    }

    struct Answers {
        F t;
        M hit;
        std::uint32_t hit_bits, doubtful;
    };
    [[gnu::always_inline]] static Answers answers_to(const UpperLimits& limits,
                                                     const StreamRays& taken, const Found& found,
                                                     const HitStream& hits, std::size_t i,
                                                     std::size_t filled) {
        double first[F::size], last[F::size];
        for (std::size_t k = 0; k < F::size; k += half) {
            const Number per_unit = Number::load_unaligned(taken.per_unit + i + k);
            const Number t = Number::load_unaligned(found.t + i + k) * per_unit;
            // The length and all operations are off by a few ulps.
            const Number error =
                Number::load_unaligned(found.error + i + k) * per_unit * Number(1 + 0x1p-50) +
                Number(0x1p-49) * t;
            (t - error).store_unaligned(first + k);
            (t + error).store_unaligned(last + k);
        }
        const F t = Lanes<Arch>::narrow(first), none = S::broadcast_bits(no_slot);
        const M sure = (t == Lanes<Arch>::narrow(last)) & (t > zero<Arch>()) & (t < S::infinity());
        const M missed = Lanes<Arch>::in_range(S::load_bits(found.slot + i), none, none);
        const F unknown = S::broadcast_bits(
            hit_doubtful | (hits.wants_normals() ? hit_normal_doubtful | hit_normal_unknown : 0));
        const M known = Lanes<Arch>::in_range(S::load_bits(found.hit + i) & unknown, zero<Arch>(),
                                              zero<Arch>());
        const M any = (Lanes<Arch>::narrow(taken.t_limit + i) >= zero<Arch>()) & ~missed &
                      S::first_lanes(filled);
        M certain = sure & known, hit = any & certain;
        if (limits.t_max != nullptr) {
            float most[F::size] = {};
            __builtin_memcpy(most, limits.t_max + i, filled * sizeof(float));
            hit = hit & (t <= S::load(most));
        } else if (limits.are_doubles) {
            const Sides sides = sides_of_t_limit(taken, found, i);
            certain = certain & (sides.before | sides.beyond);
            hit = hit & sides.before;
        }
        return {t, hit, Lanes<Arch>::bits(hit), Lanes<Arch>::bits(any & ~certain)};
    }

    /// Lanes whose t is certainly not after t_limit, and lanes whose t certainly is.
    struct Sides {
        M before, beyond;
    };
    static Sides sides_of_t_limit(const StreamRays& taken, const Found& found, std::size_t i) {
        float before[F::size], beyond[F::size];
        for (std::size_t lane = 0; lane < F::size; ++lane) {
            const double t = found.t[i + lane], most = taken.t_limit[i + lane];
            const double error = found.error[i + lane] * (1 + 0x1p-50);
            before[lane] = t + error <= most * (1 - 0x1p-47) ? 1 : 0;
            beyond[lane] = t - error > most * (1 + 0x1p-50) ? 1 : 0;
        }
        return {S::load(before) > zero<Arch>(), S::load(beyond) > zero<Arch>()};
    }

    static void list(std::uint32_t lanes, std::size_t i, std::uint32_t* to, std::size_t& count) {
        for (; lanes != 0; lanes &= lanes - 1)
            to[count++] =
                static_cast<std::uint32_t>(i) + static_cast<unsigned>(__builtin_ctz(lanes));
    }

    static void store(const F& values, float* to, std::size_t count) {
        if (count == F::size) return values.store_unaligned(to);
        float lanes[F::size];
        values.store_unaligned(lanes);
        __builtin_memcpy(to, lanes, count * sizeof(float));
    }

    /// Stores the ids of shapes. `table` is the first one to search for a slot, and is updated.
    static void store_shapes(const SceneView& scene, const std::uint32_t* slots, std::uint32_t hit,
                             std::size_t count, std::uint32_t* to, const TableView*& table) {
        for (std::size_t lane = 0; lane < count; ++lane)
            to[lane] = no_slot; // core::no_shape
        for (; hit != 0; hit &= hit - 1) {
            const auto lane = static_cast<unsigned>(__builtin_ctz(hit));
            const std::uint32_t slot = slots[lane];
            if (!Slots<Arch>::holds(*table, slot))
                table = &Slots<Arch>::table_of(scene, Slots<Arch>::kind_of(scene, slot));
            to[lane] = Slots<Arch>::id(*table, slot);
        }
    }
};

} // namespace raylane::simd
