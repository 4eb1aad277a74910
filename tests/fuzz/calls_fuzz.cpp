#include "core/shapes/shapes.hpp"
#include "tests/fuzz/shapes.hpp"
#include "tests/scenes/api/exam_in_double.hpp"

#include <algorithm>
#include <string>

/// Calls the library with arbitrary shapes and rays. Exact arithmetic (the oracle) decides which
/// answers are right. For spans of any length, the answers of different calls are compared with
/// each other. This is the only check if rays name the shape that they leave, or if some surfaces
/// are visible from one side only: the oracle is not used there.
using namespace raylane;
using namespace raylane::fuzz;
using core::Vec3d;
using tests::AnyShapeInDouble, tests::Hits, tests::Rays;

namespace {

tests::Sides sides_of(Bytes& bytes) {
    return bytes.below(4) == 0 ? tests::Sides::some : tests::Sides::both;
}

void ask_in_float(Bytes& bytes) {
    const tests::Sides sides = sides_of(bytes);
    const std::vector<tests::AnyShape> shapes = shapes_of<tests::AnyShape>(bytes);
    std::vector<core::Ray<float>> rays;
    for (int i = 0; i < 12 && bytes.any(); ++i) {
        rays.push_back(ray_of<float>(bytes, shapes));
        const core::Ray<double> wide{core::convert<double>(rays.back().origin),
                                     core::convert<double>(rays.back().direction)};
        if (!is_usual(wide)) rays.pop_back();
    }
    tests::Tally tally;
    tests::Exam(shapes, sides).ask(rays, tests::Limits::at_crossings, tests::Ways::one, tally);
    if (tally.wrong() != 0) found(tally.report());
}

void ask_in_double(Bytes& bytes) {
    const std::vector<AnyShapeInDouble> shapes = shapes_of<AnyShapeInDouble>(bytes);
    std::vector<core::Ray<double>> rays;
    for (int i = 0; i < 12 && bytes.any(); ++i) {
        rays.push_back(ray_of<double>(bytes, shapes));
        if (!is_usual(rays.back())) rays.pop_back();
    }
    tests::DoubleFaults faults;
    tests::ask(shapes, rays, faults);
    if (faults.all() != 0) found(faults.first);
}

/// Rays with all optional inputs of a caller.
struct Asked {
    Rays rays;
    std::vector<ShapeId> shape;
    std::vector<std::uint8_t> face, inward;

    RaySpan part(std::size_t first, std::size_t count) const {
        RaySpan span = rays.part(first, count);
        if (!shape.empty()) span.origin_shape = std::span(shape).subspan(first, count);
        if (!face.empty()) span.origin_face = std::span(face).subspan(first, count);
        if (!inward.empty()) span.origin_inward = std::span(inward).subspan(first, count);
        return span;
    }
};

/// Returns rows of rays. In each row, the origin and the direction change by equal steps. Some
/// numbers are arbitrary, including infinities and NaN.
Asked any_rays(Bytes& bytes, const std::vector<tests::AnyShape>& shapes) {
    Asked asked;
    Rays& rays = asked.rays;
    const int says = bytes.byte();
    const auto says_so = [&](int bit) { return (says >> bit & 1) != 0; };
    for (int row = 0; row < 6 && bytes.any() && rays.size() < 200; ++row) {
        const core::Ray<float> first = ray_of<float>(bytes, shapes);
        const bool moves = bytes.flag(), turns = bytes.flag();
        const core::Vec3f by = moves ? bytes.vector<float>() : core::Vec3f(0.0F);
        const core::Vec3f turn = turns ? bytes.vector<float>() : core::Vec3f(0.0F);
        const int special = bytes.byte();
        const int count = 1 + bytes.below(48);
        for (int i = 0; i < count; ++i) {
            const auto step = static_cast<float>(i) / 8.0F;
            core::Vec3f o = first.origin + step * by, d = first.direction + step * turn;
            if (special >= 240) (special % 2 == 0 ? o : d)[special % 3] = bytes.any_float();
            rays.add({o.x, o.y, o.z}, {d.x, d.y, d.z});
            if (says_so(0)) rays.t_min.push_back(bytes.any_float());
            if (says_so(1)) rays.t_max.push_back(bytes.any_float());
            if (says_so(2)) asked.shape.push_back(static_cast<ShapeId>(bytes.byte() - 4));
            if (says_so(2) && says_so(3))
                asked.face.push_back(static_cast<std::uint8_t>(bytes.byte()));
            if (says_so(2) && says_so(4))
                asked.inward.push_back(static_cast<std::uint8_t>(bytes.byte()));
        }
    }
    return asked;
}

void hold(bool condition, const char* what, std::size_t ray) {
    if (!condition) found(std::string(what) + ", ray " + std::to_string(ray));
}

bool is_a_ray(const Rays& rays, std::size_t i) {
    const core::Ray<double> ray = rays.ray(i);
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(ray.origin[axis]) || !std::isfinite(ray.direction[axis])) return false;
    if (!rays.t_min.empty() && std::isnan(rays.t_min[i])) return false;
    if (!rays.t_max.empty() && std::isnan(rays.t_max[i])) return false;
    return ray.direction != Vec3d(0.0);
}

/// Lets the rays start on no shape that cannot start on the one that they name.
void drop_invalid_starts(const Tracer& tracer, Asked& asked) {
    for (bool again = true; again;) {
        again = false;
        try {
            Hits hits(asked.rays.size());
            tracer.intersect(asked.part(0, asked.rays.size()), hits.span());
        } catch (const InvalidRay& invalid) {
            asked.shape[invalid.ray] = no_shape;
            again = true;
        }
    }
}

void check_by_oracle(const std::vector<tests::AnyShape>& shapes, const Asked& asked,
                     const Hits& hits) {
    const oracle::Neighbours neighbours(shapes);
    const Rays& rays = asked.rays;
    for (std::size_t i = 0; i < rays.size(); i += 1 + rays.size() / 40) {
        if (!is_a_ray(rays, i)) {
            hold(hits.is_none(i), "no ray", i);
            continue;
        }
        oracle::Sight sight(shapes, neighbours, rays.ray(i), [](ShapeId, bool) { return true; });
        const float t_min = rays.t_min.empty() ? 0.0F : std::max(0.0F, rays.t_min[i]);
        const oracle::Found* const truth =
            sight.first(t_min, rays.t_max.empty() ? tests::infinity : rays.t_max[i]);
        hold(truth == nullptr ? hits.is_none(i)
                              : hits.shape[i] == truth->shape && hits.t[i] == truth->t &&
                                    hits.entering[i] == (truth->hit.entering ? 1 : 0),
             "differs from the oracle", i);
    }
}

/// Traces the rays of a span with all of the library's calls. With Precision::exact, compares the
/// answers with each other, with those for some of the rays alone and, if possible, with the
/// oracle.
void ask_spans(Bytes& bytes) {
    constexpr Precision precisions[] = {Precision::exact, Precision::exact,
                                        Precision::exact, Precision::robust,
                                        Precision::fast,  Precision::plain_double};
    const Precision precision = precisions[bytes.below(6)];
    const tests::Sides sides = sides_of(bytes);
    const std::vector<tests::AnyShape> shapes = shapes_of<tests::AnyShape>(bytes);
    Asked asked = any_rays(bytes, shapes);
    const std::size_t count = asked.rays.size();
    const Tracer tracer(tests::scene_of(shapes, sides), {.threads = 1, .precision = precision});
    drop_invalid_starts(tracer, asked);
    Hits hits(count);
    std::vector<std::uint8_t> face(count, 77), blocked(count, 77);
    std::vector<double> t_double(count, -1.0);
    HitSpan span = hits.span();
    span.face = face;
    span.t_double = t_double;
    tests::DoubleNormals normals(count);
    normals.add_to(span);
    const RaySpan rays = asked.part(0, count);
    tracer.intersect(rays, span);
    tracer.occluded(rays, blocked);
    CrossingRows rows, first;
    tracer.crossings(rays, rows, {.normals = true, .normals_double = true});
    tracer.crossings(rays, first, {.most = 1});
    LengthRows lengths;
    tracer.path_lengths(rays, lengths);
    SolidLengthRows of_solids;
    tracer.solid_lengths(rays, of_solids);
    std::vector<std::uint64_t> counts(count, 77);
    tracer.count_crossings(rays, counts);
    if (precision != Precision::exact) return;
    for (std::size_t i = 0; i < count; ++i) {
        const bool any = hits.shape[i] != no_shape;
        hold(any || (hits.is_none(i) && face[i] == 0), "a hit without a shape", i);
        hold(blocked[i] == (any ? 1 : 0), "occluded differs from intersect", i);
        const std::uint64_t row = rows.first[i];
        hold((rows.first[i + 1] != row) == any, "crossings differ from intersect", i);
        hold(first.first[i + 1] - first.first[i] == (any ? 1 : 0), "most", i);
        hold(counts[i] == rows.first[i + 1] - row, "another number of crossings", i);
        hold((of_solids.first[i + 1] != of_solids.first[i]) ==
                 (lengths.first[i + 1] != lengths.first[i]),
             "lengths inside of solids", i);
        if (!any) {
            hold(normals[i] == Vec3d(0.0), "a normal without a shape", i);
            continue;
        }
        hold(normals[i] == Vec3d(rows.normal_double_x[row], rows.normal_double_y[row],
                                 rows.normal_double_z[row]),
             "the first crossing has another normal", i);
        hold(rows.shape_id[row] == hits.shape[i] && rows.t[row] == t_double[i] &&
                 rows.face[row] == face[i] && rows.entering[row] == hits.entering[i] &&
                 rows.normal_x[row] == hits.nx[i] && rows.normal_y[row] == hits.ny[i] &&
                 rows.normal_z[row] == hits.nz[i],
             "the first crossing is not the hit", i);
        const std::uint64_t once = first.first[i];
        hold(first.shape_id[once] == hits.shape[i] && first.t[once] == t_double[i], "most, first",
             i);
    }
    for (std::size_t i = 0; i < count; i += 1 + count / 16) { // some of them alone
        Hits alone(1);
        const RaySpan one = asked.part(i, 1);
        tracer.intersect(one, alone.span());
        std::uint8_t is_blocked = 77;
        tracer.occluded(one, {&is_blocked, 1});
        hold(alone.t[0] == hits.t[i] && alone.nx[0] == hits.nx[i] && alone.ny[0] == hits.ny[i] &&
                 alone.nz[0] == hits.nz[i] && alone.shape[0] == hits.shape[i] &&
                 alone.entering[0] == hits.entering[i] && is_blocked == blocked[i],
             "the ray alone gives another answer", i);
    }
    if (asked.shape.empty() && sides == tests::Sides::both) check_by_oracle(shapes, asked, hits);
}

/// Returns the approximate length of a line inside of any of these solids.
double length_inside(const CrossingRows& rows, std::size_t row, double t_max) {
    std::vector<std::pair<double, double>> intervals;
    std::vector<std::pair<ShapeId, double>> open;
    for (std::uint64_t k = rows.first[row]; k < rows.first[row + 1]; ++k) {
        const auto of_shape = std::find_if(
            open.begin(), open.end(), [&](const auto& at) { return at.first == rows.shape_id[k]; });
        if (rows.entering[k] != 0) {
            open.emplace_back(rows.shape_id[k], rows.t[k]);
        } else if (of_shape != open.end()) {
            intervals.emplace_back(of_shape->second, rows.t[k]);
            open.erase(of_shape);
        } else {
            intervals.emplace_back(0.0, rows.t[k]);
        }
    }
    for (const auto& [shape, from] : open)
        intervals.emplace_back(from, t_max);
    std::sort(intervals.begin(), intervals.end());
    double length = 0.0, until = 0.0;
    for (const auto& [from, to] : intervals) {
        length += std::max(0.0, to - std::max(from, until));
        until = std::max(until, to);
    }
    return length;
}

/// Checks which solids contain points, and the lengths of lines inside of solids.
void ask_insides(Bytes& bytes) {
    std::vector<AnyShapeInDouble> shapes = shapes_of<AnyShapeInDouble>(bytes);
    std::erase_if(shapes, [](const AnyShapeInDouble& any) {
        return std::visit(
            []<class Shape>(const Shape&) { return !tests::is_solid<core::InFloat<Shape>>; }, any);
    });
    tests::DoubleRays rays;
    for (int i = 0; i < 16 && bytes.any(); ++i) {
        const core::Ray<double> ray = ray_of<double>(bytes, shapes);
        if (is_usual(ray)) rays.add(ray, 0.0, tests::endless);
    }
    const Tracer tracer(tests::scene_of(shapes), {.threads = 1});
    const DoubleRaySpan span = rays.span();
    SolidRows solids;
    tracer.contains(DoublePointSpan{span.origin_x, span.origin_y, span.origin_z}, solids);
    std::vector<ShapeId> cells(rays.size(), 77);
    tracer.cells(DoublePointSpan{span.origin_x, span.origin_y, span.origin_z}, {.shape_id = cells});
    LengthRows lengths;
    tracer.path_lengths(span, lengths);
    SolidLengthRows of_solids;
    tracer.solid_lengths(span, of_solids);
    CrossingRows rows;
    tracer.crossings(span, rows);
    const std::vector<char> counts = tests::which_count(shapes);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Vec3d point(rays.origin[0][i], rays.origin[1][i], rays.origin[2][i]);
        const Vec3d along(rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]);
        std::uint64_t at = solids.first[i];
        for (ShapeId id = 0; id < shapes.size(); ++id) {
            const core::Side side = std::visit(
                [&]<class Shape>(const Shape& shape) {
                    if constexpr (tests::is_solid<core::InFloat<Shape>>)
                        return core::side_of(shape, point);
                    else
                        return core::Side::outside;
                },
                shapes[id]);
            if (side == core::Side::outside || counts[id] == 0) continue;
            hold(at < solids.first[i + 1] && solids.shape_id[at] == id &&
                     solids.on_surface[at] == (side == core::Side::surface ? 1 : 0),
                 "not the solids around a point", i);
            ++at;
        }
        hold(at == solids.first[i + 1], "too many solids around a point", i);
        hold(cells[i] == (at == solids.first[i] ? no_shape : solids.shape_id[at - 1]), "cell", i);
        double length = 0.0;
        if (lengths.first[i] != lengths.first[i + 1]) length = lengths.length[lengths.first[i]];
        const double t = length_inside(rows, i, 0.0), unit = core::length(along);
        const double far = rows.first[i] != rows.first[i + 1] ? rows.t[rows.first[i + 1] - 1] : 0.0;
        // t is rounded. Lengths that overflow are not compared.
        if (std::isfinite(far * unit) && unit > 1e-100)
            hold(std::abs(length - t * unit) <= 1e-13 * far * unit + 1e-300, "lengths", i);
        double sum = 0.0;
        for (std::uint64_t k = of_solids.first[i]; k < of_solids.first[i + 1]; ++k)
            sum += of_solids.length[k];
        hold(sum >= length * (1.0 - 1e-13), "lengths of solids", i);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    switch (bytes.below(4)) {
    case 0:
        ask_in_float(bytes);
        break;
    case 1:
        ask_in_double(bytes);
        break;
    case 2:
        ask_spans(bytes);
        break;
    default:
        ask_insides(bytes);
    }
    return 0;
}
