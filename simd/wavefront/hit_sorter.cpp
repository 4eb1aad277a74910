#include "simd/wavefront/hit_sorter.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace raylane::simd {

void HitSorter::take_from(Arena& arena, std::size_t capacity) {
    keys_ = arena.take<std::uint32_t>(capacity);
    order_ = arena.take<std::uint32_t>(capacity);
    scratch_ = arena.take<std::uint32_t>(capacity);
    runs_.reserve(capacity);
}

void HitSorter::sort(const std::uint32_t* slots, std::size_t count,
                     std::span<const std::uint32_t> at_contacts, const std::uint32_t* passed,
                     std::uint32_t most) {
    const std::vector<MaterialView>& views = scene_.materials();
    const auto materials = static_cast<std::uint32_t>(views.size());
    const std::uint32_t missed = materials, left_out = materials + 1;
    for (std::size_t lane = 0; lane < count; ++lane)
        keys_[lane] = slots[lane] == no_slot ? missed : scene_.record_of(slots[lane]).material;
    if (passed != nullptr)
        for (std::size_t lane = 0; lane < count; ++lane)
            if (keys_[lane] != missed && passed[lane] >= most && views[keys_[lane]].opacity < 1.0)
                keys_[lane] = materials - 1;
    for (const std::uint32_t lane : at_contacts)
        keys_[lane] = left_out;

    std::iota(order_, order_ + count, 0U);
    for (int shift = 0; shift < 32 && left_out >> shift != 0; shift += digit_bits)
        sort_by_digit(count, shift, std::min<std::size_t>((left_out >> shift) + 1, digits));

    runs_.clear();
    hit_count_ = 0;
    const auto end_of = [&](std::size_t begin) {
        const std::uint32_t key = keys_[order_[begin]];
        while (begin < count && keys_[order_[begin]] == key)
            ++begin;
        return begin;
    };
    while (hit_count_ < count && keys_[order_[hit_count_]] < materials) {
        const std::size_t begin = hit_count_;
        hit_count_ = end_of(begin);
        runs_.push_back({&views[keys_[order_[begin]]], begin, hit_count_});
    }
    missed_count_ = hit_count_ < count && keys_[order_[hit_count_]] == missed
                        ? end_of(hit_count_) - hit_count_
                        : 0;
}

/// Does one pass of a radix sort, by a digit below `values`.
void HitSorter::sort_by_digit(std::size_t count, int shift, std::size_t values) {
    std::array<std::uint32_t, digits + 1> begin;
    std::fill_n(begin.begin(), values + 1, 0U);
    const auto digit_of = [&](std::size_t lane) { return keys_[lane] >> shift & (digits - 1); };
    for (std::size_t lane = 0; lane < count; ++lane)
        ++begin[digit_of(lane) + 1];
    for (std::size_t value = 1; value < values; ++value)
        begin[value] += begin[value - 1];
    for (std::size_t i = 0; i < count; ++i)
        scratch_[begin[digit_of(order_[i])]++] = order_[i];
    std::swap(order_, scratch_);
}

} // namespace raylane::simd
