#pragma once

#include "simd/kernel/lanes/short_lanes.hpp"
#include "simd/kernel/traverse/ray_lanes.hpp"

namespace raylane::simd {

/// Sixteen rays of a frustum in contiguous memory. In streams, each value needs its address looked
/// up.
///
/// Drawing: bench/drawings/packet.svg
template <class Arch, class Method>
struct alignas(64) Packet : Streams<Arch> {
    using S = Streams<Arch>;
    static constexpr std::size_t size = 16;

    float origin[3][size], direction[3][size], slack[size];
    std::uint32_t origin_first[size], origin_last[size];

    void gather(const RoundedRays& rays, std::size_t i) {
        for (std::size_t k = 0; k < size; k += S::lanes, i += S::lanes) {
            for (int axis = 0; axis < 3; ++axis) {
                S::load(rays.origin[axis] + i).store_unaligned(origin[axis] + k);
                S::load(rays.direction[axis] + i).store_unaligned(direction[axis] + k);
            }
            S::load(rays.slack + i).store_unaligned(slack + k);
            S::store_bits(S::load_bits(rays.origin_first + i), origin_first + k);
            S::store_bits(S::load_bits(rays.origin_last + i), origin_last + k);
        }
    }

    /// Returns the rays from k on, one per lane.
    [[gnu::always_inline]] RayLanes<Arch, Method> packet(std::size_t k) const {
        const auto load = [&](const float(&rows)[3][size]) {
            return Vectors<Arch>{S::load(rows[0] + k), S::load(rows[1] + k), S::load(rows[2] + k)};
        };
        return {{load(origin), load(direction), S::load(slack + k)},
                S::load_bits(origin_first + k),
                S::load_bits(origin_last + k)};
    }
};

/// Faces with deferred tests that rays of a frustum cross within a part that they cut, with these
/// rays.
template <class Arch>
class CrossedFaces {
  public:
    /// Records that rays of a packet, given as bits, cross a face.
    void note(std::uint32_t slot, std::size_t packet, std::uint32_t rays) {
        int face = 0;
        while (face < count_ && slots_[face] != slot)
            ++face;
        if (face == most) {
            has_room_ = false;
            return;
        }
        if (face == count_) {
            slots_[count_++] = slot;
            for (std::uint16_t& of_packet : rays_[face])
                of_packet = 0;
        }
        rays_[face][packet] = static_cast<std::uint16_t>(rays_[face][packet] | rays);
    }
    bool has_room() const { return has_room_; }
    int count() const { return count_; }
    std::uint32_t slot(int face) const { return slots_[face]; }
    std::uint32_t rays(int face, std::size_t packet) const { return rays_[face][packet]; }

  private:
    static constexpr int most = 32;

    int count_ = 0;
    bool has_room_ = true;
    std::uint32_t slots_[most];
    std::uint16_t rays_[most][16];
};

/// Candidates for the nearest hits of a frustum's rays, with the interface that FrustumWalk
/// requires.
template <class Arch, class Method>
class FrustumCandidates : Streams<Arch> {
    using S = Streams<Arch>;

    struct Rays : Packet<Arch, Method> {
        float first[16], second[16];
        std::uint32_t slot[16];

        Candidates found() { return {first, second, slot}; }
    };
    const SceneView& scene_;
    Rays packets_[16];
    CrossedFaces<Arch> crossed_;

    /// Records the faces that rays of a packet, from k on, cross.
    struct Notes {
        static constexpr bool asks = true;
        CrossedFaces<Arch>& to;
        std::size_t packet, k;

        void operator()(std::uint32_t slot, std::uint32_t rays) const {
            to.note(slot, packet, rays << k);
        }
    };

  public:
    FrustumCandidates(const SceneView& scene, const RoundedRays& rays, const Candidates& candidates,
                      std::size_t begin, std::size_t end)
        : scene_(scene) {
        for (std::size_t i = begin; i < end; i += 16) {
            Rays& packet = packets_[(i - begin) / 16];
            packet.gather(rays, i);
            for (std::size_t k = 0; k < 16; k += S::lanes) {
                LaneCandidates<Arch> found(candidates, i + k);
                // Absent rays get a hit at t = 0.
                const std::size_t filled = i + k < end ? end - i - k : 0;
                found.first = select(S::first_lanes(filled), found.first, zero<Arch>());
                found.store(packet.found(), k);
            }
        }
    }

    /// Tests one shape against one packet.
    template <class Filter>
    [[gnu::always_inline]] void test(const Filter& filter, std::uint32_t id, std::uint32_t slot,
                                     std::size_t which) {
        if (knows_cuts<Method> && S::waits(scene_, slot)) return;
        Rays& packet = packets_[which];
        for (std::size_t k = 0; k < 16; k += S::lanes) {
            LaneCandidates<Arch> found(packet.found(), k);
            found.test(filter, id, slot, cut_of<Method>(scene_, slot), packet.packet(k),
                       Notes{crossed_, which, k});
            found.store(packet.found(), k);
        }
    }

    /// Returns the faces with deferred tests, which are to be tested against the rays that cross
    /// them.
    const CrossedFaces<Arch>& crossed() const { return crossed_; }
    template <class Filter>
    [[gnu::always_inline]] void test_crossed(const Filter& filter, std::uint32_t id, int face) {
        const std::uint32_t slot = crossed_.slot(face);
        for (std::size_t which = 0; which < 16; ++which) {
            const std::uint32_t bits = crossed_.rays(face, which);
            if (bits == 0) continue;
            float crosses[16];
            for (std::size_t k = 0; k < 16; ++k)
                crosses[k] = static_cast<float>(bits >> k & 1);
            Rays& packet = packets_[which];
            for (std::size_t k = 0; k < 16; k += S::lanes) {
                LaneCandidates<Arch> found(packet.found(), k);
                const LaneCandidates<Arch> before = found;
                found.test(filter, id, slot, cut_of<Method>(scene_, slot), packet.packet(k));
                found.keep(S::load(crosses + k) > zero<Arch>(), before);
                found.store(packet.found(), k);
            }
        }
    }

    /// Returns the t beyond which crossings do not matter to a packet.
    float limit_of(std::size_t which) const {
        return S::greatest_of_16(packets_[which].first) * culling_slack;
    }

    void hand_back(const Candidates& candidates, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; i += S::lanes) {
            Rays& packet = packets_[(i - begin) / 16];
            LaneCandidates<Arch>(packet.found(), (i - begin) % 16).store(candidates, i);
        }
    }
};

/// Occlusions of a frustum's rays, with the interface that FrustumWalk requires.
template <class Arch, class Method>
class FrustumOcclusions : Streams<Arch> {
    using S = Streams<Arch>;

    struct Rays : Packet<Arch, Method> {
        float t_limit[16];
    };
    const SceneView& scene_;
    Rays packets_[16];
    /// Rays as bits, by packet.
    std::uint32_t blocked_[16], doubtful_[16] = {};

  public:
    FrustumOcclusions(const SceneView& scene, const RoundedRays& rays, const Occlusions& occlusions,
                      std::size_t begin, std::size_t end)
        : scene_(scene) {
        for (std::size_t which = 0; which < 16; ++which) {
            const std::size_t i = begin + 16 * which;
            blocked_[which] = 0xFFFF; // absent rays
            if (i >= end) continue;
            packets_[which].gather(rays, i);
            for (std::size_t k = 0; k < 16; k += S::lanes)
                S::load(occlusions.t_limit + i + k).store_unaligned(packets_[which].t_limit + k);
            with_states(occlusions.state + i, end - i, [&](const std::uint8_t* states) {
                blocked_[which] = ShortLanes<Arch>::equal_16(states, blocked);
            });
        }
    }

    /// Tests one shape against one packet.
    template <class Filter>
    [[gnu::always_inline]] void test(const Filter& filter, std::uint32_t id, std::uint32_t slot,
                                     std::size_t which) {
        if (blocked_[which] == 0xFFFF || only_cuts<Arch, Method>(scene_, slot)) return;
        const bool plain = S::is_plain(scene_, slot);
        const Rays& packet = packets_[which];
        for (std::size_t k = 0; k < 16; k += S::lanes) {
            LaneOcclusions<Arch> found({packet.t_limit, nullptr}, k);
            found.test(filter, id, plain, cut_of<Method>(scene_, slot), packet.packet(k),
                       ~blocked_[which] >> k);
            blocked_[which] |= found.sure << k;
            doubtful_[which] |= found.maybe_blocked << k;
        }
    }

    /// Returns the limit of t for a packet: negative if all of its rays are blocked.
    float limit_of(std::size_t which) const {
        return blocked_[which] == 0xFFFF ? -1.0F : __builtin_inff();
    }

    void hand_back(const Occlusions& occlusions, std::size_t begin, std::size_t end) const {
        for (std::size_t i = begin, which = 0; i < end; i += 16, ++which)
            with_states(occlusions.state + i, end - i, [&](std::uint8_t* states) {
                ShortLanes<Arch>::raise_16(states, doubtful_[which], doubtful);
                ShortLanes<Arch>::raise_16(states, blocked_[which], blocked);
            });
    }

  private:
    /// Calls visit(states) for 16 states, of which at most `count` exist. The others are blocked.
    template <class Visit>
    static void with_states(std::uint8_t* state, std::size_t count, const Visit& visit) {
        if (count >= 16) return visit(state);
        std::uint8_t buffer[16];
        for (std::size_t k = 0; k < 16; ++k)
            buffer[k] = k < count ? state[k] : std::uint8_t{blocked};
        visit(buffer);
        for (std::size_t k = 0; k < count; ++k)
            state[k] = buffer[k];
    }
};

} // namespace raylane::simd
