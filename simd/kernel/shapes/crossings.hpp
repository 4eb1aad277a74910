#pragma once

#include "simd/kernel/lanes/vectors.hpp"

namespace raylane::simd {

/// Returns the answer to a question that chooses between equivalent ways of computing the same
/// value. Either way is correct, so numbers with bounds need not be certain of the answer.
template <class Number, class Arch>
xsimd::batch_bool<Number, Arch> either_way(const xsimd::batch_bool<Number, Arch>& a) {
    return a;
}

template <class Arch>
struct Rays {
    Vectors<Arch> origin, direction;
};

/// Rays with numbers that many shapes need.
template <class Arch>
struct MeasuredRays : Rays<Arch> {
    Floats<Arch> squared_length; ///< of directions
    Divisor<Arch> by_squared_length;

    MeasuredRays(const Rays<Arch>& rays) // NOLINT: implicit
        : Rays<Arch>(rays), squared_length(simd::squared_length(rays.direction)),
          by_squared_length(squared_length) {}
};

/// core::Start per lane. Faces are small integers held as floats, so that all masks have one type.
template <class Arch>
struct Starts {
    Mask<Arch> on_surface; ///< the ray starts on the tested shape
    Mask<Arch> inward;
    Floats<Arch> face;
};

/// core::Crossing per lane, valid where `exists`.
template <class Arch>
struct Crossing {
    Mask<Arch> exists;
    Floats<Arch> t;
    Floats<Arch> face;
    Mask<Arch> entering;
};

/// Up to two crossings per lane. If both exist, `first` comes first along the ray.
template <class Arch>
struct Crossings {
    Crossing<Arch> first, second;
};

template <class Arch>
Mask<Arch> none() {
    return Mask<Arch>(false);
}
template <class Arch>
Mask<Arch> all() {
    return Mask<Arch>(true);
}
/// Returns the starts of rays that start on no surface.
template <class Arch>
Starts<Arch> starts_nowhere() {
    return {none<Arch>(), none<Arch>(), zero<Arch>()};
}

/// True where a crossing counts: ahead of the ray or, if the ray starts on the surface, at t = 0.
template <class Arch>
Mask<Arch> ahead(const Crossing<Arch>& crossing, const Mask<Arch>& on_surface) {
    return crossing.exists &
           ((crossing.t > zero<Arch>()) | (on_surface & (crossing.t == zero<Arch>())));
}

/// Returns the first crossing that is ahead.
template <class Arch>
Crossing<Arch> first_ahead(const Crossings<Arch>& found, const Mask<Arch>& on_surface) {
    const Mask<Arch> first = ahead(found.first, on_surface),
                     second = ahead(found.second, on_surface);
    return {first | second, select(first, found.first.t, found.second.t),
            select(first, found.first.face, found.second.face),
            (first & found.first.entering) | (~first & found.second.entering)};
}

/// Same as core::not_behind, per lane.
template <class Arch>
Floats<Arch> not_behind(const Floats<Arch>& t) {
    return select(t > zero<Arch>(), t, zero<Arch>());
}

/// Removes the crossings of rays that leave a convex solid, as they do not meet it again.
template <class Arch>
Crossings<Arch> inward_only(Crossings<Arch> crossings, const Starts<Arch>& starts) {
    const Mask<Arch> counts = ~starts.on_surface | starts.inward;
    crossings.first.exists = crossings.first.exists & counts;
    crossings.second.exists = crossings.second.exists & counts;
    return crossings;
}

/// core::ClipInterval per lane.
template <class Arch>
class ClipInterval {
  public:
    void clip_front(const Mask<Arch>& lanes, const Floats<Arch>& t, const Floats<Arch>& face) {
        const Mask<Arch> clips = lanes & (~has_front_ | (front_ < t));
        front_ = select(clips, t, front_);
        front_face_ = select(clips, face, front_face_);
        has_front_ = has_front_ | lanes;
    }

    void clip_back(const Mask<Arch>& lanes, const Floats<Arch>& t, const Floats<Arch>& face) {
        const Mask<Arch> clips = lanes & (~has_back_ | (t < back_));
        back_ = select(clips, t, back_);
        back_face_ = select(clips, face, back_face_);
        has_back_ = has_back_ | lanes;
    }

    void clip_all(const Mask<Arch>& lanes) { empty_ = empty_ | lanes; }

    void clip_slab(const Mask<Arch>& lanes, const Floats<Arch>& start, const Floats<Arch>& slope,
                   const Floats<Arch>& end, float low, float high) {
        const Mask<Arch> rises = slope > zero<Arch>(), falls = slope < zero<Arch>();
        const Mask<Arch> beside = (start < zero<Arch>()) | (end < start);
        clip_all(lanes & ~rises & ~falls & beside);
        const Divisor<Arch> by_slope(slope);
        const Floats<Arch> at_low = negated(start) / by_slope;
        const Floats<Arch> at_high = (end - start) / by_slope;
        const Floats<Arch> low_face = constant<Arch>(low), high_face = constant<Arch>(high);
        const Mask<Arch> crosses = lanes & (rises | falls);
        clip_front(crosses, select(rises, at_low, at_high), select(rises, low_face, high_face));
        clip_back(crosses, select(rises, at_high, at_low), select(rises, high_face, low_face));
    }

    /// Returns both ends of the interval. `exits`: lanes that start on the surface, for which only
    /// the far end counts.
    Crossings<Arch> crossings(const Mask<Arch>& exits) const {
        const Mask<Arch> both = ~exits & ~empty_ & has_front_ & has_back_ & ~(back_ < front_);
        const Mask<Arch> leaves = exits & has_back_;
        return {{both, front_, front_face_, all<Arch>()},
                {both | leaves, select(leaves, not_behind<Arch>(back_), back_), back_face_,
                 none<Arch>()}};
    }

  private:
    // Braces would call xsimd's constructor that takes a list of all lanes.
    Floats<Arch> front_ = zero<Arch>(), back_ = zero<Arch>();
    Floats<Arch> front_face_ = zero<Arch>(), back_face_ = zero<Arch>();
    Mask<Arch> has_front_ = none<Arch>(), has_back_ = none<Arch>(), empty_ = none<Arch>();
};

} // namespace raylane::simd
