#include "core/scene/transfer.hpp"
#include "scenes/formats/pov/expressions.hpp"
#include "scenes/formats/pov/finishes.hpp"
#include "scenes/images/png.hpp"
#include "scenes/images/texture.hpp"

#include <cmath>
#include <new>

namespace raylane::scenes::pov {

namespace {

/// An image with more pixels costs too much for a single colour.
constexpr std::uint64_t max_pixels = std::uint64_t{1} << 26;

/// Returns the mean, weighted by alpha. `transmit` is 1 minus the mean alpha.
Tuple mean_of(const Image& image, bool is_linear) {
    const auto decoded = [&](float code) {
        if (!is_linear) return static_cast<double>(code);
        if (image.bits == 8)
            return static_cast<double>(
                core::decode_srgb(static_cast<std::uint8_t>(std::lround(code * 255.0F))));
        return core::linear_of_srgb(static_cast<double>(code));
    };
    const std::size_t count =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    Tuple sum{{}, 5};
    double weights = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double alpha = image.alpha.size() == 0 ? 1.0 : static_cast<double>(image.alpha[i]);
        weights += alpha;
        for (std::size_t channel = 0; channel < 3; ++channel)
            sum.at[channel] += alpha * decoded(image.rgb[3 * i + channel]);
    }
    if (weights > 0.0)
        for (std::size_t channel = 0; channel < 3; ++channel)
            sum.at[channel] /= weights;
    sum.at[4] = 1.0 - weights / static_cast<double>(count);
    return sum;
}

std::optional<Tuple> color_of_file(const std::filesystem::path& path, bool is_linear) {
    try {
        InputFile file(path);
        const std::uint64_t pixels = pixels_of_png(file.head());
        if (pixels == 0 || pixels > max_pixels) return std::nullopt;
        ByteSource source(file);
        Image image;
        read_png(source, image);
        return mean_of(image, is_linear);
    } catch (const std::bad_alloc&) {
    } catch (const std::runtime_error&) { // it is malformed, or cannot be read
    }
    return std::nullopt;
}

} // namespace

std::optional<Tuple> read_image_color(Tokens& tokens) {
    const Place place = tokens.peek().place;
    std::optional<std::filesystem::path> path;
    tokens.expect("{");
    while (!tokens.accept("}")) {
        if (at_string(tokens))
            path = tokens.file_beside(read_string(tokens), place);
        else if (tokens.at("{"))
            tokens.skip_braces();
        else if (const Token token = tokens.next(); token.kind == TokenKind::end)
            fail(token.place, "must be \"}\", got " + token.quoted());
    }
    if (!path) return std::nullopt;
    const bool is_linear = tokens.gamma() == 1.0;
    const auto [known, is_new] =
        tokens.image_colors.try_emplace({path->string(), is_linear}, std::nullopt);
    if (is_new) known->second = color_of_file(*path, is_linear);
    return known->second;
}

} // namespace raylane::scenes::pov
