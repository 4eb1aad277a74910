#include "scenes/image/writer.hpp"

#include "core/scene/transfer.hpp"
#include "scenes/errors.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <string_view>
#include <utility>
#include <zlib.h>

namespace {

/// Compressor that stb_image_write calls: the memory is to be freed, and null if there is none. Of
/// what a PNG's filter leaves, zlib finds runs as good as all that it would find at its lowest
/// level, in three quarters of the time.
unsigned char* compress_for_stb(unsigned char* data, int size, int* compressed_size, int) {
    constexpr int window_bits = 15, memory_level = 9;
    z_stream stream{};
    if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, window_bits, memory_level, Z_RLE) != Z_OK)
        return nullptr;
    const uLong room = deflateBound(&stream, static_cast<uLong>(size));
    auto* compressed = static_cast<unsigned char*>(std::malloc(room));
    stream.next_in = data;
    stream.avail_in = static_cast<uInt>(size);
    stream.next_out = compressed;
    stream.avail_out = static_cast<uInt>(room);
    const bool done = compressed != nullptr && deflate(&stream, Z_FINISH) == Z_STREAM_END;
    *compressed_size = static_cast<int>(stream.total_out);
    deflateEnd(&stream);
    if (done) return compressed;
    std::free(compressed);
    return nullptr;
}

} // namespace

// Its functions stay in this file: a program that links the library may have them as well.
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBIW_ZLIB_COMPRESS compress_for_stb
#include <stb_image_write.h>

namespace raylane::scenes {

namespace {

static_assert(sizeof(core::Color) == 3 * sizeof(float), "a film is rows of RGB floats");

/// Takes what stb_image_write writes. No exception may pass through it: it would not free its
/// memory.
struct Sink {
    AtomicFile& file;
    std::exception_ptr failure;

    static void write(void* context, void* data, int size) {
        Sink& sink = *static_cast<Sink*>(context);
        if (sink.failure) return;
        try {
            sink.file.write({static_cast<const char*>(data), static_cast<std::size_t>(size)});
        } catch (...) {
            sink.failure = std::current_exception();
        }
    }

    /// `encoded`: what the writing function returned; 0 if it had no memory.
    void finish(int encoded) const {
        if (failure) std::rethrow_exception(failure);
        if (encoded == 0) throw SystemRefused(file.name(), "write", ENOMEM);
    }
};

/// Component as a shared exponent can hold it; its largest power of two is 2^127.
float radiance_component(float value) {
    constexpr float largest = 0x1.FFFFFEp126F;
    return std::isnan(value) ? 0.0F : std::clamp(value, 0.0F, largest);
}

} // namespace

PictureFormat picture_format_of(const std::filesystem::path& path) {
    if (path == "-") return PictureFormat::png;
    std::string ending = path.extension().string();
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    static constexpr std::pair<std::string_view, PictureFormat> endings[] = {
        {".png", PictureFormat::png}, {".hdr", PictureFormat::hdr}, {".pfm", PictureFormat::pfm},
        {".tga", PictureFormat::tga}, {".bmp", PictureFormat::bmp}, {".ppm", PictureFormat::ppm}};
    for (const auto& [known, format] : endings)
        if (ending == known) return format;
    throw BadInput(path.string(), "",
                   "must end in .png, .hdr, .pfm, .tga, .bmp or .ppm, got " +
                       (ending.empty() ? "no ending" : '"' + printable(ending) + '"'));
}

OutputFile::OutputFile(const std::filesystem::path& path)
    : OutputFile(path, picture_format_of(path)) {}

OutputFile::OutputFile(const std::filesystem::path& path, PictureFormat format)
    : format_(format), file_(path) {}

void OutputFile::reserve(int width, int height) {
    // Those that are compressed: any room may do.
    const std::int64_t components = std::int64_t{3} * width * height;
    switch (format_) {
    case PictureFormat::png:
    case PictureFormat::hdr:
        return file_.reserve(1);
    case PictureFormat::pfm:
        return file_.reserve(components * static_cast<int>(sizeof(float)));
    case PictureFormat::tga:
    case PictureFormat::bmp:
    case PictureFormat::ppm:
        return file_.reserve(components);
    }
}

void OutputFile::commit(const core::Film& film, core::Transfer transfer) {
    switch (format_) {
    case PictureFormat::png:
    case PictureFormat::tga:
    case PictureFormat::bmp:
    case PictureFormat::ppm:
        write_codes(film, transfer);
        break;
    case PictureFormat::hdr:
        write_hdr(film);
        break;
    case PictureFormat::pfm:
        write_pfm(film);
        break;
    }
    file_.commit();
}

void OutputFile::write_codes(const core::Film& film, core::Transfer transfer) {
    std::vector<std::uint8_t> codes;
    codes.reserve(3 * film.pixels().size());
    const core::Encoder encode(transfer);
    for (const core::Color& pixel : film.pixels())
        for (int channel = 0; channel < 3; ++channel)
            codes.push_back(encode(pixel[channel]));
    const int width = film.width(), height = film.height();
    if (format_ == PictureFormat::ppm) {
        file_.write("P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n");
        file_.write({reinterpret_cast<const char*>(codes.data()), codes.size()});
        return;
    }
    // Its search for each row's best filter takes longer than the rest, and saves nothing to speak
    // of. Not all that reads Targa reads what is compressed.
    constexpr int differences_along_rows = 1;
    static const bool once = [] {
        stbi_write_force_png_filter = differences_along_rows;
        stbi_write_tga_with_rle = 0;
        return true;
    }();
    static_cast<void>(once);
    Sink sink{file_, nullptr};
    if (format_ == PictureFormat::tga)
        sink.finish(stbi_write_tga_to_func(&Sink::write, &sink, width, height, 3, codes.data()));
    else if (format_ == PictureFormat::bmp)
        sink.finish(stbi_write_bmp_to_func(&Sink::write, &sink, width, height, 3, codes.data()));
    else
        sink.finish(
            stbi_write_png_to_func(&Sink::write, &sink, width, height, 3, codes.data(), 3 * width));
}

void OutputFile::write_hdr(const core::Film& film) {
    std::vector<float> components;
    components.reserve(3 * film.pixels().size());
    for (const core::Color& pixel : film.pixels())
        for (int channel = 0; channel < 3; ++channel)
            components.push_back(radiance_component(pixel[channel]));
    Sink sink{file_, nullptr};
    sink.finish(stbi_write_hdr_to_func(&Sink::write, &sink, film.width(), film.height(), 3,
                                       components.data()));
}

/// The format is Paul Debevec's: rows from the bottom up, a negative scale for little-endian.
void OutputFile::write_pfm(const core::Film& film) {
    const std::string header =
        "PF\n" + std::to_string(film.width()) + " " + std::to_string(film.height()) + "\n-1.0\n";
    file_.write(header);
    std::vector<char> row;
    for (int y = film.height() - 1; y >= 0; --y) {
        row.clear();
        for (int x = 0; x < film.width(); ++x)
            for (int channel = 0; channel < 3; ++channel) {
                const auto bits = std::bit_cast<std::uint32_t>(film.at(x, y)[channel]);
                for (int shift = 0; shift < 32; shift += 8)
                    row.push_back(static_cast<char>(bits >> shift & 0xFF));
            }
        file_.write(row);
    }
}

} // namespace raylane::scenes
