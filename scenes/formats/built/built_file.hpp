#pragma once

#include "core/scene/scene.hpp"
#include "scenes/files/atomic_file.hpp"
#include "scenes/files/input_file.hpp"

#include <string>

namespace raylane::scenes {

/// Writes a scene in its in-memory layout, so that reading it need not repeat the work of building
/// it. Throws BadInput for a scene with constructed solids, and SystemRefused.
void write_built(AtomicFile& file, const core::Scene& scene);

/// Returns a scene that write_built() wrote. Its shapes stay in the file, which is mapped into
/// memory if possible: processes that read the same file share them. First verifies the checksum
/// and that all content is valid. Throws BadInput for a file that write_built() did not write, and
/// SystemRefused.
core::Scene read_built(InputFile& file, core::Workers* workers);
/// Recomputes the checksum of a modified file, so that tests reach the checks behind the checksum.
void seal(std::string& built_file);

/// Returns true if a file begins like a built scene.
bool looks_built(std::string_view head);

} // namespace raylane::scenes
