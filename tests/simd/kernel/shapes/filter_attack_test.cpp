#include "tests/oracle/first_hit.hpp"
#include "tests/simd/kernel/shapes/filter_trial.hpp"
#include "tests/simd/kernel/shapes/mutations.hpp"
#include "tests/simd/kernel/shapes/scaled_filters.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <algorithm>
#include <cstdlib>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using namespace raylane::filter_trial;
using namespace raylane::mutations;

/// Searches for rays that break the filters' bounds. Each ray needs a part of the filter's
/// allowance for rounding: with less, the filter's answer would be wrong. The search climbs to
/// where that part is largest.

namespace {

int rounds() {
    return tests::rounds(200, 20, 500);
}

ScaledFilters scaled_filters_of(Isa isa) {
    return of_isa(isa, []<Isa which>() { return scaled_filters<which>(); });
}

/// Tests one shape and one ray with the filters.
template <class Shape>
class Trial {
  public:
    Trial(const ScaledFilters& filters, const Attempt<Shape>& attempt)
        : filters_(filters), truth_(first_crossing(attempt.shape, attempt.ray)) {
        block_.set(0, attempt.shape, 0);
        stream_.add(Doubled(attempt.ray));
        view_ = stream_.view();
    }

    /// Returns whether the filter is wrong if it allows for this part of the rounding.
    bool is_lie(double part) {
        *filters_.half_ulp = static_cast<float>(part * 0x1p-24);
        filters_.checks.bound_rays(kind_of<Shape>, view_of(block_), 0, view_);
        return lie(stream_.answer(0), truth_) != nullptr;
    }

    /// Returns the part that the ray needs, which must be more than `least`; 1 if even the whole
    /// does not suffice.
    double part_needed(double least) {
        double most = 1.0;
        if (is_lie(most)) return most;
        while (most - least > 1e-4) {
            const double middle = 0.5 * (least + most);
            (is_lie(middle) ? least : most) = middle;
        }
        return least;
    }

  private:
    const ScaledFilters& filters_;
    First truth_;
    Block<Shape> block_;
    Stream stream_;
    FilterStream view_{};
};

/// Normalises a ray's direction. One time in four, its length then differs from 1 by 2^-40.
/// Without `slack`, rounds the origin to float.
void tidy(Ray<double>& ray, bool slack, Random& random) {
    if (!slack) ray.origin = in_double(ray_sets::rounded(ray.origin));
    ray.direction = normalized(ray.direction);
    if (random.integer(0, 3) == 0)
        ray.direction *= 1.0 + 0x1p-40 * (random.integer(0, 1) == 0 ? -1.0 : 1.0);
}

template <class Shape>
struct Summit {
    double part = 0.0;
    Attempt<Shape> attempt{};
};

template <class Shape>
Summit<Shape> climb(const ScaledFilters& filters, bool slack, int steps, Random& random) {
    const bool lattice = random.integer(0, 3) == 0;
    Summit<Shape> summit;
    summit.attempt.shape = make_shape<Shape>(random, lattice);
    summit.attempt.ray = attack(summit.attempt.shape, lattice, random);
    for (int step = 0; step < steps && summit.part < 1.0; ++step) {
        Attempt<Shape> next = mutated(summit.attempt, random);
        if (summit.part == 0.0 && step % 8 == 0) next.ray = attack(next.shape, lattice, random);
        tidy(next.ray, slack, random);
        if (!is_valid(next.shape)) continue;
        Trial<Shape> trial(filters, next);
        // Accepts a slightly smaller part, to leave local maxima.
        if (!trial.is_lie((random.integer(0, 7) == 0 ? 0.98 : 1.001) * summit.part)) continue;
        summit = {trial.part_needed(0.98 * summit.part), next};
    }
    return summit;
}

/// Returns whether the oracle agrees with the solver. Double-double does not suffice for all
/// floats.
template <class Shape>
bool is_confirmed(const Attempt<Shape>& attempt) {
    const First truth = first_crossing(attempt.shape, attempt.ray);
    const auto hit = oracle::first_hit(attempt.shape, attempt.ray);
    if (!truth.exists() || !hit) return truth.exists() == hit.has_value();
    return abs(hit->t - truth.t) <= truth.error + 0x1p-52 * truth.t;
}

template <class Shape>
Summit<Shape> highest(bool slack, int climbs, std::uint64_t seed) {
    std::vector<ScaledFilters> filters;
    for (const Isa isa : available_isas())
        filters.push_back(scaled_filters_of(isa));
    Random random(seed);
    Summit<Shape> highest;
    for (int i = 0; i < climbs; ++i) {
        const Summit<Shape> summit = climb<Shape>(
            filters[static_cast<std::size_t>(i) % filters.size()], slack, 1200, random);
        if (summit.part > highest.part && is_confirmed(summit.attempt)) highest = summit;
    }
    return highest;
}

} // namespace

TEMPLATE_TEST_CASE("no search finds a ray that breaks the filters' bounds", "",
                   RAYLANE_ALL_SHAPES) {
    const int climbs = std::max(1, rounds() / 2);
    const auto without = highest<TestType>(false, climbs, 29);
    const auto with = highest<TestType>(true, climbs, 31);
    INFO(description(without.attempt.shape, without.attempt.ray));
    INFO(description(with.attempt.shape, with.attempt.ray));
    CHECK(without.part < 1.0);
    CHECK(with.part < 1.0);
    if (std::getenv("RAYLANE_TEST_REPORT") != nullptr)
        WARN(name_of(kind_of<TestType>) << ": share of the rounding bound that the worst ray uses: "
                                        << without.part << ", with slack: " << with.part);
}
