#include "scenes/annotation/atom_visibility.hpp"

#include <algorithm>

namespace raylane::scenes {

using core::Vec3d;

ShownAtoms::ShownAtoms(const Legend& legend) : legend_(legend) {
    if (legend.atoms_of_shape.empty()) return;
    const Structure& structure = legend.structure;
    has_shape_.resize(structure.size());
    for (const AtomPair& pair : legend.atoms_of_shape)
        if (pair != no_atoms && pair[0] == pair[1]) has_shape_[pair[0]] = 1;
    is_shown_ = has_shape_;
    if (structure.residues.empty()) return;
    std::vector<char> is_residue_shown(structure.of_residue.size());
    for (AtomIndex atom = 0; atom < structure.size(); ++atom)
        if (has_shape_[atom] != 0) is_residue_shown[structure.residues[atom]] = 1;
    for (AtomIndex atom = 0; atom < structure.size(); ++atom)
        if (!legend.is_in_chain.empty() && legend.is_in_chain[atom] != 0)
            is_shown_[atom] = is_residue_shown[structure.residues[atom]];
}

std::vector<Vec3d> ShownAtoms::places_of(AtomIndex atom) const {
    std::vector<Vec3d> places;
    const auto first = std::lower_bound(legend_.places.begin(), legend_.places.end(), atom,
                                        [](const auto& a, AtomIndex b) { return a.atom < b; });
    for (auto place = first; place != legend_.places.end() && place->atom == atom; ++place)
        places.push_back(core::convert<double>(place->at));
    if (places.empty()) places.push_back(core::convert<double>(legend_.structure.positions[atom]));
    return places;
}

AtomVisibility::AtomVisibility(const ShownAtoms& atoms, const core::Camera& camera,
                               const core::Scene* scene)
    : atoms_(atoms), camera_(camera), scene_(scene) {
    if (scene != nullptr && atoms.legend().atoms_of_shape.size() == scene->shape_count())
        searcher_.emplace(*scene, core::Search::hierarchy);
}

bool AtomVisibility::is_of(core::ShapeId shape, const std::vector<AtomIndex>& atoms) const {
    const AtomPair& pair = atoms_.legend().atoms_of_shape[shape];
    return std::binary_search(atoms.begin(), atoms.end(), pair[0]) ||
           std::binary_search(atoms.begin(), atoms.end(), pair[1]);
}

bool AtomVisibility::is_nearest_copy(const std::vector<AtomIndex>& atoms, const Vec3d& place,
                                     const Vec3d& point) const {
    if (atoms.size() > 1 || atoms_.legend().places.empty()) return true;
    const double distance = core::length(point - place);
    for (const Vec3d& other : atoms_.places_of(atoms[0]))
        if (core::length(point - other) < distance) return false;
    return true;
}

bool AtomVisibility::is_visible(const std::vector<AtomIndex>& atoms, const Vec3d& place) {
    if (!searcher_ || std::none_of(atoms.begin(), atoms.end(),
                                   [&](AtomIndex atom) { return atoms_.has_shape(atom); }))
        return true;
    Vec3d from = core::convert<double>(camera_.from);
    if (camera_.projection == core::Projection::orthographic) {
        const Vec3d sight = core::convert<double>(camera_.at) - from;
        const Vec3d forward = 1.0 / core::length(sight) * sight;
        from = place - core::dot(place - from, forward) * forward;
    }
    const double distance = core::length(place - from);
    if (!(distance > 0.0)) return true;
    const core::Ray<double> ray{from, 1.0 / distance * (place - from)};
    const auto is_own = [&](core::ShapeId shape, double t) {
        return is_of(shape, atoms) && is_nearest_copy(atoms, place, ray.origin + t * ray.direction);
    };
    // The first surface that is opaque or an own one decides.
    const auto counts = [&](const core::Hit<double>& hit) {
        return atoms_.legend().atoms_of_shape[hit.shape] != no_atoms &&
               (scene_->material_of(hit.shape).opacity == 1.0F || is_own(hit.shape, hit.t));
    };
    const core::Hit<double> hit = searcher_->nearest(ray, {}, counts, distance).hit;
    return !(hit.t < distance) || is_own(hit.shape, hit.t);
}

} // namespace raylane::scenes
