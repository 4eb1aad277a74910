#pragma once

#include "core/scene/film.hpp"
#include "core/scene/scene.hpp"

#include <cstdint>
#include <span>
#include <string>

/// Hashes that tell scenes and images apart: xxHash's XXH3 (128 bits as 32 hexadecimal digits; 64
/// bits for records). They detect accidents, not forgery.
namespace raylane::scenes {

/// Returns the fingerprint of everything in a scene that an image depends on, except the settings:
/// shapes in the order of their tables (which follows from the shapes alone), materials, lights,
/// camera and fog.
std::string fingerprint_of(const core::Scene& scene);

/// Returns the fingerprint of an image's size and of the bits of its colours and alphas.
std::string fingerprint_of(const core::Film& film);

/// Returns a checksum. Different seeds give different checksums.
std::uint64_t checksum_of(std::span<const char> bytes, std::uint64_t seed);

} // namespace raylane::scenes
