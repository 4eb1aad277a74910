#include "scenes/formats/structure/cartoon/path.hpp"

#include <cmath>

namespace raylane::scenes {

namespace {

using core::Vec3d;

Vec3d place_of(const Structure& structure, AtomIndex atom) {
    return core::convert<double>(structure.positions[atom]);
}

/// Returns a direction of length 1, or 0 if the direction is as short as rounding errors.
Vec3d unit_or_zero(const Vec3d& v, double least = 1e-6) {
    const double size = core::length(v);
    return size > least ? 1.0 / size * v : Vec3d(0.0);
}

/// Returns the part of `v` that is perpendicular to a direction of length 1.
Vec3d perpendicular(const Vec3d& v, const Vec3d& along) {
    return v - core::dot(v, along) * along;
}

Vec3d any_perpendicular(const Vec3d& along) {
    const Vec3d axis = std::abs(along.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    return unit_or_zero(perpendicular(axis, along));
}

/// Returns the index before or behind, or the same at the ends.
std::size_t before(std::size_t i) {
    return i == 0 ? 0 : i - 1;
}
std::size_t behind(std::size_t i, const Path& path) {
    return std::min(i + 1, path.size() - 1);
}

Vec3d chord(const Path& path, std::size_t i) {
    return unit_or_zero(path[behind(i, path)].at - path[before(i)].at);
}

/// Returns the direction across the plane of three points, or 0 if they are in a line.
Vec3d across_plane(const Path& path, std::size_t i) {
    if (path.size() < 3) return Vec3d(0.0);
    i = std::clamp<std::size_t>(i, 1, path.size() - 2);
    return unit_or_zero(core::cross(path[i].at - path[i - 1].at, path[i + 1].at - path[i].at), 0.1);
}

/// Completes missing directions, makes all perpendicular to the path, and turns each by half a
/// turn if it is then nearer to the one before.
void align(Path& path) {
    for (std::size_t i = 0; i < path.size(); ++i) {
        const Vec3d along = chord(path, i);
        Vec3d across = unit_or_zero(perpendicular(path[i].across, along), 0.1);
        if (across == Vec3d(0.0))
            across = unit_or_zero(perpendicular(across_plane(path, i), along), 0.1);
        if (across == Vec3d(0.0) && i > 0)
            across = unit_or_zero(perpendicular(path[i - 1].across, along), 0.1);
        if (across == Vec3d(0.0)) across = any_perpendicular(along);
        path[i].across = i > 0 && core::dot(across, path[i - 1].across) < 0.0 ? -across : across;
    }
}

/// Replaces directions by means with their neighbours of the same secondary structure.
void even_directions(Path& path) {
    const Path old = path;
    for (std::size_t i = 0; i < path.size(); ++i) {
        Vec3d sum = 2.0 * old[i].across;
        for (const std::size_t other : {before(i), behind(i, old)})
            sum += old[other].secondary == old[i].secondary ? old[other].across : old[i].across;
        path[i].across = sum;
    }
    align(path);
}

void flatten_strands(Path& path) {
    const Path old = path;
    for (std::size_t i = 1; i + 1 < path.size(); ++i)
        if (old[i].secondary == Secondary::strand)
            path[i].at = 0.25 * (old[i - 1].at + 2.0 * old[i].at + old[i + 1].at);
}

} // namespace

Path path_of_peptide(const Structure& structure, const Segment& segment,
                     const std::vector<Secondary>& secondary) {
    using enum BackboneAtom;
    const auto carbonyl = [&](const BackboneResidue& residue) {
        if (!residue.has(c) || !residue.has(o)) return Vec3d(0.0);
        return unit_or_zero(place_of(structure, residue.atom(o)) -
                            place_of(structure, residue.atom(c)));
    };
    Path path;
    Vec3d last(0.0);
    for (const BackboneResidue& residue : segment) {
        Vec3d next = carbonyl(residue);
        if (core::dot(last, next) < 0.0) next = -next;
        path.push_back({place_of(structure, residue.atom(ca)), last + next, residue.atom(ca),
                        secondary[residue.residue]});
        last = next;
    }
    align(path);
    return path;
}

Path path_of_nucleic(const Structure& structure, const Segment& segment) {
    Path path;
    for (const BackboneResidue& residue : segment)
        path.push_back({place_of(structure, residue.guide()), Vec3d(0.0), residue.guide()});
    if (const AtomIndex end = segment.back().atom(BackboneAtom::o3);
        end != no_atom && end != path.back().atom)
        path.push_back({place_of(structure, end), Vec3d(0.0), path.back().atom});
    align(path);
    return path;
}

void smooth(Path& path) {
    flatten_strands(path);
    flatten_strands(path);
    align(path);
    even_directions(path);
    even_directions(path);
}

namespace {

Spline spline_of(const Path& path, Vec3d PathPoint::*member) {
    std::vector<Vec3d> values;
    for (const PathPoint& point : path)
        values.push_back(point.*member);
    return Spline(std::move(values));
}

} // namespace

Curve::Curve(const Path& path)
    : points_(spline_of(path, &PathPoint::at)), directions_(spline_of(path, &PathPoint::across)) {}

Frame Curve::operator()(double s) const {
    const Spline::Place place = points_(s), direction = directions_(s);
    const double speed = core::length(place.first);
    Frame frame{};
    frame.at = place.at;
    frame.by_at = place.first;
    frame.along = speed > 0.0 ? 1.0 / speed * place.first : Vec3d(1, 0, 0);
    const Vec3d by_along =
        speed > 0.0 ? 1.0 / speed * perpendicular(place.second, frame.along) : Vec3d(0.0);
    // The direction minus its part along the path, by the product rule.
    const Vec3d &w = direction.at, &by_w = direction.first;
    const double part = core::dot(w, frame.along);
    const Vec3d across = w - part * frame.along;
    const double size = core::length(across);
    if (size > 1e-3) {
        frame.across = 1.0 / size * across;
        const double by_part = core::dot(by_w, frame.along) + core::dot(w, by_along);
        const Vec3d by_across = by_w - by_part * frame.along - part * by_along;
        frame.by_across = 1.0 / size * perpendicular(by_across, frame.across);
    } else {
        frame.across = any_perpendicular(frame.along);
    }
    frame.up = core::cross(frame.along, frame.across);
    frame.by_up = core::cross(by_along, frame.across) + core::cross(frame.along, frame.by_across);
    return frame;
}

} // namespace raylane::scenes
