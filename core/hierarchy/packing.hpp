#pragma once

#include "core/hierarchy/workers.hpp"
#include "core/shapes/shape_table.hpp"

#include <cstddef>

namespace raylane::core {

/// Number of spheres from which tables are packed. Smaller tables take little memory anyway, and
/// tracing is faster without unpacking.
inline constexpr std::size_t packed_from = std::size_t{1} << 22;

/// Minimum number of spheres for packing, whatever the caller asks for: scenes without a tree keep
/// plain tables.
inline constexpr std::size_t min_packed = 64;

/// Packs a table if it has blocks for at least `from` spheres, all of floats, and if packing saves
/// a fifth. All ids must be less than `id_count`. The result does not depend on the workers.
void pack_spheres(Table<Sphere>& table, std::size_t id_count, std::size_t from, Workers& workers);

} // namespace raylane::core
