#pragma once

/// raylane as a library: scenes of quadrics, built in code or loaded; rays asked about them in
/// structure-of-arrays spans; and pictures of them.
///
/// Lengths have no unit, angles are degrees, colours are linear RGB with 1 as white. Surfaces are
/// exactly what the floats of a shape say, and which of them a ray hits is decided as real
/// arithmetic decides it.

#include "raylane/errors.hpp"
#include "raylane/image.hpp"
#include "raylane/material.hpp"
#include "raylane/precision.hpp"
#include "raylane/scene.hpp"
#include "raylane/shapes.hpp"
#include "raylane/solid.hpp"
#include "raylane/surroundings.hpp"
#include "raylane/tracer.hpp"
#include "raylane/vector.hpp"
#include "raylane/version.hpp"
