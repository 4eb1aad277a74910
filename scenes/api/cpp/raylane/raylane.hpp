#pragma once

/// The raylane library: scenes of quadrics, built in code or loaded from files; ray queries on
/// structure-of-arrays spans; and rendered images.
///
/// Lengths are in the scene's unit, which is arbitrary. Angles are in degrees. Colours are linear
/// RGB, where 1 is white. A surface is exactly the one that the numbers of its shape define, and
/// real arithmetic on these numbers decides which surface a ray hits.

#include "raylane/api.hpp"
#include "raylane/camera_rays.hpp"
#include "raylane/errors.hpp"
#include "raylane/generators.hpp"
#include "raylane/group.hpp"
#include "raylane/image.hpp"
#include "raylane/material.hpp"
#include "raylane/precision.hpp"
#include "raylane/scene.hpp"
#include "raylane/shapes.hpp"
#include "raylane/solid.hpp"
#include "raylane/surroundings.hpp"
#include "raylane/tracer.hpp"
#include "raylane/transform.hpp"
#include "raylane/vector.hpp"
#include "raylane/version.hpp"
