#include "scenes/errors.hpp"
#include "scenes/image/exr.hpp"
#include "scenes/image/reader.hpp"

#include <cstdint>
#include <string_view>

/// Pictures, for any bytes: as anybody's, and as a part that merge is given. A picture, or one
/// complaint that names the file; anything else is a finding.
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

/// Of few bytes a large picture may be made, rightly, which takes its time.
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
