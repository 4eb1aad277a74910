#include "scenes/files/errors.hpp"
#include "scenes/images/exr.hpp"
#include "scenes/images/reader.hpp"

#include <cstdint>
#include <string_view>

/// Reads any bytes as an image, and as a part of an image for merge. The result must be an image,
/// or one error that names the file. Anything else is a finding.
using namespace raylane;

namespace {

template <class Read>
void read(std::string_view bytes, const Read& read_as) {
    try {
        scenes::InputFile file("a.picture", bytes);
        read_as(file);
    } catch (const scenes::BadInput& bad) {
        if (!std::string_view(bad.what()).starts_with("a.picture")) __builtin_trap();
    } catch (const scenes::SystemRefused&) {
    }
}

/// A few bytes may rightly make a large image, which takes long.
bool is_large(const scenes::Image& image) {
    return image.width > 4096 || image.height > 4096;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    bool large = false;
    read(bytes, [&](scenes::InputFile& file) {
        const scenes::Image image = scenes::read_image(file);
        large = is_large(image);
        const auto pixels =
            static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
        if (image.rgb.size() != 3 * pixels ||
            (image.alpha.size() != 0 && image.alpha.size() != pixels))
            __builtin_trap();
    });
    if (!large) read(bytes, [](scenes::InputFile& file) { scenes::read_own_exr(file); });
    return 0;
}
