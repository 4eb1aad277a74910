#include "scenes/image/png_writer.hpp"

#include "core/scene/transfer.hpp"
#include "scenes/errors.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <exception>
#include <new>
#include <png.h>
#include <zlib.h>

namespace raylane::scenes {

namespace {

/// Writes by libpng, which reports errors by a longjmp out of its functions. So no object with a
/// destructor may live across that jump, and no exception may pass through libpng.
class PngWriting {
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
    PngWriting(const PngWriting&) = delete;
    PngWriting& operator=(const PngWriting&) = delete;

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
        if (setjmp(png_jmpbuf(png_)) == 0) { // NOLINT: libpng's replacement for exceptions
            act();
            return;
        }
        if (failure_) std::rethrow_exception(failure_);
        throw std::bad_alloc(); // the only failure that is left
    }

    [[noreturn]] static void jump_on_error(png_structp png, png_const_charp) {
        png_longjmp(png, 1);
    }
    static void ignore(png_structp, png_const_charp) {}

    static void take(png_structp png, png_bytep bytes, std::size_t count) {
        auto& self = *static_cast<PngWriting*>(png_get_io_ptr(png));
        if (!self.write({reinterpret_cast<const char*>(bytes), count})) png_longjmp(png, 1);
    }
    bool write(std::span<const char> bytes) noexcept {
        try {
            file_.write(bytes);
            return true;
        } catch (...) {
            failure_ = std::current_exception();
            return false;
        }
    }

    AtomicFile& file_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    std::exception_ptr failure_;
};

/// Returns texts that point into the options. ASCII texts are marked as Latin-1, others as UTF-8.
std::vector<png_text> png_texts(const PictureOptions& options) {
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

/// Encodes the components of a row for the file, the high byte first.
class RowEncoder {
  public:
    explicit RowEncoder(const PictureOptions& options)
        : options_(options), encode_(options.transfer) {}

    int bits() const { return options_.bits == 16 ? 16 : 8; }

    const std::vector<std::uint8_t>& codes(const core::Film& film, int y) {
        codes_.clear();
        for (int x = 0; x < film.width(); ++x) {
            const float alpha = film.alpha_at(x, y);
            for (int channel = 0; channel < 3; ++channel)
                add(alpha > 0.0F ? film.at(x, y)[channel] / alpha : 0.0F);
            if (film.has_alpha()) add_alpha(alpha);
        }
        return codes_;
    }

  private:
    void add(float component) {
        if (bits() == 8)
            codes_.push_back(encode_(component));
        else
            add_word(core::encode_in_16_bits(component, options_.transfer));
    }
    /// Adds an alpha without a transfer curve, since it is a fraction and not light.
    void add_alpha(float alpha) {
        if (bits() == 8)
            codes_.push_back(core::encode(alpha, core::Transfer::linear));
        else
            add_word(core::encode_in_16_bits(alpha, core::Transfer::linear));
    }
    void add_word(std::uint16_t code) {
        codes_.push_back(static_cast<std::uint8_t>(code >> 8));
        codes_.push_back(static_cast<std::uint8_t>(code & 0xFF));
    }

    const PictureOptions& options_;
    core::Encoder encode_;
    std::vector<std::uint8_t> codes_;
};

} // namespace

void write_png(AtomicFile& file, const core::Film& film, const PictureOptions& options) {
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
