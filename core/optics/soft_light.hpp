#pragma once

#include "core/numbers/elementary.hpp"
#include "core/numbers/sample_sequence.hpp"
#include "core/scene/appearance.hpp"

/// Samples of lights that have a size, for scalars and registers alike.
namespace raylane::core {

struct Light;

/// A light with a size, prepared for sampling: plain data.
struct SoftLight {
    LightKind kind;
    double color[3];  ///< radiance; sky: of the zenith
    double ground[3]; ///< sky: of the nadir
    double reach;     ///< sky
    double middle[3]; ///< sphere, disc; rectangle: a corner
    double radius;
    double axis[3][3]; ///< unit vectors; the last is up (sky) or the normal (disc, rectangle)
    double extent[2];  ///< rectangle: lengths of its edges, along the first two axes
};

/// Prepares a light, which must have a size.
SoftLight prepared(const Light& light);

/// Returns the point whose sample is the light's middle, for hard light. For the sky, the sample is
/// the normal.
constexpr SamplePoint middle_of(const SoftLight& light) {
    return light.kind == LightKind::rectangle ? SamplePoint{0.5F, 0.5F} : SamplePoint{0.0F, 0.0F};
}

template <class Number>
struct Directed {
    Number x, y, z;
};

template <class Number>
struct LightSample {
    Directed<Number> direction; ///< unit
    Number distance;            ///< to the light
    Number share;               ///< factor on the radiance; for the sky it includes the cosine
    Number height;              ///< sky: 1 shows the zenith, 0 the nadir
};

/// Samples a light at points in [0, 1)^2. The mean over the points of radiance * share * cosine
/// (for the sky: radiance * share) is the light's irradiance divided by pi, which a white diffuse
/// surface shows. Each operation is rounded separately, so that registers give the same bits as
/// scalars.
template <class Number>
class SoftLightSampler {
  public:
    explicit SoftLightSampler(const SoftLight& light) : light_(light) {}

    /// `normal` is the unit normal of the surface at `point`: the sky is sampled by the cosine to
    /// it.
    LightSample<Number> sample(const Directed<Number>& point, const Directed<Number>& normal,
                               const Number& u, const Number& v) const {
        switch (light_.kind) {
        case LightKind::point:
        case LightKind::directional:
            break;
        case LightKind::sky:
            return of_sky(normal, u, v);
        case LightKind::sphere:
            return of_sphere(point, u, v);
        case LightKind::disc:
            return of_disc(point, u, v);
        case LightKind::rectangle:
            return of_rectangle(point, u, v);
        }
        __builtin_unreachable();
    }

  private:
    using P = Primitives<Number>;
    using V = Directed<Number>;
    using Turn = typename Elementary<Number>::SineCosine;

    static V constant(const double (&v)[3]) { return {Number(v[0]), Number(v[1]), Number(v[2])}; }
    static V minus(const V& a, const V& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    static Number dot(const V& a, const V& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    static V scaled(const Number& s, const V& a) { return {s * a.x, s * a.y, s * a.z}; }
    static V sum(const V& a, const V& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    static V cross(const V& a, const V& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
    static Number not_negative(const Number& x) {
        return P::select(x > Number(0.0), x, Number(0.0));
    }
    static Turn turn(const Number& v) {
        return Elementary<Number>::sin_cos(Number(0x1.921fb54442d18p+2) * v);
    }

    /// Returns a vector in a frame around the unit vector z: Duff et al., "Building an orthonormal
    /// basis, revisited" (2017). Their frame changes sign at z.z = 0, the normals of walls, where
    /// rounding would choose the sign. This one changes at a value that is not typical of any
    /// surface, and is equally accurate.
    static V around(const V& z, const Number& x_part, const Number& y_part, const Number& z_part) {
        const Number seam(-0.28651);
        const Number sign = P::select(z.z < seam, Number(-1.0), Number(1.0));
        const Number a = Number(-1.0) / (sign + z.z);
        const Number b = z.x * z.y * a;
        const V x{Number(1.0) + sign * z.x * z.x * a, sign * b, Number(0.0) - sign * z.x};
        const V y{b, sign + z.y * z.y * a, Number(0.0) - z.y};
        return sum(sum(scaled(x_part, x), scaled(y_part, y)), scaled(z_part, z));
    }

    /// Samples by the cosine to the normal (Malley): a point of the unit disc, raised to the
    /// hemisphere.
    LightSample<Number> of_sky(const V& normal, const Number& u, const Number& v) const {
        const Turn azimuth = turn(v);
        const Number r = P::sqrt(u), z = P::sqrt(not_negative(Number(1.0) - u));
        const V direction = around(normal, r * azimuth.cosine, r * azimuth.sine, z);
        const Number up = dot(direction, constant(light_.axis[2]));
        return {direction, Number(light_.reach), Number(1.0), Number(0.5) + Number(0.5) * up};
    }

    /// Samples evenly over the cone of directions to the sphere; from inside, over all directions.
    LightSample<Number> of_sphere(const V& point, const Number& u, const Number& v) const {
        const Number one(1.0), zero(0.0);
        const V offset = minus(constant(light_.middle), point);
        const Number squared = dot(offset, offset);
        const Number radius_squared(light_.radius * light_.radius);
        const auto outside = squared > radius_squared;
        const Number distance = P::sqrt(squared);
        const auto off_middle = distance > zero;
        const Number per_distance = one / P::select(off_middle, distance, one);
        V axis = scaled(per_distance, offset);
        axis.z = P::select(off_middle, axis.z, one);

        // 1 - cos of the cone's half angle, without cancellation.
        const Number sine_squared =
            radius_squared / P::select(outside, squared, Number(4.0) * radius_squared);
        const Number of_cone = sine_squared / (one + P::sqrt(not_negative(one - sine_squared)));
        const Number height = P::select(outside, of_cone, Number(2.0));
        const Number h = u * height;
        const Number cosine = one - h, sine = P::sqrt(not_negative(h * (Number(2.0) - h)));
        const Turn azimuth = turn(v);
        const V direction = around(axis, sine * azimuth.cosine, sine * azimuth.sine, cosine);
        const Number across = distance * sine;
        const Number half_chord = P::sqrt(not_negative(radius_squared - across * across));
        const Number along = distance * cosine;
        return {direction, P::select(outside, along - half_chord, along + half_chord),
                Number(2.0) * height, zero};
    }

    /// Samples the cone of directions to a disc, which is elliptic. Its axis bisects the angle
    /// between the disc's nearest and farthest points, and its cross-section is an ellipse.
    /// Azimuths are sampled by the ellipse's area, and evenly by solid angle along each azimuth.
    LightSample<Number> of_disc(const V& point, const Number& u, const Number& v) const {
        const Number one(1.0), zero(0.0), tiny(0x1p-500);
        const Number radius(light_.radius);
        const V offset = minus(constant(light_.middle), point);
        V normal = constant(light_.axis[2]);
        Number height = dot(offset, normal);
        const Number side = P::select(height < zero, Number(-1.0), one);
        normal = scaled(side, normal);
        height = side * height;
        const auto is_seen = height > tiny;
        height = P::select(is_seen, height, one);

        // In the disc's plane, from the point below the surface point to the disc's middle.
        const V beside = minus(offset, scaled(height, normal));
        const Number middle = P::sqrt(dot(beside, beside));
        const auto oblique = middle > height * Number(0x1p-40);
        const Number per_middle = one / P::select(oblique, middle, one);
        const V first = constant(light_.axis[0]);
        const V y{P::select(oblique, beside.x * per_middle, first.x),
                  P::select(oblique, beside.y * per_middle, first.y),
                  P::select(oblique, beside.z * per_middle, first.z)};
        const V x = cross(normal, y);

        // The nearest and the farthest point, as unit vectors of y and the normal, and the bisector
        // of both.
        const Number near = middle - radius, far = middle + radius;
        const Number per_near = one / P::sqrt(near * near + height * height);
        const Number per_far = one / P::sqrt(far * far + height * height);
        const Number y_sum = near * per_near + far * per_far;
        const Number z_sum = height * (per_near + per_far);
        const Number y_apart = far * per_far - near * per_near;
        const Number z_apart = height * (per_far - per_near);
        const Number sum_length = P::sqrt(y_sum * y_sum + z_sum * z_sum);
        const Number b = P::sqrt(y_apart * y_apart + z_apart * z_apart) / sum_length;
        const Number axis_y = y_sum / sum_length, axis_z = z_sum / sum_length;
        const Number way = height / axis_z;
        const Number beyond = way * axis_y - middle;
        const Number a = P::sqrt(not_negative(radius * radius - beyond * beyond)) / way;

        const Turn azimuth = turn(v);
        const Number across = a * azimuth.cosine, along = b * azimuth.sine;
        const Number squared = across * across + along * along;
        const Number slant = P::sqrt(one + squared);
        const Number per_slant = one / (slant * (one + slant));
        const Number h = u * (squared * per_slant); // share of the cone's 1 - cos at this azimuth
        const Number cosine = one - h, sine = P::sqrt(not_negative(h * (Number(2.0) - h)));
        const Number per_edge = sine / P::sqrt(P::select(squared > tiny, squared, one));
        const Number x_part = across * per_edge, edge_part = along * per_edge;
        const Number y_part = cosine * axis_y + edge_part * axis_z;
        const Number z_part = cosine * axis_z - edge_part * axis_y;
        const V direction = sum(sum(scaled(x_part, x), scaled(y_part, y)), scaled(z_part, normal));
        return {direction, height / P::select(z_part > tiny, z_part, one),
                P::select(is_seen, Number(2.0) * a * b * per_slant, zero), zero};
    }

    /// Samples evenly by solid angle: Urena, Fajardo and King, "An area-preserving parametrization
    /// for spherical rectangles" (2013). Samples a small and distant rectangle by area.
    LightSample<Number> of_rectangle(const V& point, const Number& u, const Number& v) const {
        const Number one(1.0), zero(0.0);
        const V corner = minus(constant(light_.middle), point);
        const V x_axis = constant(light_.axis[0]), y_axis = constant(light_.axis[1]);
        const V normal = constant(light_.axis[2]);
        const Number width(light_.extent[0]), length(light_.extent[1]);
        const Number x0 = dot(corner, x_axis), y0 = dot(corner, y_axis), z0 = dot(corner, normal);
        const Number x1 = x0 + width, y1 = y0 + length;
        const Number z_squared = z0 * z0;
        const auto is_seen = z_squared > Number(0x1p-1000);
        const Number z = P::select(is_seen, P::sqrt(z_squared), one);

        const auto corner_angle = [&](const Number& x, const Number& y) {
            return Elementary<Number>::atan(x * y / (z * P::sqrt(x * x + y * y + z_squared)));
        };
        const Number a00 = corner_angle(x0, y0), a01 = corner_angle(x0, y1);
        const Number solid_angle =
            not_negative((corner_angle(x1, y1) - a01) - (corner_angle(x1, y0) - a00));
        const Number half_x = x0 + Number(0.5) * width, half_y = y0 + Number(0.5) * length;
        const Number from_middle = half_x * half_x + half_y * half_y + z_squared;
        const auto is_small = (width * width + length * length) < Number(0x1p-20) * from_middle;

        const Number b0 = Number(0.0) - y0 / P::sqrt(z_squared + y0 * y0);
        const Number b1 = y1 / P::sqrt(z_squared + y1 * y1);
        const Number start = Number(0x1.921fb54442d18p+1) + (a01 - a00);
        const Turn angle = Elementary<Number>::sin_cos(start + u * solid_angle);
        const Number slope = (angle.cosine * b0 - b1) / angle.sine;
        const Number squared = slope * slope + b0 * b0;
        const Number c = P::select(slope < zero, Number(-1.0), one) /
                         P::sqrt(P::select(squared > one, squared, one));
        const Number by_angle = c * z / P::sqrt(not_negative(one - c * c) + Number(0x1p-1000));
        const Number x_of_area = x0 + u * width;
        Number x = P::select(is_small, x_of_area, by_angle);
        x = P::select(x > x0, x, x0);
        x = P::select(x < x1, x, x1);
        const Number reach_squared = x * x + z_squared;
        const Number h0 = y0 / P::sqrt(reach_squared + y0 * y0);
        const Number h1 = y1 / P::sqrt(reach_squared + y1 * y1);
        const Number h = h0 + v * (h1 - h0);
        const Number rest = not_negative(one - h * h) + Number(0x1p-1000);
        Number y = P::select(is_small, y0 + v * length, h * P::sqrt(reach_squared / rest));
        y = P::select(y > y0, y, y0);
        y = P::select(y < y1, y, y1);

        const Number distance = P::sqrt(reach_squared + y * y);
        const Number per_distance = one / P::select(distance > zero, distance, one);
        const V way = sum(sum(scaled(x, x_axis), scaled(y, y_axis)), scaled(z0, normal));
        const Number of_area = z * width * length / (from_middle * P::sqrt(from_middle));
        const Number share =
            Number(0x1.45f306dc9c883p-2) * P::select(is_small, of_area, solid_angle);
        return {scaled(per_distance, way), distance, P::select(is_seen, share, zero), zero};
    }

    const SoftLight& light_;
};

} // namespace raylane::core
