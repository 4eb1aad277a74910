#pragma once

#include "scenes/annotation/sheet.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

/// Places of annotations beside each other.
namespace raylane::scenes {

/// A rectangle of an image, in pixels.
struct Box {
    double left, top, right, bottom;

    bool meets(const Box& other) const {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
};

/// Returns a rectangle that contains a mark. The width of a text is estimated, as fonts differ.
Box box_of(const Mark& mark);
/// Returns the rectangle of all marks of a group, of which there is at least one.
Box box_of(const MarkGroup& group);

/// Moves all marks.
void move(MarkGroup& group, double right, double down);

enum class Corner : std::uint8_t { upper_left, upper_right, lower_left, lower_right };

/// Marks that can be anywhere, such as a legend.
struct Block {
    std::string option; ///< in messages
    MarkGroup group;
    std::array<Corner, 4> corners; ///< from the best to the worst
    std::optional<Box> box{};      ///< unset: that of the marks
};

/// Puts blocks into the corners of an image. No two of them meet.
class BlockLayout {
  public:
    /// `margin`: free pixels along the sides. `gap`: between blocks.
    BlockLayout(int width, int height, double margin, double gap);

    /// Moves a block to its first corner where it meets no earlier block and none of `others`. If
    /// all corners have one of the others, these do not count. Within a corner it may be above,
    /// below or beside other blocks. Returns false if all places meet blocks.
    bool place(Block& block, const std::vector<Box>& others);

  private:
    /// Returns the rectangles of this size that touch a corner's sides or blocks, the best first.
    std::vector<Box> places_in(Corner corner, double width, double height) const;
    bool is_free(const Box& box) const;

    double width_, height_, margin_, gap_;
    std::vector<Box> boxes_;
    std::vector<Corner> corners_; // of the boxes
};

} // namespace raylane::scenes
