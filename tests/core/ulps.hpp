#pragma once

#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

/// Compares functions with results in 256 bits, in ulps.
namespace raylane {

namespace mp = boost::multiprecision;
using Number = mp::number<mp::cpp_bin_float<256, mp::digit_base_2>, mp::et_off>;

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline const int rounds = tests::fixed_rounds(6'000, 1'000, 20'000);

class Random {
  public:
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    double sign() { return engine_() % 2 == 0 ? 1.0 : -1.0; }

  private:
    std::mt19937_64 engine_{1};
};

/// Collects errors in ulps of the exact results.
class Errors {
  public:
    void add(double computed, const Number& exact) {
        if (exact == 0) {
            ulps_.push_back(computed == 0.0 ? 0.0 : infinity);
            return;
        }
        const Number ulp = mp::ldexp(Number(1), mp::ilogb(exact) - 52);
        const Number error = mp::abs((Number(computed) - exact) / ulp);
        ulps_.push_back(static_cast<double>(error));
    }

    void check(const std::string& name, double most, double max_median = 0.3) {
        std::sort(ulps_.begin(), ulps_.end());
        const auto at = [&](double part) {
            return ulps_[static_cast<std::size_t>(part * static_cast<double>(ulps_.size() - 1))];
        };
        const std::string report = name + ": ulps median " + std::to_string(at(0.5)) +
                                   ", 99th percentile " + std::to_string(at(0.99)) + ", largest " +
                                   std::to_string(at(1.0));
        INFO(report);
        CHECK(at(1.0) <= most);
        CHECK(at(0.5) <= max_median);
        if (std::getenv("RAYLANE_TEST_REPORT") != nullptr) WARN(report);
    }

  private:
    std::vector<double> ulps_;
};

} // namespace raylane
