#include "scenes/formats/nff/orientation.hpp"
#include "tests/support/catch.hpp"

#include <random>

using namespace raylane;
using scenes::PlanePoint;

TEST_CASE("orientation is never wrong") {
    // Points near 1 on a lattice of 2^-23, where the rounded determinant is noise.
    std::mt19937 random(3);
    std::uniform_int_distribution<int> small(-3, 3);
    int wrong = 0;
    for (int i = 0; i < 100000; ++i) {
        std::array<std::array<int, 2>, 3> p;
        std::array<PlanePoint, 3> q;
        for (int k = 0; k < 3; ++k) {
            p[k] = {small(random), small(random)};
            q[k] = {1.0 + p[k][0] * 0x1p-23, 1.0 + p[k][1] * 0x1p-23};
        }
        const int turn_of =
            (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        if (scenes::orientation(q[0], q[1], q[2]) != (turn_of > 0) - (turn_of < 0)) ++wrong;
    }
    CHECK(wrong == 0);
    // Differences that are not doubles.
    const double tiny = 0x1p-140;
    CHECK(scenes::orientation({-0x1p100, 0}, {0x1p100, 0}, {0, tiny}) == 1);
    CHECK(scenes::orientation({1, 1}, {0x1p100, 0x1p100}, {tiny, tiny}) == 0);
    CHECK(scenes::orientation({1, 1}, {0x1p100, 0x1p100}, {tiny, 0}) == -1);
    CHECK(scenes::orientation({1, 1}, {0x1p100, 0x1p100}, {0, tiny}) == 1);
}
