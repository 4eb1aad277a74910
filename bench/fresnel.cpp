#include "core/optics/optics.hpp"

#include <cmath>
#include <cstdio>

/// Prints tables for fresnel.sh, computed by the renderer's functions: reflectance by angle for
/// some indices, and Schlick's largest error by index.
namespace {

using namespace raylane::core;

struct Shares {
    double schlick, dielectric;
};

Shares shares_at(double degrees, double n1, double n2) {
    const double angle = degrees * (3.14159265358979323846 / 180.0);
    const Vec3d incident{std::sin(angle), 0.0, -std::cos(angle)};
    const Refraction<double> at = refract(incident, Vec3d(0, 0, 1), n1, n2);
    Material material;
    material.reflection = Reflection::schlick;
    const double by_schlick = reflectance(material, at, n1, n2);
    material.reflection = Reflection::dielectric;
    return {by_schlick, reflectance(material, at, n1, n2)};
}

void print_angles(double n1, double n2) {
    std::printf("# from index %g to %g: degrees, Fresnel, Schlick\n", n1, n2);
    for (int step = 0; step <= 1800; ++step) {
        const double degrees = step / 20.0;
        const Shares shares = shares_at(degrees, n1, n2);
        std::printf("%g %.9g %.9g\n", degrees, shares.dielectric, shares.schlick);
    }
    std::printf("\n\n");
}

void print_largest_errors() {
    std::printf("# index, Schlick's largest error entering and leaving, and at which degrees\n");
    for (int step = 1; step <= 300; ++step) {
        const double index = 1.0 + step / 100.0;
        double error[2] = {}, at[2] = {};
        for (int side = 0; side < 2; ++side)
            for (int i = 0; i < 9000; ++i) {
                const double degrees = i / 100.0;
                const Shares shares =
                    side == 0 ? shares_at(degrees, 1.0, index) : shares_at(degrees, index, 1.0);
                const double difference = std::abs(shares.schlick - shares.dielectric);
                if (difference > error[side]) error[side] = difference, at[side] = degrees;
            }
        std::printf("%g %.5f %.5f %.2f %.2f\n", index, error[0], error[1], at[0], at[1]);
    }
}

} // namespace

int main() {
    for (const double index : {1.1, 1.5, 2.4, 4.0}) {
        print_angles(1.0, index);
        print_angles(index, 1.0);
    }
    print_largest_errors();
}
