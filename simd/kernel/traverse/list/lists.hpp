#pragma once

#include "simd/kernel/lanes/short_lanes.hpp"
#include "simd/kernel/traverse/pairs.hpp"

namespace raylane::simd {

/// Traces many rays down the wide hierarchy as one list (a ray stream). A node is loaded once for
/// all rays that come to it, and each of its children gets the list of the rays that enter it. Rays
/// whose directions have the same signs go together, so that a node's children have the same order
/// for all rays of a list.
///
/// `Answer` is derived from this class, and has these functions:
/// - take<Filter>(table, number, block, ray): tests a ray against a block
/// - take<Filter>(pairs): the same for pairs
template <class Arch, class Method, class Answer>
class RayLists : protected Streams<Arch> {
  protected:
    using S = Streams<Arch>;
    using typename S::F;
    using typename S::M;
    using Number = std::uint16_t; ///< number of a ray
    using Record = ListRecord;

    /// The number of rays whose bounds with a block are computed together.
    static constexpr int batch = 64;

    const SceneView& scene_;
    const RoundedRays& rays_;
    TraceCounters& counters_;
    Record* records_; ///< `best.first` is the limit of t, and negative if the ray is done
    Number* free_;    ///< free memory for further lists
    int octant_ = 0;
    PairsByKind<Arch, Method> pairs_;

    RayLists(const SceneView& scene, const RoundedRays& rays, const Workspace& workspace,
             TraceCounters& counters)
        : scene_(scene), rays_(rays), counters_(counters),
          records_(reinterpret_cast<Record*>(workspace.records)), free_(workspace.lists) {}

    Answer& answer() { return static_cast<Answer&>(*this); }

    static int octant_of(const Record& record) {
        int octant = 0;
        for (int axis = 0; axis < 3; ++axis)
            octant |= static_cast<int>(record.box.template falls<Arch>(axis)) << axis;
        return octant;
    }

    /// Traces all rays to their ends.
    void descend(std::size_t count) {
        BoxRays<Arch> box_rays;
        int starts[9] = {};
        for (std::size_t i = 0; i < count; ++i) {
            if (i % 16 == 0) box_rays.load(scene_, rays_, i);
            records_[i].box = box_rays.get(static_cast<int>(i % 16));
            ++starts[octant_of(records_[i]) + 1];
        }
        for (int octant = 0; octant < 8; ++octant)
            starts[octant + 1] += starts[octant];
        Number* const list = free_;
        free_ += count;
        int ends[8];
        for (int octant = 0; octant < 8; ++octant)
            ends[octant] = starts[octant];
        for (std::size_t i = 0; i < count; ++i)
            list[ends[octant_of(records_[i])]++] = static_cast<Number>(i);
        for (octant_ = 0; octant_ < 8; ++octant_)
            if (ends[octant_] != starts[octant_])
                at_child(0, list + starts[octant_], ends[octant_] - starts[octant_]);
        pairs_.flush([&]<class Filter>(const Pairs<Arch, Method>& pairs) {
            answer().template take<Filter>(pairs);
        });
    }

  private:
    void at_child(std::uint32_t child, const Number* list, int count) {
        if ((child & child_is_block) != 0)
            at_block(child, list, count);
        else
            at_node(child, list, count);
    }

    void at_node(std::uint32_t index, const Number* list, int count) {
        const NodeView& node = scene_.nodes[index];
        counters_.nodes += static_cast<std::uint64_t>(count);
        Number* const masks = free_;
        Number* const entered = masks + count;
        std::uint32_t any = enter(node, list, count, masks);
        std::uint64_t order = scene_.orders[8 * index + static_cast<unsigned>(octant_)];
        for (; any != 0; order >>= 4) {
            const auto entry = static_cast<unsigned>(order & 15);
            if ((any >> entry & 1) == 0) continue;
            any &= ~(1U << entry);
            const int picked = ShortLanes<Arch>::pick(list, masks, count, entry, entered);
            free_ = entered + picked;
            at_child(node.children[entry], entered, picked);
        }
        free_ = masks;
    }

    /// Finds the children that each ray enters, as bits in `masks`. Returns those that any ray
    /// enters.
    std::uint32_t enter(const NodeView& node, const Number* list, int count, Number* masks) const {
        switch (octant_) {
        case 0:
            return enter<false, false, false>(node, list, count, masks);
        case 1:
            return enter<true, false, false>(node, list, count, masks);
        case 2:
            return enter<false, true, false>(node, list, count, masks);
        case 3:
            return enter<true, true, false>(node, list, count, masks);
        case 4:
            return enter<false, false, true>(node, list, count, masks);
        case 5:
            return enter<true, false, true>(node, list, count, masks);
        case 6:
            return enter<false, true, true>(node, list, count, masks);
        default:
            return enter<true, true, true>(node, list, count, masks);
        }
    }

    template <bool x_falls, bool y_falls, bool z_falls>
    std::uint32_t enter(const NodeView& node, const Number* list, int count, Number* masks) const {
        static constexpr bool falls[] = {x_falls, y_falls, z_falls};
        std::uint32_t any = 0;
        for (int from = 0, end = end_of_filled<Arch>(node.children); from < end;
             from += static_cast<int>(F::size)) {
            F near_planes[3], far_planes[3];
            for (int axis = 0; axis < 3; ++axis) {
                near_planes[axis] = S::load((falls[axis] ? node.upper : node.lower)[axis] + from);
                far_planes[axis] = S::load((falls[axis] ? node.lower : node.upper)[axis] + from);
            }
            const std::uint32_t filled = S::filled(node, from);
            for (int k = 0; k < count; ++k) {
                const Record& record = records_[list[k]];
                const F t_limit(record.best.first * culling_slack);
                F near = zero<Arch>();
                const std::uint32_t bits =
                    record.box.template enter<Arch>(near_planes, far_planes, t_limit, near);
                const std::uint32_t before = from == 0 ? 0U : masks[k];
                masks[k] = static_cast<Number>(before | (bits & filled) << from);
                any |= bits << from;
            }
            any &= filled << from | ((1U << from) - 1);
        }
        return any;
    }

    void at_block(std::uint32_t child, const Number* list, int count) {
        const core::Kind kind = S::kind_of(child);
        counters_.shapes += 16 * static_cast<std::uint64_t>(count);
        Method::with_filter(
            kind, [&]<class Filter>() { test<Filter>(kind, child & child_index, list, count); });
    }

    /// A separate function, as compilers reach their limits of inlining in one function for all
    /// kinds.
    template <class Filter>
    [[gnu::noinline, gnu::flatten]] void test(core::Kind kind, std::uint32_t number,
                                              const Number* list, int count) {
        const TableView& table = S::table_of(scene_, kind);
        BlockRoom<Arch> room;
        const float* const block = S::template block_for<Filter>(table, number, room);
        if constexpr (packs_pairs<Filter, Method>) {
            Pairs<Arch, Method>& pairs = pairs_.of(kind);
            const auto take_them = [&] { answer().template take<Filter>(pairs); };
            for (int k = 0; k < count; ++k)
                pairs.template gather<Filter>(table, number, block, rays_, list[k], list[k],
                                              take_them);
        } else {
            for (int begin = 0; begin < count; begin += batch) {
                Number batch_values[batch];
                int found = 0;
                for (int k = begin; k < begin + batch && k < count; ++k) {
                    batch_values[found] = list[k];
                    const std::uint32_t bits = Leaf<Arch, Method>::template may_meet<Filter>(
                        PlainLanes<Arch>(table, block), rays_, list[k]);
                    found += static_cast<int>(bits != 0);
                }
                for (int k = 0; k < found; ++k)
                    answer().template take<Filter>(table, number, block, batch_values[k]);
            }
        }
    }
};

} // namespace raylane::simd
