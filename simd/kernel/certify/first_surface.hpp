#pragma once

#include "simd/kernel/certify/gathered_rays.hpp"
#include "simd/kernel/certify/slot_reader.hpp"
#include "simd/kernel/shapes/certified_solver.hpp"
#include "simd/kernel/shapes/shapes.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

/// Finds the first surface of each ray in a scene of few shapes with solids. Implements
/// RefineKernels::first_surfaces.
///
/// A line is inside of a shape before its first crossing, between both or behind the second. So
/// whether a crossing is a surface of its solid follows from comparisons of t alone. All t are
/// computed by the solvers' formulas in double with bounds, and each comparison takes them into
/// account. A ray for which one of these leaves a doubt is left to the caller.
template <class Arch>
class FirstSurfaces {
  public:
    FirstSurfaces(const SurfaceNodes& nodes, const Found& found, std::uint32_t* slot)
        : nodes_(nodes), found_(found), slot_(slot) {}

    void find(const std::uint32_t* lanes, std::size_t count) {
        for (std::size_t begin = 0; begin < count; begin += width) {
            const std::size_t filled = count - begin < width ? count - begin : width;
            rays_.gather(found_, lanes + begin, filled);
            Best best;
            for (std::uint32_t root = 0; root < nodes_.count; root = nodes_.node[root].end)
                look(root, best);
            store(best, lanes + begin, filled);
        }
    }

  private:
    using D = Double<Arch>;
    using F = Floats<D>;
    using M = Mask<D>;
    using C = Certified<D>;
    static constexpr std::size_t width = F::size;

    /// The crossings of lines with a shape. Missing ones are at infinity, behind the others.
    struct Line {
        F t[2], error[2], face[2];
        M exists[2];
        M counts[2]; ///< those that exist, if they are on the clipped surface
        M inside;    ///< before the first crossing
    };

    /// The candidate with the smallest lower bound.
    struct Best {
        F lower = F(__builtin_inf()), second = F(__builtin_inf()); ///< the two smallest bounds
        F t = zero<D>(), error = zero<D>(), face = zero<D>(), node = F(-1.0);
        M is_surface = none<D>(), entering = none<D>();
        M doubt = none<D>(); ///< of any kind
    };

    struct Sides {
        M yes, no;
    };

    /// Reads one shape into all lanes; if `unclipped`, a quadric without its clipping.
    template <class Number>
    struct ReaderOf {
        const double* numbers;
        bool unclipped = false;
        int row = 0;
        Floats<Number> next() {
            constexpr int lower = 13, upper = 16; // rows of QuadricNumbers
            const int at = row++;
            return Floats<Number>(!unclipped || at < lower ? numbers[at]
                                  : at < upper             ? -1e300
                                                           : 1e300);
        }
    };
    using Reader = ReaderOf<C>;

    /// Bound on the error of a comparison. The last digits of the sum of both errors and of the
    /// difference of both t are within the factor.
    static F margin(const F& error, const F& other) { return (error + other) * F(1.0 + 0x1p-48); }

    void look(std::uint32_t root, Best& best) {
        const std::uint32_t end = nodes_.node[root].end;
        for (std::uint32_t index = root; index < end; ++index)
            if (const SurfaceNode& node = nodes_.node[index]; node.numbers != nullptr)
                with_shape(node.kind, [&]<class Shape>() {
                    cross<Shape>(node, lines_[index - root], best.doubt);
                });
        for (std::uint32_t index = root; index < end; ++index)
            for (int which = 0; which < 2 && nodes_.node[index].slot != no_slot; ++which)
                consider(root, index, which, best);
    }

    template <class Shape>
    [[gnu::noinline]] void cross(const SurfaceNode& node, Line& line, M& doubt) const {
        using Solver = typename ShapeKernels<Shape>::template Solver<C, false>;
        using Certified = typename ShapeKernels<Shape>::template CertifiedSolver<D>;
        const Starts<D> starts = rays_.starts_on(node.id);
        if constexpr (std::is_base_of_v<SphereNumbers<C>, Solver>)
            return cross_sphere(node.numbers, starts, line, doubt);
        else if constexpr (requires { typename Certified::Through; })
            if (go_through<Certified>(node.numbers, starts, line)) return;
        // A quadric's inside extends beyond its clipped surface.
        const Solver solver(Reader{node.numbers, node.is_part && node.kind == core::Kind::quadric});
        const Rays<C> rays = certified<D>(rays_.rays);
        const Answers<D> on_surface(starts.on_surface, all<D>()), inward(starts.inward, all<D>());
        const Crossings<C> found =
            solver.crossings(rays, Starts<C>{on_surface, inward, Floats<C>(starts.face)});
        const M both = found.first.exists.answer & found.second.exists.answer;
        const M either = found.first.exists.answer | found.second.exists.answer;
        const auto is_known = [](const Crossing<C>& crossing) {
            return crossing.exists.surely_not() |
                   (crossing.exists.surely() & (crossing.t.error < F(__builtin_inf())) &
                    (crossing.face.error == zero<D>()) & crossing.entering.known);
        };
        const M is_first = found.first.exists.answer;
        const auto chosen_of = [&](const F& first, const F& second) {
            return select(is_first, first, second);
        };
        const F nowhere(__builtin_inf()), o = zero<D>();
        line.counts[0] = line.exists[0] = either;
        line.counts[1] = line.exists[1] = both;
        line.t[0] = select(either, chosen_of(found.first.t.value, found.second.t.value), nowhere);
        line.t[1] = select(both, found.second.t.value, nowhere);
        line.error[0] = select(either, chosen_of(found.first.t.error, found.second.t.error), o);
        line.error[1] = select(both, found.second.t.error, o);
        line.face[0] = chosen_of(found.first.face.value, found.second.face.value);
        line.face[1] = found.second.face.value;
        const M enters =
            (is_first & found.first.entering.answer) | (~is_first & found.second.entering.answer);
        const Answers<D> alone = (on_surface & inward) | (~on_surface & runs_inside(solver, rays));
        line.inside = (either & ~enters) | (~either & alone.answer);
        doubt = doubt | ~(is_known(found.first) & is_known(found.second) & (either | alone.known)) |
                (both & ~differ(found.second.entering.answer, found.first.entering.answer));
        if constexpr (std::is_base_of_v<QuadricNumbers<C>, Solver>)
            if (node.is_part) clip(QuadricNumbers<C>(Reader{node.numbers}), line, doubt);
    }

    /// The spheres' crossings, with the bounds that SphereCertifiedSolver derives. They are those
    /// of unit directions, whose lengths and quotients err by a few ulps.
    void cross_sphere(const double* numbers, const Starts<D>& starts, Line& line, M& doubt) const {
        const Vectors<D> center = {F(numbers[0]), F(numbers[1]), F(numbers[2])};
        const F radius(numbers[3]);
        const Vectors<D> from_center = rays_.rays.origin - center;
        const F shift = negated(dot(from_center, rays_.unit));
        const Vectors<D> foot = mul_add<D>(shift, rays_.unit, from_center);
        const F foot_squared = squared_length(foot), size = sum_of_sizes(foot);
        const F discriminant = radius * radius - foot_squared;
        const auto error_of = [&](const F& r) {
            const F H = abs(shift) + (r + r);
            return H * (F(0x1p-49) * r + F(0x1p-90) * H);
        };
        const F off = error_of(radius);
        const M meets = discriminant > off, passes = negated(discriminant) > error_of(size);
        const F root = sqrt(select(meets, discriminant, F(1.0)));
        const F H = abs(shift) + (radius + radius), error = F(0x1p-45) * H + off / root;
        const M &on = starts.on_surface, is_near = foot_squared < F(2.0) * (radius * radius);
        line.face[0] = line.face[1] = zero<D>();
        doubt =
            doubt | (on & starts.inward & ~is_near) | (~on & ~(meets | passes)) |
            set(line, starts, meets, select(on, shift + shift, shift - root),
                select(on, F(0x1p-49) * H + F(0x1p-45) * abs(shift), error), shift + root, error);
    }

    /// Returns false if a lane is in doubt.
    template <class Certified>
    bool go_through(const double* numbers, const Starts<D>& starts, Line& line) const {
        const auto [first, second, misses] =
            Certified(ReaderOf<D>{numbers}).through({rays_.rays.origin, rays_.unit}, starts);
        const M meets = first.certain & second.certain, leaves = starts.on_surface & starts.inward;
        line.face[0] = first.face;
        line.face[1] = second.face;
        const M doubt = (~starts.on_surface & ~(meets | misses)) | (leaves & ~first.certain);
        return !any<D>(doubt |
                       set(line, starts, meets, first.t, first.error, second.t, second.error));
    }

    /// Sets the crossings with a convex shape at t along the unit directions. Rays that start on
    /// it have only the first one, if they go inward. Others have both if they meet it. Returns
    /// true where the former crossing may be behind the start.
    M set(Line& line, const Starts<D>& starts, const M& meets, const F& first, const F& first_error,
          const F& second, const F& second_error) const {
        const M leaves = starts.on_surface & starts.inward;
        set(line, 0, leaves | (~starts.on_surface & meets), first, first_error);
        set(line, 1, ~starts.on_surface & meets, second, second_error);
        line.inside = leaves;
        return leaves & ~(first > first_error);
    }
    void set(Line& line, int which, const M& exists, const F& t, const F& error) const {
        const F inverse = F(1.0) / rays_.length, of_caller = t * inverse;
        line.counts[which] = line.exists[which] = exists;
        line.t[which] = select(exists, of_caller, F(__builtin_inf()));
        line.error[which] = select(
            exists, error * inverse * F(1.0 + 0x1p-48) + F(0x1p-48) * abs(of_caller), zero<D>());
    }

    void clip(const QuadricNumbers<C>& quadric, Line& line, M& doubt) const {
        const Rays<C> rays = certified<D>(rays_.rays);
        for (int which = 0; which < 2; ++which) {
            const Vectors<C> p = mul_add<C>(
                Floats<C>(select(line.exists[which], line.t[which], zero<D>()), line.error[which]),
                rays.direction, rays.origin - quadric.center);
            const Vectors<C>&lower = quadric.lower, &upper = quadric.upper;
            const Answers<D> outside = (p.x < lower.x) | (upper.x < p.x) | (p.y < lower.y) |
                                       (upper.y < p.y) | (p.z < lower.z) | (upper.z < p.z);
            line.counts[which] = line.exists[which] & ~outside.answer;
            doubt = doubt | (line.exists[which] & ~outside.known);
        }
    }

    /// Tells whether lines that do not cross a shape are inside of it.
    template <class Solver>
    static Answers<D> runs_inside(const Solver& solver, const Rays<C>& rays) {
        if constexpr (std::is_base_of_v<QuadricNumbers<C>, Solver>)
            return solver.value(rays.origin - solver.center) < zero<C>();
        else if constexpr (std::is_base_of_v<PlaneNumbers<C>, Solver>)
            return dot(solver.normal, rays.origin - solver.point) < zero<C>();
        else
            return Answers<D>(false);
    }

    /// Whether points of lines are inside of a part: those at t, with an error.
    static Sides inside(const Line& line, const SurfaceNode& node, const F& t, const F& error) {
        const F first = line.t[0] - t, second = line.t[1] - t;
        const F first_off = margin(error, line.error[0]), second_off = margin(error, line.error[1]);
        const M before = first > first_off, behind = negated(first) > first_off;
        const M before_second = second > second_off, behind_second = negated(second) > second_off;
        const M same = before | (behind & behind_second), other = behind & before_second;
        const M yes = (same & line.inside) | (other & ~line.inside);
        const M no = (same & ~line.inside) | (other & line.inside);
        return node.reversed ? Sides{no, yes} : Sides{yes, no};
    }

    Sides value(std::uint32_t root, std::uint32_t index, const F& t, const F& error) const {
        const SurfaceNode& node = nodes_.node[index];
        if (node.numbers != nullptr) return inside(lines_[index - root], node, t, error);
        Sides sides = {M(node.of_all), M(!node.of_all)};
        for (std::uint32_t child = index + 1; child < node.end; child = nodes_.node[child].end) {
            const Sides of_child = value(root, child, t, error);
            sides.yes = node.of_all ? sides.yes & of_child.yes : sides.yes | of_child.yes;
            sides.no = node.of_all ? sides.no | of_child.no : sides.no & of_child.no;
        }
        return sides;
    }

    /// Whether crossings of a part are surfaces of the solid: no other part decides there.
    Sides is_surface(std::uint32_t root, std::uint32_t index, const F& t, const F& error) const {
        Sides surface = {all<D>(), none<D>()};
        while (index != root) {
            const std::uint32_t parent = nodes_.node[index].parent;
            const SurfaceNode& above = nodes_.node[parent];
            for (std::uint32_t other = parent + 1; other < above.end;
                 other = nodes_.node[other].end) {
                if (other == index) continue;
                const Sides of_other = value(root, other, t, error);
                surface.yes = surface.yes & (above.of_all ? of_other.yes : of_other.no);
                surface.no = surface.no | (above.of_all ? of_other.no : of_other.yes);
            }
            index = parent;
        }
        return surface;
    }

    /// Considers the first or second crossing of a shape as the first surface.
    void consider(std::uint32_t root, std::uint32_t index, int which, Best& best) const {
        const SurfaceNode& node = nodes_.node[index];
        const Line& line = lines_[index - root];
        const F t = line.t[which], error = line.error[which];
        const M entering = which == 0 ? ~line.inside : line.inside;
        const M seen = (entering & M(node.seen[1])) | (~entering & M(node.seen[0]));
        const F ahead = t - rays_.t_after, off = margin(error, rays_.half_ulp);
        const M counts = line.counts[which] & seen & ~(negated(ahead) > off);
        best.doubt = best.doubt | (counts & ~(ahead > off));
        // A surface that is certainly before makes the crossing irrelevant.
        const F lower = t - margin(error, zero<D>());
        const M relevant = counts & ~(best.is_surface & (t - best.t > margin(error, best.error)));
        if (!any<D>(relevant)) return;
        const Sides surface = is_surface(root, index, t, error);
        const M candidate = relevant & ~surface.no, is_first = candidate & (lower < best.lower);
        // A crossing changes nothing if the line only touches the shape.
        const M is_alone = line.t[1] - line.t[0] > margin(line.error[0], line.error[1]);
        best.second = select(is_first, best.lower,
                             select(candidate & (lower < best.second), lower, best.second));
        best.lower = select(is_first, lower, best.lower);
        best.t = select(is_first, t, best.t);
        best.error = select(is_first, error, best.error);
        best.face = select(is_first, line.face[which], best.face);
        best.node = select(is_first, F(static_cast<double>(index)), best.node);
        best.entering = (is_first & entering) | (~is_first & best.entering);
        best.is_surface = (is_first & surface.yes & is_alone) | (~is_first & best.is_surface);
    }

    void store(const Best& best, const std::uint32_t* lanes, std::size_t count) {
        const M misses = (best.node < zero<D>()) & ~best.doubt;
        const M certain = best.is_surface & ~best.doubt & is_result<D>(best.t, best.error) &
                          (best.second - best.t > margin(best.error, F(0x1p-50) * best.t));
        const F unit_t = best.t * rays_.length;
        const F rounding = select(rays_.length == F(1.0), zero<D>(), F(0x1p-50));
        double t[width], error[width], face[width], node[width];
        unit_t.store_unaligned(t);
        (best.error * rays_.length * F(1.0 + 0x1p-50) + rounding * unit_t).store_unaligned(error);
        best.face.store_unaligned(face);
        best.node.store_unaligned(node);
        const std::uint32_t is_hit = Lanes<D>::bits(certain), is_miss = Lanes<D>::bits(misses),
                            entering = Lanes<D>::bits(best.entering);
        for (std::size_t lane = 0; lane < count; ++lane) {
            const std::uint32_t ray = lanes[lane];
            found_.hit[ray] |= hit_doubtful;
            if ((is_miss >> lane & 1) != 0) slot_[ray] = no_slot;
            if ((is_hit >> lane & 1) == 0) continue;
            const SurfaceNode& shape = nodes_.node[static_cast<std::uint32_t>(node[lane])];
            slot_[ray] = shape.slot;
            found_.t[ray] = t[lane];
            found_.error[ray] = error[lane];
            found_.hit[ray] = static_cast<std::uint32_t>(face[lane]) | hit_normal_unknown |
                              ((entering >> lane & 1) != 0 ? hit_entering : 0) |
                              (shape.reversed ? hit_reversed : 0);
        }
        if (found_.normal[0] == nullptr || is_hit == 0) return;
        for (std::uint32_t index = 0; index < nodes_.count; ++index)
            if (const M those = certain & (best.node == F(static_cast<double>(index)));
                any<D>(those))
                store_normals(nodes_.node[index], best, Lanes<D>::bits(those), lanes, count);
    }

    void store_normals(const SurfaceNode& node, const Best& best, std::uint32_t those,
                       const std::uint32_t* lanes, std::size_t count) const {
        // If a ray starts on a shape, but its origin is beside the surface, the ray also leaves
        // beside it. The normals of cones then depend on more than the point.
        those &= ~Lanes<D>::bits(rays_.starts_on(node.id).on_surface);
        if (those == 0) return;
        CertifiedCrossing<D> crossing;
        with_solver<C>(node.kind, [&]<class Solver>() {
            find_normal<Solver>(Reader{node.numbers}, best, crossing);
        });
        const std::uint32_t rounded = those & Lanes<D>::bits(is_rounded(crossing));
        double normal[3][width];
        crossing.normal.x.store_unaligned(normal[0]);
        crossing.normal.y.store_unaligned(normal[1]);
        crossing.normal.z.store_unaligned(normal[2]);
        for (std::size_t lane = 0; lane < count; ++lane) {
            if ((rounded >> lane & 1) == 0) continue;
            for (int axis = 0; axis < 3; ++axis)
                found_.normal[axis][lanes[lane]] =
                    node.reversed ? -normal[axis][lane] : normal[axis][lane];
            found_.hit[lanes[lane]] &= ~hit_normal_unknown;
        }
    }
    template <class Solver>
    [[gnu::noinline]] void find_normal(const Reader& reader, const Best& best,
                                       CertifiedCrossing<D>& crossing) const {
        const Solver solver(reader);
        const Rays<C> rays = certified<D>(rays_.rays);
        const Vectors<C> normal = solver.outward_normal(
            mul_add<C>(Floats<C>(best.t, best.error), rays.direction, rays.origin),
            Floats<C>(best.face));
        crossing.normal = {normal.x.value, normal.y.value, normal.z.value};
        crossing.normal_error = {normal.x.error, normal.y.error, normal.z.error};
    }

    const SurfaceNodes& nodes_;
    const Found& found_;
    std::uint32_t* slot_;
    GatheredRays<Arch> rays_;
    Line lines_[SurfaceNodes::most]; // of one solid, by node
};

template <class Arch>
void first_surfaces(const SurfaceNodes& nodes, const Found& found, std::uint32_t* slot,
                    const std::uint32_t* lanes, std::size_t count) {
    FirstSurfaces<Arch>(nodes, found, slot).find(lanes, count);
}

} // namespace raylane::simd
