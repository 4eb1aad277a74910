#include "scenes/image/reader.hpp"

#include "scenes/errors.hpp"
#include "scenes/image/float_pictures.hpp"

// Its functions stay in this file: a program that links the library may have them as well.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 65535
#include <stb_image.h>

#include <exception>
#include <memory>

namespace raylane::scenes {

namespace {

/// Hands a file to stb_image. No exception may pass through that: it would not free its memory.
struct Feed {
    ByteSource& source;
    std::exception_ptr failure;
    bool at_end = false;

    static int read(void* context, char* data, int size) {
        Feed& feed = *static_cast<Feed*>(context);
        std::size_t count = 0;
        try {
            if (!feed.failure) count = feed.source.read({data, static_cast<std::size_t>(size)});
        } catch (...) {
            feed.failure = std::current_exception();
        }
        if (count < static_cast<std::size_t>(size)) feed.at_end = true;
        return static_cast<int>(count);
    }
    static void skip(void* context, int count) {
        char byte = 0;
        for (int i = 0; i < count && read(context, &byte, 1) == 1; ++i) {
        }
    }
    static int is_at_end(void* context) { return static_cast<Feed*>(context)->at_end ? 1 : 0; }
};

template <class Code>
void take_codes(Image& image, Code* decoded) {
    const std::unique_ptr<Code, void (*)(void*)> codes(decoded, &stbi_image_free);
    if (!codes) throw damaged("PNG");
    constexpr auto largest = static_cast<float>(std::numeric_limits<Code>::max());
    const std::size_t count = std::size_t{3} * image.width * image.height;
    image.rgb.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        image.rgb.push_back(static_cast<float>(codes.get()[i]) / largest);
}

/// `head`: the start of the file, which has width, height and bits a component at fixed places.
void read_png(std::string_view head, ByteSource& source, Image& image) {
    constexpr std::size_t width_at = 16;
    constexpr std::size_t height_at = 20;
    constexpr std::size_t depth_at = 24;
    if (head.size() <= depth_at) throw damaged("PNG");
    const auto number_at = [&](std::size_t place) {
        std::int64_t number = 0;
        for (std::size_t i = place; i < place + 4; ++i)
            number = number << 8 | static_cast<unsigned char>(head[i]);
        return number;
    };
    check_size(number_at(width_at), number_at(height_at));
    const bool sixteen_bits = head[depth_at] == 16;
    Feed feed{source, nullptr};
    const stbi_io_callbacks callbacks{&Feed::read, &Feed::skip, &Feed::is_at_end};
    int channels = 0;
    try {
        if (sixteen_bits)
            take_codes(image, stbi_load_16_from_callbacks(&callbacks, &feed, &image.width,
                                                          &image.height, &channels, 3));
        else
            take_codes(image, stbi_load_from_callbacks(&callbacks, &feed, &image.width,
                                                       &image.height, &channels, 3));
    } catch (const MalformedPicture&) {
        if (feed.failure) std::rethrow_exception(feed.failure);
        throw;
    }
}

Image decoded(InputFile& file) {
    const std::string_view head = file.head();
    ByteSource source(file);
    Image image;
    image.name = file.name();
    if (head.starts_with("\x89PNG\r\n\x1A\n")) {
        read_png(head, source, image);
    } else if (head.starts_with("#?RADIANCE") || head.starts_with("#?RGBE")) {
        image.linear_float = true;
        read_hdr(source, image);
    } else if (head.starts_with("PF") || head.starts_with("Pf")) {
        image.linear_float = true;
        read_pfm(source, image);
    } else {
        throw BadInput(file.name(), "", "must be a PNG, HDR or PFM picture, got something else");
    }
    return image;
}

} // namespace

Image read_image(const std::filesystem::path& path) {
    InputFile file(path);
    try {
        return decoded(file);
    } catch (const MalformedPicture& malformed) {
        throw BadInput(file.name(), "", malformed.what());
    }
}

} // namespace raylane::scenes
