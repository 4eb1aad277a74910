#include "core/numbers/elementary.hpp"
#include "tests/core/ulps.hpp"
#include "tests/support/catch.hpp"

#include <boost/math/constants/constants.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace raylane;

namespace {

/// Holds the digits of pi that the reduction of the largest doubles needs.
using LongNumber = mp::number<mp::cpp_bin_float<1400, mp::digit_base_2>, mp::et_off>;

struct SineCosine {
    Number sine, cosine;
};

SineCosine exact_sin_cos(double x) {
    const LongNumber half_pi = boost::math::constants::half_pi<LongNumber>();
    const LongNumber quadrants = mp::floor(LongNumber(x) / half_pi + 0.5);
    const Number rest(LongNumber(LongNumber(x) - quadrants * half_pi));
    const Number s = mp::sin(rest), c = mp::cos(rest);
    const LongNumber turns = mp::floor(quadrants / 4);
    switch (static_cast<int>(LongNumber(quadrants - 4 * turns))) {
    case 0:
        return {s, c};
    case 1:
        return {c, -s};
    case 2:
        return {-s, -c};
    default:
        return {-c, s};
    }
}

void check_sin_cos(const std::string& name, const std::vector<double>& xs) {
    Errors sines, cosines;
    for (const double x : xs) {
        const SineCosine exact = exact_sin_cos(x);
        sines.add(core::sin(x), exact.sine);
        cosines.add(core::cos(x), exact.cosine);
    }
    sines.check("sin " + name, 0.85);
    cosines.check("cos " + name, 0.85);
}

} // namespace

TEST_CASE("exp is within an ulp") {
    Random random;
    Errors small, large;
    for (int i = 0; i < rounds; ++i) {
        const double x = random.uniform(-3.0, 0.0), y = random.uniform(-707.7, 709.7);
        small.add(core::exp(x), mp::exp(Number(x)));
        large.add(core::exp(y), mp::exp(Number(y)));
        // In the middle between two multiples of log 2, the reduction's power of two changes.
        const double edge = (std::floor(random.uniform(-1020, 1023)) + 0.5) * 0.69314718055994531;
        large.add(core::exp(edge), mp::exp(Number(edge)));
    }
    small.check("exp", 1.0);
    large.check("exp, all sizes", 1.0);
}

TEST_CASE("expm1 is within two ulps for arguments of any size") {
    Random random;
    Errors fog, small, positive;
    for (int i = 0; i < rounds; ++i) {
        const double x = random.uniform(-3.0, 0.0), y = random.uniform(0.0, 3.0);
        const double tiny = random.sign() * std::exp(random.uniform(-700.0, 0.0));
        fog.add(core::expm1(x), mp::expm1(Number(x)));
        small.add(core::expm1(tiny), mp::expm1(Number(tiny)));
        positive.add(core::expm1(y), mp::expm1(Number(y)));
    }
    fog.check("expm1", 1.0);
    small.check("expm1 near 0", 1.0);
    positive.check("expm1 above 0", 2.0);
}

TEST_CASE("pow is within two ulps") {
    Random random;
    Errors usual, near_one, deep;
    for (int i = 0; i < rounds; ++i) {
        // Powers down to 2^-30, 2^-126 and 2^-1020.
        const auto add = [&](Errors& errors, double x, double least) {
            const double y = random.uniform(0.0, least) / std::log2(x);
            errors.add(core::pow(x, y), mp::pow(Number(x), Number(y)));
        };
        add(usual, random.uniform(0.0, 1.0), -30.0);
        add(near_one, 1.0 - std::exp(random.uniform(-36.0, -0.1)), -126.0);
        add(deep, random.uniform(0.0, 1.0), -1020.0);
        add(deep, random.uniform(0.68, 0.73), -1020.0); // where the logarithm's reduction changes
    }
    usual.check("pow", 1.5);
    near_one.check("pow near 1", 1.5);
    deep.check("pow, least results", 2.0);
}

TEST_CASE("sin and cos are within an ulp for all angles") {
    Random random;
    std::vector<double> small, moderate, quarters, huge;
    for (int i = 0; i < rounds / 4; ++i) {
        small.push_back(random.uniform(-10.0, 10.0));
        moderate.push_back(random.uniform(-0x1p20, 0x1p20));
        quarters.push_back(std::floor(random.uniform(-600000.0, 600000.0)) * 1.5707963267948966);
        quarters.push_back(std::floor(random.uniform(-100.0, 100.0)) * 1.5707963267948966);
        huge.push_back(random.sign() * std::ldexp(random.uniform(1.0, 2.0),
                                                  static_cast<int>(random.uniform(20, 1024))));
        huge.push_back(std::floor(random.uniform(-1e12, 1e12)) * 1.5707963267948966);
    }
    // The double nearest to a multiple of pi/2 (Muller, "Elementary Functions", 11.3).
    huge.push_back(std::ldexp(6381956970095103.0, 797));
    huge.push_back(std::numeric_limits<double>::max());
    huge.push_back(std::nextafter(0x1p20, infinity));
    check_sin_cos("small", small);
    check_sin_cos("moderate", moderate);
    check_sin_cos("near quarter turns", quarters);
    check_sin_cos("huge", huge);
}

TEST_CASE("atan is within two ulps") {
    Random random;
    Errors steep, usual, tiny;
    const auto add = [](Errors& errors, double x) {
        errors.add(core::atan(x), mp::atan(Number(x)));
    };
    for (int i = 0; i < rounds / 4; ++i) {
        for (int k = 0; k < 4; ++k)
            add(usual, random.uniform(-3.0, 3.0));
        add(steep, random.sign() * std::exp(random.uniform(0.0, 700.0)));
        add(tiny, random.sign() * std::exp(random.uniform(-700.0, 0.0)));
        // Arguments at which the formula changes.
        add(usual, 0.41421356237309503 + random.uniform(-1e-12, 1e-12));
        add(usual, 2.4142135623730949 + random.uniform(-1e-12, 1e-12));
    }
    usual.check("atan", 2.0);
    steep.check("atan, steep", 1.0);
    tiny.check("atan, tiny", 1.5);
}

TEST_CASE("logarithms are within an ulp") {
    Random random;
    Errors usual, near_one, of_ten;
    for (int i = 0; i < rounds / 4; ++i) {
        for (const double x : {random.uniform(0.0, 3.0), std::exp(random.uniform(-740.0, 709.0)),
                               std::sqrt(0.5) + random.uniform(-1e-9, 1e-9)}) {
            usual.add(core::log(x), mp::log(Number(x)));
            of_ten.add(core::log10(x), mp::log10(Number(x)));
        }
        const double near = 1.0 + random.sign() * std::exp(random.uniform(-36.0, -1.0));
        near_one.add(core::log(near), mp::log(Number(near)));
        near_one.add(core::log10(near), mp::log10(Number(near)));
    }
    usual.check("log", 0.75);
    of_ten.check("log10", 0.75);
    near_one.check("log near 1", 0.75);
    // Powers of ten that are exact doubles.
    double power = 1.0;
    for (int n = 0; n <= 22; ++n, power *= 10.0)
        CHECK(core::log10(power) == n);
    for (int n = -1074; n < 1024; n += 7)
        CHECK(core::log(std::ldexp(1.0, n)) == static_cast<double>(n * mp::log(Number(2))));
}

TEST_CASE("elementary functions are right at the ends of their domains") {
    CHECK(core::log(0.0) == -infinity);
    CHECK(core::log(-0.0) == -infinity);
    CHECK(core::log(infinity) == infinity);
    CHECK(core::log(1.0) == 0.0);
    CHECK(std::isnan(core::log(-0x1p-1074)));
    CHECK(std::isnan(core::log10(-infinity)));
    CHECK(std::isnan(core::log10(std::numeric_limits<double>::quiet_NaN())));
    CHECK(core::exp(0.0) == 1.0);
    CHECK(core::exp(-0.0) == 1.0);
    CHECK(core::exp(-infinity) == 0.0);
    CHECK(core::exp(-800.0) == 0.0);
    CHECK(core::exp(-1e308) == 0.0);
    CHECK(core::exp(710.0) == infinity);
    CHECK(core::expm1(0.0) == 0.0);
    CHECK(core::expm1(-infinity) == -1.0);
    CHECK(core::expm1(-1e308) == -1.0);
    CHECK(core::expm1(1e308) == infinity);
    CHECK(core::expm1(0x1p-1000) == 0x1p-1000);
    CHECK(core::pow(0.0, 0.0) == 1.0);
    CHECK(core::pow(0.0, 1e-300) == 0.0);
    CHECK(core::pow(0.0, 1e300) == 0.0);
    CHECK(core::pow(0.5, 0.0) == 1.0);
    CHECK(core::pow(1.0, 1e308) == 1.0);
    CHECK(core::pow(0.5, 3.0) == 0.125);
    CHECK(core::pow(1.0 - 0x1p-53, 1e308) == 0.0);
    CHECK(core::pow(1.0 + 0x1p-52, 1e308) == infinity);
    CHECK(core::pow(0x1p-1074, 0.5) == 0x1p-537);
    CHECK(core::sin(0.0) == 0.0);
    CHECK(core::atan(0.0) == 0.0);
    CHECK(std::signbit(core::atan(-0.0)));
    CHECK(core::atan(infinity) == 1.5707963267948966);
    CHECK(core::atan(-infinity) == -1.5707963267948966);
    CHECK(core::atan(1.0) == 0.78539816339744828);
    CHECK(core::atan(0x1p-1074) == 0x1p-1074);
    CHECK(core::cos(0.0) == 1.0);
    CHECK(core::pow(0.25F, 1.5F) == 0.125F);
    CHECK(core::exp(-1.0F) == static_cast<float>(core::exp(-1.0)));
}
