#pragma once

#include "bench/ceiling/ceiling.hpp"
#include "simd/kernel/lanes/vectors.hpp"

/// Textbook formulas of a tracer in float, one ray per lane, without error bounds. Each kind of
/// shape is a struct: `count` is the number of floats per shape, first() finds a ray's first hit
/// with a shape, and normal() returns the normal at a point.
namespace raylane::bench {

/// The same number of one shape in all lanes.
template <class Arch>
struct Uniform {
    using F = simd::Floats<Arch>;
    const float* from;
    F operator[](int i) const { return F(from[i]); }
};

/// The same number of a shape per lane.
template <class Arch>
struct Gathered {
    using F = simd::Floats<Arch>;
    const float* from;
    std::uint32_t place[F::size];
    F operator[](int i) const { return simd::Lanes<Arch>::gather(from + i, place); }
};

template <class Arch>
struct CeilingLoops {
    using F = simd::Floats<Arch>;
    using M = simd::Mask<Arch>;
    using V = simd::Vectors<Arch>;

    struct Ray {
        V origin, direction;
        V at(const F& t) const { return simd::mul_add<Arch>(t, direction, origin); }
    };
    /// No hit unless t > 0. The face of bodies is 0.
    struct Hit {
        F t, face;
    };

    static F fused(const F& a, const F& b, const F& c) { return simd::mul_add<Arch>(a, b, c); }
    static F nothing() { return F(-1.0F); }
    static F none() { return F(0.0F); }
    template <class Numbers>
    static V vector(const Numbers& n, int i) {
        return {n[i], n[i + 1], n[i + 2]};
    }
    /// Returns the first of two values in order that is ahead.
    static F first_ahead(const F& in, const F& out) { return select(in > none(), in, out); }
    static F square(const V& v) { return dot(v, v); }

    /// Centre, radius, 1 / radius.
    struct Sphere {
        static constexpr int count = 5;
        template <class Numbers>
        static Hit first(const Numbers& n, const Ray& ray) {
            const V from_center = ray.origin - vector(n, 0);
            const F shift = -dot(from_center, ray.direction);
            const V foot = simd::mul_add<Arch>(shift, ray.direction, from_center);
            // The root of a negative number is NaN, which is not ahead and not nearest.
            const F half = sqrt(fused(n[3], n[3], -square(foot)));
            return {first_ahead(shift - half, shift + half), none()};
        }
        template <class Numbers>
        static V normal(const Numbers& n, const V& point, const F&) {
            return scaled(n[4], point - vector(n, 0));
        }
    };

    /// Point, normal.
    struct Plane {
        static constexpr int count = 6;
        template <class Numbers>
        static Hit first(const Numbers& n, const Ray& ray) {
            const V normal = vector(n, 3);
            return {dot(normal, vector(n, 0) - ray.origin) / dot(normal, ray.direction), none()};
        }
        template <class Numbers>
        static V normal(const Numbers& n, const V&, const F&) {
            return vector(n, 3);
        }
    };

    /// Centre, normal, squared radius.
    struct Disc : Plane {
        static constexpr int count = 7;
        template <class Numbers>
        static Hit first(const Numbers& n, const Ray& ray) {
            const F t = Plane::first(n, ray).t;
            const V across = ray.at(t) - vector(n, 0);
            return {select(square(across) <= n[6], t, nothing()), none()};
        }
    };

    /// Corner, two edges from there, normal.
    struct Triangle {
        static constexpr int count = 12;
        template <class Numbers>
        static Hit first(const Numbers& n, const Ray& ray) {
            const V edge_b = vector(n, 3), edge_c = vector(n, 6);
            const V from_corner = ray.origin - vector(n, 0);
            const V by_c = cross(ray.direction, edge_c), by_b = cross(from_corner, edge_b);
            const F inverse = F(1.0F) / dot(edge_b, by_c);
            const F b = dot(from_corner, by_c) * inverse, c = dot(ray.direction, by_b) * inverse;
            const M inside = (b >= none()) & (c >= none()) & (b + c <= F(1.0F));
            return {select(inside, dot(edge_c, by_b) * inverse, nothing()), none()};
        }
        template <class Numbers>
        static V normal(const Numbers& n, const V&, const F&) {
            return vector(n, 9);
        }
    };

    /// Corner; for each of three edge coordinates, the vector whose product gives the coordinate,
    /// and the unit normal where it is 1.
    struct Box {
        static constexpr int count = 21;
        template <class Numbers>
        static Hit first(const Numbers& n, const Ray& ray) {
            const V from_corner = ray.origin - vector(n, 0);
            F in(-__builtin_inff()), out(__builtin_inff()), in_face = none(), out_face = none();
            for (int i = 0; i < 3; ++i) {
                const V row = vector(n, 3 + 6 * i);
                const F slope = dot(row, ray.direction), inverse = F(1.0F) / slope;
                const F low = -dot(row, from_corner) * inverse, high = low + inverse;
                const M rises = slope > none();
                const F low_face(static_cast<float>(2 * i)),
                    high_face(static_cast<float>(2 * i + 1));
                const F near = min(low, high), far = max(low, high);
                in_face = select(near > in, select(rises, low_face, high_face), in_face);
                out_face = select(far < out, select(rises, high_face, low_face), out_face);
                in = max(in, near);
                out = min(out, far);
            }
            const M enters = in > none();
            return {select(in <= out, select(enters, in, out), nothing()),
                    select(enters, in_face, out_face)};
        }
        template <class Numbers>
        static V normal(const Numbers& n, const V&, const F& face) {
            const V third = select(face >= F(4.0F), vector(n, 18), vector(n, 12));
            const V normal = select(face >= F(2.0F), third, vector(n, 6));
            const M high = (face == F(1.0F)) | (face == F(3.0F)) | (face == F(5.0F));
            return select(high, normal, -normal);
        }
    };

    /// Base, unit axis, length, squared base radius, change of the radius along the axis, base
    /// radius.
    template <bool tapers, bool capped>
    struct Axial {
        static constexpr int count = 10;
        template <class Numbers>
        static Hit first(const Numbers& n, const Ray& ray) {
            const V axis = vector(n, 3), from_base = ray.origin - vector(n, 0);
            const F height = dot(from_base, axis), rise = dot(ray.direction, axis);
            const V o = simd::mul_add<Arch>(-height, axis, from_base);
            const V d = simd::mul_add<Arch>(-rise, axis, ray.direction);
            F in, out;
            if constexpr (tapers) {
                const F width = fused(n[8], height, n[9]), widening = n[8] * rise;
                const F A = fused(-widening, widening, square(d));
                const F B = fused(-widening, width, dot(o, d));
                const F C = fused(-width, width, square(o));
                const F root = sqrt(fused(B, B, -(A * C)));
                const F q = select(B < none(), root - B, -root - B);
                const F by_A = q / A, by_C = C / q;
                in = min(by_A, by_C);
                out = max(by_A, by_C);
            } else {
                const F inverse = F(1.0F) / square(d), tau = -dot(o, d) * inverse;
                const V foot = simd::mul_add<Arch>(tau, d, o);
                const F half = sqrt((n[7] - square(foot)) * inverse);
                in = tau - half;
                out = tau + half;
            }
            const auto between_ends = [&](const F& t) {
                const F at = fused(t, rise, height);
                return (at >= none()) & (at <= n[6]);
            };
            if constexpr (!capped) {
                const F first = select(between_ends(in), in, nothing());
                return {first_ahead(first, select(between_ends(out), out, nothing())), none()};
            } else if constexpr (tapers) {
                const F inverse = F(1.0F) / rise;
                const F base = -height * inverse, top = (n[6] - height) * inverse;
                const auto within = [&](const F& t, const F& radius) {
                    return square(simd::mul_add<Arch>(t, d, o)) <= radius * radius;
                };
                Hit hit{F(__builtin_inff()), none()};
                const auto take = [&](const F& t, const M& is_there, float face) {
                    const M first = is_there & (t > none()) & (t < hit.t);
                    hit = {select(first, t, hit.t), select(first, F(face), hit.face)};
                };
                take(in, between_ends(in), 0.0F);
                take(out, between_ends(out), 0.0F);
                take(base, within(base, n[9]), 1.0F);
                take(top, within(top, fused(n[8], n[6], n[9])), 2.0F);
                return hit;
            } else {
                const F inverse = F(1.0F) / rise;
                const F base = -height * inverse, top = (n[6] - height) * inverse;
                const M rises = rise > none();
                const F near = min(base, top), far = max(base, top);
                const F near_face = select(rises, F(1.0F), F(2.0F));
                const F far_face = F(3.0F) - near_face;
                const F in_face = select(near > in, near_face, none());
                const F out_face = select(far < out, far_face, none());
                in = max(near, in); // NaN stays NaN
                out = min(far, out);
                const M enters = in > none();
                return {select(in <= out, select(enters, in, out), nothing()),
                        select(enters, in_face, out_face)};
            }
        }
        template <class Numbers>
        static V normal(const Numbers& n, const V& point, const F& face) {
            const V axis = vector(n, 3), from_base = point - vector(n, 0);
            const V across = simd::mul_add<Arch>(-dot(from_base, axis), axis, from_base);
            const F inverse = F(1.0F) / sqrt(square(across));
            V normal = scaled(inverse, across);
            if constexpr (tapers) {
                const F lean = n[8], shorter = F(1.0F) / sqrt(fused(lean, lean, F(1.0F)));
                normal = scaled(shorter, simd::mul_add<Arch>(-lean, axis, normal));
            }
            if constexpr (!capped) return normal;
            return select(face == none(), normal, select(face == F(1.0F), -axis, axis));
        }
    };

    /// Centre, a symmetric matrix, the linear part, the constant, the clipping box.
    struct Quadric {
        static constexpr int count = 19;
        template <class Numbers>
        static V product(const Numbers& n, const V& v) {
            return {dot(V{n[3], n[6], n[7]}, v), dot(V{n[6], n[4], n[8]}, v),
                    dot(V{n[7], n[8], n[5]}, v)};
        }
        template <class Numbers>
        static Hit first(const Numbers& n, const Ray& ray) {
            const V o = ray.origin - vector(n, 0), linear = vector(n, 9);
            const V of_o = product(n, o), of_d = product(n, ray.direction);
            const F A = dot(of_d, ray.direction), B = dot(of_o + linear, ray.direction);
            const F C = dot(of_o + linear + linear, o) + n[12];
            const F root = sqrt(fused(B, B, -(A * C)));
            const F q = select(B < none(), root - B, -root - B);
            const F by_A = q / A, by_C = C / q;
            const V lower = vector(n, 13), upper = vector(n, 16);
            const auto within = [&](const F& t) {
                const V p = simd::mul_add<Arch>(t, ray.direction, o);
                return select((p.x >= lower.x) & (p.x <= upper.x) & (p.y >= lower.y) &
                                  (p.y <= upper.y) & (p.z >= lower.z) & (p.z <= upper.z),
                              t, nothing());
            };
            return {first_ahead(within(min(by_A, by_C)), within(max(by_A, by_C))), none()};
        }
        template <class Numbers>
        static V normal(const Numbers& n, const V& point, const F&) {
            return simd::unit(product(n, point - vector(n, 0)) + vector(n, 9));
        }
    };

    /// Centre, and the rows of the map to the unit ball.
    struct Ellipsoid {
        static constexpr int count = 12;
        template <class Numbers>
        static V mapped(const Numbers& n, const V& v) {
            return {dot(vector(n, 3), v), dot(vector(n, 6), v), dot(vector(n, 9), v)};
        }
        template <class Numbers>
        static Hit first(const Numbers& n, const Ray& ray) {
            const V o = mapped(n, ray.origin - vector(n, 0)), d = mapped(n, ray.direction);
            const F inverse = F(1.0F) / square(d), tau = -dot(o, d) * inverse;
            const F half = sqrt((F(1.0F) - square(simd::mul_add<Arch>(tau, d, o))) * inverse);
            return {first_ahead(tau - half, tau + half), none()};
        }
        template <class Numbers>
        static V normal(const Numbers& n, const V& point, const F&) {
            const V p = mapped(n, point - vector(n, 0));
            return simd::unit(simd::mul_add<Arch>(
                p.x, vector(n, 3),
                simd::mul_add<Arch>(p.y, vector(n, 6), scaled(p.z, vector(n, 9)))));
        }
    };

    template <class Kind>
    static void nearest(const float* numbers, int shape_count, const CeilingRays& rays,
                        const CeilingHits& hits) {
        for (std::size_t i = 0; i < rays.count; i += F::size) {
            const auto load = [&](const float* const(&from)[3]) {
                return V{F::load_unaligned(from[0] + i), F::load_unaligned(from[1] + i),
                         F::load_unaligned(from[2] + i)};
            };
            const Ray ray{load(rays.origin), load(rays.direction)};
            F best(__builtin_inff()), which = none(), face = none();
            for (int shape = 0; shape < shape_count; ++shape) {
                const Hit hit = Kind::first(Uniform<Arch>{numbers + shape * Kind::count}, ray);
                const M nearer = (hit.t > none()) & (hit.t < best);
                best = select(nearer, hit.t, best);
                which = select(nearer, F(__builtin_bit_cast(float, shape)), which); // by its bits
                face = select(nearer, hit.face, face);
            }
            Gathered<Arch> gathered;
            gathered.from = numbers;
            which.store_unaligned(reinterpret_cast<float*>(hits.shape + i));
            for (std::size_t lane = 0; lane < F::size; ++lane)
                gathered.place[lane] = hits.shape[i + lane] * std::uint32_t{Kind::count};
            const V normal = Kind::normal(gathered, ray.at(best), face);
            best.store_unaligned(hits.t + i);
            normal.x.store_unaligned(hits.normal[0] + i);
            normal.y.store_unaligned(hits.normal[1] + i);
            normal.z.store_unaligned(hits.normal[2] + i);
        }
    }

    static constexpr CeilingUnit unit = {nearest<Sphere>,
                                         nearest<Plane>,
                                         nearest<Disc>,
                                         nearest<Triangle>,
                                         nearest<Box>,
                                         nearest<Axial<false, false>>,
                                         nearest<Axial<false, true>>,
                                         nearest<Axial<true, false>>,
                                         nearest<Axial<true, true>>,
                                         nearest<Quadric>,
                                         nearest<Ellipsoid>};
};

} // namespace raylane::bench
