#pragma once

namespace raylane::tests {

/// Rounds two doubles to float and widens the results.
void round_and_widen(const double* from, float* rounded, double* widened);

} // namespace raylane::tests
