#include "core/beams/beam_tracer.hpp"

#include "core/shapes/shapes.hpp"

#include <algorithm>

namespace raylane::core {

namespace {

double middle_of(double a, double b, double c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// Width of a shape where it is narrowest, in units of length, roughly. Flat shapes, such as faces
// of solids, show their broad side.
double width_of(const SphereOf<double>& sphere) {
    return 2.0 * sphere.radius;
}
double width_of(const DiscOf<double>& disc) {
    return 2.0 * disc.radius;
}
template <AnyTriangle Triangle>
double width_of(const Triangle& triangle) {
    const Vec3d ab = triangle.b - triangle.a, ac = triangle.c - triangle.a;
    const double longest = std::max({length(ab), length(ac), length(Vec3d(ac - ab))});
    return length(cross(ab, ac)) / longest;
}
double width_of(const BoxOf<double>& box) {
    return middle_of(length(box.edge_u), length(box.edge_v), length(box.edge_w));
}
template <Ends ends>
double width_of(const CylinderOf<double, ends>& cylinder) {
    return 2.0 * cylinder.radius;
}
template <Ends ends>
double width_of(const ConeOf<double, ends>& cone) {
    return 2.0 * std::max(cone.base_radius, cone.top_radius);
}
double width_of(const EllipsoidOf<double>& ellipsoid) {
    return 2.0 *
           middle_of(length(ellipsoid.axis_u), length(ellipsoid.axis_v), length(ellipsoid.axis_w));
}
double width_of(const QuadricOf<double>& quadric) {
    const Vec3d size = quadric.upper - quadric.lower;
    return middle_of(size.x, size.y, size.z);
}

} // namespace

BeamTracer::BeamTracer(const Scene& scene, const Settings& settings)
    : scene_(scene), settings_(settings), rays_(scene.camera(), settings), search_(scene) {}

Beam BeamTracer::camera_beam(const Square& square) const {
    const double half = square.size;
    const double x = 2.0 * square.x + half - settings_.width;
    const double y = settings_.height - 2.0 * square.y - half;
    Beam beam;
    for (int axis = 0; axis < 3; ++axis) {
        const double right = rays_.right()[axis], up = rays_.up()[axis];
        const Affine offset(x * right + y * up, half * right, half * up,
                            affine::roundoff(std::abs(x * right) + std::abs(y * up)));
        const Affine start(rays_.from()[axis]), forward(rays_.forward()[axis]);
        beam.origin[axis] = rays_.orthographic() ? start + offset : start;
        beam.direction[axis] = rays_.orthographic() ? forward : forward + offset;
    }
    if (!rays_.orthographic()) beam.direction = normalized(beam.direction);
    return beam;
}

bool BeamTracer::shows_thin(const Square& square) {
    thin_.clear();
    if (rays_.has_lens()) return false;
    const Beam beam = camera_beam(square);
    if (!search_.collect(beam, shown_)) return false;
    if (std::none_of(shown_.begin(), shown_.end(), [&](const auto& s) { return is_thin(s); }))
        return false;
    search_.keep_first(beam, shown_);
    for (const BeamCandidate& shape : shown_)
        if (is_thin(shape)) thin_.push_back(shape.id);
    return !thin_.empty() && thin_.size() <= max_thin;
}

/// Compares the shape's width with the size of a pixel at the middle of its bounds.
bool BeamTracer::is_thin(const BeamCandidate& candidate) const {
    return with_table(scene_.shapes(), candidate.kind, [&]<class Shape>(const Table<Shape>& table) {
        if constexpr (is_bounded<Shape>) {
            const Vec3d middle = 0.5 * (convert<double>(candidate.bounds.lower) +
                                        convert<double>(candidate.bounds.upper));
            const double depth =
                rays_.orthographic() ? 1.0 : dot(Vec3d(middle - rays_.from()), rays_.forward());
            const double pixel = 2.0 * length(rays_.right()) * depth;
            return width_of(table.get(candidate.place)) < pixel;
        } else {
            return false;
        }
    });
}

void BeamTracer::keep_shown(const Square& square, const std::vector<BeamCandidate>& shown,
                            int halvings, int min_parts, std::vector<ShapeId>& asked) {
    found_.clear();
    find_shown(square, shown, halvings, asked);
    std::erase_if(asked, [&](ShapeId id) {
        return std::count(found_.begin(), found_.end(), id) < min_parts;
    });
}

/// Halves the square `halvings` times. For each of the smallest parts, appends to found_ the shapes
/// of `asked` that may be visible in it. So a shape is in found_ once for each such part.
void BeamTracer::find_shown(const Square& square, const std::vector<BeamCandidate>& shown,
                            int halvings, const std::vector<ShapeId>& asked) {
    std::vector<BeamCandidate>& closer = closer_[static_cast<std::size_t>(halvings) - 1];
    const double half = 0.5 * square.size;
    for (int quarter = 0; quarter < 4; ++quarter) {
        const Square part{square.x + (quarter % 2 == 0 ? 0.0 : half),
                          square.y + (quarter < 2 ? 0.0 : half), half};
        const Beam beam = camera_beam(part);
        closer = shown;
        BeamSearch::narrow(beam, closer);
        search_.keep_first(beam, closer);
        parts_shown_.clear();
        for (const ShapeId id : asked)
            if (std::any_of(closer.begin(), closer.end(),
                            [&](const auto& shape) { return shape.id == id; }))
                parts_shown_.push_back(id);
        if (halvings == 1)
            found_.insert(found_.end(), parts_shown_.begin(), parts_shown_.end());
        else if (!parts_shown_.empty())
            find_shown(part, closer, halvings - 1, asked);
    }
}

} // namespace raylane::core
