#include "scenes/images/png.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/images/float_images.hpp"
#include "scenes/images/row_encoder.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <png.h>
#include <utility>
#include <zlib.h>

namespace raylane::scenes {

namespace {

/// Steps of libpng, which reports errors by a longjmp out of its functions. So no object with a
/// destructor may live across that jump, and no exception may pass through libpng.
class PngSteps {
  public:
    PngSteps() = default;
    PngSteps(const PngSteps&) = delete;
    PngSteps& operator=(const PngSteps&) = delete;

  protected:
    /// Calls act(). Throws the exception that call_back() has caught; without one, calls fail().
    template <class Act, class Fail>
    void step(const Act& act, const Fail& fail) {
        if (setjmp(png_jmpbuf(png_)) == 0) { // NOLINT: libpng's replacement for exceptions
            act();
            return;
        }
        if (failure_) std::rethrow_exception(failure_);
        fail();
    }
    /// Calls act() from within libpng, and jumps out of it if act() throws or returns false.
    template <class Act>
    void call_back(const Act& act) {
        if (!succeeds(act)) png_longjmp(png_, 1);
    }
    [[noreturn]] static void jump_on_error(png_structp png, png_const_charp) {
        png_longjmp(png, 1);
    }

    png_structp png_ = nullptr;
    png_infop info_ = nullptr;

  private:
    template <class Act>
    bool succeeds(const Act& act) noexcept {
        try {
            return act();
        } catch (...) {
            failure_ = std::current_exception();
            return false;
        }
    }

    std::exception_ptr failure_;
};

class PngReading : PngSteps {
  public:
    explicit PngReading(ByteSource& source) : source_(source) {
        png_ = png_create_read_struct_2(PNG_LIBPNG_VER_STRING, this, &jump_on_error,
                                        &look_at_warning, this, &allocate, &release);
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw std::bad_alloc();
        }
        png_set_read_fn(png_, this, &feed);
    }
    ~PngReading() { png_destroy_read_struct(&png_, &info_, nullptr); }

    /// Reads width, height, bits per component and whether there is an alpha.
    void begin() {
        step([this] {
            png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
            png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX); // check_size() checks
            png_read_info(png_, info_);
            png_get_IHDR(png_, info_, &width, &height, &bits, &color_type, nullptr, nullptr,
                         nullptr);
            has_alpha = (color_type & PNG_COLOR_MASK_ALPHA) != 0 ||
                        png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
        });
    }
    std::size_t channels() const { return has_alpha ? 4 : 3; }

    /// Reads all pixels as RGB or RGBA. `rows`: one pointer per row.
    template <class Code>
    void read(Code** rows) {
        step([this, rows] {
            png_set_expand(png_);
            if ((color_type & PNG_COLOR_MASK_COLOR) == 0) png_set_gray_to_rgb(png_);
            if constexpr (sizeof(Code) == 2 && std::endian::native == std::endian::little)
                png_set_swap(png_);
            const int passes = png_set_interlace_handling(png_);
            png_read_update_info(png_, info_);
            if (png_get_rowbytes(png_, info_) != channels() * width * sizeof(Code))
                png_error(png_, "rows of another length");
            for (int pass = 0; pass < passes; ++pass)
                for (png_uint_32 y = 0; y < height; ++y)
                    png_read_row(png_, reinterpret_cast<png_bytep>(rows[y]), nullptr);
            png_read_end(png_, info_);
        });
    }
    /// Returns the texts read so far.
    std::vector<std::pair<std::string, std::string>> texts() {
        png_textp first = nullptr;
        const int count = png_get_text(png_, info_, &first, nullptr);
        std::vector<std::pair<std::string, std::string>> texts;
        texts.reserve(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i)
            texts.emplace_back(first[i].key,
                               std::string(first[i].text, first[i].compression > 0
                                                              ? first[i].itxt_length
                                                              : first[i].text_length));
        return texts;
    }

    png_uint_32 width = 0, height = 0;
    int bits = 0, color_type = 0;
    bool has_alpha = false;

  private:
    template <class Act>
    void step(const Act& act) {
        PngSteps::step(act, [this] {
            if (memory_refused_) throw std::bad_alloc();
            throw damaged("PNG");
        });
    }

    static PngReading& self(png_voidp pointer) { return *static_cast<PngReading*>(pointer); }

    /// Treats data after that of the last row as an error. libpng only warns of it, and it may be
    /// gigabytes.
    static void look_at_warning(png_structp png, png_const_charp message) {
        if (std::strncmp(message, "IDAT", 4) == 0) png_longjmp(png, 1);
    }
    static png_voidp allocate(png_structp png, png_alloc_size_t size) {
        void* const memory = std::malloc(size);
        if (memory == nullptr) self(png_get_mem_ptr(png)).memory_refused_ = true;
        return memory;
    }
    static void release(png_structp, png_voidp memory) { std::free(memory); }

    static void feed(png_structp png, png_bytep bytes, std::size_t count) {
        PngReading& reading = self(png_get_io_ptr(png));
        reading.call_back([&] {
            return reading.source_.read({reinterpret_cast<char*>(bytes), count}) == count;
        });
    }

    ByteSource& source_;
    bool memory_refused_ = false;
};

template <class Code>
void read_codes(PngReading& reading, Image& image) {
    const std::size_t row = reading.channels() * reading.width;
    std::vector<Code> codes(row * reading.height);
    std::vector<Code*> rows(reading.height);
    for (std::size_t y = 0; y < rows.size(); ++y)
        rows[y] = codes.data() + y * row;
    reading.read(rows.data());
    if (reading.has_alpha) {
        std::vector<Code> alpha(codes.size() / 4);
        for (std::size_t pixel = 0; pixel < alpha.size(); ++pixel) {
            alpha[pixel] = codes[4 * pixel + 3];
            std::copy_n(&codes[4 * pixel], 3, &codes[3 * pixel]);
        }
        codes.resize(3 * alpha.size());
        image.alpha = Components(std::move(alpha));
    }
    image.rgb = Components(std::move(codes));
}

class PngWriting : PngSteps {
  public:
    explicit PngWriting(AtomicFile& file) : file_(file) {
        png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, &jump_on_error, &ignore);
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) {
            png_destroy_write_struct(&png_, nullptr);
            throw std::bad_alloc();
        }
        png_set_write_fn(png_, this, &take, nullptr);
    }
    ~PngWriting() { png_destroy_write_struct(&png_, &info_); }

    /// Writes everything before the rows. `metre`: pixels per metre; 0 if unknown.
    void begin(const core::Film& film, int bits, png_uint_32 metre, std::vector<png_text>& texts) {
        step([&] {
            png_set_IHDR(png_, info_, static_cast<png_uint_32>(film.width()),
                         static_cast<png_uint_32>(film.height()), bits,
                         film.has_alpha() ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                         PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
            // Searching the best filter for each row takes longer than the rest and saves next to
            // nothing. The data that this filter leaves compresses by run lengths as well as by
            // zlib's lowest level, in three quarters of the time.
            png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
            png_set_compression_level(png_, Z_BEST_SPEED);
            png_set_compression_strategy(png_, Z_RLE);
            png_set_compression_mem_level(png_, 9);
            png_set_compression_buffer_size(png_, std::size_t{1} << 20);
            if (metre != 0) png_set_pHYs(png_, info_, metre, metre, PNG_RESOLUTION_METER);
            if (!texts.empty())
                png_set_text(png_, info_, texts.data(), static_cast<int>(texts.size()));
            png_write_info(png_, info_);
        });
    }
    void row(const std::vector<std::uint8_t>& codes) {
        step([&] { png_write_row(png_, codes.data()); });
    }
    void end() {
        step([&] { png_write_end(png_, nullptr); });
    }

  private:
    template <class Act>
    void step(const Act& act) {
        PngSteps::step(act, [] { throw std::bad_alloc(); }); // the only failure that is left
    }

    static void ignore(png_structp, png_const_charp) {}

    static void take(png_structp png, png_bytep bytes, std::size_t count) {
        auto& writing = *static_cast<PngWriting*>(png_get_io_ptr(png));
        writing.call_back([&] {
            writing.file_.write({reinterpret_cast<const char*>(bytes), count});
            return true;
        });
    }

    AtomicFile& file_;
};

/// Returns texts that point into the options. ASCII texts are marked as Latin-1, others as UTF-8.
std::vector<png_text> png_texts(const ImageOptions& options) {
    std::vector<png_text> texts;
    for (const auto& [name, content] : options.texts) {
        const bool is_plain = std::all_of(content.begin(), content.end(),
                                          [](char c) { return static_cast<signed char>(c) > 0; });
        png_text text{};
        text.compression = is_plain ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
        text.key = const_cast<char*>(name.c_str()); // NOLINT: libpng copies it
        text.text = const_cast<char*>(content.c_str());
        (is_plain ? text.text_length : text.itxt_length) = content.size();
        texts.push_back(text);
    }
    return texts;
}

} // namespace

void read_png(ByteSource& source, Image& image) {
    PngReading reading(source);
    reading.begin();
    check_size(reading.width, reading.height);
    image.width = static_cast<int>(reading.width);
    image.height = static_cast<int>(reading.height);
    constexpr int max_bits_of_a_byte = 8;
    image.bits = std::max(reading.bits, max_bits_of_a_byte);
    if (image.bits > max_bits_of_a_byte)
        read_codes<std::uint16_t>(reading, image);
    else
        read_codes<std::uint8_t>(reading, image);
    if (source.get() >= 0) throw damaged("PNG");
    image.texts = reading.texts();
}

std::string foreign_chunk(std::string_view bytes) {
    constexpr std::string_view written[] = {"IHDR", "pHYs", "tEXt", "iTXt", "IDAT", "IEND"};
    constexpr std::string_view texts[] = {"Title", "Software", "Comment", "Film", "Part",
                                          "Scene", "Options",  "Pixels",  "Rays"};
    bool has_text[std::size(texts)] = {};
    constexpr std::size_t signature = 8, length_and_type = 8, checksum = 4;
    for (std::size_t at = signature; at + length_and_type <= bytes.size();) {
        std::size_t length = 0;
        for (std::size_t byte = at; byte < at + 4; ++byte)
            length = length << 8 | static_cast<unsigned char>(bytes[byte]);
        const std::string_view type = bytes.substr(at + 4, 4);
        const std::string_view data = bytes.substr(at + length_and_type, length);
        const bool is_stretched =
            type == "pHYs" && (data.size() < 8 || data.substr(0, 4) != data.substr(4, 4));
        if (is_stretched ||
            std::find(std::begin(written), std::end(written), type) == std::end(written))
            return std::string(type);
        if (type == "tEXt" || type == "iTXt") {
            const std::string_view key = data.substr(0, data.find('\0'));
            const auto* const text = std::find(std::begin(texts), std::end(texts), key);
            if (text == std::end(texts) || std::exchange(has_text[text - std::begin(texts)], true))
                return std::string(type) + " " + std::string(key);
        }
        at += length_and_type + length + checksum;
    }
    return {};
}

void write_png(AtomicFile& file, const core::Film& film, const ImageOptions& options) {
    constexpr double inch = 0.0254; // metres
    try {
        RowEncoder encoder(options);
        std::vector<png_text> texts = png_texts(options);
        PngWriting writing(file);
        const double metre = options.dpi ? static_cast<double>(*options.dpi) / inch : 0.0;
        writing.begin(film, encoder.bits(), static_cast<png_uint_32>(std::lround(metre)), texts);
        for (int y = 0; y < film.height(); ++y)
            writing.row(encoder.codes(film, y));
        writing.end();
    } catch (const std::bad_alloc&) {
        throw SystemRefused(file.name(), "write", ENOMEM);
    }
}

} // namespace raylane::scenes
