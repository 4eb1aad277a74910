#pragma once

#include "core/scene/scene.hpp"
#include "core/shapes/precision.hpp"

#include <string>
#include <vector>

namespace raylane::core {

/// Estimate of a method's cost and of its effect on a picture.
struct MethodEstimate {
    Precision precision;
    double cost;           ///< time of finding what rays hit, relative to exact's
    double pixels;         ///< by which a surface or a shadow may be displaced; infinity: unbounded
    std::string objection; ///< reason why it will not do, in words; empty if it will
};

/// The cheapest method whose pictures cannot be told from the right one: whose surfaces and shadows
/// are displaced by less than a tenth of a pixel, and which cannot take one surface for another.
struct MethodChoice {
    Precision precision;
    std::vector<MethodEstimate> considered; ///< the cheapest first
};

/// Depends on the scene and on `settings` alone, so that a picture does not depend on the machine
/// that draws it. Costs are those of bench/chart.sh.
MethodChoice choose_method(const Scene& scene, const Settings& settings);

} // namespace raylane::core
