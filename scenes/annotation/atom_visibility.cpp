#include "scenes/annotation/atom_visibility.hpp"

#include <algorithm>

namespace raylane::scenes {

using core::Vec3d;

AtomVisibility::AtomVisibility(const Legend& legend, const AnnotatedView& view)
    : legend_(legend), view_(view) {
    if (view.scene == nullptr || legend.atoms_of_shape.size() != view.scene->shape_count()) return;
    has_shape_.resize(legend.structure.size());
    for (const AtomPair& pair : legend.atoms_of_shape)
        if (pair != no_atoms) has_shape_[pair[0]] = has_shape_[pair[1]] = 1;
    searcher_.emplace(*view.scene, core::Search::hierarchy);
}

std::vector<Vec3d> AtomVisibility::places_of(AtomIndex atom) const {
    std::vector<Vec3d> places;
    const auto first = std::lower_bound(legend_.places.begin(), legend_.places.end(), atom,
                                        [](const auto& a, AtomIndex b) { return a.atom < b; });
    for (auto place = first; place != legend_.places.end() && place->atom == atom; ++place)
        places.push_back(core::convert<double>(place->at));
    if (places.empty()) places.push_back(core::convert<double>(legend_.structure.positions[atom]));
    return places;
}

bool AtomVisibility::is_of(core::ShapeId shape, const std::vector<AtomIndex>& atoms) const {
    const AtomPair& pair = legend_.atoms_of_shape[shape];
    return std::binary_search(atoms.begin(), atoms.end(), pair[0]) ||
           std::binary_search(atoms.begin(), atoms.end(), pair[1]);
}

bool AtomVisibility::is_nearest_copy(const std::vector<AtomIndex>& atoms, const Vec3d& place,
                                     const Vec3d& point) const {
    if (atoms.size() > 1) return true;
    const double distance = core::length(point - place);
    for (const Vec3d& other : places_of(atoms[0]))
        if (core::length(point - other) < distance) return false;
    return true;
}

bool AtomVisibility::is_visible(const std::vector<AtomIndex>& atoms, const Vec3d& place) {
    const bool has_shape =
        !has_shape_.empty() && std::any_of(atoms.begin(), atoms.end(),
                                           [&](AtomIndex atom) { return has_shape_[atom] != 0; });
    if (!has_shape) return true;
    const core::Camera& camera = view_.camera;
    Vec3d from = core::convert<double>(camera.from);
    if (camera.projection == core::Projection::orthographic) {
        const Vec3d sight = core::convert<double>(camera.at) - from;
        const Vec3d forward = 1.0 / core::length(sight) * sight;
        from = place - core::dot(place - from, forward) * forward;
    }
    const double distance = core::length(place - from);
    if (!(distance > 0.0)) return true;
    const core::Ray<double> ray{from, 1.0 / distance * (place - from)};
    const auto find = [&](bool own, double limit) {
        const auto counts = [&](const core::Hit<double>& hit) {
            if (legend_.atoms_of_shape[hit.shape] == no_atoms) return false;
            const bool is_own = is_of(hit.shape, atoms) &&
                                is_nearest_copy(atoms, place, ray.origin + hit.t * ray.direction);
            return is_own == own && (own || view_.scene->material_of(hit.shape).opacity == 1.0F);
        };
        return searcher_->nearest(ray, {}, counts, limit).hit.t;
    };
    return !(find(false, std::min(distance, find(true, distance))) < distance);
}

} // namespace raylane::scenes
