#include "scenes/annotation/layout.hpp"

#include <algorithm>
#include <variant>

namespace raylane::scenes {

namespace {

/// Returns the number of characters of a text in UTF-8.
double characters_of(const std::string& text) {
    return static_cast<double>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    }));
}

Box around(const Point& a, const Point& b, double distance) {
    return {std::min(a.x, b.x) - distance, std::min(a.y, b.y) - distance,
            std::max(a.x, b.x) + distance, std::max(a.y, b.y) + distance};
}

void include(Box& box, const Box& other) {
    box = {std::min(box.left, other.left), std::min(box.top, other.top),
           std::max(box.right, other.right), std::max(box.bottom, other.bottom)};
}

Box rectangle_of(const SheetLine& line) {
    return around(line.from, line.to, 0.5 * line.width);
}
Box rectangle_of(const SheetPolygon& polygon) {
    Box box = around(polygon.corners.front(), polygon.corners.front(), 0.0);
    for (const Point& corner : polygon.corners)
        include(box, around(corner, corner, 0.0));
    return box;
}
Box rectangle_of(const SheetBall& ball) {
    return around(ball.center, ball.center, ball.radius);
}
Box rectangle_of(const SheetRamp& ramp) {
    return {ramp.corner.x, ramp.corner.y, ramp.corner.x + ramp.width, ramp.corner.y + ramp.height};
}
/// The factors are those of usual fonts without serifs; most of them are narrower.
Box rectangle_of(const SheetText& text) {
    constexpr double advance = 0.6, ascent = 0.76, descent = 0.24, halo = 0.5 * halo_width;
    const double width = advance * text.size * characters_of(text.text);
    const double left = text.anchor == Anchor::start    ? text.at.x
                        : text.anchor == Anchor::middle ? text.at.x - 0.5 * width
                                                        : text.at.x - width;
    return {left - halo * text.size, text.at.y - (ascent + halo) * text.size,
            left + width + halo * text.size, text.at.y + (descent + halo) * text.size};
}

void shift(Point& point, double right, double down) {
    point = {point.x + right, point.y + down};
}
void move_mark(SheetLine& line, double right, double down) {
    shift(line.from, right, down);
    shift(line.to, right, down);
}
void move_mark(SheetPolygon& polygon, double right, double down) {
    for (Point& corner : polygon.corners)
        shift(corner, right, down);
}
void move_mark(SheetBall& ball, double right, double down) {
    shift(ball.center, right, down);
}
void move_mark(SheetRamp& ramp, double right, double down) {
    shift(ramp.corner, right, down);
}
void move_mark(SheetText& text, double right, double down) {
    shift(text.at, right, down);
}

} // namespace

Box box_of(const Mark& mark) {
    return std::visit([](const auto& shape) { return rectangle_of(shape); }, mark);
}

Box box_of(const MarkGroup& group) {
    Box box = box_of(group.marks.front());
    for (const Mark& mark : group.marks)
        include(box, box_of(mark));
    return box;
}

void move(MarkGroup& group, double right, double down) {
    for (Mark& mark : group.marks)
        std::visit([&](auto& shape) { move_mark(shape, right, down); }, mark);
}

BlockLayout::BlockLayout(int width, int height, double margin, double gap)
    : width_(width), height_(height), margin_(margin), gap_(gap) {}

bool BlockLayout::is_free(const Box& box) const {
    return box.left >= 0.5 * margin_ && box.top >= 0.5 * margin_ &&
           box.right <= width_ - 0.5 * margin_ && box.bottom <= height_ - 0.5 * margin_ &&
           std::none_of(boxes_.begin(), boxes_.end(), [&](const Box& other) {
               return box.meets(
                   {other.left - gap_, other.top - gap_, other.right + gap_, other.bottom + gap_});
           });
}

std::vector<Box> BlockLayout::places_in(Corner corner, double width, double height) const {
    const bool is_left = corner == Corner::upper_left || corner == Corner::lower_left;
    const bool is_upper = corner == Corner::upper_left || corner == Corner::upper_right;
    const auto at = [&](double x, double y) { // of the rectangle's corner of the same name
        const double left = is_left ? x : x - width, top = is_upper ? y : y - height;
        return Box{left, top, left + width, top + height};
    };
    const double x = is_left ? margin_ : width_ - margin_;
    const double y = is_upper ? margin_ : height_ - margin_;
    constexpr double slack = 1e-3; // pixels, as neighbours must not meet by rounding
    std::vector<Box> places = {at(x, y)};
    for (std::size_t i = 0; i < boxes_.size(); ++i)
        if (corners_[i] == corner)
            places.push_back(
                at(x, is_upper ? boxes_[i].bottom + gap_ + slack : boxes_[i].top - gap_ - slack));
    for (std::size_t i = 0; i < boxes_.size(); ++i)
        if (corners_[i] == corner)
            places.push_back(
                at(is_left ? boxes_[i].right + gap_ + slack : boxes_[i].left - gap_ - slack, y));
    return places;
}

bool BlockLayout::place(Block& block, const std::vector<Box>& others) {
    const Box own = block.box ? *block.box : box_of(block.group);
    std::optional<std::pair<Box, Corner>> found;
    const auto meets_others = [&](const Box& box) {
        return std::any_of(others.begin(), others.end(),
                           [&](const Box& other) { return box.meets(other); });
    };
    for (const Corner corner : block.corners)
        for (const Box& box : places_in(corner, own.right - own.left, own.bottom - own.top)) {
            if (!is_free(box)) continue;
            const bool is_best = !meets_others(box);
            if (!found || is_best) found = {box, corner};
            if (!is_best) continue;
            move(block.group, box.left - own.left, box.top - own.top);
            boxes_.push_back(box);
            corners_.push_back(corner);
            return true;
        }
    if (!found) return false;
    move(block.group, found->first.left - own.left, found->first.top - own.top);
    boxes_.push_back(found->first);
    corners_.push_back(found->second);
    return true;
}

} // namespace raylane::scenes
