#pragma once

#include "core/scene/film.hpp"
#include "core/scene/scene.hpp"

#include <cstdint>
#include <span>
#include <string>

/// Digits that tell one thing from another: xxHash's XXH3 (128 bits, 32 hexadecimal digits; 64 bits
/// of records). They find accidents, and keep nobody from forging.
namespace raylane::scenes {

/// Of all that a picture of the scene depends on but its settings: shapes with their tables'
/// order, which depends on nothing else, materials, lights, camera and fog.
std::string fingerprint_of(const core::Scene& scene);

/// Of a picture's size and the bits of its colours and alphas.
std::string fingerprint_of(const core::Film& film);

/// Other ones by other seeds.
std::uint64_t checksum_of(std::span<const char> bytes, std::uint64_t seed);

} // namespace raylane::scenes
