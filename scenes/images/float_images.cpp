#include "scenes/images/float_images.hpp"

#include "core/scene/surroundings.hpp"
#include "scenes/files/number.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

namespace raylane::scenes {

namespace {

constexpr std::size_t longest_header_line = 1024;

unsigned char byte_of(ByteSource& source, const char* format) {
    const int byte = source.get();
    if (byte < 0) throw damaged(format);
    return static_cast<unsigned char>(byte);
}

unsigned char hdr_byte(ByteSource& source) {
    return byte_of(source, "HDR");
}

std::string header_line(ByteSource& source) {
    std::string line;
    for (unsigned char byte = hdr_byte(source); byte != '\n'; byte = hdr_byte(source)) {
        if (line.size() == longest_header_line) throw damaged("HDR");
        line.push_back(static_cast<char>(byte));
    }
    return line;
}

using Pixel = std::array<unsigned char, 4>; // red, green, blue, exponent

void add_pixel(std::vector<float>& rgb, const Pixel& pixel) {
    // The mantissa counts 256ths; the exponent's bias is 128.
    const float scale = pixel[3] == 0 ? 0.0F : std::ldexp(1.0F, pixel[3] - (128 + 8));
    for (int channel = 0; channel < 3; ++channel)
        rgb.push_back(static_cast<float>(pixel[channel]) * scale);
}

/// Reads one component of a row, which consists of runs of one byte and of literal bytes.
void read_runs(ByteSource& source, std::vector<Pixel>& row, int component) {
    constexpr std::size_t run_flag = 128;
    for (std::size_t x = 0; x < row.size();) {
        std::size_t count = hdr_byte(source);
        const bool run = count > run_flag;
        if (run) count -= run_flag;
        if (count == 0 || count > row.size() - x) throw damaged("HDR");
        unsigned char byte = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (i == 0 || !run) byte = hdr_byte(source);
            row[x++][component] = byte;
        }
    }
}

void read_row(ByteSource& source, std::vector<Pixel>& row) {
    const auto read_pixel = [&](Pixel& pixel) {
        for (unsigned char& component : pixel)
            component = hdr_byte(source);
    };
    read_pixel(row[0]);
    // No flat row begins like this: the largest component of its first pixel would be at least 128.
    const auto width = static_cast<std::size_t>(row[0][2]) << 8 | row[0][3];
    if (row[0][0] == 2 && row[0][1] == 2 && row[0][2] < 128 && width == row.size()) {
        for (int component = 0; component < 4; ++component)
            read_runs(source, row, component);
        return;
    }
    for (std::size_t x = 1; x < row.size(); ++x)
        read_pixel(row[x]);
    // In files older than 1991, 1 1 1 n is not a pixel but a repetition of the previous one.
    for (const Pixel& pixel : row)
        if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) throw damaged("HDR");
}

void take_size(Image& image, std::optional<int> width, std::optional<int> height,
               const char* format) {
    if (!width || !height) throw damaged(format);
    check_size(*width, *height);
    image.width = *width;
    image.height = *height;
}

std::string pfm_word(ByteSource& source) {
    std::string word;
    for (unsigned char byte = byte_of(source, "PFM"); byte > ' '; byte = byte_of(source, "PFM")) {
        if (word.size() == longest_header_line) throw damaged("PFM");
        word.push_back(static_cast<char>(byte));
    }
    return word;
}

} // namespace

MalformedImage damaged(const std::string& format) {
    return MalformedImage("must be a PNG, TIFF, EXR, HDR or PFM image, got a damaged " + format);
}

void check_size(std::int64_t width, std::int64_t height) {
    using core::Settings;
    const bool good = width >= 1 && height >= 1 && width <= Settings::max_size &&
                      height <= Settings::max_size && width * height <= Settings::max_pixels;
    if (!good)
        throw MalformedImage("must be an image of 1 to " + std::to_string(Settings::max_size) +
                             " pixels a side and at most " + std::to_string(Settings::max_pixels) +
                             " in total, got " + std::to_string(width) + " x " +
                             std::to_string(height));
}

void read_hdr(ByteSource& source, Image& image) {
    bool shared_exponent = false;
    for (std::string line = header_line(source); !line.empty(); line = header_line(source))
        shared_exponent = shared_exponent || line == "FORMAT=32-bit_rle_rgbe";
    const std::string size = header_line(source); // "-Y height +X width"
    const std::size_t plus = size.find(" +X ");
    if (!shared_exponent || !size.starts_with("-Y ") || plus == std::string::npos)
        throw damaged("HDR");
    take_size(image, to_int(std::string_view(size).substr(plus + 4)),
              to_int(std::string_view(size).substr(3, plus - 3)), "HDR");

    std::vector<float> rgb;
    std::vector<Pixel> row(image.width);
    for (int y = 0; y < image.height; ++y) {
        read_row(source, row);
        for (const Pixel& pixel : row)
            add_pixel(rgb, pixel);
    }
    image.rgb = Components(std::move(rgb));
}

void read_pfm(ByteSource& source, Image& image) {
    const std::string magic = pfm_word(source);
    if (magic != "PF" && magic != "Pf") throw damaged("PFM");
    const int channels = magic == "PF" ? 3 : 1;
    const std::string width = pfm_word(source);
    take_size(image, to_int(width), to_int(pfm_word(source)), "PFM");
    const std::optional<float> scale = to_float(pfm_word(source));
    if (!scale || *scale == 0.0F) throw damaged("PFM");
    const bool little_endian = *scale < 0.0F;

    std::vector<float> rgb;
    std::vector<char> row(std::size_t{4} * channels * image.width);
    for (int y = 0; y < image.height; ++y) {
        if (source.read(row) != row.size()) throw damaged("PFM");
        for (std::size_t i = 0; i < row.size(); i += 4) {
            std::uint32_t bits = 0;
            for (std::size_t k = 0; k < 4; ++k)
                bits = bits << 8 | static_cast<unsigned char>(row[i + (little_endian ? 3 - k : k)]);
            rgb.insert(rgb.end(), 3 / channels, std::bit_cast<float>(bits));
        }
    }
    const auto row_size = static_cast<std::ptrdiff_t>(3) * image.width;
    for (int y = 0; y < image.height / 2; ++y)
        std::swap_ranges(rgb.begin() + y * row_size, rgb.begin() + (y + 1) * row_size,
                         rgb.end() - (y + 1) * row_size);
    image.rgb = Components(std::move(rgb));
}

} // namespace raylane::scenes
