#include "core/numbers/elementary.hpp"
#include "simd/isa/by_isa.hpp"
#include "simd/isa/isa.hpp"
#include "tests/simd/kernel/lanes/elementary_check.hpp"
#include "tests/support/catch.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace raylane;
using namespace raylane::simd;

namespace {

/// Returns numbers of both signs: a third of all sizes, a third below 2 in size, a third of whole
/// quarter turns.
std::vector<double> numbers(int count, unsigned seed) {
    std::mt19937_64 engine(seed);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1p-53);
    };
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> numbers = {
        0.0,       -0.0,  1.0,    -1.0,   infinity, -infinity, 0x1p-53,     0x1p-900, 0x1p-1022,
        0x1p-1074, 1e308, -1e308, -707.7, -707.71,  709.7,     0x1.62e4p+9, 0x1p20,   -0x1.0001p20};
    while (static_cast<int>(numbers.size()) < count) {
        const double sign = engine() % 2 == 0 ? 1.0 : -1.0;
        switch (numbers.size() % 3) {
        case 0:
            numbers.push_back(sign *
                              std::ldexp(uniform(1.0, 2.0), static_cast<int>(uniform(-60, 60))));
            break;
        case 1:
            numbers.push_back(sign * uniform(0.0, 2.0));
            break;
        default:
            numbers.push_back(1.5707963267948966 * std::floor(uniform(-1e7, 1e7)));
        }
    }
    return numbers;
}

int differing(const std::vector<double>& vector, const std::vector<double>& x,
              const std::vector<double>& y, double (*scalar)(double, double)) {
    int count = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double expected = scalar(x[i], y[i]);
        const bool same =
            std::isnan(expected) // for infinite arguments
                ? std::isnan(vector[i])
                : std::bit_cast<std::uint64_t>(vector[i]) == std::bit_cast<std::uint64_t>(expected);
        count += same ? 0 : 1;
    }
    return count;
}

void check(void (*fill)(const ElementaryArrays&)) {
    constexpr int count = 60000;
    const std::vector<double> x = numbers(count, 1);
    std::vector<double> y = numbers(count, 2);
    for (std::size_t i = 0; i < 36; ++i) // pairs of special numbers
        y[i] = y[(i * 7) % 18];
    std::vector<double> exp(count), expm1(count), pow(count), sin(count), cos(count), atan(count);
    fill({x.data(), y.data(), exp.data(), expm1.data(), pow.data(), sin.data(), cos.data(),
          atan.data(), count});
    CHECK(differing(exp, x, y, [](double a, double) { return core::exp(a); }) == 0);
    CHECK(differing(expm1, x, y, [](double a, double) { return core::expm1(a); }) == 0);
    CHECK(differing(pow, x, y,
                    [](double a, double b) { return core::pow(std::abs(a), std::abs(b)); }) == 0);
    CHECK(differing(sin, x, y, [](double a, double) { return core::sin(a); }) == 0);
    CHECK(differing(cos, x, y, [](double a, double) { return core::cos(a); }) == 0);
    CHECK(differing(atan, x, y, [](double a, double) { return core::atan(a); }) == 0);
}

} // namespace

TEST_CASE("elementary functions have the same bits in every lane as the scalar functions") {
    for (const Isa isa : available_isas()) {
        CAPTURE(name_of(isa));
        check(of_isa(isa, []<Isa which>() { return &elementary<which>; }));
    }
}
