#include "scenes/images/tiff.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/images/row_encoder.hpp"

#ifndef RAYLANE_WITH_TIFF

namespace raylane::scenes {

bool has_tiff() {
    return false;
}

std::string tiff_of(const core::Film&, const core::Layers*, const ImageOptions&) {
    throw BadInput("TIFF", "", "is not supported: raylane was built without libtiff-dev");
}

} // namespace raylane::scenes

#else

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <tiffio.h>

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

} // namespace

bool has_tiff() {
    return true;
}

std::string tiff_of(const core::Film& film, const core::Layers*, const ImageOptions& options) {
    MemoryTiff file;
    // Little-endian on all machines, so that the file has the same bytes.
    std::unique_ptr<TIFF, CloseTiff> tiff(
        TIFFClientOpen("image", "wl", &file, &MemoryTiff::read, &MemoryTiff::write,
                       &MemoryTiff::seek, &MemoryTiff::close, &MemoryTiff::size, nullptr, nullptr));
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
