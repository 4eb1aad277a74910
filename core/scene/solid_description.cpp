#include "core/scene/solid_description.hpp"

#include <utility>
#include <vector>

namespace raylane::core {

namespace {

using Op = Solids::Op;

class Describer {
  public:
    Describer(const Scene& scene, Solids::Index solid)
        : scene_(scene), solids_(scene.solids()), whole_(solids_.medium(solid)) {}

    /// A node or, `outside`, all that is not in it; either is described by what has an inside.
    Solid describe(Solids::Index index, bool outside) const {
        const Solids::Node& node = solids_.node(index);
        if (node.op == Op::part) return shape_of(node);
        // Of what the intersection of others is cut by, what a union leaves out.
        std::vector<Solid> inside, taken_away, cuts, cut_away;
        solids_.each_child(index, [&](Solids::Index child) {
            if (cuts_only(child)) {
                const bool is_kept = has_inside(child, outside);
                (is_kept ? cuts : cut_away).push_back(describe(child, outside == is_kept));
            } else if (has_inside(child, outside))
                inside.push_back(describe(child, outside));
            else
                taken_away.push_back(describe(child, !outside));
            return true;
        });
        const bool of_all = (node.op == Op::all) != outside;
        Solid solid = made(of_all ? Made::by_intersection : Made::by_union, std::move(inside));
        if (!taken_away.empty()) {
            taken_away.insert(taken_away.begin(), std::move(solid));
            solid = made(Made::by_difference, std::move(taken_away));
        }
        // What clips has an inside, so what it leaves out is left out of something.
        if (!cuts.empty() && !cut_away.empty()) {
            cut_away.insert(cut_away.begin(), std::move(cuts[0]));
            cuts[0] = made(Made::by_difference, std::move(cut_away));
        }
        if (!cuts.empty()) {
            cuts.insert(cuts.begin(), std::move(solid));
            solid = made(Made::by_clip, std::move(cuts));
        }
        return solid;
    }

  private:
    static Solid made(Made by, std::vector<Solid> parts) {
        if (parts.size() == 1) return std::move(parts[0]);
        Solid solid{by};
        solid.parts = std::move(parts);
        return solid;
    }

    /// True for what is described as it is, and not by what is outside of it.
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

    /// True for what clips, and has no faces.
    bool cuts_only(Solids::Index index) const {
        for (Solids::Index part = index; part < solids_.node(index).end; ++part)
            if (solids_.node(part).op == Op::part && solids_.node(part).shape != no_shape)
                return false;
        return true;
    }

    Solid shape_of(const Solids::Node& part) const {
        Solid solid;
        with_table(scene_.shapes(), part.kind, [&]<class Shape>(const Table<Shape>& table) {
            solid.shape = table.get(part.place);
        });
        // A plane of a solid with bounds.
        if (const auto* q = std::get_if<QuadricOf<double>>(&solid.shape))
            if (q->xx == 0.0 && q->yy == 0.0 && q->zz == 0.0 && q->xy == 0.0 && q->xz == 0.0 &&
                q->yz == 0.0 && q->one == 0.0)
                solid.shape = PlaneOf<double>{q->center, {q->x, q->y, q->z}};
        if (part.shape != no_shape && scene_.material_index_of(part.shape) != whole_)
            solid.material = scene_.material_index_of(part.shape);
        return solid;
    }

    const Scene& scene_;
    const Solids& solids_;
    MaterialIndex whole_;
};

} // namespace

Solid description_of(const Scene& scene, Solids::Index solid) {
    Solid described = Describer(scene, solid).describe(solid, false);
    described.material = scene.solids().medium(solid);
    return described;
}

} // namespace raylane::core
