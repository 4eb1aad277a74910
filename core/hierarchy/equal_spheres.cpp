#include "core/hierarchy/equal_spheres.hpp"

#include "core/hierarchy/hash.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace raylane::core {

namespace {

/// Hashes of the spheres of a block; 0 for parts of solids and for empty lanes.
using BlockHashes = std::array<std::uint64_t, block_size>;

BlockHashes hashes_of(const Blocks<Sphere>& blocks, std::size_t index,
                      const MaterialIndices& material_of, const Solids& solids) {
    const Block<Sphere>& block = blocks.floats[index];
    BlockHashes hashes{};
    for (int lane = 0; lane < block_size && block.ids[lane] != no_shape; ++lane) {
        const ShapeId id = block.ids[lane];
        if (solids.has(id)) continue;
        std::uint64_t hash = material_of[id] + 1;
        const auto add = [&]<class Numbers>(const Numbers& numbers) {
            constexpr std::size_t count = sizeof numbers / sizeof hash;
            for (const auto word : std::bit_cast<std::array<std::uint64_t, count>>(numbers))
                hash = mixed(hash, word);
        };
        if (blocks.doubles.empty())
            add(block.get(lane));
        else
            add(blocks.doubles[index].get(lane));
        hashes[lane] = hash | 1;
    }
    return hashes;
}

} // namespace

EqualSpheres::EqualSpheres(std::size_t slots)
    : bits_(static_cast<int>(std::bit_width(slots * 3 / 2))), seen_(std::size_t{1} << bits_) {
    std::fill(seen_.begin(), seen_.end(), 0);
}

void EqualSpheres::add(const Blocks<Sphere>& blocks, std::size_t first, std::size_t last,
                       const MaterialIndices& material_of, const Solids& solids) {
    // A number's place comes from a hash's upper bits, the number from the lower ones.
    const auto place_of = [&](std::uint64_t hash) {
        return static_cast<std::size_t>(hash >> (64 - bits_));
    };
    BlockHashes next{};
    for (std::size_t index = first; index <= last; ++index) {
        const BlockHashes hashes = next;
        if (index < last) next = hashes_of(blocks, index, material_of, solids);
        for (const std::uint64_t hash : next)
            __builtin_prefetch(&seen_[place_of(hash)]);
        for (const std::uint64_t hash : hashes) {
            if (hash == 0) continue;
            const auto number = static_cast<std::uint32_t>(hash);
            std::size_t at = place_of(hash);
            while (seen_[at] != 0 && seen_[at] != number)
                at = (at + 1) & (seen_.size() - 1);
            may_be_any_ = may_be_any_ || seen_[at] == number;
            seen_[at] = number;
        }
    }
}

} // namespace raylane::core
