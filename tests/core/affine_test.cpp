#include "core/numbers/affine.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"
#include "tests/support/rounds.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

using namespace raylane;
using core::Affine;
using ray_sets::Random;

namespace {

/// The oracle's number type, for the value at one point of the square.
using Wide = boost::multiprecision::cpp_bin_float_100;

struct Both {
    Affine form;
    Wide at[5]; // at (a, b) of `places`
};

constexpr double places[5][2] = {{0, 0}, {1, 1}, {-1, 1}, {0.3, -1}, {-0.7, 0.9}};

Both leaf(Random& random) {
    const double size = random.log_uniform(1e-3, 1e3), width = random.log_uniform(1e-6, 1.0);
    Both both;
    both.form = {random.uniform(-size, size), random.uniform(-width, width),
                 random.uniform(-width, width)};
    for (int i = 0; i < 5; ++i)
        both.at[i] = Wide(both.form.value) + Wide(both.form.across) * places[i][0] +
                     Wide(both.form.upward) * places[i][1];
    return both;
}

bool holds(const Both& both) {
    const Affine& f = both.form;
    if (!(f.error < std::numeric_limits<double>::infinity())) return true;
    for (int i = 0; i < 5; ++i) {
        const Wide linear =
            Wide(f.value) + Wide(f.across) * places[i][0] + Wide(f.upward) * places[i][1];
        if (abs(both.at[i] - linear) > Wide(f.error)) return false;
    }
    return true;
}

template <class Of>
Both combined(const Both& x, const Both& y, const Of& object) {
    Both result{object(x.form, y.form), {}};
    for (int i = 0; i < 5; ++i)
        result.at[i] = object(x.at[i], y.at[i]);
    return result;
}

Both tree(Random& random, int depth) {
    if (depth == 0) return leaf(random);
    const Both x = tree(random, depth - 1), y = tree(random, depth - 1);
    using std::sqrt;
    switch (random.integer(0, 4)) {
    case 0:
        return combined(x, y, [](const auto& a, const auto& b) { return a + b; });
    case 1:
        return combined(x, y, [](const auto& a, const auto& b) { return a - b; });
    case 2:
        return combined(x, y, [](const auto& a, const auto& b) { return a * b; });
    case 3:
        return combined(x, y, [](const auto& a, const auto& b) { return a / b; });
    default:
        return combined(x, y, [](const auto& a, const auto& b) {
            using T = std::decay_t<decltype(a)>;
            return T(sqrt(T(a * a + b * b + T(1e-3))));
        });
    }
}

} // namespace

TEST_CASE("an affine form encloses the exact values of its expression") {
    Random random(tests::seed(11));
    int wrong = 0, finite = 0;
    const int count = tests::rounds(4000, 200);
    for (int i = 0; i < count; ++i) {
        const Both both = tree(random, random.integer(1, 4));
        wrong += holds(both) ? 0 : 1;
        finite += both.form.error < 1e300 ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(finite > count / 2);
}

TEST_CASE("the error of an affine form is of second order in its width") {
    const auto error = [](double width) {
        const Affine x(2.0, width, 0.0), y(3.0, 0.0, width);
        return (sqrt(x * y) / (x + y)).error;
    };
    CHECK(error(1e-3) < 1e-5);
    CHECK(error(1e-3) / error(1e-4) > 80.0);
}

TEST_CASE("an affine form that may be 0 has no bounded reciprocal and has a root from 0") {
    const Affine x(0.5, 1.0, 0.0);
    CHECK(reciprocal(x).error == std::numeric_limits<double>::infinity());
    const Affine root = sqrt(x);
    CHECK(root.lower() <= 0.0);
    CHECK(root.upper() >= std::sqrt(1.5));
    CHECK_FALSE(x < Affine(1.0));
    CHECK(x < Affine(1.75));
}
