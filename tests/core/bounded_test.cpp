#include "core/numbers/bounded.hpp"
#include "tests/support/bounded_truth.hpp"
#include "tests/support/catch.hpp"

using namespace raylane;
using core::Bounded;
using core::DoubleDouble;
using tests::BoundedNumber;
using tests::Operation;

namespace {

Bounded<DoubleDouble> in_core(const BoundedNumber& a, DoubleDouble) {
    return {{a.high, a.low}, a.error};
}
Bounded<double> in_core(const BoundedNumber& a, double) {
    return {a.high, a.error};
}
BoundedNumber of(const Bounded<DoubleDouble>& a) {
    return {a.value.high, a.value.low, a.error};
}
BoundedNumber of(const Bounded<double>& a) {
    return {a.value, 0.0, a.error};
}

template <class T>
Bounded<T> result_of(Operation operation, const Bounded<T>& a, const Bounded<T>& b) {
    switch (operation) {
    case Operation::sum:
        return a + b;
    case Operation::product:
        return a * b;
    case Operation::quotient:
        return a / b;
    case Operation::root:
        break;
    }
    return sqrt(a);
}

} // namespace

TEMPLATE_TEST_CASE("the bounds of a result hold for all operands within their bounds", "", double,
                   DoubleDouble) {
    ray_sets::Random random(1);
    int wrong = 0, without = 0;
    for (int i = 0; i < 20000; ++i) {
        constexpr bool wide = std::is_same_v<TestType, DoubleDouble>;
        BoundedNumber a = tests::any_bounded(random, wide);
        const BoundedNumber b = tests::any_bounded(random, wide);
        for (const Operation operation : tests::all_operations) {
            if (operation == Operation::root) a = tests::with_root(a);
            const BoundedNumber result =
                of(result_of(operation, in_core(a, TestType{}), in_core(b, TestType{})));
            for (int k = 0; k < 4; ++k)
                wrong += tests::bounds_hold(operation, a.end(k % 2 == 0), b.end(k / 2 == 0), result)
                             ? 0
                             : 1;
            const bool may_have_none =
                operation == Operation::quotient && !(b.error < 0.25 * std::abs(b.high));
            without += !may_have_none && !(result.error < HUGE_VAL) ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
    CHECK(without == 0);
}

TEST_CASE("a number that may be 0 has bounded products and quotients") {
    const Bounded<DoubleDouble> zero({0.0, 0.0}, 1e-30), two(2.0);
    CHECK((zero * two).error < 1e-29);
    CHECK((two * zero).error < 1e-29);
    CHECK((zero / two).error < 1e-29);
    // A product that underflows has no bound.
    const Bounded<DoubleDouble> tiny({1e-200, 0.0}, 0.0);
    CHECK_FALSE((tiny * tiny).error < 1e300);
}
