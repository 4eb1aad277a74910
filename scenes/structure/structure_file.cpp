#include "scenes/structure/structure_file.hpp"

#include "scenes/errors.hpp"
#include "scenes/structure/readers.hpp"

namespace raylane::scenes {

namespace {

std::unique_ptr<FrameReader> reader_of(InputFile& file, Format format) {
    switch (format) {
    case Format::pdb:
        return open_pdb(file);
    case Format::cif:
        return open_cif(file);
    case Format::xyz:
        return open_xyz(file);
    case Format::gro:
        return open_gro(file);
    case Format::lammps_dump:
        return open_lammps_dump(file);
    case Format::lammps_data:
        return open_lammps_data(file);
    case Format::json:
    case Format::nff:
    case Format::pov:
    case Format::tachyon:
        break;
    }
    throw BadInput(file.name(), "", "is no file of atoms");
}

} // namespace

core::Scene read_structure(InputFile& file, Format format, const Drawing& drawing,
                           core::Workers* workers) {
    core::SceneBuilder builder;
    builder.workers = workers;
    {
        Structure structure;
        if (!reader_of(file, format)->next(structure))
            throw BadInput(file.name(), "", "has no atoms");
        draw(structure, drawing, file.name(), builder);
    }
    try {
        return std::move(builder).build();
    } catch (const core::InvalidValue& invalid) {
        throw BadInput(file.name(), "", invalid.what());
    }
}

} // namespace raylane::scenes
