#include "core/numbers/more_functions.hpp"
#include "tests/core/ulps.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <initializer_list>
#include <limits>

using namespace raylane;

namespace {

using Function = double (*)(double);
using Exact = Number (*)(const Number&);

struct Domain {
    double least, most;
    bool logarithmic; ///< log-uniform between these, with both signs
};

double draw(Random& random, const Domain& domain) {
    if (!domain.logarithmic) return random.uniform(domain.least, domain.most);
    return random.sign() * std::exp(random.uniform(std::log(domain.least), std::log(domain.most)));
}

void check(const char* name, Function computed, Exact exact, double max_ulps,
           std::initializer_list<Domain> domains) {
    Random random;
    Errors errors;
    for (const Domain& domain : domains)
        for (int i = 0; i < rounds / 4; ++i) {
            const double x = draw(random, domain);
            errors.add(computed(x), exact(Number(x)));
        }
    errors.check(name, max_ulps, 0.5);
}

constexpr double nan_ = std::numeric_limits<double>::quiet_NaN();

/// Returns whether both numbers are NaN, or equal with the same sign.
bool same(double a, double b) {
    return std::isnan(a) ? std::isnan(b) : a == b && std::signbit(a) == std::signbit(b);
}

} // namespace

TEST_CASE("trigonometric functions of readers are within three ulps") {
    check("tan", core::tan, [](const Number& x) -> Number { return mp::tan(x); }, 3.0,
          {{-1.6, 1.6, false}, {0x1p-600, 1.5, true}, {-30.0, 30.0, false}});
    check("asin", core::asin, [](const Number& x) -> Number { return mp::asin(x); }, 3.0,
          {{-1.0, 1.0, false}, {0x1p-600, 1.0, true}, {0.999, 1.0, false}});
    check("acos", core::acos, [](const Number& x) -> Number { return mp::acos(x); }, 3.0,
          {{-1.0, 1.0, false}, {0x1p-600, 1.0, true}, {0.999, 1.0, false}, {-1.0, -0.999, false}});
}

TEST_CASE("hyperbolic functions of readers and their inverses are within three ulps") {
    check("sinh", core::sinh, [](const Number& x) -> Number { return mp::sinh(x); }, 3.0,
          {{-3.0, 3.0, false}, {0x1p-600, 710.4, true}, {708.0, 710.4, false}});
    check("cosh", core::cosh, [](const Number& x) -> Number { return mp::cosh(x); }, 3.0,
          {{-3.0, 3.0, false}, {0x1p-600, 710.4, true}, {708.0, 710.4, false}});
    check("tanh", core::tanh, [](const Number& x) -> Number { return mp::tanh(x); }, 3.0,
          {{-3.0, 3.0, false}, {0x1p-600, 100.0, true}});
    check("asinh", core::asinh, [](const Number& x) -> Number { return mp::asinh(x); }, 3.0,
          {{-3.0, 3.0, false}, {0x1p-600, 0x1p1000, true}});
    check("acosh", core::acosh, [](const Number& x) -> Number { return mp::acosh(x); }, 3.0,
          {{1.0, 3.0, false}, {1.0, 1e6, false}, {1.0, 1.0001, false}, {1e9, 1e300, false}});
    check("atanh", core::atanh, [](const Number& x) -> Number { return mp::atanh(x); }, 3.0,
          {{-1.0, 1.0, false}, {0x1p-600, 1.0, true}, {0.999, 1.0, false}});
}

TEST_CASE("atan2 is within three ulps in all quadrants") {
    Random random;
    Errors errors;
    for (int i = 0; i < rounds; ++i) {
        const double y = draw(random, {1e-3, 1e3, true}), x = draw(random, {1e-3, 1e3, true});
        errors.add(core::atan2(y, x), mp::atan2(Number(y), Number(x)));
    }
    errors.check("atan2", 3.0, 0.5);
    const double values[] = {0.0, -0.0, 1.0, -1.0, infinity, -infinity, nan_};
    for (const double y : values)
        for (const double x : values) {
            INFO("atan2 of " << y << ", " << x);
            CHECK(same(core::atan2(y, x), std::atan2(y, x)));
        }
}

TEST_CASE("powers of readers are exact where the result is a double") {
    // All integer powers below 2^53 of integers from -60 to 60 are exact. Their inverses are the
    // nearest doubles.
    for (int base = -60; base <= 60; ++base) {
        double exact = 1.0;
        for (int n = 0; std::abs(exact) < 0x1p53; ++n, exact *= base) {
            INFO(base << " to the " << n);
            CHECK(core::power(base, n) == exact);
            if (base != 0) CHECK(core::power(base, -n) == 1.0 / exact);
            if (std::abs(base) < 2 && n > 40) break;
        }
    }
    for (int root = 1; root < 2000; ++root) {
        INFO("square of " << root);
        CHECK(core::power(static_cast<double>(root) * root, 0.5) == root);
        CHECK(core::power(static_cast<double>(root) * root, 1.5) ==
              static_cast<double>(root) * root * root);
    }
    // Results of all sizes. Results near 0 have fewer bits and are rounded twice.
    Random random;
    Errors of_integers, others, negative, first;
    for (int i = 0; i < rounds; ++i) {
        const double n = std::floor(random.uniform(1.0, 60.0)) * random.sign();
        const double x = std::exp(random.uniform(-1021.0, 1023.9) * 0.6931471805599453 / n);
        of_integers.add(core::power(x, n), mp::pow(Number(x), static_cast<int>(n)));
        const double any = std::exp(random.uniform(-744.0, 709.0));
        first.add(core::power(any, 1.0), Number(any));
        const double y = random.uniform(-3.0, 3.0);
        const double z = std::exp(random.uniform(-1020.0, 1023.9) * 0.6931471805599453 / y);
        if (std::isfinite(z) && z > 0.0)
            others.add(core::power(z, y), mp::pow(Number(z), Number(y)));
    }
    first.check("first powers", 0.0);
    for (const double y : {-1023.0, -1022.5, -1000.25, 1000.0})
        CHECK(core::power(0.5, y) == Approx(std::pow(0.5, y)).epsilon(1e-14));
    CHECK(core::power(10.0, 308.0) == 1e308);
    CHECK(core::power(0.1, -308.0) == Approx(1e308).epsilon(1e-13));
    for (int i = 0; i < rounds / 2; ++i) {
        const double base = random.sign() * random.uniform(0.3, 3.0);
        const double n = std::floor(random.uniform(-500.0, 500.0));
        of_integers.add(core::power(base, n), mp::pow(Number(base), static_cast<int>(n)));
        const double x = draw(random, {1e-5, 1e5, true}), y = random.uniform(-20.0, 20.0);
        others.add(core::power(std::abs(x), y), mp::pow(Number(std::abs(x)), Number(y)));
        const double most = std::floor(random.uniform(1100.0, 2000.0));
        negative.add(core::power(-1.25, most), mp::pow(Number(-1.25), static_cast<int>(most)));
    }
    of_integers.check("whole powers", 0.501);
    others.check("powers", 2.0);
    negative.check("large whole powers", 2.0, 0.5);
}

TEST_CASE("functions of readers are right at the ends of their domains") {
    const double values[] = {0.0, -0.0, 0.5, -0.5, 1.0,      -1.0,      2.0, -2.0,
                             3.0, -3.0, 1e6, -1e6, infinity, -infinity, nan_};
    for (const double x : values)
        for (const double y : values) {
            // Compares only special results, which are exact in all libraries.
            const double exact = std::pow(x, y);
            if (std::isfinite(x) && std::isfinite(y) && (exact != 0.0 && std::isfinite(exact)))
                continue;
            INFO(x << " to the " << y);
            CHECK(same(core::power(x, y), exact));
        }
    struct Pair {
        Function ours, usual;
    };
    const Pair pairs[] = {{core::asin, std::asin},   {core::acos, std::acos},
                          {core::sinh, std::sinh},   {core::cosh, std::cosh},
                          {core::tanh, std::tanh},   {core::asinh, std::asinh},
                          {core::acosh, std::acosh}, {core::atanh, std::atanh}};
    for (std::size_t i = 0; i < std::size(pairs); ++i)
        for (const double x : {0.0, -0.0, 1.0, -1.0, 1e300, -1e300, infinity, -infinity, nan_}) {
            const double expected = pairs[i].usual(x), got = pairs[i].ours(x);
            INFO("function " << i << " of " << x << ": " << got << " for " << expected);
            CHECK((same(got, expected) || std::abs(got - expected) <= 1e-15 * std::abs(expected)));
        }
    CHECK(core::tan(0.0) == 0.0);
    for (const double x : {infinity, -infinity, nan_})
        CHECK(std::isnan(core::tan(x)));
}
