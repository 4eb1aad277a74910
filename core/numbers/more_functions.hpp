#pragma once

/// Functions that readers of scenes are asked for, which few rays depend on: of one double at a
/// time, made of those of elementary.hpp, and so with the same bits on every processor and by every
/// C library. They are within 3 ulps. What is not finite, or outside of where a function is
/// defined, gives what <cmath> gives.
namespace raylane::core {

double tan(double x);
double asin(double x);
double acos(double x);
double atan2(double y, double x); ///< in [-pi, pi]
double sinh(double x);
double cosh(double x);
double tanh(double x);
double asinh(double x);
double acosh(double x);
double atanh(double x);

/// x^y for all numbers. 0.5 ulp where y is a whole number of up to 1024, so that it is exact where
/// a double holds it; else 1.7, and 0 below 2^-1021.
double power(double x, double y);

} // namespace raylane::core
