#pragma once

#include "simd/kernel/double_double.hpp"

/// Lanes of core::Bounded: numbers and how far they may be from what real arithmetic would have
/// given. A formula that is written for any numbers thereby carries the proof of its own accuracy,
/// and so do the questions that it asks.
namespace raylane::simd {

/// Stands for `Number`, which is Double<...> or Wide<...>, but with bounds on errors.
template <class Number>
struct Certified {};

/// Stands for D = Double<...>, but with twice its digits.
template <class D>
struct Wide {};

/// What Certified<Number> computes in. `roundoff`: core::unit_roundoff.
template <class Number>
struct Digits;
template <class Arch>
struct Digits<Double<Arch>> {
    using D = Double<Arch>;
    using Value = Floats<D>;
    static constexpr double roundoff = 0x1p-52;
    static Floats<D> in_double(const Value& value) { return value; }
};
template <class Lesser>
struct Digits<Wide<Lesser>> {
    using D = Lesser;
    using Value = DoubleDoubles<D>;
    static constexpr double roundoff = 0x1p-101;
    static Floats<D> in_double(const Value& value) { return value.high; }
};

/// The answer to a question, and whether it is known (Kleene's logic).
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
    /// Where either answer will do.
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

    /// Exact.
    BoundedLanes() = default;
    explicit BoundedLanes(double exact) : value(F(exact)), error(0.0) {}
    explicit BoundedLanes(const F& exact) : value(exact), error(0.0) {}
    BoundedLanes(const Value& value_, const F& error_) : value(value_), error(error_) {}

    F in_double() const { return Its::in_double(value); }
    F magnitude() const { return abs(in_double()); }

    BoundedLanes operator+(const BoundedLanes& b) const {
        return rounded(value + b.value, error + b.error);
    }
    BoundedLanes operator-(const BoundedLanes& b) const {
        return rounded(value - b.value, error + b.error);
    }
    BoundedLanes operator*(const BoundedLanes& b) const {
        return rounded(value * b.value, magnitude() * b.error + (b.magnitude() + b.error) * error);
    }
    BoundedLanes operator/(const BoundedLanes& b) const {
        const Value quotient = value / b.value;
        const F least = b.magnitude() - b.error; // of the true divisor
        const F propagated = (error + abs(Its::in_double(quotient)) * b.error) / least;
        return rounded(quotient, select(least > zero<D>(), propagated, unbounded()));
    }
    friend BoundedLanes negated(const BoundedLanes& a) { return {-a.value, a.error}; }
    /// Of numbers that are known not to be negative; what rounding makes negative counts as 0.
    friend BoundedLanes sqrt(const BoundedLanes& a) {
        const M positive = a.in_double() > zero<D>();
        const Value root = sqrt(select(positive, a.value, Value(F(1.0))));
        const F in_all = sqrt(a.error) * F(1.0000001);
        const F far_from_0 = a.error / Its::in_double(root);
        const BoundedLanes result = rounded(root, select(far_from_0 < in_all, far_from_0, in_all));
        return {select(positive, root, Value(zero<D>())), select(positive, result.error, in_all)};
    }
    friend BoundedLanes abs(const BoundedLanes& a) {
        return {select(a.in_double() < zero<D>(), -a.value, a.value), a.error};
    }
    /// Where the answer is not known: one of both, and so within their difference of either.
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
    static BoundedLanes rounded(const Value& value, const F& propagated) {
        return {value, propagated + F(Its::roundoff) * abs(Its::in_double(value))};
    }
    /// Or is 0 for sure.
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
