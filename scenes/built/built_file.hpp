#pragma once

#include "core/scene/scene.hpp"
#include "scenes/atomic_file.hpp"
#include "scenes/input_file.hpp"

#include <string>

namespace raylane::scenes {

/// Writes a scene as it is in memory: what takes time to build of it need not be built again.
/// Throws BadInput for one with solids that are made of others, and SystemRefused.
void write_built(AtomicFile& file, const core::Scene& scene);

/// Such a scene again, whose shapes stay in the file, mapped into memory, if it is one that can be:
/// processes that have the same file share them. All of it is checked first, by its checksum and as
/// whatever it is that it holds. Throws BadInput for what write_built did not write, and
/// SystemRefused.
core::Scene read_built(InputFile& file, core::Workers* workers);
/// Gives bytes that were changed the checksum that they have: for tests of what is behind it.
void seal(std::string& built_file);

/// True if a file begins as one of a built scene.
bool looks_built(std::string_view head);

} // namespace raylane::scenes
