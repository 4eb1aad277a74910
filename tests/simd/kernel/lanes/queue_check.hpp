#pragma once

#include "simd/kernel/traverse/traversal_queue.hpp"

/// For units that are built for one instruction set, like lanes_check.hpp.
namespace raylane::simd {

/// Traces a ray that enters all boxes of a full tree. Counts levels that are visited too rarely or
/// too often, and writes beyond the queue's capacity.
template <class Arch>
struct QueueCheck {
    static int failures() {
        constexpr std::uint32_t levels = 5, level_unit = 1U << 24, canary = 0xDEADBEEF;
        constexpr std::size_t room = pending_entries(levels);
        static std::uint16_t keys[2 * room];
        static std::uint32_t children[2 * room];
        int failures = 0;
        for (int steps = 0; steps < 3; ++steps) { // how far keys may rise below a node
            for (std::size_t i = 0; i < 2 * room; ++i) {
                keys[i] = static_cast<std::uint16_t>(canary);
                children[i] = canary;
            }
            TraversalQueue<Arch> queue;
            queue.place({keys, children}, 0, levels);
            queue.start(0);
            std::uint32_t visited[levels + 1] = {};
            std::uint32_t random = 1;
            for (std::uint32_t child; (child = queue.pop_before(__builtin_inff())) != no_child;) {
                const std::uint32_t level = child / level_unit;
                if (level > levels) return failures + 1;
                ++visited[level];
                if (level == levels) continue;
                for (int from = 0; from < 16; from += static_cast<int>(Floats<Arch>::size)) {
                    float near[16];
                    std::uint32_t below[16];
                    for (int i = 0; i < 16; ++i) {
                        random = random * 1664525 + 1013904223;
                        below[i] = (level + 1) * level_unit;
                        near[i] = static_cast<float>((random >> 24) * static_cast<unsigned>(steps));
                    }
                    queue.add(Floats<Arch>::load_unaligned(near), below,
                              (1U << Floats<Arch>::size) - 1);
                }
            }
            for (std::uint32_t level = 0; level <= levels; ++level)
                failures += visited[level] == 1U << 4 * level ? 0 : 1;
            for (std::size_t i = room; i < 2 * room; ++i)
                failures +=
                    keys[i] == static_cast<std::uint16_t>(canary) && children[i] == canary ? 0 : 1;
        }
        return failures;
    }
};

/// Runs QueueCheck; defined in the kernel unit of each instruction set.
template <Isa isa>
int queue_failures();

} // namespace raylane::simd
