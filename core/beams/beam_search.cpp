#include "core/beams/beam_search.hpp"

#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <bit>

namespace raylane::core {

namespace {

/// Maximum number of blocks in the cache of bounds: 3 MB.
constexpr std::size_t max_held = 8192;

constexpr float far = std::numeric_limits<float>::infinity();

Bounds everywhere() {
    return {Vec3f(-far), Vec3f(far)};
}

template <class Shape>
BlockBounds bounds_of_block(const Table<Shape>& table, std::uint32_t index, const Solids& solids) {
    BlockBounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
        std::fill_n(bounds.lower[axis], block_size, far);
        std::fill_n(bounds.upper[axis], block_size, -far);
    }
    for_each_in_block(table, index, [&](Place place, ShapeId id) {
        const Bounds* const of_part = solids.bounds_of(id);
        const Bounds of_shape = of_part != nullptr ? *of_part : bounds_of(table.get(place));
        for (int axis = 0; axis < 3; ++axis) {
            bounds.lower[axis][place.lane] = of_shape.lower[axis];
            bounds.upper[axis][place.lane] = of_shape.upper[axis];
        }
    });
    return bounds;
}

} // namespace

BeamSearch::BeamSearch(const Scene& scene) : scene_(scene) {
    std::size_t blocks = 0;
    for_each_table(scene.shapes(), [&]<class Shape>(const Table<Shape>& table) {
        if constexpr (is_bounded<Shape>) {
            blocks += table.blocks().size() + table.copied_blocks();
        } else {
            for (std::uint32_t index = 0; index < table.blocks().size(); ++index)
                for_each_in_block(table, index, [&](Place place, ShapeId id) {
                    unbounded_.push_back({everywhere(), place, kind_of<Shape>, id, 0.0F});
                });
        }
    });
    held_.resize(std::bit_ceil(std::min(blocks, max_held)));
    pending_.reserve(512);
}

const BlockBounds& BeamSearch::bounds_of(const Child& block) {
    constexpr std::size_t apart = 0x9e37; // separates kinds with equal indices
    const std::size_t place = block.index() + apart * static_cast<std::size_t>(block.kind());
    Held& held = held_[place & (held_.size() - 1)];
    if (held.any && held.index == block.index() && held.kind == block.kind()) return held.bounds;
    held.index = block.index();
    held.kind = block.kind();
    held.any = true;
    for_each_bounded_table(scene_.shapes(), [&]<class Shape>(const Table<Shape>& table) {
        if (kind_of<Shape> == block.kind())
            held.bounds = bounds_of_block(table, block.index(), scene_.solids());
    });
    return held.bounds;
}

bool BeamSearch::collect(const Beam& beam, std::vector<BeamCandidate>& candidates) {
    candidates = unbounded_;
    const BeamSlabs slabs(beam);
    const auto add_block = [&](const Child& child) {
        const BlockBounds& bounds = bounds_of(child);
        float near[block_size];
        slabs.near(bounds, near);
        for (int lane = 0; lane < block_size; ++lane)
            if (near[lane] < far) add(child, lane, bounds, near[lane], candidates);
        return candidates.size() <= max_candidates;
    };
    if (!for_each_block(scene_.hierarchy(), slabs, add_block)) return false;
    return scene_.copies() == nullptr || for_each_copied_block(slabs, add_block);
}

/// Calls visit(block) for the blocks of a hierarchy that a beam may meet, until it returns false.
/// Returns false in that case.
template <class Visit>
bool BeamSearch::for_each_block(const Hierarchy& hierarchy, const BeamSlabs& slabs,
                                const Visit& visit) {
    float near[block_size];
    pending_.clear();
    if (!hierarchy.nodes.empty()) pending_.push_back(Child::node(0));
    while (!pending_.empty()) {
        const Child child = pending_.back();
        pending_.pop_back();
        if (child.is_block()) {
            if (!visit(child)) return false;
            continue;
        }
        const WideNode& node = hierarchy.nodes[child.index()];
        slabs.near(node, near);
        for (int entry = 0; entry < block_size; ++entry)
            if (near[entry] < far && !node.children[entry].empty())
                pending_.push_back(node.children[entry]);
    }
    return true;
}

/// Same for the blocks of all copies that a beam may meet.
template <class Visit>
bool BeamSearch::for_each_copied_block(const BeamSlabs& slabs, const Visit& visit) {
    const Copies& copies = *scene_.copies();
    const auto visit_all_of = [&](const Copies::Copy& copy) {
        for (int k = 0; k < kind_count; ++k)
            for (std::uint32_t i = 0; i < copy.set.block_count[static_cast<std::size_t>(k)]; ++i) {
                const auto kind = static_cast<Kind>(k);
                const std::uint32_t block = Copies::block_of(copy, kind, i);
                copies.make(kind, block);
                if (!visit(Child::block(kind, block))) return false;
            }
        return true;
    };
    std::vector<std::uint32_t> nodes{0};
    while (!nodes.empty()) {
        const Copies::Node& node = copies.nodes()[nodes.back()];
        nodes.pop_back();
        for (int i = 0; i < 4 && node.children[i] != Copies::Node::none; ++i) {
            if (!(slabs.near(node.bounds(i)) < far)) continue;
            if ((node.children[i] & Copies::Node::copy_bit) == 0)
                nodes.push_back(node.children[i]);
            else if (!visit_all_of(copies.copy_at(node.children[i] & ~Copies::Node::copy_bit)))
                return false;
        }
    }
    return true;
}

void BeamSearch::narrow(const Beam& beam, std::vector<BeamCandidate>& candidates) {
    const BeamSlabs slabs(beam);
    for (BeamCandidate& candidate : candidates)
        candidate.near = slabs.near(candidate.bounds);
    std::erase_if(candidates, [](const BeamCandidate& c) { return !(c.near < far); });
}

void BeamSearch::add(const Child& block, int lane, const BlockBounds& block_bounds, float near,
                     std::vector<BeamCandidate>& candidates) const {
    const Place place{block.index(), static_cast<std::uint8_t>(lane)};
    const ShapeId id = with_table(scene_.shapes(), block.kind(),
                                  [&](const auto& table) { return table.id(place); });
    if (id == no_shape) return;
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
        bounds.lower[axis] = block_bounds.lower[axis][lane];
        bounds.upper[axis] = block_bounds.upper[axis][lane];
    }
    candidates.push_back({bounds, place, block.kind(), id, near});
}

namespace {

/// crossings(), inlined into one function.
template <class Shape>
[[gnu::flatten]] Crossings<Affine> meetings(const Shape& shape, const Beam& beam,
                                            ErrorPredicate<Affine>& predicate) {
    return crossings(shape, beam, Start{}, predicate);
}

/// Returns a crossing that is not behind the first crossing of any ray that meets the shape. Where
/// nothing is known, its t may be any number.
template <class Shape>
Crossing<Affine> first_possible(const Shape& shape, const Beam& beam) {
    ErrorPredicate<Affine> predicate = ErrorPredicate<Affine>::that_lets_none_miss();
    const Crossings<Affine> crossings = meetings(shape, beam, predicate);
    if (predicate.doubt() || crossings.begin() == crossings.end())
        return {Affine(0.0, 0.0, 0.0, std::numeric_limits<double>::infinity()), body};
    return *crossings.begin();
}

} // namespace

/// Finds where a beam meets a shape first, on the visible side.
BeamSearch::Met BeamSearch::meet(const BeamCandidate& candidate, const Beam& beam,
                                 const BeamCone& cone) const {
    if (candidate.kind == Kind::sphere) {
        const auto sphere = std::get<Table<Sphere>>(scene_.shapes()).get(candidate.place);
        if (cone.misses(sphere.center, sphere.radius)) return {Met::missed};
    }
    const Material& material = scene_.material_of(candidate.id);
    return with_table(scene_.shapes(), candidate.kind, [&](const auto& table) -> Met {
        ErrorPredicate<Affine> predicate;
        const Crossings<Affine> crossings = meetings(table.get(candidate.place), beam, predicate);
        if (predicate.doubt())
            return {Met::partly, first_possible(table.get(candidate.place), beam)};
        for (const Crossing<Affine>& crossing : crossings) {
            if (crossing.t.upper() < 0.0) continue;
            if (!(crossing.t.lower() > 0.0)) return {Met::partly, crossing};
            if (ErrorPredicate<Affine>::is_doubtful(crossing)) return {Met::partly, crossing};
            // A part may or may not be the surface of its solid here.
            if (scene_.solids().has(candidate.id)) return {Met::partly, crossing};
            if (material.is_seen(crossing.entering)) return {Met::whole, crossing};
        }
        return {Met::missed};
    });
}

void BeamSearch::keep_first(const Beam& beam, std::vector<BeamCandidate>& candidates) {
    const BeamCone cone(beam);
    std::sort(candidates.begin(), candidates.end(),
              [](const BeamCandidate& a, const BeamCandidate& b) {
                  return a.near != b.near ? a.near < b.near : a.id < b.id;
              });

    // The first surface that all rays meet, whatever some of them meet before it.
    ShapeId covering = no_shape;
    Affine covered_at;
    met_.clear();
    std::size_t count = 0;
    for (const BeamCandidate& candidate : candidates) {
        if (covering != no_shape && static_cast<double>(candidate.near) > covered_at.upper()) break;
        const Met met = meet(candidate, beam, cone);
        if (met.what == Met::missed) continue;
        const Affine& t = met.crossing.t;
        if (met.what == Met::whole && (covering == no_shape || (t - covered_at).upper() < 0.0)) {
            covering = candidate.id;
            covered_at = t;
        }
        met_.push_back(t);
        candidates[count++] = candidate;
    }
    // Drops shapes that are certainly behind it.
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (covering == no_shape || candidates[i].id == covering ||
            !((met_[i] - covered_at).lower() > 0.0))
            candidates[kept++] = candidates[i];
    candidates.resize(kept);
}

} // namespace raylane::core
