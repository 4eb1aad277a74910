#include "core/numbers/primitives.hpp"
#include "core/numbers/sample_sequence.hpp"
#include "core/numbers/vector.hpp"
#include "core/optics/soft_light.hpp"
#include "core/scene/surroundings.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"

#include <cmath>
#include <numbers>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;
using ray_sets::rounded;

namespace {

constexpr double pi = std::numbers::pi;

Directed<double> directed(const Vec3d& v) {
    return {v.x, v.y, v.z};
}
Vec3d vector(const Directed<double>& v) {
    return {v.x, v.y, v.z};
}

Light sphere_light(const Vec3f& middle, float radius) {
    return {.kind = LightKind::sphere, .position = middle, .radius = radius};
}
Light disc_light(const Vec3f& middle, const Vec3f& normal, float radius) {
    Light light = sphere_light(middle, radius);
    light.kind = LightKind::disc;
    light.direction = normal;
    return light;
}
Light rectangle_light(const Vec3f& corner, const Vec3f& u, const Vec3f& v) {
    return {.kind = LightKind::rectangle, .position = corner, .edge_u = u, .edge_v = v};
}

/// A surface's irradiance in units of pi times the light's radiance, and the light's solid angle in
/// units of pi.
struct Shown {
    double by_cosine = 0.0, solid_angle = 0.0;
};

template <class Check>
Shown shown(const Light& light, const Vec3d& point, const Vec3d& normal, const Check& check,
            std::uint32_t count = 1U << 14) {
    const SoftLight soft = prepared(light);
    const SoftLightSampler<double> sampler(soft);
    Shown sum;
    for (std::uint32_t i = 0; i < count; ++i) {
        const SamplePoint at = sequence_point(7, i);
        const LightSample<double> sample =
            sampler.sample(directed(point), directed(normal), static_cast<double>(at.x),
                           static_cast<double>(at.y));
        check(sample);
        const double cosine = dot(vector(sample.direction), normal);
        sum.by_cosine += sample.share * std::max(cosine, 0.0) / count;
        sum.solid_angle += sample.share / count;
    }
    return sum;
}
Shown shown(const Light& light, const Vec3d& point, const Vec3d& normal) {
    return shown(light, point, normal, [](const LightSample<double>&) {});
}

/// Integrates by the midpoint rule over small cells.
double solid_angle_of_disc(const Vec3d& middle, const Vec3d& normal, double radius,
                           const Vec3d& point) {
    const Vec3d x =
        normalized(cross(normal, std::abs(normal.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0)));
    const Vec3d y = cross(normal, x);
    constexpr int rings = 400, spokes = 800;
    double sum = 0.0;
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < spokes; ++k) {
            const double r = radius * (i + 0.5) / rings, angle = 2.0 * pi * (k + 0.5) / spokes;
            const Vec3d way = middle + r * std::cos(angle) * x + r * std::sin(angle) * y - point;
            const double distance = length(way);
            sum += r * (radius / rings) * (2.0 * pi / spokes) * std::abs(dot(way, normal)) /
                   (distance * distance * distance);
        }
    return sum;
}

double solid_angle_of_rectangle(double x0, double x1, double y0, double y1, double z) {
    const auto corner = [&](double x, double y) {
        return std::atan(x * y / (z * std::sqrt(x * x + y * y + z * z)));
    };
    return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

} // namespace

TEST_CASE("samples of a sphere light are spread evenly over its visible solid angle") {
    Random random(1);
    for (int round = 0; round < 40; ++round) {
        const double radius = random.log_uniform(0.01, 10.0);
        const Vec3f middle = rounded(random.cube(10.0));
        const Light light = sphere_light(middle, static_cast<float>(radius));
        const Vec3d point = random.cube(10.0);
        const Vec3d offset = convert<double>(middle) - point;
        const double d = length(offset), r = static_cast<double>(light.radius);
        const Vec3d normal = offset / d;
        const Shown shown_light =
            shown(light, point, normal, [&](const LightSample<double>& sample) {
                const Vec3d direction = vector(sample.direction);
                CHECK(std::abs(length(direction) - 1.0) < 1e-14);
                const double at = length(sample.distance * direction - offset);
                CHECK(std::abs(at - r) < 1e-6 * r + 1e-12 * d * d / r);
                CHECK(sample.distance > 0.0);
            });
        if (d > r) {
            CHECK(shown_light.by_cosine == Approx(r * r / (d * d)).epsilon(1e-4));
            CHECK(shown_light.solid_angle ==
                  Approx(2.0 * (1.0 - std::sqrt(1.0 - r * r / (d * d)))).epsilon(1e-6));
        } else {
            CHECK(shown_light.by_cosine ==
                  Approx(1.0).epsilon(1e-3)); // the light covers the hemisphere
            CHECK(shown_light.solid_angle == Approx(4.0).epsilon(1e-12));
        }
        if (d < 2.0 * r) continue;
        const Vec3d aslant = normalized(normal + 0.5 * random.direction());
        const Shown slanted = shown(light, point, aslant);
        CHECK(slanted.by_cosine == Approx(dot(aslant, normal) * r * r / (d * d)).epsilon(1e-3));
    }
    // From the middle of the light.
    const Shown from_middle = shown(sphere_light({1, 2, 3}, 2.0F), {1, 2, 3}, {0, 1, 0});
    CHECK(from_middle.by_cosine == Approx(1.0).epsilon(1e-3));
}

TEST_CASE("samples of a disc light lie on it and add up to its solid angle") {
    Random random(2);
    for (int round = 0; round < 40; ++round) {
        const Vec3f middle = rounded(random.cube(3.0)), axis = rounded(random.cube(2.0));
        const auto radius = static_cast<float>(random.log_uniform(0.01, 5.0));
        const Light light = disc_light(middle, axis, radius);
        const Vec3d normal = normalized(convert<double>(axis)), m = convert<double>(middle);
        const Vec3d point = random.cube(5.0);
        const double height = std::abs(dot(m - point, normal)), r = static_cast<double>(radius);
        if (height < 0.05 * r) continue;
        double least = 1e300, most = 0.0;
        const Shown shown_light =
            shown(light, point, normal, [&](const LightSample<double>& sample) {
                const Vec3d hit = point + sample.distance * vector(sample.direction) - m;
                const double scale = length(m - point);
                CHECK(std::abs(dot(hit, normal)) < 1e-12 * scale);
                CHECK(length(hit) < r * (1.0 + 1e-9) + 1e-12 * scale);
                least = std::min(least, sample.share);
                most = std::max(most, sample.share);
            });
        const double expected = solid_angle_of_disc(m, normal, r, point) / pi;
        CHECK(shown_light.solid_angle == Approx(expected).epsilon(2e-4));
        CHECK(most < 2.0 * (1.0 + r / height) * least); // weights are nearly equal
    }
    // Closed forms for a point straight below the middle.
    const Shown above = shown(disc_light({0, 3, 0}, {0, -1, 0}, 2.0F), {0, 0, 0}, {0, 1, 0});
    CHECK(above.by_cosine == Approx(4.0 / 13.0).epsilon(1e-4));
    CHECK(above.solid_angle == Approx(2.0 * (1.0 - 3.0 / std::sqrt(13.0))).epsilon(1e-6));
    // A point in the disc's plane does not see it. A point beside it, close to the plane, hardly
    // does.
    CHECK(shown(disc_light({0, 0, 0}, {0, 1, 0}, 2.0F), {5, 0, 0}, {0, 1, 0}).solid_angle == 0.0);
    CHECK(shown(disc_light({0, 0, 0}, {0, 1, 0}, 2.0F), {1, 0, 0}, {0, 1, 0}).solid_angle == 0.0);
    const Shown beside = shown(disc_light({0, 0, 0}, {0, 1, 0}, 2.0F), {5, 1e-9, 0}, {0, 1, 0});
    CHECK((beside.solid_angle >= 0.0 && beside.solid_angle < 1e-8));
    const Shown under = shown(disc_light({0, 0, 0}, {0, 1, 0}, 2.0F), {1, -1e-9, 0}, {0, 1, 0});
    CHECK(under.by_cosine == Approx(1.0).epsilon(1e-2));
}

TEST_CASE("samples of a rectangle light are spread evenly over its solid angle") {
    Random random(3);
    for (int round = 0; round < 60; ++round) {
        const auto width = static_cast<float>(random.log_uniform(0.01, 5.0));
        const auto length_v = static_cast<float>(random.log_uniform(0.01, 5.0));
        const Vec3f corner = rounded(random.cube(4.0));
        const Light light = rectangle_light(corner, {width, 0, 0}, {0, 0, length_v});
        const Vec3d point = random.cube(5.0), offset = convert<double>(corner) - point;
        const double w = static_cast<double>(width), l = static_cast<double>(length_v);
        const Shown shown_light =
            shown(light, point, {0, 1, 0}, [&](const LightSample<double>& sample) {
                const Vec3d hit = sample.distance * vector(sample.direction) - offset;
                const double off = 1e-9 * (w + l) + 1e-13 * length(offset);
                CHECK(std::abs(hit.y) < off);
                CHECK((hit.x > -off && hit.x < w + off && hit.z > -off && hit.z < l + off));
                CHECK(std::abs(length(vector(sample.direction)) - 1.0) < 1e-14);
            });
        const double expected = solid_angle_of_rectangle(offset.x, offset.x + w, offset.z,
                                                         offset.z + l, std::abs(offset.y)) /
                                pi;
        CHECK(shown_light.solid_angle == Approx(expected).epsilon(1e-5));
    }
    // The form factor of a rectangle with a corner straight above (Siegel and Howell).
    const double a = 3.0 / 2.0, b = 1.0 / 2.0;
    const double factor = (a / std::sqrt(1 + a * a) * std::atan(b / std::sqrt(1 + a * a)) +
                           b / std::sqrt(1 + b * b) * std::atan(a / std::sqrt(1 + b * b))) /
                          (2.0 * pi);
    const Light corner = rectangle_light({0, 2, 0}, {3, 0, 0}, {0, 0, 1});
    CHECK(shown(corner, {0, 0, 0}, {0, 1, 0}).by_cosine == Approx(factor).epsilon(1e-5));
    // Points in its plane, beside it or on it, do not see it.
    CHECK(shown(corner, {-1, 2, 0}, {0, 1, 0}).solid_angle == 0.0);
    CHECK(shown(corner, {1, 2, 0.5}, {0, 1, 0}).solid_angle == 0.0);
    // From far away, it acts as a point light.
    const Shown far = shown(corner, {0, -1e6, 0}, {0, 1, 0});
    CHECK(far.by_cosine == Approx(3.0 / (pi * 1e12)).epsilon(1e-5));
}

TEST_CASE("a rounding error in the 0 of a normal does not move samples") {
    Light sky, ball;
    sky.kind = LightKind::sky;
    sky.direction = {0, 1, 0};
    ball.kind = LightKind::sphere;
    ball.position = {0, 0, 0};
    ball.radius = 1.0F;
    const SoftLight of_sky = prepared(sky), of_ball = prepared(ball);
    Random random(5);
    for (int round = 0; round < 1000; ++round) {
        const double angle = random.uniform(0.0, 6.0), u = random.uniform(0.0, 1.0),
                     v = random.uniform(0.0, 1.0);
        const int axis = round % 3;
        const auto around = [&](double little) {
            Vec3d normal;
            normal[axis] = little;
            normal[(axis + 1) % 3] = std::cos(angle);
            normal[(axis + 2) % 3] = std::sin(angle);
            return normal;
        };
        for (const double little : {1e-17, -1e-17, -1e-30}) {
            const auto sample_at = [&](double z) {
                return vector(SoftLightSampler<double>(of_sky)
                                  .sample({}, directed(around(z)), u, v)
                                  .direction);
            };
            const auto toward_ball = [&](double z) {
                return vector(SoftLightSampler<double>(of_ball)
                                  .sample(directed(3.0 * around(z)), directed({0, 1, 0}), u, v)
                                  .direction);
            };
            CHECK(length(sample_at(little) - sample_at(0.0)) < 1e-14);
            CHECK(length(toward_ball(little) - toward_ball(0.0)) < 1e-14);
        }
    }
}

TEST_CASE("samples of the sky follow the cosine and show its colours") {
    const Light light{.kind = LightKind::sky, .direction = {0, -3, 0}, .reach = 5.0F};
    const SoftLight soft = prepared(light);
    const SoftLightSampler<double> sampler(soft);
    Random random(4);
    for (int round = 0; round < 20; ++round) {
        const Vec3d normal = round == 0 ? Vec3d(0, 0, -1) : random.direction();
        constexpr std::uint32_t count = 1U << 12;
        double cosine = 0.0, height = 0.0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const SamplePoint at = sequence_point(9, i);
            const LightSample<double> sample = sampler.sample(
                {}, directed(normal), static_cast<double>(at.x), static_cast<double>(at.y));
            CHECK(std::abs(length(vector(sample.direction)) - 1.0) < 1e-14);
            CHECK(dot(vector(sample.direction), normal) >= 0.0);
            CHECK(sample.distance == 5.0);
            cosine += dot(vector(sample.direction), normal) / count;
            height += sample.height / count;
        }
        CHECK(cosine == Approx(2.0 / 3.0).epsilon(1e-3));
        // The mean height is 1/2, plus 1/2 of 2/3 of the normal's height.
        CHECK(height == Approx(0.5 + normal.y / 3.0).margin(1e-3));
    }
}
