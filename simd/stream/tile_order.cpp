#include "simd/stream/tile_order.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace raylane::simd {

namespace {

using core::Vec3f;

/// packet: rays in a packet, and the mean number of rays in a cell of the grid. group: consecutive
/// rays whose common extent is measured.
constexpr std::size_t packet = 16, group = 256;
constexpr float huge = 0x1p60F;

template <class Real>
Vec3f vector_at(const Real* const (&from)[3], std::size_t i) {
    return {static_cast<float>(from[0][i]), static_cast<float>(from[1][i]),
            static_cast<float>(from[2][i])};
}

/// Returns the bits of x with one bit between each two.
int spread(int x) {
    x = (x | x << 8) & 0x00FF00FF;
    x = (x | x << 4) & 0x0F0F0F0F;
    x = (x | x << 2) & 0x33333333;
    return (x | x << 1) & 0x55555555;
}

/// Clamps a value to [0, most]; NaN becomes 0.
float clamped(float value, float most) {
    const float positive = value > 0.0F ? value : 0.0F;
    return positive < most ? positive : most;
}

/// Least and greatest of values. NaN changes nothing.
struct Extent {
    float low, high;
    float size() const { return high - low; }
};
Extent extent_of(const float* values, std::size_t count) {
    constexpr std::size_t lanes = 8; // for vectors: a plain reduction of floats has only one order
    float low[lanes], high[lanes];
    std::fill_n(low, lanes, huge);
    std::fill_n(high, lanes, -huge);
    for (std::size_t i = 0; i + lanes <= count; i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const float value = values[i + lane];
            low[lane] = value < low[lane] ? value : low[lane];
            high[lane] = value > high[lane] ? value : high[lane];
        }
    Extent extent{*std::min_element(low, low + lanes), *std::max_element(high, high + lanes)};
    for (std::size_t i = count / lanes * lanes; i < count; ++i) {
        extent.low = std::min(extent.low, values[i]);
        extent.high = std::max(extent.high, values[i]);
    }
    return extent;
}

} // namespace

template <class Real>
bool TileOrder::find(const RayStream<Real>& rays, bool parallel) {
    const Real* const(&origin)[3] = rays.origin;
    const Real* const(&direction)[3] = rays.direction;
    const std::size_t count = rays.count;
    u_.resize(most);
    v_.resize(most);
    const Vec3f forward =
        core::normalized(Vec3f(core::normalized(vector_at(direction, 0)) +
                               core::normalized(vector_at(direction, count / 2)) +
                               core::normalized(vector_at(direction, count - 1))));
    // Returns the point where a ray meets the plane before it or, of parallel rays, where it
    // starts.
    const auto point_of = [&](std::size_t i) {
        if (parallel) return vector_at(origin, i);
        const Vec3f along = vector_at(direction, i);
        return Vec3f(along / core::dot(along, forward));
    };
    Vec3f across = point_of(packet - 1) - point_of(0);
    across = across - core::dot(across, forward) * forward;
    if (!(core::squared_length(across) > 0.0F)) return false;
    across = core::normalized(across);
    const Vec3f upward = core::cross(forward, across);
    const Real* const(&from)[3] = parallel ? origin : direction;
    for (std::size_t i = 0; i < count; ++i) {
        const auto x = static_cast<float>(from[0][i]), y = static_cast<float>(from[1][i]);
        const auto z = static_cast<float>(from[2][i]);
        const float ahead = x * forward.x + y * forward.y + z * forward.z;
        const float inverse = parallel ? 1.0F : 1.0F / ahead;
        u_[i] = (x * across.x + y * across.y + z * across.z) * inverse;
        v_[i] = (x * upward.x + y * upward.y + z * upward.z) * inverse;
    }
    return find_cells(count);
}

bool TileOrder::find_cells(std::size_t count) {
    Extent u{huge, -huge}, v{huge, -huge};
    float rims = 0.0F;
    for (std::size_t begin = 0; begin < count; begin += group) {
        const std::size_t size = std::min(group, count - begin);
        const Extent of_u = extent_of(u_.data() + begin, size);
        const Extent of_v = extent_of(v_.data() + begin, size);
        rims += of_u.size() + of_v.size();
        u = {std::min(u.low, of_u.low), std::max(u.high, of_u.high)};
        v = {std::min(v.low, of_v.low), std::max(v.high, of_v.high)};
    }
    float area_of_one = u.size() * v.size() / static_cast<float>(count);
    for (int round = 0; round < 3; ++round) { // a grid's extents are one step too short
        const float step = std::sqrt(area_of_one);
        area_of_one = (u.size() + step) * (v.size() + step) / static_cast<float>(count);
    }
    const float groups = static_cast<float>(count) / float{group};
    const float could_be = 2.0F * std::sqrt(area_of_one * float{group}) * groups;
    constexpr float worth = 2.0F;
    const float cell = std::sqrt(area_of_one * float{packet});
    if (!(u.size() > 0.0F && v.size() > 0.0F && cell > 0.0F && cell < huge && rims < huge &&
          rims > worth * could_be))
        return false;

    const bool is_upright = v.size() > u.size();
    const Extent &longer = is_upright ? v : u, &shorter = is_upright ? u : v;
    const float* const along = is_upright ? v_.data() : u_.data();
    const float* const beside = is_upright ? u_.data() : v_.data();
    const int columns = static_cast<int>(longer.size() / cell) + 2;
    const int rows = static_cast<int>(shorter.size() / cell) + 2;
    const int bits = std::bit_width(static_cast<unsigned>(rows - 1));
    const int keys = ((columns >> bits) + 1) << 2 * bits;
    if (keys > 0x10000) return false;
    key_.resize(most);
    // Half a step of a regular grid, so that none of its points is on the border of two cells.
    constexpr float half_step = 0.125F;
    const float per_cell = 1.0F / cell;
    const auto last_column = static_cast<float>(columns - 1),
               last_row = static_cast<float>(rows - 1);
    for (std::size_t i = 0; i < count; ++i) {
        const int x =
            static_cast<int>(clamped((along[i] - longer.low) * per_cell + half_step, last_column));
        const int y =
            static_cast<int>(clamped((beside[i] - shorter.low) * per_cell + half_step, last_row));
        key_[i] = static_cast<std::uint16_t>((x >> bits) << 2 * bits |
                                             spread(x & ((1 << bits) - 1)) | spread(y) << 1);
    }
    sort(count, static_cast<unsigned>(keys));
    return true;
}

void TileOrder::sort(std::size_t count, unsigned keys) {
    ends_.assign(keys + 1, 0);
    order_.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        ++ends_[key_[i] + 1U];
    for (unsigned key = 0; key < keys; ++key)
        ends_[key + 1] += ends_[key];
    for (std::size_t i = 0; i < count; ++i)
        order_[ends_[key_[i]]++] = static_cast<std::uint32_t>(i);
}

template bool TileOrder::find(const RayStream<float>&, bool);
template bool TileOrder::find(const RayStream<double>&, bool);

} // namespace raylane::simd
