#include "core/numbers/exact.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>

using namespace raylane;
using core::Exact;
using ray_sets::Random;

/// Exact numbers: the last stage of the reference's decisions.
namespace {

using Quotient = boost::multiprecision::cpp_rational;
using Number = boost::multiprecision::cpp_bin_float_100;

/// Returns a double of about 2^-spread to 2^spread, with few significant bits or all.
double any(Random& random, int spread) {
    const double mantissa =
        random.integer(0, 2) == 0 ? random.integer(-9, 9) : random.uniform(-1.0, 1.0);
    return std::ldexp(mantissa, random.integer(-spread, spread));
}

/// Evaluates a random chain of operations: the same one for each number type if seeds are equal.
template <class Real, class Operand>
Real chain(Random& random, const Operand& operand) {
    Real value = operand(random);
    for (int step = 0; step < 8; ++step) {
        const Real other = operand(random);
        switch (random.integer(0, 3)) {
        case 0:
            value = value + other;
            break;
        case 1:
            value = value - other;
            break;
        case 2:
            value = value * other;
            break;
        default:
            if (Real(0.0) < other || other < Real(0.0)) value = value / other;
        }
    }
    return value;
}

} // namespace

TEST_CASE("sums and products and quotients of doubles are exact") {
    for (const int spread : {3, 60, 900})
        for (int i = 0; i < 300; ++i) {
            const auto seed = static_cast<std::uint64_t>(1000 * spread + i);
            Random random(seed), again(seed);
            const auto ours =
                chain<Exact>(random, [&](Random& r) { return Exact(any(r, spread)); });
            const auto truth =
                chain<Quotient>(again, [&](Random& r) { return Quotient(any(r, spread)); });
            CAPTURE(spread, i);
            REQUIRE(ours.sign() == truth.sign());
            const auto rounded = static_cast<double>(ours);
            const Number number(truth);
            if (abs(number) < Number(1e-300) || abs(number) > Number(1e300)) {
                CHECK((rounded > 0.0) == (truth > 0));
                continue;
            }
            CHECK(abs(Number(rounded) - number) <= abs(number) * 0x1p-48);
        }
}

TEST_CASE("values that are equal by different formulas compare equal") {
    Random random(7);
    for (int i = 0; i < 300; ++i) {
        const Exact a(any(random, 200)), b(any(random, 200)), c(any(random, 200));
        CHECK((a * (b + c) - (a * b + a * c)).sign() == 0);
        CHECK(((a + b) * (a - b) - (a * a - b * b)).sign() == 0);
        if (c.sign() != 0) CHECK((a / c + b / c - (a + b) / c).sign() == 0);
        const Exact least(std::ldexp(1.0, -1074));
        CHECK((a + least - a).sign() == 1);
        CHECK((a - (a + least)).sign() == -1);
    }
}

TEST_CASE("square roots are exact") {
    Random random(8);
    for (int i = 0; i < 300; ++i) {
        const Exact square(std::abs(any(random, 40)) + 1e-9), a(any(random, 40));
        const Exact root = sqrt(square);
        CHECK((root * root - square).sign() == 0);
        CHECK(((a + root) * (a - root) - (a * a - square)).sign() == 0);
        CHECK(((a + root) / (a - root) * (a - root) - (a + root)).sign() == 0);
        // A rational root is recognised as rational.
        CHECK((sqrt(a * a) - (a.sign() < 0 ? -a : a)).sign() == 0);
        CHECK((sqrt(a * a) + a).sign() == (a.sign() > 0 ? 1 : 0));
    }
    // 665857 / 470832 is above the root of 2, by 1.6e-12.
    const Exact root = sqrt(Exact(2.0)), close = Exact(665857.0) / Exact(470832.0);
    CHECK((root - close).sign() == -1);
    CHECK((close - root).sign() == 1);
    const Number difference = sqrt(Number(2)) - Number(665857) / 470832;
    CHECK(static_cast<double>(root - close) ==
          Approx(difference.convert_to<double>()).epsilon(0x1p-48).margin(0.0));
    CHECK(sqrt(Exact(0.0)).sign() == 0);
}
