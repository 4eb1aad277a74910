#include "core/hierarchy/bins.hpp"

#include "core/shapes/shape_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace raylane::core {

namespace {

constexpr int max_bins = 32;

/// Larger ranges are processed strip by strip, possibly by many threads. The strip size affects the
/// result: it decides the order of the items after a partition.
constexpr std::size_t strip_size = std::size_t{1} << 16;

std::size_t strips_of(std::size_t count) {
    return (count + strip_size - 1) / strip_size;
}

/// Computes the bin of a centre for all axes at once.
class Grid {
  public:
    Grid(const Box4& centers, int bins) : lower_(centers.lower), last_(all4(float(bins - 1))) {
        for (int axis = 0; axis < 3; ++axis) {
            const float scale = float(bins) / (centers.upper[axis] - centers.lower[axis]);
            // All items share one bin if the centres are too close to divide by their distance.
            scale_[axis] = std::isfinite(scale) ? scale : 0.0F;
        }
        // The fourth component of an item is meaningless, but a denormal number there would be
        // slow.
        lower_[3] = 0.0F;
    }

    Int4 bins_of(const Item& item) const {
        const Float4 offset = (item.doubled_center() - lower_) * scale_;
        return __builtin_convertvector(least(offset, last_), Int4);
    }

  private:
    Float4 lower_, scale_{}, last_;
};

struct Bins {
    Box4 boxes[3][max_bins];
    std::uint32_t counts[3][max_bins]{};

    void include(std::span<const Item> items, const Grid& grid) {
        for (const Item& item : items) {
            const Int4 bin = grid.bins_of(item);
            for (int axis = 0; axis < 3; ++axis) {
                boxes[axis][bin[axis]].include(item);
                ++counts[axis][bin[axis]];
            }
        }
    }
    void include(const Bins& other, int bins) {
        for (int axis = 0; axis < 3; ++axis)
            for (int bin = 0; bin < bins; ++bin) {
                boxes[axis][bin].include(other.boxes[axis][bin]);
                counts[axis][bin] += other.counts[axis][bin];
            }
    }
};

/// A splitting plane. The bins before `bin` are to its left.
struct Plane3 {
    int axis = -1; ///< -1: no plane
    int bin = 0;
};

float blocks_for(std::uint32_t count) {
    return float((count + block_size - 1) / block_size); // NOLINT: whole blocks
}

/// Returns a factor that scales all sizes within the box to the range of 0 to 1.
float unit_of(const Box4& box) {
    const Float4 size = box.upper - box.lower;
    const float unit = 1.0F / std::max({float(size[0]), float(size[1]), float(size[2])});
    return std::isfinite(unit) ? unit : 1.0F;
}

/// Returns the plane of the least expected work: the probability of a hit (by surface area) times
/// the number of blocks of 16 to be tested.
Plane3 best_plane(const Bins& bins, int count, float unit) {
    Plane3 best;
    float best_cost = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        std::array<float, max_bins> right_cost;
        Box4 right;
        std::uint32_t items = 0;
        for (int bin = count - 1; bin > 0; --bin) {
            right.include(bins.boxes[axis][bin]);
            items += bins.counts[axis][bin];
            right_cost[bin] = right.half_area(unit) * blocks_for(items);
        }
        Box4 left;
        items = 0;
        for (int bin = 1; bin < count; ++bin) {
            left.include(bins.boxes[axis][bin - 1]);
            items += bins.counts[axis][bin - 1];
            // NaN if a side is empty; the comparison is then false.
            const float cost = left.half_area(unit) * blocks_for(items) + right_cost[bin];
            if (cost < best_cost) {
                best_cost = cost;
                best = {axis, bin};
            }
        }
    }
    return best;
}

/// Moves the items for which `is_left` holds to the front; returns their number. Scans blocks from
/// both ends and records misplaced items without a branch, as no processor can predict this one
/// (Edelkamp and Weiss, "BlockQuicksort", 2016).
template <class IsLeft>
std::size_t partition(std::span<Item> items, const IsLeft& is_left) {
    constexpr std::size_t block = 64;
    std::array<std::uint8_t, block> wrong_left, wrong_right;
    std::size_t lefts = 0, rights = 0, left_at = 0, right_at = 0;
    std::size_t first = 0, last = items.size();
    while (last - first >= 2 * block) {
        if (lefts == 0) {
            left_at = 0;
            for (std::size_t i = 0; i < block; ++i) {
                wrong_left[lefts] = static_cast<std::uint8_t>(i);
                lefts += is_left(items[first + i]) ? 0 : 1;
            }
        }
        if (rights == 0) {
            right_at = 0;
            for (std::size_t i = 0; i < block; ++i) {
                wrong_right[rights] = static_cast<std::uint8_t>(i);
                rights += is_left(items[last - 1 - i]) ? 1 : 0;
            }
        }
        const std::size_t both = std::min(lefts, rights);
        for (std::size_t i = 0; i < both; ++i)
            std::swap(items[first + wrong_left[left_at + i]],
                      items[last - 1 - wrong_right[right_at + i]]);
        lefts -= both;
        rights -= both;
        left_at += both;
        right_at += both;
        if (lefts == 0) first += block;
        if (rights == 0) last -= block;
    }
    const auto rest = items.subspan(first, last - first);
    return first + static_cast<std::size_t>(std::partition(rest.begin(), rest.end(), is_left) -
                                            rest.begin());
}

Box4 centers_of(std::span<const Item> items) {
    Box4 centers;
    for (const Item& item : items)
        centers.include(item.doubled_center());
    return centers;
}

/// A strip after its own partition.
struct Strip {
    std::size_t first, middle, last;
    Box4 left_centers, right_centers;
};

/// Exchanges items that are right of their strip's middle but left of `middle` with items that are
/// left of their strip's middle but right of `middle`.
void exchange(std::span<Item> items, const std::vector<Strip>& strips, std::size_t middle) {
    struct Run {
        std::size_t first, last;
    };
    std::vector<Run> wrong_left, wrong_right;
    for (const Strip& strip : strips) {
        if (strip.middle < std::min(strip.last, middle))
            wrong_left.push_back({strip.middle, std::min(strip.last, middle)});
        if (std::max(strip.first, middle) < strip.middle)
            wrong_right.push_back({std::max(strip.first, middle), strip.middle});
    }
    auto right = wrong_right.begin();
    for (Run left : wrong_left)
        while (left.first < left.last) {
            const std::size_t count = std::min(left.last - left.first, right->last - right->first);
            std::swap_ranges(items.begin() + left.first, items.begin() + left.first + count,
                             items.begin() + right->first);
            left.first += count;
            right->first += count;
            if (right->first == right->last) ++right;
        }
}

/// Like partition, for a whole range. Fills in the halves except their boxes.
template <class IsLeft>
void partition_strips(std::span<Item> items, const Range& range, const IsLeft& is_left,
                      Halves& halves, Workers& workers) {
    std::vector<Strip> strips(strips_of(range.size()));
    workers.each(strips.size(), [&](std::size_t i) {
        Strip& strip = strips[i];
        strip.first = range.first + i * strip_size;
        strip.last = std::min(strip.first + strip_size, range.last);
        const auto part = items.subspan(strip.first, strip.last - strip.first);
        const std::size_t lefts = partition(part, is_left);
        strip.middle = strip.first + lefts;
        strip.left_centers = centers_of(part.first(lefts));
        strip.right_centers = centers_of(part.subspan(lefts));
    });
    std::size_t middle = range.first;
    for (const Strip& strip : strips) {
        middle += strip.middle - strip.first;
        halves.left.centers.include(strip.left_centers);
        halves.right.centers.include(strip.right_centers);
    }
    exchange(items, strips, middle);
    halves.left.first = range.first;
    halves.left.last = halves.right.first = middle;
    halves.right.last = range.last;
}

} // namespace

Range range_of(std::span<const Item> items, std::size_t first, std::size_t last, Workers& workers) {
    Range whole_range{first, last, {}, {}};
    std::vector<Range> strips(strips_of(whole_range.size()));
    workers.each(strips.size(), [&](std::size_t i) {
        const std::size_t begin = first + i * strip_size;
        for (const Item& item : items.subspan(begin, std::min(strip_size, last - begin))) {
            strips[i].box.include(item);
            strips[i].centers.include(item.doubled_center());
        }
    });
    for (const Range& strip : strips) {
        whole_range.box.include(strip.box);
        whole_range.centers.include(strip.centers);
    }
    return whole_range;
}

Halves split_by_bins(std::span<Item> items, const Range& range, Workers& workers) {
    const int count = range.size() > 1024 ? max_bins : max_bins / 2;
    const Grid grid(range.centers, count);
    Bins bins;
    if (range.size() <= strip_size) {
        bins.include(items.subspan(range.first, range.size()), grid);
    } else {
        std::vector<Bins> strips(strips_of(range.size()));
        workers.each(strips.size(), [&](std::size_t i) {
            const std::size_t first = range.first + i * strip_size;
            strips[i].include(items.subspan(first, std::min(strip_size, range.last - first)), grid);
        });
        for (const Bins& strip : strips)
            bins.include(strip, count);
    }

    Halves halves;
    const Plane3 plane = best_plane(bins, count, unit_of(range.box));
    if (plane.axis < 0) { // all centres are equal or nearly so: any split will do
        const std::size_t middle = range.first + range.size() / 2;
        for (std::size_t i = range.first; i < range.last; ++i) {
            Range& half = i < middle ? halves.left : halves.right;
            half.box.include(items[i]);
            half.centers.include(items[i].doubled_center());
        }
        halves.left.first = range.first;
        halves.left.last = halves.right.first = middle;
        halves.right.last = range.last;
        return halves;
    }
    for (int bin = 0; bin < count; ++bin)
        (bin < plane.bin ? halves.left : halves.right).box.include(bins.boxes[plane.axis][bin]);
    partition_strips(
        items, range, [&](const Item& item) { return grid.bins_of(item)[plane.axis] < plane.bin; },
        halves, workers);
    return halves;
}

} // namespace raylane::core
