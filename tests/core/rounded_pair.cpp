#include "tests/core/rounded_pair.hpp"

void raylane::tests::round_and_widen(const double* from, float* rounded, double* widened) {
    const auto x = static_cast<float>(from[0]), y = static_cast<float>(from[1]);
    rounded[0] = x;
    rounded[1] = y;
    widened[0] = static_cast<double>(x);
    widened[1] = static_cast<double>(y);
}
