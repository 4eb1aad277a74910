#pragma once

#include "simd/kernel/traverse/in_flight/in_flight.hpp"
#include "simd/kernel/traverse/obstacles.hpp"

namespace raylane::simd {

/// Occlusion of many interleaved rays. A ray ends when it is blocked.
template <class Arch, class Method>
class InFlightOccluded : InFlight<Arch, Method> {
    using S = Streams<Arch>;
    using Base = InFlight<Arch, Method>;
    using typename S::F;

    struct Shadow : Base::Traveller {
        float t_limit;
        std::uint8_t state;
        std::uint32_t* bottom; ///< holds no_child
        std::uint32_t* top;    ///< one past the last child that is yet to be visited
    };

    const SceneView& scene_;
    const RoundedRays& rays_;
    const Occlusions& occlusions_;
    const std::size_t count_;
    Shadow shadows_[in_flight];
    std::size_t next_ = 0, loaded_ = ~std::size_t{0};
    BoxRays<Arch> box_rays_{};

    InFlightOccluded(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                     const Occlusions& occlusions, const Pending& pending)
        : scene_(scene), rays_(rays), occlusions_(occlusions), count_(count) {
        for (std::size_t which = 0; which < in_flight; ++which) {
            shadows_[which].bottom = pending.child + pending_entries(scene.tree_depth) * which;
            *shadows_[which].bottom = no_child;
        }
    }

  public:
    static void occluded(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                         const Occlusions& occlusions, const Pending& pending,
                         TraceCounters& counters) {
        InFlightOccluded walk(scene, count, rays, occlusions, pending);
        Base::go(scene, walk.shadows_, walk, counters);
    }

    /// Starts the next ray that is not blocked already.
    bool start(Shadow& shadow) {
        while (next_ < count_ && occlusions_.state[next_] == blocked)
            ++next_;
        if (next_ >= count_) return false;
        if (loaded_ != next_ / 16) {
            loaded_ = next_ / 16;
            box_rays_.load(scene_, rays_, 16 * loaded_);
        }
        shadow.set_out(box_rays_, next_);
        shadow.t_limit = occlusions_.t_limit[next_];
        shadow.state = occlusions_.state[next_];
        shadow.top = shadow.bottom + 1;
        ++next_;
        return true;
    }

    static std::uint32_t next(Shadow& shadow) {
        const std::uint32_t child = shadow.top[-1];
        --shadow.top;
        return child;
    }

    static void at_node(Shadow& shadow, const NodeView& node) {
        const F t_limit(shadow.t_limit);
        for (int from = 0, end = end_of_filled<Arch>(node.children); from < end;
             from += static_cast<int>(F::size)) {
            F near = zero<Arch>();
            const std::uint32_t bits =
                shadow.box.template enter<Arch>(node, shadow.rows, from, t_limit, near);
            Lanes<Arch>::compress_store(reinterpret_cast<float*>(shadow.top),
                                        S::load_bits(node.children + from), bits);
            shadow.top += __builtin_popcount(bits);
        }
    }

    void at_blocks(const int* which, int count) {
        Base::for_each_at_block(scene_, rays_, which, count, shadows_, *this);
    }

    /// Tests a ray against the block that it is at.
    template <class Filter>
    [[gnu::always_inline]] void all(Shadow& shadow, const TableView& table) const {
        const std::uint32_t number = shadow.child & child_index;
        take(shadow, S::template with_lanes<Filter>(table, number, [&](const auto& block) {
                 return Leaf<Arch, Method>::template occluded<Filter>(
                     scene_, table, number, block, rays_, shadow.i, shadow.t_limit);
             }));
    }
    /// Same for pairs.
    template <class Filter>
    [[gnu::always_inline]] void some(const Pairs<Arch, Method>& pairs) {
        for_each_obstacle<Filter>(
            scene_, pairs, [&](int which) { return shadows_[which].t_limit; },
            [&](int which, std::uint8_t state) { take(shadows_[which], state); });
    }

    static void take(Shadow& shadow, std::uint8_t state) {
        shadow.state = state > shadow.state ? state : shadow.state;
        shadow.top = state == blocked ? shadow.bottom + 1 : shadow.top;
    }

    void land(const Shadow& shadow) const { occlusions_.state[shadow.i] = shadow.state; }
};

} // namespace raylane::simd
