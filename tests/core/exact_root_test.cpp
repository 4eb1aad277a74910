#include "core/numbers/exact_root.hpp"
#include "tests/oracle/first_hit.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"

#include <cmath>

using namespace raylane;
using core::Dyadic;
using core::ExactQuadratic;
using core::ExactRoot;
using ray_sets::Random;

/// Compares roots with the oracle's, which orders roots by squaring, not by resultants.
namespace {

struct Both {
    ExactRoot ours;
    oracle::Root truth;
};

struct Coefficients {
    double A, B, C;

    /// Returns our roots and the oracle's in ascending order; none if the polynomial is constant.
    std::vector<Both> roots() const {
        std::vector<Both> both;
        for (const oracle::FoundRoot& root : oracle::roots(A, B, C))
            both.push_back({ExactRoot({A, B, C}, !root.falling), root.t});
        return both;
    }
};

double whole(Random& random, int most) {
    return random.integer(-most, most);
}

/// Returns small integers, so that many polynomials share a root or have a double root, or random
/// doubles of all sizes.
Coefficients any(Random& random) {
    switch (random.integer(0, 3)) {
    case 0: { // (p t - q) (r t - s)
        const double p = whole(random, 2), q = whole(random, 4), r = whole(random, 2),
                     s = whole(random, 4);
        return {2 * p * r, -(p * s + q * r), 2 * q * s};
    }
    case 1:
        return {whole(random, 3), whole(random, 3), whole(random, 3)};
    case 2:
        return {0.0, whole(random, 3), whole(random, 3)};
    default:
        return {std::ldexp(random.uniform(-1, 1), random.integer(-90, 90)),
                std::ldexp(random.uniform(-1, 1), random.integer(-90, 90)),
                std::ldexp(random.uniform(-1, 1), random.integer(-90, 90))};
    }
}

} // namespace

TEST_CASE("roots have the order of real arithmetic") {
    Random random(20261123);
    int orders[3] = {};
    for (int i = 0; i < 30'000; ++i) {
        const Coefficients F = any(random);
        // `G` is often a multiple of `F`, or has nearly the same roots.
        Coefficients G = any(random);
        if (random.integer(0, 3) == 0) G = {-3 * F.A, -3 * F.B, -3 * F.C};
        if (random.integer(0, 3) == 0) G = {F.A, F.B, F.C * (1.0 + 0x1p-52)};
        for (const Both& a : F.roots())
            for (const Both& b : G.roots()) {
                const int truth = oracle::compare(a.truth, b.truth);
                ++orders[truth + 1];
                CAPTURE(F.A, F.B, F.C, G.A, G.B, G.C);
                REQUIRE(compare(a.ours, b.ours) == truth);
                REQUIRE(a.ours.sign_of({G.A, G.B, G.C}) ==
                        oracle::sign_at(a.truth, G.C, oracle::Exact(2) * G.B, G.A));
            }
    }
    for (const int count : orders)
        CHECK(count > 5'000);
}

TEST_CASE("a root has the right sign and nearest float and digits") {
    Random random(20261124);
    int middles = 0;
    for (int i = 0; i < 10'000; ++i) {
        Coefficients F = any(random);
        const float low = static_cast<float>(random.log_uniform(1e-40, 1e38));
        const float high = std::nextafter(low, HUGE_VALF);
        if (random.integer(0, 3) == 0) // half way between two floats
            F = {0.0, 0.5, -0.5 * (static_cast<double>(low) + static_cast<double>(high))};
        for (const Both& root : F.roots()) {
            const oracle::Number t(root.truth);
            REQUIRE(root.ours.sign() == t.sign());
            if (t <= 0 || t > oracle::Number("1e38")) continue;
            middles += F.A == 0.0 && F.B == 0.5 ? 1 : 0;
            const auto near = static_cast<float>(t);
            const float below = std::nextafter(near, 0.0F), above = std::nextafter(near, HUGE_VALF);
            const float rounded = oracle::rounded(root.truth);
            if (below > 0.0F) CHECK(root.ours.rounded_between(below, above, 0) == rounded);
            const auto approximate = static_cast<double>(t);
            if (approximate < 1e-250) continue;
            const auto wide = root.ours.in_wide(approximate, 1e-9 * approximate);
            const oracle::Number digits =
                oracle::Number(wide.value.high) + oracle::Number(wide.value.low);
            CHECK(abs(digits - t) <= oracle::Number(wide.error));
            CHECK(wide.error <= 0x1p-99 * approximate);
        }
    }
    CHECK(middles > 1000);
}
