#pragma once

#include "core/scene/scene.hpp"
#include "scenes/format.hpp"
#include "scenes/structure/drawing.hpp"
#include "scenes/structure/legend.hpp"
#include "scenes/structure/readers.hpp"

namespace raylane::scenes {

/// The reader of a file of atoms, which must outlive it. Throws BadInput for another format.
std::unique_ptr<FrameReader> open_structure(InputFile& file, Format format,
                                            const ReaderOptions& options = {});

/// The scene of a frame; `file` is what messages call it, and `scale` what draw() leaves there.
core::Scene draw_structure(const Structure& structure, const Drawing& drawing,
                           const std::string& file, core::Workers* workers = nullptr,
                           DrawingScale* scale = nullptr, const OnRemark& on_remark = {});

/// Reads the first frame of a file of atoms, and draws it; `legend`, if there is one, is left with
/// what its shapes are. Throws BadInput, with the line, and SystemRefused.
core::Scene read_structure(InputFile& file, Format format, const ReaderOptions& options,
                           const Drawing& drawing, core::Workers* workers = nullptr,
                           Legend* legend = nullptr);

} // namespace raylane::scenes
