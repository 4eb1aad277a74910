#pragma once

#include "tests/oracle/normals.hpp"

/// What is true of a ray and a shape, for the floats and doubles given: decided in numbers that are
/// never rounded (rationals, and roots of quadratics over them), so that a tie is a tie. Digits
/// alone cannot tell one.
