#include "simd/query/clip_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::simd {

namespace {

using core::Solids;
using core::Vec3d;

/// The half-spaces that make a part: their intersection is the part if `inside` is true. Otherwise
/// these are the complements, whose union is the reversed part.
class HalfSpacesOf {
  public:
    HalfSpacesOf(const core::Scene& scene, const Solids::Node& part, bool inside)
        : shape_(part.traced ? part.shape : core::no_shape - 1), inside_(inside) {
        core::with_table(scene.shapes(), part.kind,
                         [&](const auto& table) { add(table.get(part.place)); });
    }
    std::vector<HalfSpace>::const_iterator begin() const { return found_.begin(); }
    std::vector<HalfSpace>::const_iterator end() const { return found_.end(); }
    std::ptrdiff_t size() const { return std::ssize(found_); }

  private:
    void add(const core::PlaneOf<double>& plane) { take(plane.point, plane.normal); }
    /// Adds only quadrics that are planes.
    void add(const core::QuadricOf<double>& q) {
        if (q.xx == 0.0 && q.yy == 0.0 && q.zz == 0.0 && q.xy == 0.0 && q.xz == 0.0 &&
            q.yz == 0.0 && q.one == 0.0)
            take(q.center, {q.x, q.y, q.z});
    }
    void add(const core::BoxOf<double>& box) {
        const Vec3d* const edges[] = {&box.edge_u, &box.edge_v, &box.edge_w};
        for (int k = 0; k < 3; ++k) {
            const Vec3d &u = *edges[(k + 1) % 3], &v = *edges[(k + 2) % 3];
            Vec3d normal = core::cross(u, v);
            // With a normal this long, the differences of the cross product lose hardly a digit.
            if (!(core::length(normal) > 0x1p-3 * core::length(u) * core::length(v))) continue;
            if (core::dot(normal, *edges[k]) < 0.0) normal = -normal;
            take(box.corner, -normal);
            take(box.corner + *edges[k], normal);
        }
        if (!inside_ && found_.size() != 6) found_.clear();
        // A ray that starts on one face of a solid box may leave through another: it is at first
        // inside of that face's half-space, and outside of it later. For a subtracted box, the
        // half-spaces are turned around, so a ray from it that is outside of one later has been
        // outside of it since its start.
        for (HalfSpace& half : found_)
            half.stays = !inside_;
    }
    template <class Shape>
    void add(const Shape&) {}

    /// Adds the half-space behind a plane if `inside_`, and otherwise the one in front of it.
    void take(const Vec3d& point, const Vec3d& normal) {
        const double length = core::length(normal);
        if (!(length > 0x1p-400) || !(length < 0x1p+400)) return;
        const Vec3d unit = (inside_ ? 1.0 : -1.0) / length * normal;
        const double size =
            std::abs(unit.x * point.x) + std::abs(unit.y * point.y) + std::abs(unit.z * point.z);
        found_.push_back({unit, core::dot(unit, point), size, shape_, true, false});
    }

    core::ShapeId shape_;
    bool inside_;
    std::vector<HalfSpace> found_;
};

std::ptrdiff_t faces_of(const Solids::Node& part) {
    return part.kind == core::Kind::box ? 6 : 1;
}

/// Collects the half-spaces that cut a union (its clip planes), in groups. Nothing of the solid is
/// left outside of all half-spaces of one group.
class Collector {
  public:
    explicit Collector(const core::Scene& scene) : scene_(scene), solids_(scene.solids()) {}

    /// Returns the union at a node and everything that cuts it.
    CutUnion around(const Solids::Index below) {
        cut_ = {below, {}, true};
        for (Solids::Index index = below; solids_.node(index).parent != Solids::none;
             index = solids_.node(index).parent) {
            const Solids::Index parent = solids_.node(index).parent;
            if (solids_.node(parent).op != Solids::Op::all) {
                cut_.is_all = false;
                continue;
            }
            solids_.each_child(parent, [&](Solids::Index child) {
                if (child != index) add(child);
                return true;
            });
        }
        return cut_;
    }

  private:
    void add(Solids::Index index) {
        const Solids::Node& node = solids_.node(index);
        if (node.op == Solids::Op::part && !node.reversed) {
            // A point outside of any of its half-spaces is outside of the part, so each is a group.
            const HalfSpacesOf halves(scene_, node, true);
            for (const HalfSpace& half : halves)
                add_group({half});
            cut_.is_all = cut_.is_all && halves.size() == faces_of(node);
            return;
        }
        // A point outside of all parts of a union is outside of the union, so all are one group.
        std::vector<HalfSpace> group;
        bool is_known = !node.many;
        for (Solids::Index part = index; is_known && part < node.end; ++part) {
            const Solids::Node& part_node = solids_.node(part);
            if (part_node.op == Solids::Op::part) {
                const HalfSpacesOf more(scene_, part_node, !part_node.reversed);
                // The half-spaces of a part that is not reversed would need one group each.
                is_known =
                    more.size() == faces_of(part_node) && (part_node.reversed || more.size() == 1);
                group.insert(group.end(), more.begin(), more.end());
            } else {
                is_known = part_node.op == Solids::Op::any;
            }
        }
        if (is_known)
            add_group(std::move(group));
        else
            cut_.is_all = false;
    }

    void add_group(std::vector<HalfSpace> group) {
        if (group.empty() || cut_.by.size() + group.size() > ClipPlanesView::most) {
            cut_.is_all = false;
            return;
        }
        group.back().ends_group = true;
        cut_.by.insert(cut_.by.end(), group.begin(), group.end());
    }

    const core::Scene& scene_;
    const Solids& solids_;
    CutUnion cut_{};
};

ClipPlanesView view_of(const CutUnion& cut) {
    ClipPlanesView view{};
    for (const HalfSpace& half : cut.by) {
        const int k = view.count++;
        for (int axis = 0; axis < 3; ++axis)
            view.normal[axis][k] = static_cast<float>(half.normal[axis]);
        view.offset[k] = static_cast<float>(half.offset);
        view.shape[k] = half.stays ? half.shape : core::no_shape - 1;
        view.face[k] = no_slot;
        view.size = std::max(
            {view.size, 2.0F * std::abs(view.offset[k]), static_cast<float>(0x1p-20 * half.size)});
        if (half.ends_group) view.group_ends |= 1U << k;
    }
    view.is_all = cut.is_all;
    return view;
}

} // namespace

void ClipPlanes::find(const core::Scene& scene, SceneView& view, std::uint32_t slots) {
    constexpr std::uint16_t cuts_nothing = 1;
    const Solids& solids = scene.solids();
    number_.resize(solids.nodes().size());
    for (Solids::Index index = 0; index < number_.size(); ++index) {
        if (!solids.node(index).counts) continue;
        CutUnion cut = Collector(scene).around(index);
        if (cut.by.empty() || unions_.size() > std::numeric_limits<std::uint16_t>::max()) continue;
        if (unions_.empty()) {
            unions_.resize(cuts_nothing + 1);
            views_.resize(cuts_nothing + 1);
        }
        number_[index] = static_cast<std::uint16_t>(unions_.size());
        views_.push_back(view_of(cut));
        unions_.push_back(std::move(cut));
    }
    if (unions_.empty()) {
        number_ = {};
        return;
    }

    // A part beside one of these unions in an intersection is seen only where it cuts the union.
    cut_by_.resize(solids.nodes().size());
    for (Solids::Index index = 0; index < number_.size(); ++index) {
        const Solids::Index parent = solids.node(index).parent;
        if (number_[index] == 0 || solids.node(parent).op != Solids::Op::all) continue;
        solids.each_child(parent, [&](Solids::Index child) {
            // If both are unions of many parts, rays have to find one of them, so neither only
            // cuts.
            const auto begin = solids.nodes().begin();
            if (child == index || std::any_of(begin + child, begin + solids.node(child).end,
                                              [](const Solids::Node& node) { return node.many; }))
                return true;
            for (Solids::Index part = child; part < solids.node(child).end; ++part)
                if (solids.node(part).op == Solids::Op::part) cut_by_[part] = number_[index];
            return true;
        });
    }
    of_block_.resize(slots / core::block_size);
    only_cut_.resize(slots / core::block_size);
    std::size_t block_number = 0;
    core::for_each_table(scene.shapes(), [&](const auto& table) {
        for (const auto& block : table.blocks()) {
            bool is_of_one = true, is_cut = false;
            bool is_flat = true;
            std::uint16_t of_all = 0, by_all = 0;
            for (int lane = 0; lane < core::block_size; ++lane) {
                if (block.ids[lane] == core::no_shape) continue;
                const Solids::Index part = solids.part_of(block.ids[lane]);
                const Solids::Index parent =
                    part != Solids::none ? solids.node(part).parent : Solids::none;
                const std::uint16_t cut =
                    parent != Solids::none ? number_[parent] : std::uint16_t{0};
                const std::uint16_t cuts = part != Solids::none ? cut_by_[part] : std::uint16_t{0};
                is_cut = is_cut || (cut != 0 && !solids.node(part).fills);
                is_of_one = is_of_one && (lane == 0 || cut == of_all);
                of_all = cut;
                is_flat =
                    is_flat && cuts != 0 && solids.node(part).flat && (lane == 0 || cuts == by_all);
                by_all = cuts;
                if (cuts != 0)
                    only_cut_[block_number] =
                        static_cast<std::uint16_t>(only_cut_[block_number] | 1U << lane);
            }
            if (is_cut) of_block_[block_number] = is_of_one ? of_all : cuts_nothing;
            // A flat part that cuts a union is itself cut by the other half-spaces.
            if (is_flat) of_block_[block_number] = by_all;
            ++block_number;
        }
    });
    let_faces_wait(scene);
    view.cuts = views_.data();
    view.cut_of_block = of_block_.data();
    view.only_cut_lanes = only_cut_.data();
    view.deferred_lanes = deferred_.data();
}

/// Marks the faces whose clip tests are deferred (SceneView::deferred_lanes). The test of a face is
/// not deferred if a part of the union that it cuts shares a block with shapes outside of the
/// union, because the cut is not known there.
void ClipPlanes::let_faces_wait(const core::Scene& scene) {
    const Solids& solids = scene.solids();
    const auto for_each_lane = [&](const auto& visit) {
        std::uint32_t slot = 0;
        core::for_each_table(scene.shapes(), [&](const auto& table) {
            for (const auto& block : table.blocks())
                for (const core::ShapeId id : block.ids)
                    visit(slot++, id, id != core::no_shape ? solids.part_of(id) : Solids::none);
        });
    };
    std::vector<char> is_known(unions_.size(), 1);
    for_each_lane([&](std::uint32_t slot, core::ShapeId, Solids::Index part) {
        if (part == Solids::none || solids.node(part).fills) return;
        const Solids::Index parent = solids.node(part).parent;
        const std::uint16_t cut = parent != Solids::none ? number_[parent] : std::uint16_t{0};
        if (cut != 0 && of_block_[slot / core::block_size] != cut) is_known[cut] = 0;
    });
    deferred_.resize(only_cut_.size());
    for_each_lane([&](std::uint32_t slot, core::ShapeId id, Solids::Index part) {
        const std::uint16_t cut = part != Solids::none ? cut_by_[part] : std::uint16_t{0};
        if (cut == 0 || is_known[cut] == 0) return;
        const std::vector<HalfSpace>& by = unions_[cut].by;
        const auto is_its = [&](const HalfSpace& half) { return half.shape == id; };
        if (std::count_if(by.begin(), by.end(), is_its) != faces_of(solids.node(part))) return;
        for (std::size_t k = 0; k < by.size(); ++k)
            if (is_its(by[k])) views_[cut].face[k] = slot;
        std::uint16_t& lanes = deferred_[slot / core::block_size];
        lanes = static_cast<std::uint16_t>(lanes | 1U << slot % core::block_size);
    });
}

} // namespace raylane::simd
