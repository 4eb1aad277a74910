#pragma once

#include "tests/support/placing.hpp"
#include "tests/support/random.hpp"

#include <algorithm>

namespace raylane::meetings {

using core::Vec3d;
using core::Vec3f;
using ray_sets::Random;
using tests::AnyShape;

/// Coordinate frame of a meeting: three orthogonal vectors of one length, with integer components.
/// Shapes meet at the frame's origin, where z is up. Coordinates of few bits in the frame are exact
/// in the world.
class Frame {
  public:
    explicit Frame(Random& random) {
        // Rows are orthogonal, of the lengths 1, 3, 5, 7 and 9.
        static constexpr int bases[][3][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                              {{1, 2, 2}, {2, 1, -2}, {-2, 2, -1}},
                                              {{3, 4, 0}, {-4, 3, 0}, {0, 0, 5}},
                                              {{2, 3, 6}, {3, -6, 2}, {6, 2, -3}},
                                              {{1, 4, 8}, {8, -4, 1}, {4, 7, -4}}};
        static constexpr int lengths[] = {1, 3, 5, 7, 9};
        const int which = std::max(0, random.integer(-4, 4)); // about half along the axes
        length_ = lengths[which];
        const int first = random.integer(0, 2), sign = random.integer(0, 1) == 0 ? 1 : -1;
        for (int row = 0; row < 3; ++row)
            for (int axis = 0; axis < 3; ++axis)
                rows_[row][axis] = sign * bases[which][(row + first) % 3][axis];
    }

    /// Returns the frame turned upside down.
    Frame turned_over() const {
        Frame turned = *this;
        turned.rows_[1] = -rows_[1];
        turned.rows_[2] = -rows_[2];
        return turned;
    }
    /// Returns the frame turned by a right angle about z.
    Frame turned_aside() const {
        Frame turned = *this;
        turned.rows_[0] = rows_[1];
        turned.rows_[1] = -rows_[0];
        return turned;
    }

    /// Returns the frame with axis `axis`, 0 to 2, as its up direction.
    Frame with_up(int axis) const {
        Frame turned = *this;
        for (int row = 0; row < 3; ++row)
            turned.rows_[row] = rows_[(row + axis + 1) % 3];
        return turned;
    }

    Vec3d operator()(double x, double y, double z) const {
        return x * rows_[0] + y * rows_[1] + z * rows_[2];
    }
    Vec3d operator()(const Vec3d& v) const { return (*this)(v.x, v.y, v.z); }
    Vec3f exact(double x, double y, double z) const { return ray_sets::rounded((*this)(x, y, z)); }
    /// Returns the length in the world of 1 in the frame.
    double length() const { return length_; }
    Vec3d row(int i) const { return rows_[i]; }

  private:
    Vec3d rows_[3];
    double length_;
};

} // namespace raylane::meetings
