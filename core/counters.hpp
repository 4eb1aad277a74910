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
    /// What the vector engine has left to the reference to decide:
    std::uint64_t doubtful = 0; ///< rays: which shape is the nearest
    std::uint64_t contacts = 0; ///< rays where several surfaces meet: all that follows

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
        doubtful += other.doubtful;
        contacts += other.contacts;
        return *this;
    }
};

} // namespace raylane::core
