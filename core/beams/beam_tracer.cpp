#include "core/beams/beam_tracer.hpp"

#include "core/numbers/infinity.hpp"
#include "core/optics/optics.hpp"
#include "core/scene/pattern.hpp"
#include "core/shapes/normal.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>

namespace raylane::core {

namespace {

double largest(const Color& color) {
    return static_cast<double>(std::max({color.x, color.y, color.z}));
}

double spread_of(const Vec3<Affine>& v) {
    return std::max({v.x.spread(), v.y.spread(), v.z.spread()});
}

Vec3d middle_of(const Vec3<Affine>& v) {
    return {v.x.value, v.y.value, v.z.value};
}

bool same_cell(const Affine& x, double size) {
    return std::floor(x.lower() / size) == std::floor(x.upper() / size);
}

/// True if a pattern has no edge in the range of a point.
bool is_unbroken(const Pattern& pattern, const Vec3<Affine>& point) {
    switch (pattern.kind) {
    case PatternKind::solid:
    case PatternKind::gradient:
        return true;
    case PatternKind::checker:
        for (int axis = 0; axis < 3; ++axis)
            if ((pattern.axes >> axis & 1) != 0 &&
                !same_cell(point[axis], static_cast<double>(pattern.size)))
                return false;
        return true;
    case PatternKind::stripes: {
        const Vec3d unit = normalized(convert<double>(pattern.direction));
        return same_cell(dot(point, convert<Affine>(unit)), static_cast<double>(pattern.size));
    }
    case PatternKind::back_plane: {
        // No wave of its bands is shorter than 2 pi, no arc of its disc sharper than that.
        const Affine &x = point.x, &y = point.y;
        const Affine from_disc = x * x + y * y - Affine(150.0);
        return std::max(x.spread(), y.spread()) < 0.1 && std::abs(y.value) > 4.0 * y.spread() &&
               std::abs(from_disc.value) > from_disc.spread();
    }
    }
    return false;
}

} // namespace

BeamTracer::BeamTracer(const Scene& scene, const Settings& settings)
    : scene_(scene), settings_(settings), rays_(scene.camera(), settings), search_(scene),
      tolerance_(0.5 * core::pow(10.0, -static_cast<double>(settings.quality) / 20.0)) {
    for (const Light& light : scene.lights())
        if (is_soft(light.kind))
            has_soft_lights_ = true;
        else
            brightest_ += largest(light.color);
}

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
        if (!rays_.has_lens()) continue;
        // From anywhere on the lens, to whatever is sharp there.
        const double aside = rays_.lens_radius() *
                             (std::abs(rays_.lens_right()[axis]) + std::abs(rays_.lens_up()[axis]));
        const Affine on_lens(0.0, 0.0, 0.0, aside * (1.0 + 0x1p-40));
        beam.origin[axis] = beam.origin[axis] + on_lens;
        beam.direction[axis] =
            beam.direction[axis] + on_lens * Affine((1.0 + 0x1p-40) / rays_.focus());
    }
    if (!rays_.orthographic() || rays_.has_lens()) beam.direction = normalized(beam.direction);
    return beam;
}

Sight BeamTracer::sight_of(const Square& square, double t_likely) {
    const Beam beam = camera_beam(square);
    const BeamHit hit = first_in(beam, t_likely);
    if (hit.what == BeamHit::nothing) return Sight::even;
    if (hit.what == BeamHit::doubt) return Sight::edge;
    const Surface surface = surface_at(beam, hit);
    if (!is_unbroken(surface.material.pattern, surface.point) || !is_lit_evenly(surface, 1.0))
        return Sight::step;
    if (is_lit_softly(surface)) return Sight::soft;
    if (!is_smooth(surface, 1.0, square.size)) return Sight::uneven;
    return unknown_behind(surface, 1.0, square.size, 0) <= 2.0 * tolerance_ ? Sight::even
                                                                            : Sight::uneven;
}

Sight BeamTracer::surfaces_in(const Square& square, double t_likely) {
    const Beam beam = camera_beam(square);
    const BeamHit hit = first_in(beam, t_likely);
    if (hit.what == BeamHit::nothing) return Sight::even;
    if (hit.what == BeamHit::doubt) return Sight::edge;
    const Surface surface = surface_at(beam, hit);
    const bool is_even =
        is_unbroken(surface.material.pattern, surface.point) && is_lit_evenly(surface, 1.0);
    return is_even ? Sight::even : Sight::step;
}

BeamHit BeamTracer::first_in(const Beam& beam, double t_likely) {
    for (double t_most = t_likely;; t_most = infinity<double>) {
        BeamHit hit{BeamHit::doubt};
        if (!search_.collect(beam, t_most, shown_)) {
            shown_.clear();
            return hit;
        }
        hit = search_.first(beam, {}, shown_);
        const bool is_all_known =
            hit.is_covered() ? hit.crossing.t.upper() <= t_most : hit.what == BeamHit::doubt;
        if (is_all_known || t_most == infinity<double>) return hit;
    }
}

void BeamTracer::keep_shown(const Square& square, const std::vector<BeamCandidate>& shown,
                            int halvings, int least_parts, std::vector<ShapeId>& asked) {
    found_.clear();
    find_shown(square, shown, halvings, asked);
    std::erase_if(asked, [&](ShapeId id) {
        return std::count(found_.begin(), found_.end(), id) < least_parts;
    });
}

/// Notes the asked shapes of each of the smallest parts.
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
        const bool is_covered = search_.first(beam, {}, closer).is_covered();
        parts_shown_.clear();
        for (const ShapeId id : asked)
            if (id == no_shape ? !is_covered
                               : std::any_of(closer.begin(), closer.end(),
                                             [&](const auto& shape) { return shape.id == id; }))
                parts_shown_.push_back(id);
        if (halvings == 1)
            found_.insert(found_.end(), parts_shown_.begin(), parts_shown_.end());
        else if (!parts_shown_.empty())
            find_shown(part, closer, halvings - 1, asked);
    }
}

BeamTracer::Surface BeamTracer::surface_at(const Beam& beam, const BeamHit& hit) const {
    const Vec3<Affine> point = mul_add(hit.crossing.t, beam.direction, beam.origin);
    const bool entering = hit.crossing.entering;
    bool is_bent = false;
    Vec3<Affine> normal =
        with_table(scene_.shapes(), hit.shape.kind, [&]<class Shape>(const Table<Shape>& table) {
            is_bent = has_shading_normals<Shape>;
            return outward_normal(table.get(hit.shape.place), point, hit.crossing.face);
        });
    if (!entering) normal = -normal;
    return {scene_.material_of(hit.shape.id),
            {hit.shape.id,
             scene_.coplanar_with(hit.shape.id),
             {/*on_surface=*/true, hit.crossing.face, /*inward=*/!entering}},
            is_bent,
            point,
            normal,
            beam.direction};
}

bool BeamTracer::is_lit_softly(const Surface& surface) const {
    return has_soft_lights_ &&
           (surface.material.diffuse != 0.0F || surface.material.specular != 0.0F);
}

/// By lights without a size.
bool BeamTracer::is_lit_evenly(const Surface& surface, double weight) {
    if (surface.material.diffuse == 0.0F && surface.material.specular == 0.0F) return true;
    const auto& lights = scene_.lights();
    return std::all_of(lights.begin(), lights.end(), [&](const Light& light) {
        return is_soft(light.kind) || is_light_known(surface, light, weight);
    });
}

bool BeamTracer::is_light_known(const Surface& surface, const Light& light, double weight) {
    const bool is_point = light.kind == LightKind::point;
    Vec3<Affine> to_light = is_point ? convert<Affine>(light.position) - surface.point
                                     : convert<Affine>(Vec3f(-light.direction));
    const Affine facing = dot(surface.flat_normal, to_light);
    if (facing.upper() < 0.0) return true;

    if (facing.lower() > 0.0) {
        const double t_most = is_point ? 1.0 : infinity<double>;
        const Beam shadow{surface.point, to_light};
        if (search_.collect(shadow, t_most, in_the_way_) &&
            search_.arrives(shadow, surface.departure, t_most, in_the_way_) !=
                BeamSearch::Light::doubt)
            return true;
    }
    return weight * largest(light.color) * most_reflected(surface, to_light) <= tolerance_;
}

/// A bound on the share of a light that a surface shows.
double BeamTracer::most_reflected(const Surface& surface, const Vec3<Affine>& to_light) {
    const Material& material = surface.material;
    const Vec3<Affine> unit = normalized(to_light);
    const auto most_cos = [&](const Vec3<Affine>& direction) {
        const double cos = dot(surface.flat_normal, direction).upper();
        return cos < 1.0 ? std::max(cos, 0.0) : 1.0; // 1: where it is not known, too
    };
    double most = static_cast<double>(material.diffuse) * most_cos(unit);
    if (material.specular > 0.0F)
        most += static_cast<double>(material.specular) *
                core::pow(most_cos(normalized(Vec3<Affine>(unit - surface.direction))),
                          static_cast<double>(material.exponent));
    return most;
}

/// True if highlights are wide enough to be seen by one sample. The
/// mean of a highlight cos^e over a square that turns it by +-phi differs from the middle by
/// e phi^2 / 6, and more slowly changing terms by less.
bool BeamTracer::is_smooth(const Surface& surface, double weight, double size) const {
    const Material& material = surface.material;
    if (surface.has_shading_normals) return false;
    const double turn = (spread_of(surface.flat_normal) + spread_of(surface.direction)) / size;
    const double bend = static_cast<double>(material.specular) *
                            std::max(1.0, static_cast<double>(material.exponent)) +
                        static_cast<double>(material.diffuse);
    return weight * brightest_ * bend * turn * turn / 6.0 <= tolerance_;
}

/// How much of a pixel may come of what is not known to be even behind a surface: what it mirrors
/// and lets through.
double BeamTracer::unknown_behind(const Surface& surface, double weight, double size, int depth) {
    const Material& material = surface.material;
    double unknown = weight * (1.0 - static_cast<double>(material.opacity));
    if (!material.reflects() && !material.transmits()) return unknown;
    if (depth >= settings_.max_depth) return unknown;

    auto share = static_cast<double>(material.reflectivity);
    if (material.reflection != Reflection::constant) {
        const auto index = static_cast<double>(material.index);
        const double before = surface.departure.start.inward ? index : 1.0;
        const double behind = surface.departure.start.inward ? 1.0 : index;
        share = reflectance(
            material,
            refract(middle_of(surface.direction), middle_of(surface.flat_normal), before, behind),
            before, behind);
    }
    if (material.transmits()) {
        const double transmitted = (1.0 - share) * static_cast<double>(material.transmission);
        unknown += weight * transmitted;
    }
    const double reflected_weight = weight * share;
    if (!(reflected_weight > static_cast<double>(settings_.min_weight))) return unknown;
    if (unknown + reflected_weight <= tolerance_) return unknown + reflected_weight;
    if (unknown > 2.0 * tolerance_) return unknown;

    const Beam mirrored{surface.point, reflected(surface.direction, surface.flat_normal)};
    if (spread_of(mirrored.direction) > 0.25) return unknown + reflected_weight;
    return unknown + unknown_along(mirrored, surface.departure, reflected_weight, size, depth + 1);
}

double BeamTracer::unknown_along(const Beam& beam, const Departure& from, double weight,
                                 double size, int depth) {
    if (!search_.collect(beam, infinity<double>, mirrored_)) return weight;
    const BeamHit hit = search_.first(beam, from, mirrored_);
    if (hit.what == BeamHit::nothing) return 0.0;
    if (hit.what == BeamHit::doubt) return weight;
    const Surface surface = surface_at(beam, hit);
    if (!is_unbroken(surface.material.pattern, surface.point) || is_lit_softly(surface) ||
        !is_lit_evenly(surface, weight) || !is_smooth(surface, weight, size))
        return weight;
    return unknown_behind(surface, weight, size, depth);
}

} // namespace raylane::core
