#pragma once

#include "core/scene/surroundings.hpp"
#include "scenes/formats/nff/fields.hpp"

namespace raylane::scenes {

struct NffView {
    core::Camera camera;
    int width = 0;  ///< pixels
    int height = 0; ///< pixels
};

/// Reads the fields of a "v": from, at, up, angle, hither and resolution, in any order. Throws
/// BadInput or core::InvalidValue.
NffView read_nff_view(NffFields& fields);

} // namespace raylane::scenes
