#pragma once

#include "simd/kernel/shapes/shapes.hpp"
#include "simd/kernel/traverse/rays.hpp"

/// Clipping of the parts of solids. The half-spaces of a cut (ClipPlanesView) remove the crossings
/// of the parts that they cut on their outer side. If float arithmetic is certain of this, no ray
/// stops there.
namespace raylane::simd {

/// True if a method's filters evaluate cuts. Otherwise rays stop at surfaces that are cut away, and
/// go on from there.
template <class Method>
inline constexpr bool knows_cuts = Method::certifies&& Method::rounded_alone;

template <class Filter, class Rays>
inline constexpr bool has_chord = requires(const Filter& filter, const Rays& rays) {
    filter.chord(rays);
};

/// True for filters whose shapes, where they are cut, are crossed only once. The only quadrics that
/// are cut are planes.
template <class Filter>
inline constexpr bool crosses_once_where_cut = requires {
    Filter::is_quadric;
};

/// Rays with the ids of the shapes that they start on.
template <class Arch>
struct CutRays {
    const FilterRays<Arch>& rays;
    Floats<Arch> origin_first, origin_last;

    [[gnu::always_inline]] Mask<Arch> starts_on(std::uint32_t id) const {
        return Lanes<Arch>::in_range(Streams<Arch>::broadcast_bits(id), origin_first, origin_last);
    }
};

/// Takes the place of a callback for crossed faces, if the caller needs none.
struct NoCrossedFaces {
    static constexpr bool asks = false;
};

/// Whether the crossings of rays with a convex shape are certainly removed, as they are on the side
/// of a cut on which nothing is left.
///
/// If a ray starts on a plane, or on a box that is subtracted, and then certainly is where nothing
/// is left, it has been there from the start.
///
/// Let the normal and point of a plane be rounded to float, with a normal of length 1 -+ 2 u, and
/// let P be the point at t. Then n . P - c is off by slack + u (5 |o|_1 + 15 t + 2 |c|) at most.
template <class Arch>
class Removed {
    using F = Floats<Arch>;
    using M = Mask<Arch>;

  public:
    M entry; ///< the first crossing is certainly removed
    M chord; ///< everything from the first crossing to the last is certainly removed

    /// Calls crossed(slot, rays as bits) for each face with a deferred test that `possible` rays
    /// may cross between the first crossing and the last.
    template <class Crossed = NoCrossedFaces>
    [[gnu::always_inline]] Removed(const ClipPlanesView& cut, const CutRays<Arch>& cut_rays,
                                   const Chord<Arch>& where, const M& possible = all<Arch>(),
                                   const Crossed& crossed = {})
        : entry(none<Arch>()), chord(none<Arch>()) {
        const FilterRays<Arch>& rays = cut_rays.rays;
        const Place begin(cut, rays, positive_part<Arch>(where.entry));
        const Place middle(cut, rays, positive_part<Arch>(where.entry_end));
        const Place end(cut, rays, where.exit_end);
        M of_entry = all<Arch>(), of_chord = all<Arch>();
        for (int k = 0; k < cut.count; ++k) {
            const F first = begin.outside(cut, k), last = end.outside(cut, k);
            const M at_begin = (first > begin.error) | cut_rays.starts_on(cut.shape[k]);
            const M at_end = last > end.error;
            of_entry = of_entry & at_begin & middle.is_outside(cut, k);
            of_chord = of_chord & at_begin & at_end;
            if constexpr (Crossed::asks)
                if (cut.face[k] != no_slot) {
                    const M stays = ((first > begin.error) & at_end) |
                                    ((first < negated(begin.error)) & (last < negated(end.error)));
                    const std::uint32_t bits = Lanes<Arch>::bits(possible & ~stays);
                    if (bits != 0) crossed(cut.face[k], bits);
                }
            if ((cut.group_ends >> k & 1) == 0) continue;
            entry = entry | of_entry;
            chord = chord | of_chord;
            of_entry = of_chord = all<Arch>();
        }
    }

  private:
    struct Place {
        Vectors<Arch> point;
        F error;

        [[gnu::always_inline]] Place(const ClipPlanesView& cut, const FilterRays<Arch>& rays,
                                     const F& t)
            : point(fast_mul_add<Arch>(t, rays.direction, rays.origin)) {
            const Vectors<Arch>& o = rays.origin;
            const F size = abs(o.x) + abs(o.y) + abs(o.z) + t + F(cut.size);
            error = fast_mul_add<Arch>(F(24 * half_ulp), size, rays.slack + rays.slack);
        }
        [[gnu::always_inline]] F outside(const ClipPlanesView& cut, int k) const {
            const Vectors<Arch> normal = {F(cut.normal[0][k]), F(cut.normal[1][k]),
                                          F(cut.normal[2][k])};
            return fast_dot(normal, point, F(-cut.offset[k]));
        }
        [[gnu::always_inline]] M is_outside(const ClipPlanesView& cut, int k) const {
            return outside(cut, k) > error;
        }
    };
};

/// True if a shape only cuts others, so that occlusion queries of methods that evaluate cuts can
/// skip it.
template <class Arch, class Method>
[[gnu::always_inline]] inline bool only_cuts(const SceneView& scene, std::uint32_t slot) {
    return knows_cuts<Method> && Streams<Arch>::only_cuts(scene, slot);
}

/// Returns a t before which rays do not leave a convex shape. The shape must end at t = `end` or
/// before. The bound is that of the reverse ray from there. Its origin is off by the roundings of
/// end * direction and of the sum.
template <class Arch, class Filter>
[[gnu::noinline]] inline Floats<Arch> min_exit(const Filter& filter, const FilterRays<Arch>& rays,
                                               const Floats<Arch>& end) {
    using F = Floats<Arch>;
    const Vectors<Arch>& o = rays.origin;
    const F size = abs(o.x) + abs(o.y) + abs(o.z) + end;
    const FilterRays<Arch> back = {fast_mul_add<Arch>(end, rays.direction, o), -rays.direction,
                                   fast_mul_add<Arch>(F(8 * half_ulp), size, rays.slack)};
    const Bounds<Arch> bounds = filter.bounds(back);
    const F exit = end - bounds.upper - F(8 * half_ulp) * size;
    return select(bounds.possible & bounds.certain, exit, zero<Arch>());
}

/// Returns the bounds of a part that is cut. The first crossing that is not removed is not before
/// `lower`. `certain` does not mean that any crossing remains. Calls crossed(slot, rays as bits)
/// for faces with deferred tests that may be crossed within the part.
template <class Arch, class Filter, class Crossed = NoCrossedFaces>
[[gnu::always_inline]] inline Bounds<Arch>
bounds_of_cut(const Filter& filter, const CutRays<Arch>& rays, const ClipPlanesView& cut,
              const Crossed& crossed = {}) {
    using F = Floats<Arch>;
    Bounds<Arch> bounds = filter.bounds(rays.rays);
    if (Lanes<Arch>::bits(bounds.possible) == 0) return bounds;
    if constexpr (has_chord<Filter, FilterRays<Arch>>) {
        const Chord<Arch> chord = filter.chord(rays.rays);
        const F end = select(bounds.certain, bounds.upper, chord.exit_end);
        F begin = bounds.lower;
        if constexpr (Crossed::asks) begin = min(begin, chord.entry); // for rays that start inside
        const Removed<Arch> removed(cut, rays, {begin, end, chord.exit, chord.exit_end},
                                    bounds.possible, crossed);
        bounds.possible = bounds.possible & ~removed.chord;
        const Mask<Arch> goes_on = bounds.possible & removed.entry;
        if (Lanes<Arch>::bits(goes_on) == 0) return bounds;
        F exit = chord.exit;
        if constexpr (Filter::has_chord_around)
            exit = min_exit<Arch>(filter, rays.rays, chord.exit_end);
        bounds.lower = select(goes_on & (exit > bounds.lower), exit, bounds.lower);
    } else if constexpr (crosses_once_where_cut<Filter>) {
        const Removed<Arch> removed(cut, rays,
                                    {bounds.lower, bounds.upper, bounds.lower, bounds.upper});
        bounds.possible = bounds.possible & ~(bounds.certain & removed.entry);
    } else if constexpr (Crossed::asks) {
        for (int k = 0; k < cut.count; ++k)
            if (cut.face[k] != no_slot) crossed(cut.face[k], Lanes<Arch>::bits(bounds.possible));
    }
    return bounds;
}

/// True where rays may cross a part that is cut, or a cut inside of it, before t.
template <class Arch, class Filter>
[[gnu::always_inline]] inline Mask<Arch>
may_cross_cut(const Filter& filter, const CutRays<Arch>& rays, const ClipPlanesView& cut,
              const Floats<Arch>& t) {
    Mask<Arch> possible = filter.bounds(rays.rays).possible;
    if constexpr (has_chord<Filter, FilterRays<Arch>>) {
        if (Lanes<Arch>::bits(possible) == 0) return possible;
        const Chord<Arch> chord = filter.chord(rays.rays);
        const Removed<Arch> removed(cut, rays, chord);
        possible = possible & ~removed.chord & ~(chord.entry >= t);
    }
    return possible;
}

/// Returns the cut of a slot's block, or null if the block is not cut.
template <class Method>
[[gnu::always_inline]] inline const ClipPlanesView* cut_of(const SceneView& scene,
                                                           std::uint32_t slot) {
    if constexpr (!knows_cuts<Method>) return nullptr;
    if (scene.cut_of_block == nullptr || scene.cut_of_block[slot / 16] == 0) [[likely]]
        return nullptr;
    return scene.cuts + scene.cut_of_block[slot / 16];
}

} // namespace raylane::simd
