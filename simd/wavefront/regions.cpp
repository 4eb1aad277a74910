#include "simd/wavefront/wavefront.hpp"

#include <algorithm>
#include <array>

namespace raylane::simd {

namespace {

/// Returns every second bit of a Morton code.
constexpr int even_bits(unsigned code) {
    int result = 0;
    for (int bit = 0; bit < 8; ++bit)
        result |= static_cast<int>(code >> 2 * bit & 1U) << bit;
    return result;
}

/// The pixels of a region in the order of their Morton codes, so that neighbours in the image are
/// neighbours in a packet.
constexpr auto pixel_order = [] {
    struct Pixel {
        std::uint8_t x, y;
    };
    constexpr unsigned codes = Wavefront::max_region * Wavefront::max_region;
    std::array<Pixel, codes> order{};
    for (unsigned code = 0; code < codes; ++code)
        order[code] = {static_cast<std::uint8_t>(even_bits(code)),
                       static_cast<std::uint8_t>(even_bits(code >> 1))};
    return order;
}();

} // namespace

void Wavefront::render(const core::Region& region, core::Film& film) {
    if (settings_.quality == 0.0F)
        render_grid(region, film);
    else
        render_to_quality(region, film);
}

/// Takes the number of samples per pixel that the settings' grid gives.
void Wavefront::render_grid(const core::Region& region, core::Film& film) {
    const int samples = settings_.grid * settings_.grid;
    sums_.assign(static_cast<std::size_t>(region.pixels()), core::Vec3d(0.0));
    if (settings_.alpha) transmittances_.assign(sums_.size(), 0.0);
    const auto add = [&](const Samples& pixel_samples, std::size_t i) {
        const std::size_t end = i + static_cast<std::size_t>(pixel_samples.count);
        if (settings_.alpha)
            for (std::size_t k = i; k < end; ++k)
                transmittances_[pixel_samples.pixel] += transmittance_[k];
        core::Vec3d& total = sums_[pixel_samples.pixel];
        core::Vec3d sum = total;
        for (; i < end; ++i)
            sum += core::Vec3d(radiance_[0][i], radiance_[1][i], radiance_[2][i]);
        total = sum;
    };
    for_each_pixel(region, [&](int x, int y, std::size_t pixel) {
        take({x, y, pixel, 0, samples}, add);
    });
    flush(add);
    if (is_abandoned()) return;
    std::size_t pixel = 0;
    for (int y = region.y0; y < region.y1; ++y)
        for (int x = region.x0; x < region.x1; ++x, ++pixel) {
            film.at(x, y) = core::convert<float>(sums_[pixel] / static_cast<double>(samples));
            if (film.has_alpha())
                film.alpha_at(x, y) =
                    static_cast<float>(1.0 - transmittances_[pixel] / static_cast<double>(samples));
        }
}

/// Returns a function that adds traced samples to the pixels that requested them.
template <class Pixels>
auto Wavefront::adder_to(Pixels& pixels) {
    return [this, &pixels](const Samples& pixel_samples, std::size_t i) {
        for (const std::size_t end = i + static_cast<std::size_t>(pixel_samples.count); i < end;
             ++i)
            pixels.add(pixel_samples.pixel, {{radiance_[0][i], radiance_[1][i], radiance_[2][i]},
                                             first_shape_[i],
                                             settings_.alpha ? transmittance_[i] : 0.0,
                                             cost_[i]});
    };
}

void Wavefront::begin_samples(int common) {
    if (common == common_samples_) return;
    common_samples_ = common;
    cells_.clear();
    for (int number = -common; number < 0; ++number) {
        const core::SamplePoint place = core::place_in_grid(number, common);
        cells_.push_back(
            camera_rays_.filtered({static_cast<double>(place.x), static_cast<double>(place.y)}));
    }
}

void Wavefront::survey(core::Survey::Pass pass, std::size_t batch) {
    if (batch >= survey_->batches(pass)) return;
    core::Survey::Samples pixels(*survey_, pass, batch);
    const auto add = adder_to(pixels);
    is_surveying_ = true;
    do {
        begin_samples(pixels.common());
        for (std::size_t pixel = 0; pixel < pixels.pixels(); ++pixel)
            take(
                {pixels.x(pixel), pixels.y(pixel), pixel, pixels.next(pixel), pixels.wanted(pixel)},
                add);
        flush(add);
    } while (!is_abandoned() && pixels.end_round());
    is_surveying_ = false;
}

/// Takes the samples that each pixel still wants, round after round.
void Wavefront::render_to_quality(const core::Region& region, core::Film& film) {
    core::RegionSamples& pixels = *to_quality_;
    const auto add = adder_to(pixels);
    pixels.begin(region);
    do {
        begin_samples(pixels.common());
        for_each_pixel(region, [&](int x, int y, std::size_t pixel) {
            take({x, y, pixel, pixels.next(pixel), pixels.wanted(pixel)}, add);
        });
        flush(add);
        if (is_abandoned()) return;
    } while (pixels.end_round());
    std::size_t pixel = 0;
    for (int y = region.y0; y < region.y1; ++y)
        for (int x = region.x0; x < region.x1; ++x, ++pixel) {
            film.at(x, y) = pixels.mean(pixel);
            if (film.has_alpha()) film.alpha_at(x, y) = pixels.alpha(pixel);
        }
}

/// Calls visit(x, y, number in the region, row by row) in the order of Morton codes.
template <class Visit>
void Wavefront::for_each_pixel(const core::Region& region, const Visit& visit) {
    const int width = region.x1 - region.x0;
    for (const auto& pixel : pixel_order) {
        const int x = region.x0 + pixel.x, y = region.y0 + pixel.y;
        if (x < region.x1 && y < region.y1)
            visit(x, y, static_cast<std::size_t>(pixel.y) * static_cast<unsigned>(width) + pixel.x);
    }
}

/// Adds samples to the chunk and traces it whenever it is full. Calls add(samples, index of the
/// first in the chunk) for traced samples.
template <class Add>
void Wavefront::take(Samples samples, const Add& add) {
    while (samples.count != 0) {
        Samples pixel_samples = samples;
        pixel_samples.count = std::min(samples.count, static_cast<int>(chunk_samples - filled_));
        samples_.push_back(pixel_samples);
        filled_ += static_cast<std::size_t>(pixel_samples.count);
        samples.first += pixel_samples.count;
        samples.count -= pixel_samples.count;
        if (filled_ == chunk_samples) flush(add);
    }
}

template <class Add>
void Wavefront::flush(const Add& add) {
    if (filled_ == 0) return;
    if (!is_abandoned()) {
        start(filled_);
        trace();
        std::size_t i = 0;
        for (const Samples& pixel_samples : samples_) {
            add(pixel_samples, i);
            i += static_cast<std::size_t>(pixel_samples.count);
        }
    }
    samples_.clear();
    filled_ = 0;
}

} // namespace raylane::simd
