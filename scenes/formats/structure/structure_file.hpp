#pragma once

#include "core/scene/scene.hpp"
#include "scenes/formats/format.hpp"
#include "scenes/formats/structure/drawing.hpp"
#include "scenes/formats/structure/readers.hpp"

#include <string>
#include <vector>

namespace raylane::scenes {

/// The meaning of a drawing's shapes.
struct Legend {
    Structure structure;
    std::vector<AtomPair> atoms_of_shape; ///< by shape id; empty: not from a file of atoms
    std::vector<ColorKey> colors{};       ///< of shapes in the scene
    std::vector<AtomPlace> places{};      ///< this and the next two: as in DrawingScale
    std::vector<char> is_in_chain{};
    bool has_too_many_colors = false;
    bool wants_atoms = true; ///< false: only the colours are kept

    /// Returns "atom 12, CA of ALA 25 in chain A (C)" and the like; empty if the shape is not an
    /// atom's.
    std::string of(core::ShapeId shape) const;
};

/// Returns the reader of a file of atoms, which must outlive it. Throws BadInput for other formats.
std::unique_ptr<FrameReader> open_structure(InputFile& file, Format format,
                                            const ReaderOptions& options = {});

/// Returns the scene of a frame. `file` is the name in messages. `scale` receives the result of
/// draw(), and `legend` the meaning of the shapes, unless they are null.
core::Scene draw_structure(const Structure& structure, const Drawing& drawing,
                           const std::string& file, core::Workers* workers = nullptr,
                           DrawingScale* scale = nullptr, const OnRemark& on_remark = {},
                           Legend* legend = nullptr);

/// Returns the scene of the first of the options' frames. `legend`, unless null, receives the
/// meaning of its shapes. Throws BadInput, with the line, and SystemRefused.
core::Scene read_structure(InputFile& file, Format format, const ReaderOptions& options,
                           const Drawing& drawing, core::Workers* workers, Legend* legend);

} // namespace raylane::scenes
