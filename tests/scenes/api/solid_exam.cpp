#include "tests/scenes/api/solid_exam.hpp"

#include "core/shapes/shapes.hpp"
#include "tests/scenes/api/exam.hpp"
#include "tests/scenes/api/in_library.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <sstream>

namespace raylane::tests {

using oracle::Expression, oracle::Op;

namespace {

template <class Visit>
void each_shape(const Expression& expression, const Visit& visit) {
    if (expression.op == Op::part) visit(expression.shape);
    for (const Expression& part : expression.operands)
        each_shape(part, visit);
}

/// Returns true if the point is on the shape's surface, even where a line lies in faces.
bool is_on(const AnyShapeInDouble& any, const core::Vec3d& point) {
    return std::visit(
        [&]<class Shape>(const Shape& shape) {
            if constexpr (core::has_inside<Shape>)
                return core::side_of(shape, point) == core::Side::surface;
            else
                return false;
        },
        any);
}

std::string word(core::ShapeId shape, double t, bool entering) {
    std::ostringstream text;
    text.precision(17);
    text << (entering ? "+" : "-") << shape << "@" << t << " ";
    return text.str();
}

/// Returns true if a number rounds to the double t of a crossing and to this float, which is never
/// 0. If t is halfway between two floats, the number may round to either.
bool rounds_to(double t, float hit) {
    const auto nearest = static_cast<float>(t);
    return hit == std::max(nearest, std::numeric_limits<float>::denorm_min()) ||
           static_cast<double>(nearest) + static_cast<double>(hit) == 2.0 * t;
}

/// Checks that hits, and single crossings, are the first of all crossings.
void check_firsts(const Tracer& tracer, const RaySpan& rays, const CrossingRows& rows,
                  SolidTally& wrong) {
    Hits hits(rays.origin_x.size());
    tracer.intersect(rays, hits.span());
    CrossingRows firsts;
    tracer.crossings(rays, firsts, {.most = 1, .normals = true});
    for (std::size_t i = 0; i < hits.t.size(); ++i) {
        if (!is_first(firsts, rows, i))
            wrong.blame(wrong.firsts, "the one crossing of ray " + std::to_string(i));
        const std::uint64_t k = rows.first[i];
        const bool is_hit =
            rows.first[i + 1] == k
                ? hits.is_none(i)
                : rows.shape_id[k] == hits.shape[i] && rounds_to(rows.t[k], hits.t[i]) &&
                      rows.entering[k] == hits.entering[i] && rows.normal_x[k] == hits.nx[i] &&
                      rows.normal_y[k] == hits.ny[i] && rows.normal_z[k] == hits.nz[i];
        if (!is_hit) wrong.blame(wrong.firsts, "the hit of ray " + std::to_string(i));
    }
}

} // namespace

std::string described(const Expression& expression) {
    std::ostringstream text;
    text.precision(17);
    if (expression.op == Op::part) {
        text << core::name_of(static_cast<core::Kind>(expression.shape.index())) << "[";
        std::visit(
            [&](const auto& shape) {
                for (const double number : core::numbers_of(shape))
                    text << " " << number;
            },
            expression.shape);
        text << " ]";
        return text.str();
    }
    text << "|&-/"[static_cast<int>(expression.op) - 1] << "(";
    for (const Expression& part : expression.operands)
        text << described(part) << " ";
    text << ")";
    return text.str();
}

std::vector<AnyShapeInDouble> shapes_of(const Expression& expression) {
    std::vector<AnyShapeInDouble> shapes;
    each_shape(expression, [&](const AnyShapeInDouble& shape) { shapes.push_back(shape); });
    return shapes;
}

raylane::Solid solid_of(const Expression& expression) {
    if (expression.op == Op::part)
        return std::visit(
            []<class Shape>(const Shape& shape) {
                return raylane::Solid(std::bit_cast<typename InLibrary<Shape>::Type>(shape));
            },
            expression.shape);
    std::vector<raylane::Solid> parts;
    for (const Expression& part : expression.operands)
        parts.push_back(solid_of(part));
    const std::vector<raylane::Solid> others(parts.begin() + 1, parts.end());
    switch (expression.op) {
    case Op::unite:
        return union_of(parts);
    case Op::intersect:
        return intersection_of(parts);
    case Op::subtract:
        return difference_of(parts[0], others);
    default:
        return clipped(parts[0], others);
    }
}

std::optional<Scene> scene_of(const Expression& expression) {
    SceneBuilder builder;
    try {
        builder.add(solid_of(expression), builder.add_material({}));
        return builder.build();
    } catch (const InvalidValue&) {
        return std::nullopt;
    }
}

void ask(const Expression& expression, const Scene& scene,
         const std::vector<core::Ray<float>>& asked, SolidTally& wrong) {
    const std::vector<AnyShapeInDouble> shapes = shapes_of(expression);
    Rays rays;
    std::vector<core::Ray<double>> exact;
    for (const core::Ray<float>& ray : asked) {
        rays.add({ray.origin.x, ray.origin.y, ray.origin.z},
                 {ray.direction.x, ray.direction.y, ray.direction.z});
        exact.push_back({core::convert<double>(ray.origin), core::convert<double>(ray.direction)});
    }
    const bool has_clip = described(expression).find('/') != std::string::npos;
    const Tracer tracer(scene);
    CrossingRows rows;
    tracer.crossings(rays.span(), rows, {.normals = true});
    check_firsts(tracer, rays.span(), rows, wrong);
    const Hits hits = intersect(tracer, rays);
    std::vector<std::uint8_t> blocked(rays.size());
    tracer.occluded(rays.span(), blocked);
    SolidRows solids;
    tracer.contains(PointSpan{rays.span().origin_x, rays.span().origin_y, rays.span().origin_z},
                    solids);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        oracle::SolidLine line(expression, exact[i]);
        const std::vector<oracle::SolidHit> truth = line.surfaces();
        ++wrong.asked;
        wrong.surfaces += static_cast<long>(truth.size());
        std::string expected, found;
        for (const oracle::SolidHit& hit : truth)
            expected +=
                word(hit.shape, oracle::rounded_to_double(hit.hit.root, hit.hit.t), hit.entering);
        for (std::uint64_t k = rows.first[i]; k < rows.first[i + 1]; ++k)
            found += word(rows.shape_id[k], rows.t[k], rows.entering[k] != 0);
        if (found != expected) wrong.blame(wrong.rows, "rows " + found + "for " + expected);
        std::string first =
            truth.empty()
                ? "none"
                : word(truth[0].shape,
                       static_cast<double>(oracle::rounded(truth[0].hit.root, truth[0].hit.t)),
                       truth[0].entering);
        const std::string hit =
            hits.shape[i] == no_shape
                ? "none"
                : word(hits.shape[i], static_cast<double>(hits.t[i]), hits.entering[i] != 0);
        if (hit != first) wrong.blame(wrong.hits, "hit " + hit + "for " + first);
        if ((blocked[i] != 0) == truth.empty()) wrong.blame(wrong.blocked, "occluded " + first);
        int side = line.side_of_origin();
        for (const AnyShapeInDouble& shape : shapes)
            if (is_on(shape, exact[i].origin)) side = 0;
        const bool is_in = solids.first[i] != solids.first[i + 1];
        // A clipped solid may have an inside without any surface.
        if (side != 0 && !has_clip && is_in != (side < 0)) wrong.blame(wrong.sides, "side");
        if (!wrong.first.empty() && wrong.example.empty()) {
            std::ostringstream text;
            text.precision(17);
            for (int axis = 0; axis < 3; ++axis)
                text << exact[i].origin[axis] << " " << exact[i].direction[axis] << ", ";
            wrong.example = described(expression) + " by " + text.str();
        }
    }
}

void ask_onward(const Scene& scene, const std::vector<core::Ray<float>>& asked, SolidTally& wrong) {
    Rays rays;
    for (const core::Ray<float>& ray : asked)
        rays.add({ray.origin.x, ray.origin.y, ray.origin.z},
                 {ray.direction.x, ray.direction.y, ray.direction.z});
    const Tracer tracer(scene);
    CrossingRows rows;
    tracer.crossings(rays.span(), rows, {.most = 1, .normals = true});
    Rays onward;
    std::vector<ShapeId> shape;
    std::vector<std::uint8_t> face, inward;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::uint64_t k = rows.first[i];
        if (rows.first[i + 1] == k) continue;
        const core::Ray<double> ray = rays.ray(i);
        const core::Vec3f at =
            core::convert<float>(core::mul_add(rows.t[k], ray.direction, ray.origin));
        const std::size_t other = i % 2 == 0 ? i : (7 * i + 1) % rays.size();
        onward.add({at.x, at.y, at.z}, {rays.dx[other], rays.dy[other], rays.dz[other]});
        shape.push_back(rows.shape_id[k]);
        face.push_back(rows.face[k]);
        const float along = rows.normal_x[k] * rays.dx[other] + rows.normal_y[k] * rays.dy[other] +
                            rows.normal_z[k] * rays.dz[other];
        inward.push_back(along < 0 ? 1 : 0);
    }
    RaySpan from = onward.span();
    from.origin_shape = shape;
    from.origin_face = face;
    from.origin_inward = inward;
    CrossingRows crossings;
    tracer.crossings(from, crossings, {.normals = true});
    check_firsts(tracer, from, crossings, wrong);
}

} // namespace raylane::tests
