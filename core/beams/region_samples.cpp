#include "core/beams/region_samples.hpp"

#include "core/numbers/elementary.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace raylane::core {

namespace {

/// A feature that n samples have all missed covers about 1 / n of the pixel or less. The required n
/// is this constant divided by the allowed error of the image.
constexpr double of_unseen = 6.4;

int max_unseen_of(double quality) {
    const double most =
        std::min<double>(RegionSamples::max_samples, of_unseen * core::pow(10.0, quality / 20.0));
    return static_cast<int>(std::bit_floor(static_cast<unsigned>(most)));
}

} // namespace

RegionSamples::RegionSamples(const Scene& scene, const Settings& settings, const Survey& survey)
    : settings_(settings), survey_(survey),
      max_unseen_(max_unseen_of(static_cast<double>(settings.quality))), beams_(scene, settings) {}

/// Returns the square that the filters of a square's pixels reach.
Square RegionSamples::seen_by(int x, int y, int size) const {
    const double beyond = reach_of(settings_.filter) - 0.5;
    return {x - beyond, y - beyond, size + 2.0 * beyond};
}

void RegionSamples::begin(const Region& region) {
    region_ = region;
    width_ = static_cast<std::size_t>(region.x1 - region.x0);
    is_first_round_ = true;
    Pixel pixel;
    pixel.wanted = common();
    states_.assign(static_cast<std::size_t>(region.pixels()), pixel);
    shown_.resize(states_.size());
}

bool RegionSamples::end_round() {
    if (is_first_round_)
        for (int y = region_.y0; y < region_.y1; y += square_size)
            for (int x = region_.x0; x < region_.x1; x += square_size)
                look_at(Region{x, y, x + square_size, y + square_size}.within(region_));
    std::size_t number = 0;
    for (int y = region_.y0; y < region_.y1; ++y)
        for (int x = region_.x0; x < region_.x1; ++x)
            look_closer(states_[number++], x, y);
    is_first_round_ = false;
    if (survey_.asks_for_variance())
        for (int y = region_.y0; y < region_.y1; ++y)
            for (int x = region_.x0; x < region_.x1; ++x)
                if (is_ahead(x, y)) reopen(states_[number_of(x, y)]);
    return std::any_of(states_.begin(), states_.end(),
                       [](const Pixel& pixel) { return pixel.wanted != 0; });
}

void RegionSamples::look_at(const Region& square) {
    const bool may_hide = beams_.shows_thin(seen_by(square.x0, square.y0, square_size));
    std::array<Shown, 9> around;
    for (int y = square.y0; y < square.y1; ++y)
        for (int x = square.x0; x < square.x1; ++x) {
            Pixel& pixel = states_[number_of(x, y)];
            pixel.may_hide = may_hide;
            if (!survey_.asks_for_variance()) continue;
            std::size_t count = 0;
            for_each_around(x, y, square, [&](int column, int row) {
                around[count++] = shown_[number_of(column, row)];
            });
            pixel.around = variance_around({around.data(), count});
        }
}

void RegionSamples::look_closer(Pixel& pixel, int x, int y) {
    if (pixel.wanted == 0) return;
    const int count = takes_grid() ? 0 : pixel.samples.count();
    const double squares = count != 0 ? pixel.samples.squares_shown(settings_.transfer) : 0.0;
    const bool is_done = count >= max_samples ||
                         (survey_.is_done({pixel.around, squares, count}) && !hides(pixel, x, y));
    pixel.wanted = is_done ? 0 : more_after(count);
    pixel.is_in_grid = is_done && takes_grid();
    if (!is_done && takes_grid()) pixel.samples = {};
}

/// Returns true if a pixel is done with less than half of the samples that most of its neighbours
/// have, or with fewer than they have if its samples are all alike. They were alike by chance, such
/// as those of a hollow in which most rays to the sky are blocked.
bool RegionSamples::is_ahead(int x, int y) const {
    const Pixel& pixel = states_[number_of(x, y)];
    if (pixel.wanted != 0) return false;
    std::array<int, 8> counts{};
    std::size_t neighbours = 0;
    for_each_around(x, y, region_, [&](int column, int row) {
        if (column == x && row == y) return;
        counts[neighbours++] = states_[number_of(column, row)].samples.count();
    });
    if (neighbours == 0) return false;
    auto* const middle = counts.begin() + (neighbours - 1) / 2;
    std::nth_element(counts.begin(), middle, counts.begin() + neighbours);
    const int count = pixel.samples.count();
    return count < *middle &&
           (2 * count < *middle || pixel.samples.squares_shown(settings_.transfer) == 0.0);
}

void RegionSamples::reopen(Pixel& pixel) const {
    if (std::exchange(pixel.is_in_grid, false)) { // needs to see thin shapes again
        pixel.samples = {};
        pixel.may_hide = true;
        pixel.closer_looks = 0;
    }
    pixel.wanted = more_after(pixel.samples.count());
}

/// Returns true if a thin shape may show in a pixel, no sample has hit it, and the samples are
/// still few.
bool RegionSamples::hides(Pixel& pixel, int x, int y) {
    if (!pixel.may_hide) return false;
    const int count = pixel.samples.count();
    // The longer a shape stays hidden, the more effort is justified to find out whether it is
    // visible.
    struct CloserLook {
        int at, halvings, min_parts;
    };
    constexpr CloserLook looks[] = {{0, 0, 0}, {16, 2, 1}, {64, 4, 3}};
    while (pixel.closer_looks < std::size(looks) && count >= looks[pixel.closer_looks].at) {
        const CloserLook& look = looks[pixel.closer_looks++];
        const Square square = seen_by(x, y, 1);
        if (!beams_.shows_thin(square)) {
            pixel.hidden.clear();
        } else if (look.halvings == 0) {
            pixel.hidden = beams_.thin();
        } else {
            in_pixel_ = beams_.shown();
            beams_.keep_shown(square, in_pixel_, look.halvings, look.min_parts, pixel.hidden);
        }
    }
    const auto is_seen = [&](ShapeId id) { return pixel.samples.has_seen(id); };
    if (!takes_grid())
        std::erase_if(pixel.hidden, is_seen);
    else if (std::all_of(pixel.hidden.begin(), pixel.hidden.end(), is_seen))
        pixel.hidden.clear(); // otherwise the pixel starts again and needs to see them all again
    pixel.may_hide = !pixel.hidden.empty() && count < max_unseen_;
    return pixel.may_hide;
}

} // namespace raylane::core
