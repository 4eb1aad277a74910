#include "scenes/images/writer.hpp"

#include "core/scene/transfer.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/images/png.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Static, because a program that links the library may contain stb_image_write, too.
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

namespace raylane::scenes {

namespace {

static_assert(sizeof(core::Color) == 3 * sizeof(float), "a film is rows of RGB floats");

/// Receives the output of stb_image_write. No exception may pass through stb_image_write, as it
/// would not free its memory.
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

    /// Throws if writing failed. `encoded`: the result of the stb function; 0 if it had no memory.
    void finish(int encoded) const {
        if (failure) std::rethrow_exception(failure);
        if (encoded == 0) throw SystemRefused(file.name(), "write", ENOMEM);
    }
};

/// Clamps a component to the range of a shared exponent, below 2^127. NaN becomes 0.
float radiance_component(float value) {
    constexpr float largest = 0x1.FFFFFEp126F;
    return std::isnan(value) ? 0.0F : std::clamp(value, 0.0F, largest);
}

} // namespace

ImageFormat image_format_of(const std::filesystem::path& path, const MoreEncoders& more) {
    if (path == "-") return ImageFormat::png;
    const std::string ending = ending_of(path);
    static constexpr std::pair<std::string_view, ImageFormat> endings[] = {
        {".png", ImageFormat::png}, {".tif", ImageFormat::tiff}, {".tiff", ImageFormat::tiff},
        {".exr", ImageFormat::exr}, {".hdr", ImageFormat::hdr},  {".pfm", ImageFormat::pfm},
        {".tga", ImageFormat::tga}, {".bmp", ImageFormat::bmp},  {".ppm", ImageFormat::ppm}};
    std::vector<std::string> known;
    for (const auto& [name, format] : endings) {
        if (format == ImageFormat::exr && more.exr == nullptr) continue;
        if (format == ImageFormat::tiff && more.tiff == nullptr) continue;
        if (ending == name) return format;
        known.emplace_back(name);
    }
    throw BadInput(path.string(), "",
                   "must end in " + alternatives(known) + ", got " +
                       (ending.empty() ? "no ending" : '"' + printable(ending) + '"'));
}

OutputFile::OutputFile(const std::filesystem::path& path, const MoreEncoders& more)
    : OutputFile(path, image_format_of(path, more), more) {}

OutputFile::OutputFile(const std::filesystem::path& path, ImageFormat format,
                       const MoreEncoders& more)
    : more_(more), format_(format), file_(path) {}

void OutputFile::reserve(int width, int height) {
    // The size of compressed formats is unknown; reserving one byte detects a full disk.
    const std::int64_t components = std::int64_t{3} * width * height;
    switch (format_) {
    case ImageFormat::png:
    case ImageFormat::tiff:
    case ImageFormat::hdr:
    case ImageFormat::exr:
        return file_.reserve(1);
    case ImageFormat::pfm:
        return file_.reserve(components * static_cast<int>(sizeof(float)));
    case ImageFormat::tga:
    case ImageFormat::bmp:
    case ImageFormat::ppm:
        return file_.reserve(components);
    }
}

void OutputFile::commit(const core::Film& film, core::Transfer transfer) {
    commit(film, {.transfer = transfer});
}

void OutputFile::commit(const core::Film& film, const ImageOptions& options,
                        const core::Aovs* aovs) {
    if (std::exchange(has_failed_, true) && !file_.restart())
        throw SystemRefused(file_.name(), "write", ESPIPE);
    switch (format_) {
    case ImageFormat::png:
        write_png(file_, film, options);
        break;
    case ImageFormat::tga:
    case ImageFormat::bmp:
    case ImageFormat::ppm:
        write_codes(film, options.transfer);
        break;
    case ImageFormat::hdr:
        write_hdr(film);
        break;
    case ImageFormat::pfm:
        write_pfm(film);
        break;
    case ImageFormat::exr:
        write_by(more_.exr, film, aovs, options);
        break;
    case ImageFormat::tiff:
        write_by(more_.tiff, film, aovs, options);
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
    if (format_ == ImageFormat::ppm) {
        file_.write("P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n");
        file_.write({reinterpret_cast<const char*>(codes.data()), codes.size()});
        return;
    }
    // Some readers of Targa do not support compression.
    static const int uncompressed = stbi_write_tga_with_rle = 0; // set once
    static_cast<void>(uncompressed);
    Sink sink{file_, nullptr};
    sink.finish(format_ == ImageFormat::tga
                    ? stbi_write_tga_to_func(&Sink::write, &sink, width, height, 3, codes.data())
                    : stbi_write_bmp_to_func(&Sink::write, &sink, width, height, 3, codes.data()));
}

void OutputFile::write_by(EncodeImage encode, const core::Film& film, const core::Aovs* aovs,
                          const ImageOptions& options) {
    try {
        file_.write(encode(film, aovs, options));
    } catch (const std::bad_alloc&) {
        throw SystemRefused(file_.name(), "write", ENOMEM);
    }
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

/// Writes Paul Debevec's format: rows from the bottom up, a negative scale for little-endian.
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
