#pragma once

#include "simd/kernel/shapes/axial.hpp"
#include "simd/kernel/shapes/root.hpp"

/// Certified solvers of cylinders and cones.
namespace raylane::simd {

/// A ray split into parts along and across the axis, as in axial.hpp. F(s) = |across|^2 - width^2
/// is 0 on the body, with width = W + s M.
///
/// Let P be the error of the position at s, and L = |start| + |s|. Subtracting the part along the
/// axis errs by 11 u L along the axis and 2 u L across it. Errors along the axis matter at second
/// order only: squared they are 2^-98 L^2, or multiply similar errors. So across errs by P and
/// 3 u L, as without errors along the axis. With k = |top - base| / |axis|, width errs by k
/// (P + 12 u L) + 4 u widest. Let T be the sum of both and `spread` >= 1 + k. Then
///   F errs by 2 (1 + 1/8) width T + T^2 + 2^-98 L^2 + 8 u width^2  where |F| < width^2 / 4,
///   half F' = across . across_direction - width M, by spread (T + 32 u width) there,
///   A = |across_direction|^2 - M^2, by 64 u spread^2,
///   the height above the base, by |axis| (P + 8 u L), the other end's by 3 u |axis|^2 more.
/// For any F, F errs by 2 (|across| + width) T + 2 T^2 + 2^-98 L^2 and 8 u of both squares.
///
/// Per component, let P_i >= 8 u (|start_i| + |s direction_i|) be the error of the position.
/// across_i errs by P_i and, as subtracting the part along the axis errs along the axis, by
/// |axis_i| / |axis|^2 times 2 |axis| . P. Half the gradient of F errs additionally by
/// |slope axis_i| times the error of width.
template <class Arch, bool tapers, Wanted wanted>
struct AxialLine {
    using F = Floats<Arch>;
    using M = Mask<Arch>;
    using V = Vectors<Arch>;

    LocalRays<Arch> local;
    V axis;
    F axis_size, axis_squared;
    F height_start, height_slope;
    V across_start, across_direction;
    F base_width, top_width, widest;
    F slope, width_start, width_slope; // if `tapers`
    F spread;
    Quadratic<Arch> quadratic;

    [[gnu::always_inline]] AxialLine(const AxialNumbers<Arch, tapers>& shape,
                                     const Rays<Arch>& rays)
        : local(rays, shape.base), axis(shape.axis), base_width(shape.base_radius),
          top_width(shape.top_radius) {
        axis_size = sum_of_sizes(axis);
        axis_squared = squared_length(axis);
        const F inverse = F(1.0) / axis_squared;
        height_start = dot(local.start, axis);
        height_slope = dot(local.direction, axis);
        across_start = mul_add<Arch>(negated(height_start * inverse), axis, local.start);
        across_direction = mul_add<Arch>(negated(height_slope * inverse), axis, local.direction);
        quadratic.A = squared_length(across_direction);
        quadratic.B = dot(across_start, across_direction);
        quadratic.C = squared_length(across_start);
        if constexpr (tapers) {
            widest = select(base_width < top_width, top_width, base_width);
            slope = (top_width - base_width) * inverse;
            width_start = base_width + slope * height_start;
            width_slope = slope * height_slope;
            quadratic.A = quadratic.A - width_slope * width_slope;
            quadratic.B = quadratic.B - width_slope * width_start;
            quadratic.C = quadratic.C - width_start * width_start;
            spread = F(1.0625) * (F(1.0) + abs(slope) * axis_size);
        } else {
            widest = base_width;
            quadratic.C = quadratic.C - base_width * base_width;
            spread = F(1.0);
        }
        quadratic.A_error = F(0x1p-47) * (spread * spread);
    }

    /// Returns the passage where F rises, in lanes of `leaves`, and where it falls, in the others.
    [[gnu::always_inline]] Passage<Arch> passage(const M& leaves) const {
        const F s = quadratic.root_where(leaves);
        const V across = across_at(s);
        const F width = width_at(s), square = width * width, width_size = abs(width);
        const F off = together(s), along = local.rounding(16.0, s);
        const F value = squared_length(across) - square;
        const Residual<Arch> residual = {
            value, (F(3.0) * width_size + off) * off + along * along + F(0x1p-49) * square,
            rise(across, width), spread * (off + F(0x1p-48) * width_size)};
        Passage<Arch> result;
        result.root = quadratic.refine(s, residual, leaves);
        result.root.certain = result.root.certain & (abs(value) < F(0.25) * square);
        result.t = local.shift + result.root.s;
        result.error = local.error_of_t(result.t, result.root.s, result.root.error);
        clip(result);
        return result;
    }

    /// Returns the passage where rays leave that start on the body. At the vertex half F' errs by
    ///   spread^2 (P + 12 u (|start| + |s|) + 16 u widest),
    /// where the last term applies only if `tapers`.
    [[gnu::noinline]] Passage<Arch> from_surface(const Starts<Arch>& starts) const {
        const F vertex = negated(quadratic.B) / quadratic.A;
        F rise_error = local.error_at(vertex, tapers ? 32.0 : 16.0);
        if constexpr (tapers) rise_error = (spread * spread) * (rise_error + F(0x1p-48) * widest);
        const F rise_there = rise(across_at(vertex), width_at(vertex));
        const F vertex_error = F(1.25) * (abs(rise_there) + rise_error) / quadratic.A;
        Passage<Arch> result = Passage<Arch>::opposite(vertex, vertex_error, local);
        result.root.certain = starts.inward & (quadratic.A > F(8.0) * quadratic.A_error);
        clip(result);
        return result;
    }

    F reach() const { return local.size + F(1.0625) * (axis_size + widest); }

    /// True where the line certainly does not cross the infinitely extended body, including its
    /// mirror nappe.
    M has_no_root() const {
        const F vertex = negated(quadratic.B) / quadratic.A;
        const V across = across_at(vertex);
        const F width = width_at(vertex), off = together(vertex),
                along = local.rounding(16.0, vertex);
        const F outer = squared_length(across), inner = width * width;
        const F error = (F(3.0) * (sum_of_sizes(across) + abs(width)) + (off + off)) * off +
                        along * along + F(0x1p-49) * (outer + inner);
        return quadratic.opens_up() & (outer - inner > error);
    }

    F height_at(const F& s) const { return mul_add<Arch>(s, height_slope, height_start); }
    V across_at(const F& s) const { return mul_add<Arch>(s, across_direction, across_start); }
    /// Returns the error of the height at an s that is off by `error_s`.
    F height_error(const F& s, const F& error_s) const {
        return F(2.0) * axis_size * (local.error_at(s, 10.0) + error_s) + F(0x1p-49) * axis_squared;
    }

  private:
    F width_at(const F& s) const {
        if constexpr (tapers)
            return mul_add<Arch>(s, width_slope, width_start);
        else
            return base_width;
    }

    /// T
    F together(const F& s) const {
        const F across_error = local.error_at(s, 6.0);
        if constexpr (tapers)
            return across_error + (spread - F(1.0)) * (across_error + local.rounding(8.0, s)) +
                   F(0x1p-50) * widest;
        else
            return across_error;
    }

    F rise(const V& across, const F& width) const {
        if constexpr (tapers)
            return dot(across, across_direction) - width * width_slope;
        else
            return dot(across, across_direction);
    }

    /// Completes the passage at root.s. The normal is half the gradient of F.
    [[gnu::always_inline]] void clip(Passage<Arch>& passage) const {
        const F s = passage.root.s;
        const F height = height_at(s), above = axis_squared - height;
        const F margin = height_error(s, passage.root.error);
        passage.inside = (height > margin) & (above > margin);
        passage.outside = (height < negated(margin)) | (above < negated(margin));
        passage.normal = across_at(s);
        const F width = width_at(s);
        if constexpr (tapers)
            passage.normal = mul_add<Arch>(negated(width * slope), axis, passage.normal);
        const F error = passage.root.error;
        passage.steady = spread * (together(s) + error) < F(0x1p-14) * abs(width);
        if constexpr (wanted == Wanted::all) find_normal_error(passage, width);
    }

    void find_normal_error(Passage<Arch>& passage, const F& width) const {
        const F s = passage.root.s;
        const V off = local.off_at(s, passage.root.error);
        const V sizes = {abs(axis.x), abs(axis.y), abs(axis.z)};
        F along = F(2.125) * dot(sizes, off) / axis_squared;
        if constexpr (tapers)
            along = along + F(1.0625) * abs(slope) *
                                (together(s) + (spread - F(1.0)) * passage.root.error +
                                 F(0x1p-50) * abs(width));
        passage.normal_error = {off.x + along * sizes.x, off.y + along * sizes.y,
                                off.z + along * sizes.z};
        if constexpr (tapers) return;
        // If a cylinder's axis is a coordinate axis, its normal has no component along that axis.
        const F o = zero<Arch>();
        const M has_x = sizes.x > o, has_y = sizes.y > o, has_z = sizes.z > o;
        const auto clear = [&](const M& others, F& component, F& of_error) {
            component = select(others, component, o);
            of_error = select(others, of_error, o);
        };
        clear(has_y | has_z, passage.normal.x, passage.normal_error.x);
        clear(has_z | has_x, passage.normal.y, passage.normal_error.y);
        clear(has_x | has_y, passage.normal.z, passage.normal_error.z);
    }
};

/// CertifiedSolver without caps. The ray may have entered or left through an open end.
template <class Arch, bool tapers>
struct OpenCertifiedSolver {
    AxialNumbers<Arch, tapers> shape;

    template <class Reader>
    explicit OpenCertifiedSolver(Reader reader) : shape(reader) {}

    template <Wanted wanted>
    [[gnu::always_inline]] CertifiedCrossing<Arch> solve(const Rays<Arch>& rays,
                                                         const Starts<Arch>& starts) const {
        const AxialLine<Arch, tapers, wanted> line(shape, rays);
        CertifiedCrossing<Arch> result = first_passage<wanted, Arch>(line, starts);
        if constexpr (wanted == Wanted::all && !tapers)
            result.misses = result.misses | (~result.certain & is_along_axis(rays.direction));
        make_unit<wanted>(result);
        return result;
    }

  private:
    /// True where each term of direction x axis has a factor 0, which proves that they are
    /// parallel. Such a line does not cross the body.
    Mask<Arch> is_along_axis(const Vectors<Arch>& direction) const {
        const auto o = zero<Arch>();
        const Vectors<Arch>& axis = shape.axis;
        const auto has = [&](const Floats<Arch>& one, const Floats<Arch>& other) {
            return (one != o) & (other != o);
        };
        const Mask<Arch> turned = has(direction.x, axis.y) | has(direction.x, axis.z) |
                                  has(direction.y, axis.z) | has(direction.y, axis.x) |
                                  has(direction.z, axis.x) | has(direction.z, axis.y);
        return ~turned;
    }
};

/// CertifiedSolver with caps. The body and its caps bound a convex solid. So where a ray crosses
/// the body in one direction, certainly between the ends, or a cap, certainly inside its rim, it
/// enters or leaves the solid.
template <class Arch, bool tapers>
struct CappedCertifiedSolver {
    AxialNumbers<Arch, tapers> shape;

    template <class Reader>
    explicit CappedCertifiedSolver(Reader reader) : shape(reader) {}

    template <Wanted wanted>
    [[gnu::always_inline]] CertifiedCrossing<Arch> solve(const Rays<Arch>& rays,
                                                         const Starts<Arch>& starts) const {
        const Line<wanted> line(shape, rays);
        CertifiedCrossing<Arch> result = pass(line, starts.on_surface, starts);
        const M behind = result.certain & ~starts.on_surface & (result.t < negated(result.error));
        if (any<Arch>(behind)) leave(result, behind, line, starts);
        result.certain = result.certain & (~starts.on_surface | starts.inward) &
                         is_result<Arch>(result.t, result.error);
        if constexpr (wanted == Wanted::all) {
            const M uncertain = ~result.certain & ~starts.on_surface;
            if (any<Arch>(uncertain)) result.misses = uncertain & passed(line);
        }
        make_unit<wanted>(result);
        return result;
    }

    /// Both crossings of lines, with t that may be negative and without normals. Each is
    /// meaningful only where it is certain.
    struct Through {
        CertifiedCrossing<Arch> first;  ///< for rays that start on the surface, where they leave
        CertifiedCrossing<Arch> second; ///< only for other rays
        Mask<Arch> misses; ///< certainly no crossing ahead of the start; only for other rays
    };
    Through through(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const Line<Wanted::crossings> line(shape, rays);
        Through result = {pass(line, starts.on_surface, starts), pass(line, all<Arch>(), starts),
                          none<Arch>()};
        const M uncertain = ~starts.on_surface & ~(result.first.certain & result.second.certain);
        if (any<Arch>(uncertain)) result.misses = uncertain & passed(line);
        return result;
    }

  private:
    using F = Floats<Arch>;
    using M = Mask<Arch>;
    template <Wanted wanted>
    using Line = AxialLine<Arch, tapers, wanted>;

    /// True where the line certainly misses the solid: it is never within the body, or only beyond
    /// one end, or only behind the start.
    template <Wanted wanted>
    static M passed(const Line<wanted>& line) {
        const Passage<Arch> in = line.passage(none<Arch>()), out = line.passage(all<Arch>());
        const M known = in.root.certain & out.root.certain & line.quadratic.opens_up();
        const auto is_beyond = [&](const Passage<Arch>& passage, bool top) {
            const F height = line.height_at(passage.root.s);
            const F margin = line.height_error(passage.root.s, passage.root.error);
            return top ? height - line.axis_squared > margin : height < negated(margin);
        };
        const M beyond = (is_beyond(in, true) & is_beyond(out, true)) |
                         (is_beyond(in, false) & is_beyond(out, false));
        return line.has_no_root() | runs_beside(line) |
               (known & (beyond | (out.t < negated(out.error))));
    }

    /// True where the line certainly stays outside of the body between the ends, as one along the
    /// axis may. Halfway between them it is at s, and between them no more than way + error_s from
    /// there: if the error of the height's slope is at most half of the slope, it at most doubles
    /// the error that the height at `furthest` has, which height_error() allows for. If it is more
    /// than half, error_s exceeds the distance from the axis at s, and nothing is claimed.
    template <Wanted wanted>
    static M runs_beside(const Line<wanted>& line) {
        const F inverse = F(1.0) / line.height_slope, half = F(0.5) * line.axis_squared;
        const F s = (half - line.height_start) * inverse, way = abs(half * inverse);
        const F furthest = abs(s) + way;
        const F error_s = line.height_error(furthest, zero<Arch>()) * abs(inverse);
        const F speed = sum_of_sizes(line.across_direction) + F(0x1p-48);
        const F nearest = line.widest + speed * (way + error_s) + line.local.error_at(s, 12.0);
        return squared_length(line.across_at(s)) * F(1.0 - 0x1p-46) > nearest * nearest;
    }

    /// Not inlined, as it is seldom needed.
    template <Wanted wanted>
    [[gnu::noinline]] static void leave(CertifiedCrossing<Arch>& result, const M& lanes,
                                        const Line<wanted>& line, const Starts<Arch>& starts) {
        result = select<Arch>(lanes, pass(line, starts.on_surface | lanes, starts), result);
    }

    /// Returns the crossing where the ray leaves the solid, in lanes of `leaves`, and where it
    /// enters it, in the others.
    template <Wanted wanted>
    [[gnu::always_inline]] static CertifiedCrossing<Arch>
    pass(const Line<wanted>& line, const M& leaves, const Starts<Arch>& starts) {
        const LocalRays<Arch>& local = line.local;
        const M rises = line.height_slope > zero<Arch>();
        const M at_top = (rises & leaves) | (~rises & ~leaves);
        const F face = select(at_top, F(2.0), F(1.0));

        // The crossing with the cap's plane, and whether it is within the rim. |across| errs by
        // `off`, so |across|^2 errs by 2 width off + off^2, and 6 u width^2.
        const F inverse = F(1.0) / line.height_slope;
        const F cap_height = select(at_top, line.axis_squared, zero<Arch>());
        const F width = select(at_top, line.top_width, line.base_width);
        const F s = (cap_height - line.height_start) * inverse;
        const F error_s = line.height_error(s, zero<Arch>()) * abs(inverse);
        const F off = local.error_at(s, 12.0) + error_s;
        const F within = width * width - squared_length(line.across_at(s));
        const M meets_plane = abs(line.height_slope) > F(0x1p-44) * line.axis_size;
        M by_cap = meets_plane & (within > width * (F(3.0) * off + F(0x1p-49) * width));

        Passage<Arch> side = line.passage(leaves);
        M by_side = side.root.certain & side.inside & side.steady;

        const M from_body = starts.on_surface & (starts.face == zero<Arch>());
        if (any<Arch>(from_body)) {
            // The ray leaves through whichever comes first, and through the cap if it does not meet
            // the body again.
            const Passage<Arch> onward = line.from_surface(starts);
            const M never = line.quadratic.A < F(-1.0) * line.quadratic.A_error;
            const M beyond = onward.root.certain & onward.outside &
                             ((onward.t > zero<Arch>()) & passes(line, onward, at_top));
            by_side = (~from_body & by_side) |
                      (from_body & onward.root.certain & onward.inside & onward.steady);
            by_cap = (~from_body & by_cap) | (from_body & meets_plane & (never | beyond));
            side.t = select(from_body, onward.t, side.t);
            side.error = select(from_body, onward.error, side.error);
            side.normal = select<Arch>(from_body, onward.normal, side.normal);
            if constexpr (wanted == Wanted::all)
                side.normal_error = select<Arch>(from_body, onward.normal_error, side.normal_error);
        }

        const F t = local.shift + s;
        // The cap's normal is the axis, which is exact.
        const CertifiedCrossing<Arch> cap = {
            by_cap, t,       local.error_of_t(t, s, error_s),
            face,   ~leaves, negated_where<Arch>(~at_top, line.axis)};
        CertifiedCrossing<Arch> result = select<Arch>(by_cap, cap, side.crossing(by_side, ~leaves));
        // A ray does not leave by the cap that it starts on.
        result.certain = result.certain & ~(starts.on_surface & (starts.face == face));
        return result;
    }

    /// For a passage that is outside of the two ends: true where it is beyond the end towards which
    /// the ray goes, which is the top in lanes of `at_top`.
    template <Wanted wanted>
    static M passes(const Line<wanted>& line, const Passage<Arch>& passage, const M& at_top) {
        const F height = line.height_at(passage.root.s);
        return (at_top & (height > line.axis_squared)) | (~at_top & (height < zero<Arch>()));
    }
};

} // namespace raylane::simd
