#include "core/scene/solid_description.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>
#include <vector>

namespace raylane::core {

namespace {

using Op = Solids::Op;

class SolidWriter {
  public:
    SolidWriter(const Scene& scene, Solids::Index solid)
        : scene_(scene), solids_(scene.solids()), whole_(solids_.medium(solid)) {}

    /// Describes a node or, if `outside`, its complement. The description uses only solids that
    /// have an inside.
    Solid describe(Solids::Index index, bool outside) const {
        const Solids::Node& node = solids_.node(index);
        if (node.op == Op::part) return shape_of(node);
        const bool is_cut = !cuts_only(index); // otherwise all of its parts only cut
        Sequence faces, cuts;
        solids_.each_child(index, [&](Solids::Index child) {
            const bool is_kept = has_inside(child, outside);
            Sequence& sequence = is_cut && cuts_only(child) ? cuts : faces;
            sequence.add(describe(child, outside == is_kept), is_kept);
            return true;
        });
        const bool of_all = (node.op == Op::all) != outside;
        Solid solid = std::move(faces).made_by(of_all ? Made::by_intersection : Made::by_union);
        std::vector<Solid> cutting = std::move(cuts).parts();
        if (cutting.empty()) return solid;
        cutting.insert(cutting.begin(), std::move(solid));
        return made(Made::by_clip, std::move(cutting));
    }

  private:
    /// Parts in their order, which decides between coincident faces. A part to subtract is
    /// subtracted from the part before it, or from the whole if no part follows.
    class Sequence {
      public:
        void add(Solid part, bool is_kept) {
            // The first part has an inside; otherwise the whole would have none.
            if (is_kept) groups_.emplace_back();
            assert(!groups_.empty());
            groups_.back().push_back(std::move(part));
        }
        Solid made_by(Made by) && {
            std::vector<Solid> taken_away;
            const bool is_last =
                std::all_of(groups_.begin(), groups_.end() - 1,
                            [](const std::vector<Solid>& group) { return group.size() == 1; });
            if (is_last) {
                std::vector<Solid>& last = groups_.back();
                taken_away.assign(std::move_iterator(last.begin() + 1),
                                  std::move_iterator(last.end()));
                last.resize(1);
            }
            Solid solid = made(by, std::move(*this).parts());
            taken_away.insert(taken_away.begin(), std::move(solid));
            return made(Made::by_difference, std::move(taken_away));
        }
        std::vector<Solid> parts() && {
            std::vector<Solid> members;
            for (std::vector<Solid>& group : groups_)
                members.push_back(made(Made::by_difference, std::move(group)));
            return members;
        }

      private:
        std::vector<std::vector<Solid>> groups_;
    };

    static Solid made(Made by, std::vector<Solid> parts) {
        if (parts.size() == 1) return std::move(parts[0]);
        Solid solid{by};
        solid.parts = std::move(parts);
        return solid;
    }

    /// Returns true if a node is described by its inside, and false if by its complement.
    bool has_inside(Solids::Index index, bool outside) const {
        const Solids::Node& node = solids_.node(index);
        if (node.op == Op::part) return node.reversed == outside;
        const bool of_all = (node.op == Op::all) != outside;
        bool inside = !of_all;
        solids_.each_child(index, [&](Solids::Index child) {
            inside = has_inside(child, outside);
            return inside != of_all;
        });
        return inside;
    }

    /// Returns true for a node that clips and has no faces.
    bool cuts_only(Solids::Index index) const {
        for (Solids::Index part = index; part < solids_.node(index).end; ++part)
            if (solids_.node(part).op == Op::part && solids_.node(part).shape != no_shape)
                return false;
        return true;
    }

    Solid shape_of(const Solids::Node& part) const {
        Solid solid = core::of_shape(shape_of_part(scene_, part));
        if (part.shape != no_shape && scene_.material_index_of(part.shape) != whole_)
            solid.material = scene_.material_index_of(part.shape);
        return solid;
    }

    const Scene& scene_;
    const Solids& solids_;
    MaterialIndex whole_;
};

} // namespace

PartShape shape_of_part(const Scene& scene, const Solids::Node& part) {
    PartShape shape;
    with_table(scene.shapes(), part.kind,
               [&](const auto& table) { shape = table.get(part.place); });
    // A plane that is a part of a bounded solid is stored as a quadric.
    if (const auto* q = std::get_if<QuadricOf<double>>(&shape))
        if (q->xx == 0.0 && q->yy == 0.0 && q->zz == 0.0 && q->xy == 0.0 && q->xz == 0.0 &&
            q->yz == 0.0 && q->one == 0.0)
            shape = PlaneOf<double>{q->center, {q->x, q->y, q->z}};
    return shape;
}

Solid description_of(const Scene& scene, Solids::Index solid) {
    Solid described = SolidWriter(scene, solid).describe(solid, false);
    if (described.made == Made::of_shape) { // otherwise it would be an ordinary shape
        Solid alone{Made::by_union};
        alone.parts.push_back(std::move(described));
        described = std::move(alone);
    }
    described.material = scene.solids().medium(solid);
    return described;
}

} // namespace raylane::core
