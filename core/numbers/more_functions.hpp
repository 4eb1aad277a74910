#pragma once

/// Functions that readers of scenes need and few rays depend on. They take one double at a time and
/// build on those of elementary.hpp, so they have the same bits on every processor and with every C
/// library. They are within 3 ulps. For arguments that are not finite or outside of a function's
/// domain, they return the same as <cmath>.
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

/// x^y for all numbers. 0.5 ulp if y is an integer up to 1024, so the result is exact if a double
/// can hold it. Otherwise 1.7 ulps, and 0 below 2^-1021.
double power(double x, double y);

} // namespace raylane::core
