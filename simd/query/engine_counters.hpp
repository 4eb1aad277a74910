#pragma once

#include "core/reference/counters.hpp"
#include "simd/units/trace_kernels.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace raylane::simd {

/// Counts of the vector engine's work.
struct EngineCounters : core::Counters {
    std::uint64_t walked = 0;   ///< shadow rays that were followed from surface to surface
    std::uint64_t deferred = 0; ///< paths deferred because a wave had grown too long
    std::uint64_t refined = 0;  ///< rays that were not certified at first
    /// Rays by the method of their search: brute force, frusta, ray streams (lists), or interleaved
    /// single rays.
    std::uint64_t one_by_one = 0, in_frusta = 0, in_lists = 0, in_flight = 0;
    /// Work left to the reference tracer:
    std::uint64_t doubtful = 0; ///< rays whose nearest shape it decides
    std::uint64_t followed = 0; ///< paths, where surfaces meet or waves grow too long

    using core::Counters::operator+=;
    EngineCounters& operator+=(const EngineCounters& other) {
        return core::add_counts(*this, other);
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

    /// All counters, in the order of their declaration.
    using Numbers = std::array<std::uint64_t, 17>;
    Numbers as_numbers() const { return std::bit_cast<Numbers>(*this); }
    static EngineCounters of_numbers(const Numbers& numbers) {
        return std::bit_cast<EngineCounters>(numbers);
    }
};

} // namespace raylane::simd
