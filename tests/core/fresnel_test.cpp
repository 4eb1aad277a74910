#include "core/optics/optics.hpp"
#include "tests/support/catch.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>
#include <limits>

using namespace raylane::core;

/// Schlick's approximation against Fresnel's equations, and both at the critical angle.
namespace {

using Number = boost::multiprecision::cpp_bin_float_100;

/// Returns the refraction of a ray that meets the plane z = 0 at an angle of this sine.
template <class Real>
Refraction<Real> refract_at(Real sine, Real n1, Real n2) {
    const Vec3<Real> incident{sine, Real(0), -std::sqrt(Real(1) - sine * sine)};
    return refract(incident, Vec3<Real>{0, 0, 1}, n1, n2);
}

Material of(Reflection reflection) {
    Material material;
    material.transmission = 1.0F;
    material.reflection = reflection;
    return material;
}

template <class Real>
Real reflectance_at(Reflection reflection, Real sine, Real n1, Real n2) {
    return reflectance(of(reflection), refract_at(sine, n1, n2), n1, n2);
}

struct Largest {
    double error = 0.0;   ///< Schlick's reflectance minus Fresnel's, where they differ most
    double degrees = 0.0; ///< incident angle there
};

Largest largest_error(double n1, double n2) {
    Largest largest;
    constexpr int steps = 20'000;
    for (int i = 0; i <= steps; ++i) {
        const double cos = static_cast<double>(i) / steps;
        const Vec3d incident{std::sqrt(1.0 - cos * cos), 0.0, -cos};
        const auto at = refract(incident, Vec3d(0, 0, 1), n1, n2);
        if (at.total) continue;
        const double error = schlick(at.cos_incident, at.cos_transmitted, n1, n2) -
                             dielectric(at.cos_incident, at.cos_transmitted, n1, n2);
        if (std::abs(error) > std::abs(largest.error))
            largest = {error, std::acos(cos) * (180.0 / 3.14159265358979323846)};
    }
    return largest;
}

} // namespace

TEST_CASE("the largest errors of Schlick's approximation are those of the table") {
    // Schlick differs most, and is always too bright, at grazing angles in the thinner medium. The
    // error is smallest near the index of flint glass.
    struct Row {
        double index, error, entering_degrees, leaving_degrees;
    };
    for (const Row& row : {Row{1.05, 0.3175, 83.9, 71.3}, Row{1.10, 0.2105, 83.1, 64.5},
                           Row{1.20, 0.1130, 83.0, 55.8}, Row{1.33, 0.0599, 83.8, 48.4},
                           Row{1.50, 0.0357, 85.0, 41.6}, Row{1.70, 0.0320, 85.5, 35.9},
                           Row{2.00, 0.0444, 85.2, 29.9}, Row{2.40, 0.0740, 84.5, 24.5},
                           Row{3.00, 0.1250, 84.1, 19.4}, Row{4.00, 0.2009, 84.0, 14.4}}) {
        CAPTURE(row.index);
        const Largest entering = largest_error(1.0, row.index);
        const Largest leaving = largest_error(row.index, 1.0);
        CHECK(entering.error == Approx(row.error).margin(6e-5));
        CHECK(leaving.error == Approx(row.error).margin(6e-5));
        CHECK(entering.degrees == Approx(row.entering_degrees).margin(0.06));
        CHECK(leaving.degrees == Approx(row.leaving_degrees).margin(0.06));
    }
}

TEST_CASE("Schlick's approximation by the incident cosine is far off for leaving rays") {
    // Both source reports use this formula: at glass's critical angle, it gives 4 % instead of
    // 100 %.
    const double n = 1.5, cos_critical = std::sqrt(1.0 - 1.0 / (n * n));
    CHECK(schlick(cos_critical, 0.0, n, 1.0) == 1.0);
    CHECK(dielectric(cos_critical, 0.0, n, 1.0) == 1.0);
    const double mistaken = schlick(cos_critical, 0.0, 1.0, n);
    CHECK(mistaken == Approx(0.0408).epsilon(0.01));
}

TEMPLATE_TEST_CASE("refraction is right from ulps below the critical angle to ulps above", "",
                   float, double) {
    using Real = TestType;
    const Real ulp = std::numeric_limits<Real>::epsilon();
    int wrong = 0, totals = 0;
    for (int step = 1; step <= 300; ++step) {
        const Real n = Real(1) + Real(step) / Real(100);
        const Number exactly_critical = 1 / Number(n);
        const auto critical = exactly_critical.template convert_to<Real>();
        Real sine = critical;
        for (int down = 0; down < 20; ++down)
            sine = std::nextafter(sine, Real(0));
        bool was_total = false;
        Real last[2] = {};
        for (int i = -20; i <= 20; ++i, sine = std::nextafter(sine, Real(1))) {
            const Refraction<Real> at = refract_at<Real>(sine, n, 1);
            CAPTURE(n, i);
            if (was_total && !at.total) FAIL("total, and a little further not");
            was_total = at.total;
            totals += at.total ? 1 : 0;
            // The quotient and the product are rounded: two ulps.
            if (std::abs(i) > 2) wrong += at.total != (Number(sine) > exactly_critical) ? 1 : 0;
            if (!(at.cos_transmitted >= Real(0) && at.cos_transmitted <= std::sqrt(48 * ulp)))
                FAIL("the transmitted ray is not in the surface");
            if (!at.total && !(std::abs(length(at.transmitted) - Real(1)) <= 4 * ulp))
                FAIL("not a direction");
            int kind = 0;
            for (const Reflection reflection : {Reflection::schlick, Reflection::dielectric}) {
                const Real share = reflectance(of(reflection), at, n, Real(1));
                if (!(share >= last[kind] && share <= Real(1))) FAIL("not continuous");
                // 1 - R is at most `slope` times the transmitted cosine.
                const Real slope = std::max(Real(5), Real(2) * (n + Real(1) / n) / at.cos_incident);
                if (!(share >= Real(1) - slope * std::sqrt(48 * ulp))) FAIL("a step");
                if (at.total && share != Real(1)) FAIL("not total");
                if (share + (Real(1) - share) != Real(1)) FAIL("not all there is");
                last[kind++] = share;
            }
        }
        if (!was_total) FAIL("never total");
    }
    CHECK(wrong == 0);
    CHECK(totals > 300 * 15);
}

TEMPLATE_TEST_CASE("R + T = 1 to the bit for all indices and sides and angles", "", float, double) {
    using Real = TestType;
    int not_shares = 0;
    for (const Reflection reflection : {Reflection::schlick, Reflection::dielectric})
        for (int step = 0; step <= 60; ++step)
            for (const bool leaving : {false, true})
                for (int i = 0; i <= 500; ++i) {
                    const Real n = Real(1) + Real(step) / Real(20), sine = Real(i) / Real(500);
                    const Real n1 = leaving ? n : Real(1), n2 = leaving ? Real(1) : n;
                    const Real R = reflectance_at(reflection, sine, n1, n2);
                    const Real T = Real(1) - R;
                    const bool shares = R >= Real(0) && T >= Real(0) && R + T == Real(1);
                    not_shares += shares ? 0 : 1;
                }
    CHECK(not_shares == 0);
}

TEMPLATE_TEST_CASE("reflection is total from just beyond the critical angle", "", float, double) {
    using Real = TestType;
    // From index 2 to 1 the critical sine is 1/2, exactly.
    const Real critical(0.5);
    const auto at = refract_at<Real>(critical, 2, 1);
    CHECK_FALSE(at.total);
    CHECK(at.cos_transmitted == Real(0));
    CHECK(at.transmitted == Vec3<Real>(1, 0, 0));
    CHECK(refract_at<Real>(std::nextafter(critical, Real(1)), 2, 1).total);
    const auto before = refract_at<Real>(std::nextafter(critical, Real(0)), 2, 1);
    CHECK_FALSE(before.total);
    CHECK(before.cos_transmitted > Real(0));

    for (const Reflection reflection : {Reflection::schlick, Reflection::dielectric}) {
        CHECK(reflectance_at<Real>(reflection, critical, 2, 1) == Real(1));
        CHECK(reflectance_at<Real>(reflection, Real(0.75), 2, 1) == Real(1));
        CHECK(reflectance_at<Real>(reflection, std::nextafter(critical, Real(0)), 2, 1) < Real(1));
    }
}

TEST_CASE("reflectance is right at normal incidence and at Brewster's angle") {
    CHECK(reflectance_at(Reflection::schlick, 0.0, 1.0, 1.5) == Approx(0.04));
    CHECK(reflectance_at(Reflection::dielectric, 0.0, 1.0, 1.5) == Approx(0.04));
    CHECK(reflectance_at(Reflection::dielectric, 0.5, 1.5, 1.5) == 0.0);
    // At tan = n, none of one polarisation is reflected, and ((1 - n^2) / (1 + n^2))^2 of the
    // other.
    const double n = 1.5, sine = n / std::sqrt(1.0 + n * n);
    const double perpendicular = (1.0 - n * n) / (1.0 + n * n);
    CHECK(reflectance_at(Reflection::dielectric, sine, 1.0, n) ==
          Approx(perpendicular * perpendicular / 2.0));
}

TEST_CASE("both sides of a surface reflect alike along one path") {
    // Schlick's cosine is that of the larger angle, so that this holds for it as well.
    for (const Reflection reflection : {Reflection::schlick, Reflection::dielectric})
        for (int i = 0; i < 100; ++i) {
            const double outside = i / 100.0;
            CHECK(reflectance_at(reflection, outside / 1.5, 1.5, 1.0) ==
                  Approx(reflectance_at(reflection, outside, 1.0, 1.5)).epsilon(1e-9));
        }
}

TEST_CASE("nothing is reflected between equal indices") {
    for (const Reflection reflection : {Reflection::schlick, Reflection::dielectric})
        for (const double sine : {0.0, 0.5, 0.999999, 1.0})
            CHECK(reflectance_at(reflection, sine, 1.5, 1.5) == 0.0);
    // Rounding makes the sine just larger than 1. Only a ray into the thinner medium is reflected
    // totally.
    const Vec3d grazing{1.0 + 1e-15, 0.0, 0.0};
    CHECK_FALSE(refract(grazing, {0, 0, 1}, 1.5, 1.5).total);
    CHECK_FALSE(refract(grazing, {0, 0, 1}, 1.0, 1.0).total);
    CHECK(refract(grazing, {0, 0, 1}, 1.5, 1.0).total);
}
