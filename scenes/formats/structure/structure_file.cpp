#include "scenes/formats/structure/structure_file.hpp"

#include "core/scene/transfer.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/frames.hpp"

namespace raylane::scenes {

namespace {

std::string words_for(const Structure& structure, AtomIndex atom) {
    std::string text = "atom " + std::to_string(atom + 1) + ", ";
    const AtomKind& kind = structure.of_kind[structure.kinds[atom]];
    text += structure.names.empty() ? kind.label : structure.names[atom];
    if (!structure.residues.empty()) {
        const Residue& residue = structure.of_residue[structure.residues[atom]];
        text += " of " + residue.name + " " + std::to_string(residue.number);
        if (residue.insertion != ' ') text += residue.insertion;
        const std::string& chain = structure.chains[residue.chain];
        if (!chain.empty()) text += " in chain " + chain;
    }
    if (kind.element != 0) text += " (" + std::string(data_of(kind.element).symbol) + ")";
    return text;
}

} // namespace

std::string Legend::of(core::ShapeId shape) const {
    if (shape >= atoms_of_shape.size() || atoms_of_shape[shape] == no_atoms) return {};
    const auto [a, b] = atoms_of_shape[shape];
    if (a == b) return words_for(structure, a);
    return "bond of " + words_for(structure, a) + ", and " + words_for(structure, b);
}

namespace {

/// Returns make(). Rethrows a value that a scene refuses as an error of the file.
auto of_file(const std::string& file, const auto& make) {
    try {
        return make();
    } catch (const core::InvalidValue& invalid) {
        throw BadInput(file, "", invalid.what());
    }
}

} // namespace

std::unique_ptr<FrameReader> open_structure(InputFile& file, Format format,
                                            const ReaderOptions& options) {
    if (!options.atom_style.empty() && format != Format::lammps_data)
        throw BadInput("--atom-style", "",
                       "goes with a LAMMPS data file, but " + printable(file.name(), 4096) +
                           " is not one");
    switch (format) {
    case Format::pdb:
        return open_pdb(file);
    case Format::cif:
        return open_cif(file, options);
    case Format::xyz:
        return open_xyz(file);
    case Format::gro:
        return open_gro(file);
    case Format::lammps_dump:
        return open_lammps_dump(file);
    case Format::lammps_data:
        return open_lammps_data(file, options);
    case Format::mol:
        return open_mol(file);
    case Format::mol2:
        return open_mol2(file);
    case Format::pqr:
        return open_pqr(file);
    case Format::json:
    case Format::nff:
    case Format::pov:
    case Format::tachyon:
    case Format::built:
        break;
    }
    throw BadInput(file.name(), "", "must be a file of atoms");
}

namespace {

/// Removes names whose colours no shape has: planes may have cut all atoms of an element away, and
/// a cartoon shows no ligands.
void keep_shown(std::vector<ColorKey>& keys, const core::Scene& scene) {
    std::vector<char> is_used(scene.materials().size());
    for (core::ShapeId id = 0; id < scene.shape_count(); ++id)
        is_used[scene.material_index_of(id)] = 1;
    const auto is_shown = [&](const core::Color& color) {
        for (std::size_t i = 0; i < is_used.size(); ++i)
            if (is_used[i] != 0 && scene.materials()[i].pattern.colors[0] == color) return true;
        return false;
    };
    for (ColorKey& key : keys)
        std::erase_if(key.entries, [&](const auto& entry) {
            return !is_shown(core::color_from_srgb(entry.second));
        });
    std::erase_if(keys,
                  [](const ColorKey& key) { return key.property.empty() && key.entries.empty(); });
}

/// Draws a frame, and sets its legend, unless that is null.
DrawingScale draw_with(core::SceneBuilder& builder, const Structure& structure,
                       const Drawing& drawing, const std::string& file, Legend* legend,
                       const OnRemark& on_remark) {
    std::vector<AtomPair> atoms;
    const bool keeps_atoms = legend != nullptr && legend->wants_atoms;
    DrawingScale drawn =
        draw(structure, drawing, file, builder, keeps_atoms ? &atoms : nullptr, on_remark);
    if (legend == nullptr) return drawn;
    legend->colors = drawn.keys;
    legend->has_too_many_colors = drawn.has_too_many_colors;
    legend->places = std::move(drawn.places);
    legend->is_in_chain = std::move(drawn.is_in_chain);
    legend->atoms_of_shape = std::move(atoms);
    return drawn;
}

core::Scene built(core::SceneBuilder&& builder, Legend* legend) {
    core::Scene scene = std::move(builder).build();
    if (legend != nullptr) keep_shown(legend->colors, scene);
    return scene;
}

} // namespace

core::Scene draw_structure(const Structure& structure, const Drawing& drawing,
                           const std::string& file, core::Workers* workers, DrawingScale* scale,
                           const OnRemark& on_remark, Legend* legend) {
    core::SceneBuilder builder;
    builder.workers = workers;
    return of_file(file, [&] {
        DrawingScale drawn = draw_with(builder, structure, drawing, file, legend, on_remark);
        if (scale != nullptr) *scale = std::move(drawn);
        if (legend != nullptr && legend->wants_atoms) legend->structure = structure;
        return built(std::move(builder), legend);
    });
}

namespace {

Structure first_frame(InputFile& file, Format format, const ReaderOptions& options) {
    Frames frames(file, format, options);
    if (!frames.next()) throw BadInput("--frames", "", "must select at least one frame, got none");
    return std::move(frames.structure());
}

} // namespace

core::Scene read_structure(InputFile& file, Format format, const ReaderOptions& options,
                           const Drawing& drawing, core::Workers* workers, Legend* legend) {
    core::SceneBuilder builder;
    builder.workers = workers;
    return of_file(file.name(), [&] {
        {
            Structure structure = first_frame(file, format, options);
            if (options.on_structure) options.on_structure(structure);
            draw_with(builder, structure, drawing, file.name(), legend, options.on_remark);
            if (legend != nullptr && legend->wants_atoms) legend->structure = std::move(structure);
        } // frees the structure before the hierarchy takes memory
        return built(std::move(builder), legend);
    });
}

} // namespace raylane::scenes
