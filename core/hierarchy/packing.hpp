#pragma once

#include "core/hierarchy/workers.hpp"
#include "core/shapes/shape_table.hpp"

#include <cstddef>

namespace raylane::core {

/// From so many spheres on they are packed: fewer take little memory anyway, and rays are faster
/// where there is nothing to unpack.
inline constexpr std::size_t packed_from = std::size_t{1} << 22;

/// No fewer are packed, whoever asks for it: scenes without a tree have their tables plain.
inline constexpr std::size_t least_packed = 64;

/// Packs a table if it has blocks for `from` spheres or more, floats all of them, and if that saves
/// a fifth; their ids are less than `id_count`. Nothing of it depends on the workers.
void pack_spheres(Table<Sphere>& table, std::size_t id_count, std::size_t from, Workers& workers);

} // namespace raylane::core
