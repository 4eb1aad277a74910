#include "core/beams/region_samples.hpp"

#include "core/numbers/elementary.hpp"
#include "core/numbers/infinity.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace raylane::core {

namespace {

/// The error that a pixel may have, as a part of the mean one: an estimate of it is one.
constexpr double of_mean = 1.25;
/// A square's other pixels may be worse where some are even, as if no less than this were not.
constexpr double least_share = 1.0 / 16.0;

/// What all of n samples have missed is some 1 / n of the pixel or less; n is this much per error
/// that the pixel may have.
constexpr double of_unseen = 8.0;

int most_unseen_of(double tolerance) {
    const double most = std::min<double>(RegionSamples::most_samples, of_unseen / tolerance);
    return static_cast<int>(std::bit_floor(static_cast<unsigned>(most)));
}

/// Other rays of a beam may go a little further than its samples.
constexpr double likely_beyond = 1.125;
/// Of neighbours' colours, as a part of white.
constexpr double contrast = 0.1;

/// As the film shows it.
Sample seen(Sample sample) {
    for (int channel = 0; channel < 3; ++channel)
        sample.color[channel] = std::min(sample.color[channel], 1.0);
    return sample;
}

double largest(const Vec3d& v) {
    return std::max({v.x, v.y, v.z});
}

/// In a channel, or in what is seen of the background.
double largest_step(const Sample& a, const Sample& b) {
    return std::max(largest(absolute(a.color - b.color)),
                    std::abs(a.transmittance - b.transmittance));
}

} // namespace

RegionSamples::RegionSamples(const Scene& scene, const Settings& settings)
    : scene_(scene), settings_(settings),
      tolerance_(of_mean * core::pow(10.0, -static_cast<double>(settings.quality) / 20.0)),
      is_grainy_(std::any_of(scene.lights().begin(), scene.lights().end(),
                             [](const Light& light) { return is_soft(light.kind); })),
      is_blurred_(scene.camera().lens_radius > 0.0F), most_unseen_(most_unseen_of(tolerance_)),
      beams_(scene, settings) {}

/// What the filters of a square's pixels reach.
Square RegionSamples::seen_by(const PixelSquare& square) const {
    const double beyond = reach_of(settings_.filter) - 0.5;
    return {square.x - beyond, square.y - beyond, square.size + 2.0 * beyond};
}

void RegionSamples::begin(const Region& region) {
    region_ = region;
    width_ = region.x1 - region.x0;
    is_first_round_ = true;
    states_.assign(static_cast<std::size_t>(region.pixels()), {});
}

SamplePoint RegionSamples::place(int x, int y, int number) const {
    if (is_first_round_) return {0.5F, 0.5F};
    return sequence_point(sequence_key(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                       SequenceUse::in_pixel),
                          static_cast<std::uint32_t>(number));
}

bool RegionSamples::end_round() {
    if (is_first_round_) {
        is_first_round_ = false;
        mark_edges();
        for (int y = region_.y0; y < region_.y1; y += square_size)
            for (int x = region_.x0; x < region_.x1; x += square_size)
                look_at({x, y, square_size});
        for (Pixel& pixel : states_)
            if (pixel.wanted != 0) pixel.samples = {};
    } else {
        std::size_t number = 0;
        for (int y = region_.y0; y < region_.y1; ++y)
            for (int x = region_.x0; x < region_.x1; ++x)
                look_closer(number++, x, y);
    }
    return std::any_of(states_.begin(), states_.end(),
                       [](const Pixel& pixel) { return pixel.wanted != 0; });
}

/// Where neighbours see different surfaces, or colours, a few samples will not do.
void RegionSamples::mark_edges() {
    for (int y = region_.y0; y < region_.y1; ++y)
        for (int x = region_.x0; x < region_.x1; ++x) {
            const std::size_t number = number_of(x, y);
            const auto differs = [&](bool is_there, int other_x, int other_y) {
                if (!is_there) return false;
                const Sample& here = states_[number].first;
                const Sample& other = states_[number_of(other_x, other_y)].first;
                return here.shape != other.shape ||
                       largest_step(seen(here), seen(other)) > contrast;
            };
            const bool is_edge =
                differs(x % square_size != 0, x - 1, y) ||
                differs(y % square_size != 0, x, y - 1) ||
                differs(x + 1 < region_.x1 && (x + 1) % square_size != 0, x + 1, y) ||
                differs(y + 1 < region_.y1 && (y + 1) % square_size != 0, x, y + 1);
            states_[number].wanted = is_blurred_ ? least_on_step : is_edge ? 8 : 4;
        }
}

/// Finds what is even of a square; its other pixels may be worse, as the square's mean counts.
void RegionSamples::look_at(const PixelSquare& square) {
    find_even(square);
    int uneven = 0, all = 0;
    for_each_pixel(square, [&](Pixel& pixel) {
        uneven += pixel.wanted != 0 ? 1 : 0;
        ++all;
    });
    const double share = std::max(static_cast<double>(uneven) / all, least_share);
    for_each_pixel(square, [&](Pixel& pixel) { pixel.tolerance = tolerance_ / std::sqrt(share); });
}

template <class Visit>
void RegionSamples::for_each_pixel(const PixelSquare& square, const Visit& visit) {
    for (int y = square.y; y < std::min(square.y + square.size, region_.y1); ++y)
        for (int x = square.x; x < std::min(square.x + square.size, region_.x1); ++x)
            visit(states_[number_of(x, y)]);
}

void RegionSamples::find_even(const PixelSquare& square) {
    if (square.x >= region_.x1 || square.y >= region_.y1) return;
    double t_likely = 0.0;
    if (looks_even(square, t_likely)) {
        const Sight sight = beams_.sight_of(seen_by(square), t_likely);
        const bool is_even = sight == Sight::even;
        if (is_even || sight == Sight::uneven || sight == Sight::soft) {
            for_each_pixel(square, [&](Pixel& pixel) {
                if (is_even) pixel.wanted = 0;
                pixel.least = 1;
            });
            // Of small squares samples take less time than beams.
            if (sight != Sight::uneven || square.size <= least_uneven) return;
        }
    }
    if (square.size == 2) return;
    const int half = square.size / 2;
    for (int quarter = 0; quarter < 4; ++quarter)
        find_even({square.x + quarter % 2 * half, square.y + quarter / 2 * half, half});
}

/// True if the middles of a square's pixels show one surface, and no steps of colour: where they
/// do, it is in vain to look by beams.
bool RegionSamples::looks_even(const PixelSquare& square, double& t_likely) const {
    const int x1 = std::min(square.x + square.size, region_.x1);
    const int y1 = std::min(square.y + square.size, region_.y1);
    const Sample& first = states_[number_of(square.x, square.y)].first;
    double step_most = contrast;
    if (first.shape != no_shape) {
        const Material& material = scene_.material_of(first.shape);
        if (material.reflects() || material.lets_light_pass()) step_most = 0.03;
    }
    for (int y = square.y; y < y1; ++y)
        for (int x = square.x; x < x1; ++x) {
            const Sample& sample = states_[number_of(x, y)].first;
            if (sample.shape != first.shape) return false;
            t_likely = std::max(t_likely, sample.shape == no_shape ? infinity<double> : sample.t);
            if (is_grainy_) continue;
            const Sample& left = states_[number_of(std::max(x - 1, square.x), y)].first;
            const Sample& above = states_[number_of(x, std::max(y - 1, square.y))].first;
            if (largest_step(sample, left) > step_most || largest_step(sample, above) > step_most)
                return false;
        }
    t_likely *= likely_beyond;
    return true;
}

void RegionSamples::look_closer(std::size_t number, int x, int y) {
    Pixel& pixel = states_[number];
    if (pixel.wanted == 0) return;
    const int count = pixel.samples.count();
    const bool is_done =
        count >= most_samples ||
        (pixel.samples.is_within(pixel.tolerance, settings_.transfer, is_blurred_) &&
         !hides(pixel, x, y));
    pixel.wanted = is_done ? 0 : count;
}

/// True if something may show in a pixel that its samples have not shown, and they are few.
bool RegionSamples::hides(Pixel& pixel, int x, int y) {
    const PixelSamples& samples = pixel.samples;
    const int count = samples.count();
    const bool is_first_look = pixel.least == 0;
    if (!is_first_look && count >= pixel.least) return false;
    // The longer it stays hidden, the more it is worth to find out whether it can be seen at all.
    struct CloserLook {
        int at, halvings, least_parts;
    };
    constexpr CloserLook looks[] = {{16, 2, 1}, {64, 4, 3}};
    const bool is_closer = pixel.least == most_unseen_ && pixel.closer_looks < std::size(looks) &&
                           count >= looks[pixel.closer_looks].at;
    if (is_first_look || is_closer) {
        const Square square = seen_by({x, y, 1});
        const Sight sight = beams_.surfaces_in(square, likely_beyond * samples.farthest());
        pixel.least = sight == Sight::edge   ? most_unseen_
                      : sight == Sight::step ? least_on_step
                                             : 1;
        if (is_blurred_ && sight == Sight::edge) {
            // All that its rays may meet is much more than what shows: as if all were white, and
            // half of what so many samples may miss.
            pixel.least = std::max(least_on_step, static_cast<int>(0.5 / tolerance_));
            return count < pixel.least;
        }
        shown_.clear();
        for (const BeamCandidate& shown : beams_.shown())
            shown_.push_back(shown.id);
        // Beside one shape alone there is something, too.
        if (shown_.size() == 1) shown_.push_back(no_shape);
        std::erase_if(shown_, [&](ShapeId id) { return has_seen(samples, id); });
        if (is_closer && !shown_.empty()) {
            const CloserLook& look = looks[pixel.closer_looks++];
            in_pixel_ = beams_.shown();
            beams_.keep_shown(square, in_pixel_, look.halvings, look.least_parts, shown_);
            if (shown_.empty()) pixel.least = 1;
        }
        pixel.hidden_count = static_cast<int>(std::min<std::size_t>(shown_.size(), most_hidden));
        std::copy_n(shown_.begin(), pixel.hidden_count, pixel.hidden.begin());
        if (sight == Sight::edge && beams_.shown().empty()) pixel.least = least_unknown;
        if (count >= pixel.least) return false;
    }
    if (pixel.least != most_unseen_) return true;
    return !std::all_of(pixel.hidden.begin(), pixel.hidden.begin() + pixel.hidden_count,
                        [&](ShapeId id) { return has_seen(samples, id); });
}

/// no_shape stands for whatever is beside the only shape that is known to show.
bool RegionSamples::has_seen(const PixelSamples& samples, ShapeId id) {
    return id == no_shape ? samples.different_shapes() > 1 : samples.has_seen(id);
}

} // namespace raylane::core
