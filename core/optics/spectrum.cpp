#include "core/optics/spectrum.hpp"

#include "core/numbers/elementary.hpp"

#include <algorithm>

namespace raylane::core {

namespace {

double lobe(double wavelength, double peak, double below, double above) {
    const double off = (wavelength - peak) / (wavelength < peak ? below : above);
    return core::exp(-0.5 * off * off);
}

Vec3d linear_rgb(double w) {
    const double x = 1.056 * lobe(w, 599.8, 37.9, 31.0) + 0.362 * lobe(w, 442.0, 16.0, 26.7) -
                     0.065 * lobe(w, 501.1, 20.4, 26.2);
    const double y = 0.821 * lobe(w, 568.8, 46.9, 40.5) + 0.286 * lobe(w, 530.9, 16.3, 31.1);
    const double z = 1.217 * lobe(w, 437.0, 11.8, 36.0) + 0.681 * lobe(w, 459.0, 26.0, 13.8);
    return {3.2406 * x - 1.5372 * y - 0.4986 * z, -0.9689 * x + 1.8758 * y + 0.0415 * z,
            0.0557 * x - 0.2040 * y + 1.0570 * z};
}

} // namespace

std::vector<Color> shares_of(std::span<const double> wavelengths) {
    std::vector<Vec3d> shares;
    Vec3d sum(0.0);
    for (const double wavelength : wavelengths) {
        Vec3d color = linear_rgb(wavelength);
        for (int channel = 0; channel < 3; ++channel)
            color[channel] = std::max(color[channel], 0.0);
        shares.push_back(color);
        sum += color;
    }
    std::vector<Color> result;
    for (const Vec3d& share : shares) {
        Color color;
        for (int channel = 0; channel < 3; ++channel)
            color[channel] =
                static_cast<float>(sum[channel] > 0.0 ? share[channel] / sum[channel]
                                                      : 1.0 / static_cast<double>(shares.size()));
        result.push_back(color);
    }
    return result;
}

} // namespace raylane::core
