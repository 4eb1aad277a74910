#pragma once

#include "simd/kernel/lanes/double_double.hpp"

/// Lanes of core::Bounded: numbers, each with a bound on its distance from the result of real
/// arithmetic. So a formula that is written for any number type carries the proof of its accuracy.
/// The same holds for its comparisons.
namespace raylane::simd {

/// Names `Number`, which is Double<...> or Wide<...>, with bounds on errors.
template <class Number>
struct Certified {};

/// Names numbers with twice the digits of D = Double<...>.
template <class D>
struct Wide {};

/// The result of one operation, with a bound on its roundoff (core::Rounded).
template <class Number>
struct RoundedLanes {
    typename Number::Value value;
    Floats<typename Number::D> error;
};

/// The arithmetic of Certified<Number>.
template <class Number>
struct Digits;

template <class Arch>
struct Digits<Double<Arch>> {
    using D = Double<Arch>;
    using F = Floats<D>;
    using Value = F;
    using Rounded = RoundedLanes<Digits>;
    static F in_double(const Value& value) { return value; }
    static F lost_in_double(const Value&) { return zero<D>(); }

    static Rounded sum(const F& a, const F& b) { return with_roundoff(a + b); }
    static Rounded product(const F& a, const F& b) { return with_roundoff(a * b); }
    static Rounded quotient(const F& a, const F& b) { return with_roundoff(a / b); }
    static Rounded root(const F& a) { return with_roundoff(sqrt(a)); }

  private:
    static Rounded with_roundoff(const F& value) { return {value, F(0x1p-52) * abs(value)}; }
};

template <class Lesser>
struct Digits<Wide<Lesser>> {
    using D = Lesser;
    using F = Floats<D>;
    using M = Mask<D>;
    using Value = DoubleDoubles<D>;
    using Rounded = RoundedLanes<Digits>;
    static F in_double(const Value& value) { return value.high + value.low; }
    /// Returns the error of in_double().
    static F lost_in_double(const Value& value) {
        return abs(Value::two_sum(value.high, value.low).low);
    }

    static Rounded sum(const Value& a, const Value& b) {
        const Value high = Value::two_sum(a.high, b.high), low = Value::two_sum(a.low, b.low);
        const Value cross = Value::two_sum(high.low, low.high);
        const Value upper = Value::two_sum(high.high, cross.high);
        const Value rest = Value::two_sum(upper.low, low.low);
        return {Value::two_sum(upper.high, rest.high), abs(cross.low) + abs(rest.low)};
    }
    static Rounded product(const Value& a, const Value& b) {
        const Value value = a * b;
        return without_roundoff((a.high == zero<D>()) | (b.high == zero<D>()),
                                with_roundoff(value, is_short(a) & is_short(b)));
    }
    static Rounded quotient(const Value& a, const Value& b) {
        const Value value = a / b;
        return without_roundoff(a.high == zero<D>(), with_roundoff(value, divides(value, b, a)));
    }
    static Rounded root(const Value& a) {
        const Value value = sqrt(a);
        return with_roundoff(value, divides(value, value, a));
    }

  private:
    static M is_short(const Value& a) { return a.low == zero<D>(); }
    static M divides(const Value& quotient, const Value& divisor, const Value& dividend) {
        const Value product = Value::two_product(quotient.high, divisor.high);
        return is_short(quotient) & is_short(divisor) & (product.high == dividend.high) &
               (product.low == dividend.low) & (abs(dividend.high) > F(0x1p-900));
    }
    /// Sets the roundoff to 0 in those of the lanes in which the value is 0. The value is exactly 0
    /// there and has not underflowed.
    static Rounded without_roundoff(const M& lanes, const Rounded& rounded) {
        return {rounded.value,
                select(lanes & (rounded.value.high == zero<D>()), zero<D>(), rounded.error)};
    }
    static Rounded with_roundoff(const Value& value, const M& is_exact) {
        const F size = abs(value.high);
        const F error = select(is_exact, zero<D>(), F(0x1p-101) * size);
        return {value, select(size > F(0x1p-900), error, F(__builtin_inf()))};
    }
};

/// The answer to a comparison, and whether it is known (Kleene's logic).
template <class Number>
struct Answers {
    using M = Mask<typename Digits<Number>::D>;
    M answer, known;

    explicit Answers(bool value) : answer(value), known(true) {}
    Answers(const M& answer_, const M& known_) : answer(answer_), known(known_) {}

    M surely() const { return known & answer; }
    M surely_not() const { return known & ~answer; }

    Answers operator~() const { return {~answer, known}; }
    Answers operator&(const Answers& b) const {
        return {answer & b.answer, (known & b.known) | surely_not() | b.surely_not()};
    }
    Answers operator|(const Answers& b) const {
        return {answer | b.answer, (known & b.known) | surely() | b.surely()};
    }
    /// Returns the answer as known in all lanes, for a choice where either answer is correct.
    friend Answers either_way(const Answers& a) { return {a.answer, M(true)}; }
};

template <class Number>
struct BoundedLanes {
    using Its = Digits<Number>;
    using D = typename Its::D;
    using F = Floats<D>;
    using Value = typename Its::Value;
    using A = Answers<Number>;
    using value_type = double;

    Value value;
    F error;

    /// Numbers without an error are exact.
    BoundedLanes() = default;
    explicit BoundedLanes(double exact) : value(F(exact)), error(0.0) {}
    explicit BoundedLanes(const F& exact) : value(exact), error(0.0) {}
    BoundedLanes(const Value& value_, const F& error_) : value(value_), error(error_) {}

    F in_double() const { return Its::in_double(value); }
    F magnitude() const { return abs(in_double()); }

    // Same rules as core::Bounded, which explains why they bound errors.
    BoundedLanes operator+(const BoundedLanes& b) const {
        const auto sum = Its::sum(value, b.value);
        return {sum.value, rounded_up(sum.error + (error + b.error))};
    }
    BoundedLanes operator-(const BoundedLanes& b) const { return *this + negated(b); }
    BoundedLanes operator*(const BoundedLanes& b) const {
        const auto product = Its::product(value, b.value);
        const F propagated = magnitude() * b.error + (b.magnitude() + b.error) * error;
        const M exact = (product.error == zero<D>()) & (error == zero<D>()) &
                        (b.error == zero<D>()) & (Its::in_double(product.value) != zero<D>());
        return unless_zero(is_zero() | b.is_zero(), product.value,
                           select(exact, zero<D>(), product.error + propagated + underflow()));
    }
    BoundedLanes operator/(const BoundedLanes& b) const {
        const auto quotient = Its::quotient(value, b.value);
        const F size = b.magnitude();
        const F propagated = (error + abs(Its::in_double(quotient.value)) * b.error + underflow()) /
                                 (size - b.error) +
                             underflow();
        const M exact = (quotient.error == zero<D>()) & (error == zero<D>()) &
                        (b.error == zero<D>()) & (Its::in_double(quotient.value) != zero<D>());
        const M has_divisor = (b.error <= F(0.5) * size) & (size > zero<D>());
        const F in_all = select(exact, zero<D>(), quotient.error + propagated);
        return unless_zero(is_zero() & has_divisor, quotient.value,
                           select(has_divisor, in_all, unbounded()));
    }
    friend BoundedLanes negated(const BoundedLanes& a) { return {-a.value, a.error}; }
    /// Returns the root of a number that is known not to be negative. Values that rounding makes
    /// negative count as 0.
    friend BoundedLanes sqrt(const BoundedLanes& a) {
        const M positive = a.in_double() > zero<D>();
        const auto root = Its::root(select(positive, a.value, Value(F(1.0))));
        const F most = sqrt(a.error) * F(1.0000001);
        const F far_from_0 = a.error / Its::in_double(root.value);
        const F propagated = select(a.error == zero<D>(), zero<D>(),
                                    select(far_from_0 < most, far_from_0, most) + underflow());
        return {select(positive, root.value, Value(zero<D>())),
                select(positive, rounded_up(root.error + propagated), most)};
    }
    friend BoundedLanes abs(const BoundedLanes& a) {
        return {select(a.in_double() < zero<D>(), -a.value, a.value), a.error};
    }
    /// Selects lane by lane. In a lane where the mask is not known, either operand may be the right
    /// one. The error there is a bound on the distance of the selected operand from both.
    friend BoundedLanes select(const A& mask, const BoundedLanes& a, const BoundedLanes& b) {
        const BoundedLanes difference = a - b;
        const F either = difference.magnitude() + difference.error;
        return {select(mask.answer, a.value, b.value),
                select(mask.known, select(mask.answer, a.error, b.error), either)};
    }

    A operator>(const BoundedLanes& b) const { return b < *this; }
    A operator<(const BoundedLanes& b) const {
        const BoundedLanes difference = *this - b;
        return {difference.in_double() < zero<D>(), difference.has_sign()};
    }
    A operator==(const BoundedLanes& b) const {
        const BoundedLanes difference = *this - b;
        return {difference.in_double() == zero<D>(), difference.has_sign()};
    }
    A operator!=(const BoundedLanes& b) const { return ~(*this == b); }

  private:
    using M = Mask<D>;

    static F unbounded() { return F(__builtin_inf()); }
    static F underflow() { return F(0x1p-1070); }
    static F rounded_up(const F& sum) { return sum * F(1.0 + 0x1p-49); }
    static BoundedLanes unless_zero(const M& is_zero, const Value& value, const F& error) {
        return {select(is_zero, Value(zero<D>()), value),
                select(is_zero, zero<D>(), rounded_up(error))};
    }
    M is_zero() const { return (error == zero<D>()) & (in_double() == zero<D>()); }
    /// True where the sign is known, or the number is certainly 0.
    M has_sign() const {
        const F size = magnitude();
        return (size > error) | ((error == zero<D>()) & (size == size));
    }
};

template <class Number>
struct Registers<Certified<Number>> {
    using Floats = BoundedLanes<Number>;
    using Mask = Answers<Number>;
};

template <class Number>
struct Lanes<Certified<Number>> {
    using F = Floats<Certified<Number>>;
    static F mul_add(const F& a, const F& b, const F& c) { return a * b + c; }
};

} // namespace raylane::simd
