#include "scenes/files/errors.hpp"
#include "scenes/files/inflater.hpp"
#include "scenes/images/float_images.hpp"
#include "scenes/images/png.hpp"

/// Implements png.hpp and inflater.hpp without libpng and zlib.
namespace raylane::scenes {

void write_png(AtomicFile& file, const core::Film& film, const ImageOptions& options) {
    static_cast<void>(film), static_cast<void>(options);
    throw BadInput(file.name(), "", "must not be PNG: raylane was built without libpng");
}

void read_png(ByteSource& source, Image& image) {
    static_cast<void>(source), static_cast<void>(image);
    throw MalformedImage("must not be PNG: raylane was built without libpng");
}

struct Inflater::State {};

Inflater::Inflater(std::string name, std::string begin, Source source) {
    static_cast<void>(begin), static_cast<void>(source);
    throw BadInput(name, "", "must not be compressed: raylane was built without zlib");
}
Inflater::~Inflater() = default;

std::size_t Inflater::read(std::span<char> buffer) {
    static_cast<void>(buffer);
    return 0;
}

} // namespace raylane::scenes
