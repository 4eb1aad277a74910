#pragma once

#include "simd/kernel/traverse/in_flight/in_flight.hpp"

namespace raylane::simd {

/// All shapes that many interleaved rays may cross. Implements RefineKernels::list_all.
template <class Arch, class Method>
class InFlightAll : InFlight<Arch, Method> {
    using S = Streams<Arch>;
    using Base = InFlight<Arch, Method>;
    using typename S::F;

    struct Lister : Base::Traveller {
        float t_limit;
        std::uint32_t* bottom; ///< holds no_child
        std::uint32_t* top;    ///< one past the last child that is yet to be visited
    };

    const SceneView& scene_;
    const RoundedRays& rays_;
    const float* const t_limit_;
    const std::size_t count_;
    PairList& list_;
    Lister listers_[in_flight];
    std::size_t next_ = 0, loaded_ = ~std::size_t{0};
    BoxRays<Arch> box_rays_{};

    InFlightAll(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                const float* t_limit, PairList& list)
        : scene_(scene), rays_(rays), t_limit_(t_limit), count_(count), list_(list) {}

  public:
    static void list(const SceneView& scene, std::uint32_t kind_bits, std::size_t count,
                     const RoundedRays& rays, const float* t_limit, const Pending& pending,
                     PairList& list) {
        InFlightAll walk(scene, count, rays, t_limit, list);
        walk.add_listed(kind_bits);
        if (pending.key == nullptr) return;
        for (std::size_t which = 0; which < in_flight; ++which) {
            walk.listers_[which].bottom = pending.child + pending_entries(scene.tree_depth) * which;
            *walk.listers_[which].bottom = no_child;
        }
        TraceCounters counters{};
        Base::go(scene, walk.listers_, walk, counters);
    }

    bool start(Lister& lister) {
        while (next_ < count_ && !(t_limit_[next_] > 0))
            ++next_;
        if (next_ >= count_) return false;
        if (loaded_ != next_ / 16) {
            loaded_ = next_ / 16;
            box_rays_.load(scene_, rays_, 16 * loaded_);
        }
        lister.set_out(box_rays_, next_);
        lister.t_limit = t_limit_[next_];
        lister.top = lister.bottom + 1;
        ++next_;
        return true;
    }

    static std::uint32_t next(Lister& lister) {
        const std::uint32_t child = lister.top[-1];
        --lister.top;
        return child;
    }

    static void at_node(Lister& lister, const NodeView& node) {
        const F t_limit(lister.t_limit);
        for (int from = 0, end = end_of_filled<Arch>(node.children); from < end;
             from += static_cast<int>(F::size)) {
            F near = zero<Arch>();
            const std::uint32_t bits =
                lister.box.template enter<Arch>(node, lister.rows, from, t_limit, near);
            Lanes<Arch>::compress_store(reinterpret_cast<float*>(lister.top),
                                        S::load_bits(node.children + from), bits);
            lister.top += __builtin_popcount(bits);
        }
    }

    void at_blocks(const int* which, int count) {
        Base::for_each_at_block(scene_, rays_, which, count, listers_, *this);
    }

    template <class Filter>
    [[gnu::always_inline]] void all(const Lister& lister, const TableView& table) {
        add_of_block<Filter>(table, lister.child & child_index, lister.i, lister.t_limit);
    }
    template <class Filter>
    [[gnu::always_inline]] void some(const Pairs<Arch, Method>& pairs) {
        const PairBounds bounds = pairs.template bound<Filter>();
        for (std::uint32_t bits = bounds.possible; bits != 0; bits &= bits - 1) {
            const int k = __builtin_ctz(bits);
            const Lister& lister = listers_[pairs.whose[k]];
            if (bounds.lower[k] < lister.t_limit) add(lister.i, pairs.slot[k]);
        }
    }

    static void land(const Lister&) {}

  private:
    /// Adds shapes of the kinds that are not in the hierarchy, or of all kinds in scenes without a
    /// hierarchy.
    void add_listed(std::uint32_t kind_bits) {
        S::for_each_kind(kind_bits, [&](core::Kind kind) {
            Method::with_filter(kind, [&]<class Filter>() { add_table<Filter>(kind); });
        });
    }
    template <class Filter>
    [[gnu::noinline, gnu::flatten]] void add_table(core::Kind kind) {
        const TableView& table = S::table_of(scene_, kind);
        for (std::size_t i = 0; i < count_; ++i)
            for (std::uint32_t block = 0; t_limit_[i] > 0 && block < table.block_count; ++block)
                add_of_block<Filter>(table, block, i, t_limit_[i]);
    }

    template <class Filter>
    [[gnu::always_inline]] void add_of_block(const TableView& table, std::uint32_t number,
                                             std::size_t i, float t_limit) {
        LeafHits hits;
        S::template with_lanes<Filter>(table, number, [&](const auto& block) {
            Leaf<Arch, Method>::template find<Filter>(block, nullptr, rays_, i, t_limit, hits);
        });
        for (std::uint32_t bits = hits.lanes; bits != 0; bits &= bits - 1)
            add(i,
                table.first_slot + 16 * number + static_cast<std::uint32_t>(__builtin_ctz(bits)));
    }

    void add(std::size_t ray, std::uint32_t slot) {
        if (list_.count < list_.room) {
            list_.ray[list_.count] = static_cast<std::uint32_t>(ray);
            list_.slot[list_.count] = slot;
        }
        ++list_.count;
    }
};

} // namespace raylane::simd
