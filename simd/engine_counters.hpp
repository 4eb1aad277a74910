#pragma once

#include "core/reference/counters.hpp"
#include "simd/trace_kernels.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace raylane::simd {

/// Counts of the vector engine's work.
struct EngineCounters : core::Counters {
    std::uint64_t walked = 0;   ///< shadow rays that had to be followed from surface to surface
    std::uint64_t deferred = 0; ///< paths put off, as a wave had become too long
    std::uint64_t refined = 0;  ///< rays that have been decided on at second sight
    /// Rays by the way of their search: shape by shape, in frusta, by lists, or each by itself with
    /// others in flight.
    std::uint64_t one_by_one = 0, in_frusta = 0, in_lists = 0, in_flight = 0;
    /// Left to the reference:
    std::uint64_t doubtful = 0; ///< rays: to decide which shape is the nearest
    std::uint64_t followed = 0; ///< paths: to follow, where surfaces meet or waves grow too long

    using core::Counters::operator+=;
    EngineCounters& operator+=(const EngineCounters& other) {
        core::Counters::operator+=(other);
        walked += other.walked;
        deferred += other.deferred;
        refined += other.refined;
        one_by_one += other.one_by_one;
        in_frusta += other.in_frusta;
        in_lists += other.in_lists;
        in_flight += other.in_flight;
        doubtful += other.doubtful;
        followed += other.followed;
        return *this;
    }
    EngineCounters& operator-=(const EngineCounters& other) {
        auto numbers = as_numbers();
        const auto others = other.as_numbers();
        for (std::size_t i = 0; i < numbers.size(); ++i)
            numbers[i] -= others[i];
        return *this = of_numbers(numbers);
    }
    EngineCounters& operator+=(const TraceCounters& traced) {
        nodes += traced.nodes;
        shapes += traced.shapes;
        one_by_one += traced.one_by_one;
        in_frusta += traced.in_frusta;
        in_lists += traced.in_lists;
        in_flight += traced.in_flight;
        return *this;
    }

    /// All of them, in the order in which they are declared.
    using Numbers = std::array<std::uint64_t, 17>;
    Numbers as_numbers() const { return std::bit_cast<Numbers>(*this); }
    static EngineCounters of_numbers(const Numbers& numbers) {
        return std::bit_cast<EngineCounters>(numbers);
    }
};

} // namespace raylane::simd
