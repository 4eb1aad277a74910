#include "scenes/images/reader.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/images/exr.hpp"
#include "scenes/images/float_images.hpp"
#include "scenes/images/png.hpp"
#include "scenes/images/tiff.hpp"

#include <cerrno>
#include <new>

namespace raylane::scenes {

namespace {

Image decoded(InputFile& file) {
    const std::string_view head = file.head();
    ByteSource source(file);
    Image image;
    image.name = file.name();
    if (head.starts_with("\x89PNG\r\n\x1A\n")) {
        read_png(source, image);
    } else if (head.starts_with("#?RADIANCE") || head.starts_with("#?RGBE")) {
        image.linear_float = true;
        read_hdr(source, image);
    } else if (head.starts_with("PF") || head.starts_with("Pf")) {
        image.linear_float = true;
        read_pfm(source, image);
    } else if (head.starts_with("\x76\x2F\x31\x01")) {
        image.linear_float = true;
        read_exr(source, image);
    } else if (looks_like_tiff(head)) {
        read_tiff(file.read_all(), image);
    } else {
        throw BadInput(file.name(), "",
                       "must be a PNG, TIFF, EXR, HDR or PFM image, got another format");
    }
    return image;
}

} // namespace

Image read_image(const std::filesystem::path& path) {
    InputFile file(path);
    return read_image(file);
}

Image read_image(InputFile& file) {
    try {
        return decoded(file);
    } catch (const MalformedImage& malformed) {
        throw BadInput(file.name(), "", malformed.what());
    } catch (const std::bad_alloc&) {
        throw SystemRefused(file.name(), "read", ENOMEM);
    }
}

} // namespace raylane::scenes
