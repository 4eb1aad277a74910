#include "scenes/image/png_reader.hpp"

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <png.h>
#include <utility>

namespace raylane::scenes {

namespace {

/// Reads by libpng, which reports errors by a longjmp out of its functions. So no object with a
/// destructor may live across that jump, and no exception may pass through libpng.
class PngReading {
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
    PngReading(const PngReading&) = delete;
    PngReading& operator=(const PngReading&) = delete;

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
        if (setjmp(png_jmpbuf(png_)) == 0) { // NOLINT: libpng's replacement for exceptions
            act();
            return;
        }
        if (failure_) std::rethrow_exception(failure_);
        if (memory_refused_) throw std::bad_alloc();
        throw damaged("PNG");
    }

    static PngReading& self(png_voidp pointer) { return *static_cast<PngReading*>(pointer); }

    [[noreturn]] static void jump_on_error(png_structp png, png_const_charp) {
        png_longjmp(png, 1);
    }
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
        if (!self(png_get_io_ptr(png)).fill({reinterpret_cast<char*>(bytes), count}))
            png_longjmp(png, 1);
    }
    bool fill(std::span<char> bytes) noexcept {
        try {
            return source_.read(bytes) == bytes.size();
        } catch (...) {
            failure_ = std::current_exception();
            return false;
        }
    }

    ByteSource& source_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    std::exception_ptr failure_;
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

} // namespace

void read_png(ByteSource& source, Image& image) {
    PngReading reading(source);
    reading.begin();
    check_size(reading.width, reading.height);
    image.width = static_cast<int>(reading.width);
    image.height = static_cast<int>(reading.height);
    constexpr int most_bits_of_a_byte = 8;
    image.bits = std::max(reading.bits, most_bits_of_a_byte);
    if (image.bits > most_bits_of_a_byte)
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

} // namespace raylane::scenes
