#include "tests/oracle/root.hpp"

#include <cmath>

namespace raylane::oracle {

int sign_at(const Root& t, const Exact& a, const Exact& b, const Exact& c) {
    const Exact V(t.V);
    return sign({c * (t.U * t.U + V * V * t.D) + b * t.W * t.U + a * t.W * t.W,
                 V * (Exact(2) * c * t.U + b * t.W)},
                t.D);
}

Number value_at(const Root& t, const Exact& a, const Exact& b) {
    return value({a * t.W + b * t.U, b * Exact(t.V)}, t.D) / Number(t.W);
}

int compare_digits(const Number& a, const Number& b) {
    static const Number unclear("1e-80");
    const Number difference = a - b;
    if (abs(difference) <= (abs(a) + abs(b)) * unclear) return 0;
    return difference > 0 ? 1 : -1;
}

int compare(const Root& a, const Number& a_value, const Root& b, const Number& b_value) {
    const int order = compare_digits(a_value, b_value);
    if (order != 0) return order;
    return sign({a.U * b.W - b.U * a.W, Exact(a.V) * b.W}, a.D, Exact(-b.V) * a.W, b.D);
}

int compare(const Root& a, const Root& b) {
    return compare(a, Number(a), b, Number(b));
}

std::vector<FoundRoot> roots(const Exact& A, const Exact& B, const Exact& C) {
    if (A.sign() == 0) {
        if (B.sign() == 0) return {};
        return {{Root::quotient(-C, Exact(2) * B), B.sign() < 0}};
    }
    const Exact D = B * B - A * C;
    if (D.sign() < 0) return {};
    const bool opens_up = A.sign() > 0;
    const Exact U = opens_up ? -B : B, W = opens_up ? A : -A;
    const int V = D.sign() == 0 ? 0 : 1;
    return {{Root{U, W, -V, D}, opens_up}, {Root{U, W, V, D}, !opens_up}};
}

namespace {

template <class Real>
Real nearest(const Root& root, const Number& digits) {
    const Real found = nearest_number<Real>(
        digits, [&](const Exact& sum) { return sign_at(root, Exact(-1) * sum, Exact(2)); });
    return found == Real(0) ? std::numeric_limits<Real>::denorm_min() : found;
}

} // namespace

float rounded(const Root& root, const Number& digits) {
    return nearest<float>(root, digits);
}

float rounded(const Root& root) {
    return rounded(root, Number(root));
}

double rounded_to_double(const Root& root, const Number& digits) {
    return nearest<double>(root, digits);
}

} // namespace raylane::oracle
