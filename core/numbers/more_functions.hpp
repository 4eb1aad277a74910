#pragma once

/// Functions that readers of scenes are asked for, which few rays depend on: of one double at a
/// time, made of those of elementary.hpp, and so with the same bits on every processor and by every
/// C library. What is not finite, or outside of where a function is defined, gives what <cmath>
/// gives. Errors are the largest that tests have seen, in ulps.
namespace raylane::core {

/// x^y for all numbers. 0.5 ulp where y is a whole number of up to 1024, so that it is exact where
/// a double holds it; else 1.6, and 0 below 2^-1021.
double power(double x, double y);

double tan(double x);             ///< 1.9
double asin(double x);            ///< 2.2
double acos(double x);            ///< 2.1
double atan2(double y, double x); ///< in [-pi, pi]. 1.9
double sinh(double x);            ///< 2.2
double cosh(double x);            ///< 2.2
double tanh(double x);            ///< 2.4
double asinh(double x);           ///< 2.2
double acosh(double x);           ///< 2.6
double atanh(double x);           ///< 2.5

} // namespace raylane::core
