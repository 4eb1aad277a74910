#pragma once

#include "core/numbers/elementary.hpp"
#include "core/numbers/sample_sequence.hpp"
#include "core/scene/field_of_view.hpp"
#include "core/scene/pixel_filter.hpp"
#include "core/scene/surroundings.hpp"
#include "core/shapes/ray.hpp"

#include <cstdint>

namespace raylane::core {

/// Returns the position of a sample in its cell of the grid. It depends on pixel and sample alone,
/// whatever is rendered around it.
inline SamplePoint sample_point(SamplePattern pattern, std::uint32_t x, std::uint32_t y,
                                std::uint32_t sample) {
    if (pattern == SamplePattern::regular) return {0.5F, 0.5F};
    // SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014),
    // keyed by all three.
    std::uint64_t z = (static_cast<std::uint64_t>(y) << 32 | x) * 0x9E3779B97F4A7C15ULL + sample;
    for (int round = 0; round < 2; ++round) {
        z += 0x9E3779B97F4A7C15ULL;
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ z >> 27) * 0x94D049BB133111EBULL;
        z ^= z >> 31;
    }
    return {static_cast<float>(z >> 40) * 0x1p-24F, static_cast<float>(z & 0xFFFFFF) * 0x1p-24F};
}

/// Generates the camera rays of an image: unit directions, from the camera's position or, if
/// orthographic, its plane.
template <class Real>
class CameraRays {
  public:
    CameraRays(const Camera& camera, const Settings& settings)
        : grid_(settings.grid), pattern_(settings.samples),
          filter_(settings.filter == PixelFilter::box ? nullptr
                                                      : &FilterPlaces::of(settings.filter)),
          orthographic_(camera.projection == Projection::orthographic), width_(settings.width),
          height_(settings.height), lens_radius_(static_cast<double>(camera.lens_radius)) {
        const Vec3d from = convert<double>(camera.from);
        const Vec3d forward = normalized(convert<double>(camera.at) - from);
        const Vec3d right = normalized(cross(forward, convert<double>(camera.up)));
        const Vec3d up = cross(right, forward);
        // Half of the image's height, in the plane at distance 1 or, if orthographic, in any plane.
        const double half = orthographic_ ? 0.5 * static_cast<double>(camera.height)
                                          : slope_of_view(camera.field_of_view);
        const double per_half_pixel = half / settings.height;
        from_ = convert<Real>(from);
        forward_ = convert<Real>(forward);
        right_ = convert<Real>(right * per_half_pixel);
        up_ = convert<Real>(up * per_half_pixel);
        lens_right_ = convert<Real>(right);
        lens_up_ = convert<Real>(up);
        focus_ = camera.focus_distance > 0.0F ? Real(camera.focus_distance)
                                              : Real(length(convert<double>(camera.at) - from));
    }

    /// Position of a sample in its pixel, from the upper left corner: in [0, 1)^2, or beyond it for
    /// wider filters.
    struct InPixel {
        Real column;
        Real row;
    };
    /// Returns the position of sample 0 <= sample < grid^2 of pixel (x, y); y counts from the top.
    /// It is the same for all pixels if the samples are regular.
    InPixel in_pixel(int x, int y, int sample) const {
        const SamplePoint point =
            sample_point(pattern_, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                         static_cast<std::uint32_t>(sample));
        return filtered(
            {(Real(sample % grid_) + Real(point.x)) / Real(grid_),
             (Real(sample / grid_) + Real(point.y)) / Real(grid_)}); // NOLINT: whole rows
    }
    /// Maps an evenly distributed position in [0, 1)^2 to the distribution of the filter.
    InPixel filtered(const InPixel& even) const {
        if (filter_ == nullptr) return even;
        return {Real(filter_->place(static_cast<double>(even.column))),
                Real(filter_->place(static_cast<double>(even.row)))};
    }

    /// A point in the image, from the middle to the right and upwards, in halves of a pixel.
    struct ImagePoint {
        Real across;
        Real upward;
    };
    ImagePoint point_at(int x, int y, const InPixel& in_pixel) const {
        return {Real(2) * (Real(x) + in_pixel.column) - Real(width_),
                Real(height_) - Real(2) * (Real(y) + in_pixel.row)};
    }

    /// The point where a sample's ray passes through the lens: its distances from the lens' middle
    /// to the right and upwards, in units of length. Points are distributed evenly over the lens.
    struct LensPoint {
        double right, up;
    };
    LensPoint on_lens(int x, int y, int sample) const {
        const SamplePoint point =
            shuffled_point(sequence_key(static_cast<std::uint32_t>(x),
                                        static_cast<std::uint32_t>(y), SequenceUse::on_lens),
                           static_cast<std::uint32_t>(sample));
        constexpr double turn = 6.283185307179586;
        const double r = lens_radius_ * std::sqrt(static_cast<double>(point.x));
        const double azimuth = turn * static_cast<double>(point.y);
        return {r * core::cos(azimuth), r * core::sin(azimuth)};
    }

    Ray<Real> ray(int x, int y, int sample) const {
        return ray({x, y, sample}, in_pixel(x, y, sample));
    }
    Ray<Real> ray(const SampleName& sample, const InPixel& in_pixel) const {
        const ImagePoint at = point_at(sample.x, sample.y, in_pixel);
        const Vec3<Real> offset = mul_add(at.across, right_, Vec3<Real>(at.upward * up_));
        const Vec3<Real> start = orthographic_ ? from_ + offset : from_;
        if (!has_lens())
            return {start, orthographic_ ? forward_ : normalized(Vec3<Real>(forward_ + offset))};
        const LensPoint lens = on_lens(sample.x, sample.y, sample.number);
        const Vec3<Real> aside =
            mul_add(Real(lens.right), lens_right_, Vec3<Real>(Real(lens.up) * lens_up_));
        const Vec3<Real> sharp = orthographic_ ? forward_ : forward_ + offset;
        return {start + aside, normalized(mul_add(focus_, sharp, Vec3<Real>(-aside)))};
    }

    bool has_lens() const { return lens_radius_ > 0.0; }
    Real focus() const { return focus_; }                        ///< distance of the focal plane
    const Vec3<Real>& lens_right() const { return lens_right_; } ///< unit
    const Vec3<Real>& lens_up() const { return lens_up_; }       ///< unit
    bool regular() const { return pattern_ == SamplePattern::regular; }
    bool orthographic() const { return orthographic_; }
    const Vec3<Real>& from() const { return from_; }
    const Vec3<Real>& forward() const { return forward_; }
    const Vec3<Real>& right() const { return right_; } ///< half a pixel long
    const Vec3<Real>& up() const { return up_; }       ///< half a pixel long

  private:
    int grid_;
    SamplePattern pattern_;
    const FilterPlaces* filter_; // null: the box filter
    bool orthographic_;
    int width_;
    int height_;
    Vec3<Real> from_, forward_, right_, up_; // right and up are half a pixel long
    double lens_radius_;
    Vec3<Real> lens_right_, lens_up_;
    Real focus_;
};

} // namespace raylane::core
