#include "core/shapes/packed_spheres.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace raylane::core {

namespace {

std::uint32_t pattern_of(float number) {
    return std::bit_cast<std::uint32_t>(number);
}

/// Range of a block's coordinates along one axis, as the integers of their bit patterns. Empty
/// lanes do not count. They follow the lanes that hold spheres.
struct Span {
    std::uint32_t least = PackedBlock::empty, most = 0;

    Span(const Block<Sphere>& block, int axis) {
        for (int lane = 0; lane < block_size && block.ids[lane] != no_shape; ++lane) {
            least = std::min(least, pattern_of(block.values[axis][lane]));
            most = std::max(most, pattern_of(block.values[axis][lane]));
        }
    }
    bool is_narrow() const { return most < least || most - least < PackedBlock::step_limit; }
};

bool has_all_radii(const Block<Sphere>& block, const RadiusPalette& palette) {
    for (int lane = 0; lane < block_size && block.ids[lane] != no_shape; ++lane)
        if (palette.find(block.values[3][lane]) == RadiusPalette::none) return false;
    return true;
}

/// Returns a mask of the rows that are stored outside of the block.
unsigned whole_rows_of(const Block<Sphere>& block, const RadiusPalette& palette) {
    unsigned rows = 0;
    for (int axis = 0; axis < 3; ++axis)
        if (!Span(block, axis).is_narrow()) rows |= PackedBlock::is_whole << axis;
    if (!has_all_radii(block, palette)) rows |= PackedBlock::is_whole << 3;
    return rows;
}

} // namespace

/// A word of all ones marks an empty lane, so the palette does not use the last number.
RadiusPalette::RadiusPalette(std::size_t id_count)
    : id_bits_(
          std::max(static_cast<int>(std::bit_width(std::max<std::size_t>(id_count, 1) - 1)), 8)),
      capacity_(std::min(most, (std::size_t{1} << (32 - id_bits_)) - 1)) {}

std::size_t RadiusPalette::place_of(float radius) const {
    std::size_t place = pattern_of(radius) * 0x9E3779B1U >> 22;
    while (places_[place] != 0 && pattern_of(radii_[places_[place] - 1U]) != pattern_of(radius))
        place = (place + 1) % places_.size();
    return place;
}

void RadiusPalette::add(float radius) {
    std::uint16_t& number = places_[place_of(radius)];
    if (number != 0 || size_ == capacity_) return;
    radii_[size_++] = radius;
    number = static_cast<std::uint16_t>(size_);
}

std::uint32_t RadiusPalette::find(float radius) const {
    const std::uint32_t number = places_[place_of(radius)];
    return number == 0 ? none : number - 1;
}

int whole_rows(const Block<Sphere>& block, const RadiusPalette& palette) {
    return std::popcount(whole_rows_of(block, palette));
}

PackedBlock pack(const Block<Sphere>& block, const RadiusPalette& palette, std::uint32_t first_row,
                 std::array<float, block_size>* rows) {
    PackedBlock packed{};
    const unsigned whole_rows = whole_rows_of(block, palette);
    packed.own_rows = first_row << PackedBlock::rows | whole_rows;
    for (int row = 0; row < PackedBlock::rows; ++row)
        if ((whole_rows >> row & 1) != 0)
            std::copy_n(block.values[row], block_size, (rows++)->begin());
    for (int axis = 0; axis < 3; ++axis) {
        if ((whole_rows >> axis & 1) != 0) continue;
        packed.least[axis] = Span(block, axis).least;
        for (int lane = 0; lane < block_size && block.ids[lane] != no_shape; ++lane) {
            const std::uint32_t step = pattern_of(block.values[axis][lane]) - packed.least[axis];
            for (int byte = 0; byte < 3; ++byte)
                packed.steps[axis][3 * lane + byte] = static_cast<std::uint8_t>(step >> 8 * byte);
        }
    }
    for (int lane = 0; lane < block_size; ++lane) {
        packed.words[lane] = PackedBlock::empty;
        if (block.ids[lane] == no_shape) continue;
        const std::uint32_t radius = palette.find(block.values[3][lane]);
        packed.words[lane] = block.ids[lane] | (radius == RadiusPalette::none ? 0 : radius)
                                                   << palette.id_bits();
    }
    return packed;
}

float PackedSpheres::value(const PackedBlock& block, int row, int lane) const {
    const unsigned before = (1U << row) - 1;
    if ((block.own_rows >> row & 1) != 0)
        return rows[(block.own_rows >> PackedBlock::rows) +
                    static_cast<unsigned>(std::popcount(block.own_rows & before))][lane];
    if (block.words[lane] == PackedBlock::empty) return std::numeric_limits<float>::quiet_NaN();
    if (row == 3) return palette.radius(block.words[lane]);
    const std::uint8_t* const step =
        block.steps[row] + std::size_t{3} * static_cast<unsigned>(lane);
    return std::bit_cast<float>(
        block.least[row] + (step[0] | std::uint32_t{step[1]} << 8 | std::uint32_t{step[2]} << 16));
}

Sphere PackedSpheres::get(std::size_t index, int lane) const {
    const PackedBlock& block = blocks[index];
    return {{value(block, 0, lane), value(block, 1, lane), value(block, 2, lane)},
            value(block, 3, lane)};
}

Block<Sphere> PackedSpheres::block(std::size_t index) const {
    Block<Sphere> block;
    for (int lane = 0; lane < block_size && id(index, lane) != no_shape; ++lane)
        block.set(lane, get(index, lane), id(index, lane));
    return block;
}

} // namespace raylane::core
