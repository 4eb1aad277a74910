#pragma once

#include "simd/arena.hpp"
#include "simd/scene_data.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace raylane::simd {

/// The order in which a wave is shaded: stably by material, then what has hit nothing.
class HitSorter {
  public:
    explicit HitSorter(const SceneData& scene) : scene_(scene) {}

    void take_from(Arena& arena, std::size_t capacity);

    /// The lanes that have hit these slots (no_slot: nothing), but those at contacts, which
    /// come last. `passed`, if there are any: how many see-through surfaces each has passed; after
    /// `most` no more of them are seen.
    void sort(const std::uint32_t* slots, std::size_t count,
              std::span<const std::uint32_t> at_contacts, const std::uint32_t* passed,
              std::uint32_t most);

    /// The lane at each position.
    const std::uint32_t* order() const { return order_; }
    /// Positions of one material, one run after the other, up to hit_count().
    const std::vector<Run>& runs() const { return runs_; }
    std::size_t hit_count() const { return hit_count_; }
    /// The lanes that have hit nothing.
    std::span<const std::uint32_t> missed() const { return {order_ + hit_count_, missed_count_}; }

  private:
    static constexpr int digit_bits = 8;
    static constexpr std::size_t digits = std::size_t{1} << digit_bits;

    void sort_by_digit(std::size_t count, int shift, std::size_t values);

    const SceneData& scene_;
    std::uint32_t* keys_ = nullptr; // by lane: the material, or one of two that follow
    std::uint32_t* order_ = nullptr;
    std::uint32_t* scratch_ = nullptr;
    std::size_t hit_count_ = 0;
    std::size_t missed_count_ = 0;
    std::vector<Run> runs_;
};

} // namespace raylane::simd
