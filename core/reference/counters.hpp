#pragma once

#include <cstdint>

namespace raylane::core {

/// What a rendering has done.
struct Counters {
    std::uint64_t primary = 0;   ///< rays from the camera
    std::uint64_t reflected = 0; ///< rays
    std::uint64_t refracted = 0; ///< rays
    std::uint64_t shadow = 0;    ///< rays
    std::uint64_t nodes = 0;     ///< wide nodes visited
    std::uint64_t shapes = 0;    ///< rays tested against one shape
    std::uint64_t widened = 0;   ///< of these, tests that had to be repeated in more than double
    std::uint64_t walked = 0;    ///< shadow rays that had to be followed from surface to surface
    std::uint64_t deferred = 0;  ///< paths put off, as a wave had become too long
    std::uint64_t refined = 0;   ///< rays that the vector engine has decided on at second sight
    /// How the vector engine has searched for what rays hit, as often as it did: shape by shape, by
    /// groups in a frustum, by lists in a stream, or each by itself with others in flight.
    std::uint64_t one_by_one = 0, in_frusta = 0, in_streams = 0, in_flight = 0;
    /// What the vector engine has left to the reference:
    std::uint64_t doubtful = 0; ///< rays: to decide which shape is the nearest
    std::uint64_t followed = 0; ///< paths: to follow, where surfaces meet or waves grow too long

    std::uint64_t rays() const { return primary + reflected + refracted + shadow; }

    Counters& operator+=(const Counters& other) {
        primary += other.primary;
        reflected += other.reflected;
        refracted += other.refracted;
        shadow += other.shadow;
        nodes += other.nodes;
        shapes += other.shapes;
        widened += other.widened;
        walked += other.walked;
        refined += other.refined;
        one_by_one += other.one_by_one;
        in_frusta += other.in_frusta;
        in_streams += other.in_streams;
        in_flight += other.in_flight;
        doubtful += other.doubtful;
        deferred += other.deferred;
        followed += other.followed;
        return *this;
    }
};

} // namespace raylane::core
