#pragma once

#include "scenes/nff/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace raylane::scenes {

struct Rectangle {
    PlanePoint lower{std::numeric_limits<double>::infinity(),
                     std::numeric_limits<double>::infinity()};
    PlanePoint upper{-std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};

    void include(const PlanePoint& p) {
        lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
        upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
    }

    bool contains(const PlanePoint& p) const {
        return lower.x <= p.x && p.x <= upper.x && lower.y <= p.y && p.y <= upper.y;
    }
};

/// Numbered points in the cells of a square grid, to be found by rectangle.
class PointGrid {
  public:
    /// Empties it, for points 0 to `count` - 1 inside `bounds`: about one to a cell.
    void reset(const Rectangle& bounds, std::size_t count) {
        side_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(count))));
        origin_ = bounds.lower;
        const auto cells_per_length = [&](double length) {
            return length > 0.0 ? side_ / length : 0.0;
        };
        scale_ = {cells_per_length(bounds.upper.x - bounds.lower.x),
                  cells_per_length(bounds.upper.y - bounds.lower.y)};
        first_.assign(static_cast<std::size_t>(side_) * side_, none);
        next_.resize(count);
    }

    void insert(std::uint32_t number, const PlanePoint& p) {
        std::uint32_t& first = first_[static_cast<std::size_t>(row(p.y)) * side_ + column(p.x)];
        next_[number] = first;
        first = number;
    }

    /// Calls visit(number) for all points in `rectangle` and for some others near it, until it
    /// returns true. Whether it did.
    template <class Visit>
    bool any_in(const Rectangle& rectangle, Visit&& visit) const {
        // Rounded, but monotonic: no point of the rectangle is in a cell outside of these.
        const int first_column = column(rectangle.lower.x);
        const int last_column = column(rectangle.upper.x);
        const int last_row = row(rectangle.upper.y);
        for (int y = row(rectangle.lower.y); y <= last_row; ++y)
            for (int x = first_column; x <= last_column; ++x)
                for (std::uint32_t number = first_[static_cast<std::size_t>(y) * side_ + x];
                     number != none; number = next_[number])
                    if (visit(number)) return true;
        return false;
    }

  private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    int cell(double offset, double scale) const {
        return std::clamp(static_cast<int>(offset * scale), 0, side_ - 1);
    }
    int column(double x) const { return cell(x - origin_.x, scale_.x); }
    int row(double y) const { return cell(y - origin_.y, scale_.y); }

    int side_ = 1;
    PlanePoint origin_{0.0, 0.0};
    PlanePoint scale_{0.0, 0.0};       // cells per length
    std::vector<std::uint32_t> first_; // by cell
    std::vector<std::uint32_t> next_;  // by point
};

} // namespace raylane::scenes
