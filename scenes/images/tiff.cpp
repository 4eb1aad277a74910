#include "scenes/images/tiff.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/images/float_images.hpp"
#include "scenes/images/row_encoder.hpp"

namespace raylane::scenes {

bool looks_like_tiff(std::string_view head) {
    using namespace std::string_view_literals;
    return head.starts_with("II*\0"sv) || head.starts_with("MM\0*"sv);
}

} // namespace raylane::scenes

#ifndef RAYLANE_WITH_TIFF

namespace raylane::scenes {

bool has_tiff() {
    return false;
}

std::string tiff_of(const core::Film&, const core::Aovs*, const ImageOptions&) {
    throw BadInput("TIFF", "", "is not supported: raylane was built without libtiff-dev");
}

void read_tiff(const std::string&, Image&) {
    throw MalformedImage("must not be a TIFF: raylane was built without libtiff-dev");
}

std::string foreign_tag(std::string_view) {
    return {};
}

} // namespace raylane::scenes

#else

#include <algorithm>
#include <bit>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <sstream>
#include <tiffio.h>
#include <utility>
#include <vector>

namespace raylane::scenes {

namespace {

/// A file in memory, for libtiff. Its functions report failures by a size of 0, as no exception may
/// pass through libtiff.
struct MemoryTiff {
    std::string bytes;
    std::size_t position = 0;
    bool has_failed = false;

    static MemoryTiff& self(thandle_t handle) { return *static_cast<MemoryTiff*>(handle); }
    static tmsize_t read(thandle_t handle, void* to, tmsize_t size) {
        MemoryTiff& file = self(handle);
        const std::size_t count =
            std::min(static_cast<std::size_t>(size),
                     file.bytes.size() - std::min(file.position, file.bytes.size()));
        std::memcpy(to, file.bytes.data() + file.position, count);
        file.position += count;
        return static_cast<tmsize_t>(count);
    }
    static tmsize_t write(thandle_t handle, void* from, tmsize_t size) {
        MemoryTiff& file = self(handle);
        const auto count = static_cast<std::size_t>(size);
        try {
            if (file.bytes.size() < file.position + count) file.bytes.resize(file.position + count);
        } catch (const std::bad_alloc&) {
            file.has_failed = true;
            return 0;
        }
        std::memcpy(file.bytes.data() + file.position, from, count);
        file.position += count;
        return size;
    }
    static toff_t seek(thandle_t handle, toff_t offset, int from) {
        MemoryTiff& file = self(handle);
        const std::size_t start = from == SEEK_CUR   ? file.position
                                  : from == SEEK_END ? file.bytes.size()
                                                     : 0;
        file.position = start + static_cast<std::size_t>(offset);
        return file.position;
    }
    static int close(thandle_t) { return 0; }
    static toff_t size(thandle_t handle) { return self(handle).bytes.size(); }
};

struct CloseTiff {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using OwnedTiff = std::unique_ptr<TIFF, CloseTiff>;

/// libtiff's messages, which have no place in the output.
int ignore(TIFF*, void*, const char*, const char*, va_list) {
    return 1;
}

OwnedTiff open(MemoryTiff& file, const char* mode) {
    const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
        TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
    if (options == nullptr) throw std::bad_alloc();
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), ignore, nullptr);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore, nullptr);
    return OwnedTiff(TIFFClientOpenExt("image", mode, &file, &MemoryTiff::read, &MemoryTiff::write,
                                       &MemoryTiff::seek, &MemoryTiff::close, &MemoryTiff::size,
                                       nullptr, nullptr, options.get()));
}

void require(bool success) {
    if (!success) throw std::bad_alloc(); // the only failure in memory
}

/// Sets the texts: one tag each for Title and Software, and one for the others.
void set_texts(TIFF* tiff, const ImageOptions& options) {
    std::string others;
    for (const auto& [name, text] : options.texts)
        if (name == "Title")
            TIFFSetField(tiff, TIFFTAG_DOCUMENTNAME, text.c_str());
        else if (name == "Software")
            TIFFSetField(tiff, TIFFTAG_SOFTWARE, text.c_str());
        else
            others.append(others.empty() ? "" : "\n").append(name).append(": ").append(text);
    if (!others.empty()) TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, others.c_str());
}

void set_fields(TIFF* tiff, const core::Film& film, int bits, const ImageOptions& options) {
    const int samples = film.has_alpha() ? 4 : 3;
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(film.width()));
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(film.height()));
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, samples);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_LZW);
    TIFFSetField(tiff, TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
    const int row = film.width() * samples * bits / 8;
    constexpr int bytes_of_strip = 1 << 16;
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP,
                 static_cast<std::uint32_t>(std::max(1, bytes_of_strip / row)));
    if (film.has_alpha()) {
        const std::uint16_t unassociated = EXTRASAMPLE_UNASSALPHA;
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &unassociated);
    }
    if (options.dpi) {
        TIFFSetField(tiff, TIFFTAG_XRESOLUTION, static_cast<double>(*options.dpi));
        TIFFSetField(tiff, TIFFTAG_YRESOLUTION, static_cast<double>(*options.dpi));
        TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
    }
    set_texts(tiff, options);
}

/// The names of texts that are lines of one tag.
constexpr std::string_view line_names[] = {"Comment", "Film",   "Part", "Scene",
                                           "Options", "Pixels", "Rays"};

/// Reads the texts that set_texts() writes. A line that begins with no name continues a text.
void read_texts(TIFF* tiff, Image& image) {
    const auto text_of = [&](std::uint32_t tag) {
        const char* text = nullptr;
        return TIFFGetField(tiff, tag, &text) == 1 ? std::string(text) : std::string();
    };
    for (const auto& [name, tag] :
         {std::pair{"Title", TIFFTAG_DOCUMENTNAME}, std::pair{"Software", TIFFTAG_SOFTWARE}})
        if (std::string text = text_of(tag); !text.empty())
            image.texts.emplace_back(name, std::move(text));
    const std::size_t before = image.texts.size();
    std::istringstream lines(text_of(TIFFTAG_IMAGEDESCRIPTION));
    for (std::string line; std::getline(lines, line);) {
        const auto* const name =
            std::find_if(std::begin(line_names), std::end(line_names), [&](std::string_view title) {
                return line.starts_with(std::string(title) + ": ");
            });
        if (name != std::end(line_names))
            image.texts.emplace_back(*name, line.substr(name->size() + 2));
        else if (image.texts.size() > before)
            image.texts.back().second += "\n" + line;
    }
}

/// Returns the pixels of rows in the order of an image's rows, of which `image` has the turned
/// size: the first row or the first column may be at any edge (TIFF 6.0, section 8, Orientation).
template <class Code>
std::vector<Code> turned(std::vector<Code> codes, std::size_t channels, const Image& image,
                         int orientation) {
    if (orientation <= ORIENTATION_TOPLEFT || orientation > ORIENTATION_LEFTBOT) return codes;
    const auto is_one_of = [&](std::initializer_list<int> values) {
        return std::find(values.begin(), values.end(), orientation) != values.end();
    };
    const bool from_right = is_one_of(
        {ORIENTATION_TOPRIGHT, ORIENTATION_BOTRIGHT, ORIENTATION_RIGHTTOP, ORIENTATION_RIGHTBOT});
    const bool from_below = is_one_of(
        {ORIENTATION_BOTRIGHT, ORIENTATION_BOTLEFT, ORIENTATION_RIGHTBOT, ORIENTATION_LEFTBOT});
    const bool has_columns = orientation >= ORIENTATION_LEFTTOP; // in place of rows
    const auto width = static_cast<std::size_t>(image.width),
               height = static_cast<std::size_t>(image.height);
    std::vector<Code> result;
    result.reserve(codes.size());
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t across = from_right ? width - 1 - x : x;
            const std::size_t down = from_below ? height - 1 - y : y;
            const std::size_t pixel = has_columns ? across * height + down : down * width + across;
            result.insert(result.end(), &codes[channels * pixel],
                          &codes[channels * pixel] + channels);
        }
    return result;
}

/// Reads rows of codes of one type.
template <class Code>
void read_codes(TIFF* tiff, Image& image, bool has_alpha) {
    std::uint16_t orientation = 0;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &orientation);
    const auto width = static_cast<std::size_t>(image.width);
    const std::size_t channels = has_alpha ? 4 : 3;
    std::vector<Code> rgb, alpha, row(channels * width);
    if (TIFFScanlineSize(tiff) != static_cast<tmsize_t>(row.size() * sizeof(Code)))
        throw damaged("TIFF");
    for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(image.height); ++y) {
        if (TIFFReadScanline(tiff, row.data(), y, 0) != 1) throw damaged("TIFF");
        for (std::size_t x = 0; x < width; ++x) {
            rgb.insert(rgb.end(), &row[channels * x], &row[channels * x] + 3);
            if (has_alpha) alpha.push_back(row[channels * x + 3]);
        }
    }
    if (orientation >= ORIENTATION_LEFTTOP) std::swap(image.width, image.height);
    image.rgb = Components(turned(std::move(rgb), 3, image, orientation));
    if (has_alpha) image.alpha = Components(turned(std::move(alpha), 1, image, orientation));
}

} // namespace

void read_tiff(const std::string& bytes, Image& image) {
    MemoryTiff file{bytes};
    const OwnedTiff tiff = open(file, "r");
    if (tiff == nullptr) throw damaged("TIFF");
    std::uint32_t width = 0, height = 0;
    TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
    const auto number = [&](std::uint32_t tag) {
        std::uint16_t value = 0;
        TIFFGetFieldDefaulted(tiff.get(), tag, &value);
        return value;
    };
    const int bits = number(TIFFTAG_BITSPERSAMPLE), channels = number(TIFFTAG_SAMPLESPERPIXEL);
    std::uint16_t count = 0;
    const std::uint16_t* kinds = nullptr;
    TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds);
    const bool has_alpha = channels == 4 && count == 1 && kinds[0] == EXTRASAMPLE_UNASSALPHA;
    if ((channels != 3 && !has_alpha) || (bits != 8 && bits != 16) ||
        number(TIFFTAG_PHOTOMETRIC) != PHOTOMETRIC_RGB ||
        number(TIFFTAG_PLANARCONFIG) != PLANARCONFIG_CONTIG ||
        number(TIFFTAG_SAMPLEFORMAT) != SAMPLEFORMAT_UINT || TIFFIsTiled(tiff.get()) != 0)
        throw MalformedImage("must be a TIFF of RGB, or of RGB and a separate alpha, with 8 or 16 "
                             "bits, in strips");
    check_size(width, height);
    image.width = static_cast<int>(width);
    image.height = static_cast<int>(height);
    image.bits = bits;
    read_texts(tiff.get(), image);
    if (bits == 8)
        read_codes<std::uint8_t>(tiff.get(), image, has_alpha);
    else
        read_codes<std::uint16_t>(tiff.get(), image, has_alpha);
}

std::string foreign_tag(std::string_view bytes) {
    constexpr unsigned known[] = {
        TIFFTAG_IMAGEWIDTH,       TIFFTAG_IMAGELENGTH,  TIFFTAG_BITSPERSAMPLE,
        TIFFTAG_COMPRESSION,      TIFFTAG_PHOTOMETRIC,  TIFFTAG_DOCUMENTNAME,
        TIFFTAG_IMAGEDESCRIPTION, TIFFTAG_STRIPOFFSETS, TIFFTAG_ORIENTATION,
        TIFFTAG_SAMPLESPERPIXEL,  TIFFTAG_ROWSPERSTRIP, TIFFTAG_STRIPBYTECOUNTS,
        TIFFTAG_XRESOLUTION,      TIFFTAG_YRESOLUTION,  TIFFTAG_PLANARCONFIG,
        TIFFTAG_RESOLUTIONUNIT,   TIFFTAG_SOFTWARE,     TIFFTAG_PREDICTOR,
        TIFFTAG_EXTRASAMPLES};
    const auto number = [&](std::size_t at, std::size_t size) {
        std::size_t value = 0;
        for (std::size_t i = size; i-- > 0;)
            value =
                value << 8 | static_cast<unsigned char>(at + i < bytes.size() ? bytes[at + i] : 0);
        return value;
    };
    if (!bytes.starts_with("II")) return "byte order MM";
    constexpr std::size_t entry_size = 12, value_at = 8;
    const std::size_t directory = number(4, 4), count = number(directory, 2);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = directory + 2 + entry_size * i, tag = number(at, 2);
        const bool is_turned =
            tag == TIFFTAG_ORIENTATION && number(at + value_at, 2) != ORIENTATION_TOPLEFT;
        if (is_turned || std::find(std::begin(known), std::end(known), tag) == std::end(known))
            return "tag " + std::to_string(tag);
    }
    return number(directory + 2 + entry_size * count, 4) != 0 ? "a second image" : "";
}

bool has_tiff() {
    return true;
}

std::string tiff_of(const core::Film& film, const core::Aovs*, const ImageOptions& options) {
    MemoryTiff file;
    // Little-endian on all machines, so that the file has the same bytes.
    OwnedTiff tiff = open(file, "wl");
    require(tiff != nullptr);
    RowEncoder encoder(options);
    set_fields(tiff.get(), film, encoder.bits(), options);
    std::vector<std::uint8_t> row;
    for (int y = 0; y < film.height(); ++y) {
        row = encoder.codes(film, y);
        // libtiff takes numbers in the machine's order.
        if (encoder.bits() == 16 && std::endian::native == std::endian::little)
            for (std::size_t i = 0; i + 1 < row.size(); i += 2)
                std::swap(row[i], row[i + 1]);
        require(TIFFWriteScanline(tiff.get(), row.data(), static_cast<std::uint32_t>(y), 0) == 1);
    }
    tiff.reset(); // writes the rest
    require(!file.has_failed);
    return std::move(file.bytes);
}

} // namespace raylane::scenes

#endif
