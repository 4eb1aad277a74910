#pragma once

#include "tests/oracle/solid.hpp"
#include "tests/scenes/api/ray_arrays.hpp"

#include <optional>
#include <string>
#include <vector>

/// Checks the library's answers for solids that are made of others against the oracle.
namespace raylane::tests {

struct SolidTally {
    long rows = 0, hits = 0, blocked = 0, sides = 0, firsts = 0, asked = 0, surfaces = 0;
    std::string first, example;

    long wrong() const { return rows + hits + blocked + sides + firsts; }
    void blame(long& kind, const std::string& what) {
        if (++kind == 1) first += what + "\n";
    }
};

std::string described(const oracle::Expression& expression);
/// Returns the parts in their order, and the clipping shapes.
std::vector<AnyShapeInDouble> shapes_of(const oracle::Expression& expression);
raylane::Solid solid_of(const oracle::Expression& expression);
/// Returns a scene of the solid alone, or nothing if it has no bounds or a shape is invalid.
std::optional<Scene> scene_of(const oracle::Expression& expression);

/// Checks all answers of the library for rays and for their origins in the scene of a solid.
void ask(const oracle::Expression& expression, const Scene& scene,
         const std::vector<core::Ray<float>>& asked, SolidTally& wrong);

/// Checks that the nearest hits of rays that start on the first surfaces of these, on both sides of
/// them, are the first of all their crossings.
void ask_onward(const Scene& scene, const std::vector<core::Ray<float>>& asked, SolidTally& wrong);

} // namespace raylane::tests
