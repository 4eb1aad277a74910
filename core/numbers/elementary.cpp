#include "core/numbers/elementary.hpp"

#include "core/numbers/primitives.hpp"

namespace raylane::core {

double exp(double x) {
    return Elementary<double>::exp(x);
}
float exp(float x) {
    return static_cast<float>(exp(static_cast<double>(x)));
}

double expm1(double x) {
    return Elementary<double>::expm1(x);
}
float expm1(float x) {
    return static_cast<float>(expm1(static_cast<double>(x)));
}

double pow(double x, double y) {
    return Elementary<double>::pow(x, y);
}
float pow(float x, float y) {
    return static_cast<float>(pow(static_cast<double>(x), static_cast<double>(y)));
}

double sin(double x) {
    return Elementary<double>::sin(x);
}
float sin(float x) {
    return static_cast<float>(sin(static_cast<double>(x)));
}

double cos(double x) {
    return Elementary<double>::cos(x);
}
float cos(float x) {
    return static_cast<float>(cos(static_cast<double>(x)));
}

double atan(double x) {
    return Elementary<double>::atan(x);
}
float atan(float x) {
    return static_cast<float>(atan(static_cast<double>(x)));
}

double log(double x) {
    return Elementary<double>::log(x);
}
double log10(double x) {
    return Elementary<double>::log10(x);
}

} // namespace raylane::core
