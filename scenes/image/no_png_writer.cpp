#include "scenes/errors.hpp"
#include "scenes/image/png_reader.hpp"
#include "scenes/image/png_writer.hpp"

namespace raylane::scenes {

void write_png(AtomicFile& file, const core::Film& film, const PictureOptions& options) {
    static_cast<void>(film), static_cast<void>(options);
    throw BadInput(file.name(), "", "must not be PNG: raylane was built without libpng");
}

void read_png(ByteSource& source, Image& image) {
    static_cast<void>(source), static_cast<void>(image);
    throw MalformedPicture("must not be PNG: raylane was built without libpng");
}

} // namespace raylane::scenes
