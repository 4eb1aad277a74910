#include "bench/method_rays.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::bench {

namespace {

/// Returns the distance of t, rounded to float, from the truth, in ulps of float.
double ulps(double t, double truth) {
    const auto exponent = std::max(std::ilogb(truth), -126);
    return std::abs(static_cast<double>(static_cast<float>(t)) - truth) /
           std::ldexp(1.0, exponent - 23);
}

} // namespace

void report_errors(benchmark::State& state, const std::vector<Crossed>& truths,
                   const std::vector<Crossed>& found) {
    std::size_t wrong = 0;
    std::vector<double> errors;
    for (std::size_t i = 0; i < truths.size(); ++i) {
        const bool hit = truths[i].slot != simd::no_slot;
        const bool same =
            found[i].slot == truths[i].slot && (!hit || found[i].entering == truths[i].entering);
        if (!same)
            ++wrong;
        else if (hit)
            errors.push_back(ulps(found[i].t, truths[i].t));
    }
    std::sort(errors.begin(), errors.end());
    const auto at = [&](double share) {
        return errors.empty() ? 0.0
                              : errors[static_cast<std::size_t>(
                                    share * static_cast<double>(errors.size() - 1))];
    };
    state.counters["wrong"] = static_cast<double>(wrong) / static_cast<double>(truths.size());
    state.counters["ulps_median"] = at(0.5);
    state.counters["ulps_p99"] = at(0.99);
    state.counters["ulps_max"] = at(1.0);
}

} // namespace raylane::bench
