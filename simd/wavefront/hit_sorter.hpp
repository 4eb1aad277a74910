#pragma once

#include "simd/query/scene_data.hpp"
#include "simd/threads/arena.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace raylane::simd {

/// The order in which a wave is shaded: stably sorted by material, then the rays without a hit.
class HitSorter {
  public:
    explicit HitSorter(const SceneData& scene) : scene_(scene) {}

    void take_from(Arena& arena, std::size_t capacity);

    /// Sorts the lanes, which have hit these slots (no_slot: no hit). Lanes at contacts come last.
    /// `passed`, if not null: number of transparent surfaces that each lane has passed. After
    /// `most` of them, further ones are invisible.
    void sort(const std::uint32_t* slots, std::size_t count,
              std::span<const std::uint32_t> at_contacts, const std::uint32_t* passed,
              std::uint32_t most);

    /// Returns the lane at each position.
    const std::uint32_t* order() const { return order_; }
    /// Returns positions with one material each, one run after the other, up to hit_count().
    const std::vector<Run>& runs() const { return runs_; }
    std::size_t hit_count() const { return hit_count_; }
    /// Returns the lanes without a hit.
    std::span<const std::uint32_t> missed() const { return {order_ + hit_count_, missed_count_}; }

  private:
    static constexpr int digit_bits = 8;
    static constexpr std::size_t digits = std::size_t{1} << digit_bits;

    void sort_by_digit(std::size_t count, int shift, std::size_t values);

    const SceneData& scene_;
    // By lane: the material, or one of two values behind: missed, left out.
    std::uint32_t* keys_ = nullptr;
    std::uint32_t* order_ = nullptr;
    std::uint32_t* scratch_ = nullptr;
    std::size_t hit_count_ = 0;
    std::size_t missed_count_ = 0;
    std::vector<Run> runs_;
};

} // namespace raylane::simd
