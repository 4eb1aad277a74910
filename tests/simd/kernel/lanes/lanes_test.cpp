#include "simd/isa/by_isa.hpp"
#include "simd/isa/isa.hpp"
#include "tests/simd/kernel/lanes/bounded_lanes.hpp"
#include "tests/simd/kernel/lanes/lanes_check.hpp"
#include "tests/simd/kernel/lanes/queue_check.hpp"
#include "tests/support/bounded_truth.hpp"
#include "tests/support/catch.hpp"

#include <cmath>

using namespace raylane::simd;
using raylane::ray_sets::Random;
using raylane::tests::BoundedNumber;
using raylane::tests::Operation;

namespace {

struct BoundedCounts {
    int wrong = 0, without = 0;
};

BoundedCounts bounds_of(BoundedOperation operate) {
    BoundedCounts counts;
    Random random(1);
    for (int i = 0; i < 4000; ++i)
        for (const Operation operation : raylane::tests::all_operations) {
            BoundedNumber a[8], b[8];
            BoundedColumns from[2], result{};
            for (int lane = 0; lane < 8; ++lane) {
                a[lane] = raylane::tests::any_bounded(random, true);
                if (operation == Operation::root) a[lane] = raylane::tests::with_root(a[lane]);
                b[lane] = raylane::tests::any_bounded(random, true);
                for (int k = 0; k < 2; ++k) {
                    const BoundedNumber& number = k == 0 ? a[lane] : b[lane];
                    from[k].high[lane] = number.high;
                    from[k].low[lane] = number.low;
                    from[k].error[lane] = number.error;
                }
            }
            const int lanes = operate(static_cast<int>(operation), from[0], from[1], result);
            for (int lane = 0; lane < lanes; ++lane) {
                const BoundedNumber found{result.high[lane], result.low[lane], result.error[lane]};
                for (int k = 0; k < 4; ++k)
                    counts.wrong += raylane::tests::bounds_hold(operation, a[lane].end(k % 2 == 0),
                                                                b[lane].end(k / 2 == 0), found)
                                        ? 0
                                        : 1;
                const bool may_have_none = operation == Operation::quotient &&
                                           !(b[lane].error < 0.25 * std::abs(b[lane].high));
                counts.without += !may_have_none && !(found.error < HUGE_VAL) ? 1 : 0;
            }
        }
    return counts;
}

} // namespace

TEST_CASE("bounds in lanes hold for all operands within their bounds") {
    for (const Isa isa : available_isas()) {
        CAPTURE(name_of(isa));
        const BoundedCounts counts = bounds_of(
            of_isa(isa, []<Isa which>() { return BoundedOperation(bounded_operation<which>); }));
        CHECK(counts.wrong == 0);
        CHECK(counts.without == 0);
    }
}

TEST_CASE("lanes give the same results as loops over numbers") {
    for (const Isa isa : available_isas()) {
        CAPTURE(name_of(isa));
        CHECK(of_isa(isa, []<Isa which>() { return lanes_failures<which>(); }) == 0);
    }
}

TEST_CASE("a queue has room for all nodes that a ray may enter and loses none of them") {
    for (const Isa isa : available_isas()) {
        CAPTURE(name_of(isa));
        CHECK(of_isa(isa, []<Isa which>() { return queue_failures<which>(); }) == 0);
    }
}
