#include "scenes/images/texture.hpp"

#include "core/scene/transfer.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/images/png.hpp"

#include <cerrno>
#include <cmath>
#include <new>
#include <string>

namespace raylane::scenes {

namespace {

Image decoded(InputFile& file, std::size_t max_pixels) {
    const std::uint64_t pixels = pixels_of_png(file.head());
    if (pixels == 0) throw MalformedImage("must be PNG, got another format");
    if (pixels > max_pixels)
        throw MalformedImage("must have at most " + std::to_string(max_pixels) +
                             " pixels, together with the other images of the scene, got " +
                             std::to_string(pixels));
    ByteSource source(file);
    Image image;
    read_png(source, image);
    for (std::size_t i = 0; i < image.alpha.size(); ++i)
        if (image.alpha[i] != 1.0F) throw MalformedImage("must have no transparent pixels");
    return image;
}

} // namespace

std::uint64_t pixels_of_png(std::string_view head) {
    if (!head.starts_with("\x89PNG\r\n\x1A\n") || head.size() < 24) return 0;
    const auto number = [&](std::size_t at) {
        std::uint64_t value = 0;
        for (std::size_t i = at; i < at + 4; ++i)
            value = value << 8 | static_cast<unsigned char>(head[i]);
        return value;
    };
    return number(16) * number(20);
}

core::Texture read_texture(InputFile& file, std::size_t max_pixels) {
    try {
        const Image image = decoded(file, max_pixels);
        const auto width = static_cast<std::size_t>(image.width),
                   height = static_cast<std::size_t>(image.height);
        if (image.bits == 8) {
            core::Texture::Codes codes(image.rgb.size());
            for (std::size_t i = 0; i < codes.size(); ++i)
                codes[i] = static_cast<std::uint8_t>(std::lround(image.rgb[i] * 255.0F));
            return {width, height, std::move(codes), file.name()};
        }
        core::Texture::Floats linear(image.rgb.size());
        for (std::size_t i = 0; i < linear.size(); ++i)
            linear[i] = static_cast<float>(core::linear_of_srgb(static_cast<double>(image.rgb[i])));
        return {width, height, std::move(linear), file.name()};
    } catch (const MalformedImage& malformed) {
        throw BadInput(file.name(), "", malformed.what());
    } catch (const std::bad_alloc&) {
        throw SystemRefused(file.name(), "read", ENOMEM);
    }
}

} // namespace raylane::scenes
