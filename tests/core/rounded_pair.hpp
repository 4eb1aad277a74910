#pragma once

namespace raylane::tests {

/// Two doubles, rounded to float, and these widened.
void round_and_widen(const double* from, float* rounded, double* widened);

} // namespace raylane::tests
