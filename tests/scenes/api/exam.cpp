#include "tests/scenes/api/exam.hpp"

#include "core/scene/validate.hpp"
#include "core/shapes/shapes.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "simd/isa/isa.hpp"
#include "simd/stream/row_worker.hpp"
#include "simd/stream/stream_tracer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <ios>
#include <sstream>
#include <utility>

namespace raylane::tests {

namespace {

using core::Vec3f;

bool is_valid(const oracle::Variant auto& any) {
    try {
        std::visit([](const auto& shape) { core::validate(shape); }, any);
        return true;
    } catch (const core::InvalidValue&) {
        return false;
    }
}

constexpr Visible visible_sides[] = {Visible::both, Visible::outside, Visible::inside};

/// Returns the index in visible_sides of a shape's sides.
std::size_t which_sides(std::size_t shape, Sides sides) {
    return sides == Sides::both ? 0 : shape % std::size(visible_sides);
}
bool is_seen(std::size_t shape, Sides sides, bool entering) {
    const Visible visible = visible_sides[which_sides(shape, sides)];
    return visible != (entering ? Visible::inside : Visible::outside);
}

/// Writes kind, floats, t and side, from which a separate test can be made.
void describe(std::ostream& out, std::span<const AnyShape> shapes, ShapeId id, float t,
              bool entering) {
    if (id >= shapes.size()) {
        out << "nothing";
        return;
    }
    out << "shape " << id << " of " << shapes.size() << ", kind " << shapes[id].index() << " {";
    std::visit(
        [&](const auto& shape) {
            for (const float value : core::numbers_of(shape))
                out << ' ' << value;
        },
        shapes[id]);
    out << " } at " << t << (entering ? " entered" : " left");
}

} // namespace

template <oracle::Variant Any>
bool are_same(const Any& a, const Any& b) {
    if (a.index() != b.index()) return false;
    return std::visit(
        [&]<class Shape>(const Shape& shape) {
            // Compares bits, as the builder does: -0 differs from 0.
            const auto bits = [](const Shape& s) {
                return std::bit_cast<std::array<char, sizeof(Shape)>>(s);
            };
            return bits(shape) == bits(std::get<Shape>(b));
        },
        a);
}

template <oracle::Variant Any>
std::vector<Any> valid(std::vector<Any> shapes) {
    std::erase_if(shapes, [](const Any& shape) { return !is_valid(shape); });
    return shapes;
}

template <oracle::Variant Any>
Scene scene_of(const std::vector<Any>& shapes, Sides sides) {
    SceneBuilder builder;
    std::vector<MaterialIndex> materials;
    for (const Visible visible : visible_sides)
        materials.push_back(builder.add_material({.visible = visible}));
    for (const Any& any : shapes) {
        const MaterialIndex material = materials[which_sides(builder.shape_count(), sides)];
        std::visit([&](const auto& shape) { add(builder, shape, material); }, any);
    }
    return builder.build();
}

template <oracle::Variant Any>
std::vector<char> which_count(const std::vector<Any>& shapes, Sides sides) {
    std::vector<char> counts;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        std::size_t first = 0;
        while (first < i && !(which_sides(first, sides) == which_sides(i, sides) &&
                              are_same(shapes[first], shapes[i])))
            ++first;
        counts.push_back(first == i ? 1 : 0);
    }
    return counts;
}

#define RAYLANE_INSTANTIATE(Any)                                                                   \
    template std::vector<Any> valid(std::vector<Any>);                                             \
    template Scene scene_of(const std::vector<Any>&, Sides);                                       \
    template bool are_same(const Any&, const Any&);                                                \
    template std::vector<char> which_count(const std::vector<Any>&, Sides);
RAYLANE_INSTANTIATE(AnyShape)
RAYLANE_INSTANTIATE(AnyShapeInDouble)
#undef RAYLANE_INSTANTIATE

bool is_right(const CrossingRows& rows, std::size_t row, const oracle::Sight& sight,
              const std::function<bool(const oracle::Found&)>& counts) {
    std::uint64_t at = rows.first[row];
    const std::uint64_t end = rows.first[row + 1];
    const oracle::Found* before = nullptr;
    for (const oracle::Found& found : sight.all()) {
        if (!counts(found)) continue;
        const bool touches =
            std::any_of(sight.all().begin(), sight.all().end(), [&](const oracle::Found& other) {
                return other.shape == found.shape && other.hit.entering != found.hit.entering &&
                       compare(other.hit, found.hit) == 0;
            });
        const bool is_tied = before != nullptr && compare(before->hit, found.hit) == 0;
        if (at == end || rows.shape_id[at] != found.shape ||
            rows.t[at] != oracle::rounded_to_double(found.hit.root, found.hit.t) ||
            rows.entering[at] != (found.hit.entering ? 1 : 0) ||
            rows.tied[at] != (is_tied ? 1 : 0) || rows.touching[at] != (touches ? 1 : 0))
            return false;
        before = &found;
        ++at;
    }
    return at == end;
}

bool is_first(const CrossingRows& firsts, const CrossingRows& rows, std::size_t row) {
    const std::uint64_t a = firsts.first[row], b = rows.first[row];
    if (rows.first[row + 1] == b) return firsts.first[row + 1] == a;
    return firsts.first[row + 1] == a + 1 && firsts.shape_id[a] == rows.shape_id[b] &&
           firsts.t[a] == rows.t[b] && firsts.entering[a] == rows.entering[b] &&
           firsts.face[a] == rows.face[b] && firsts.tied[a] == rows.tied[b] &&
           firsts.touching[a] == rows.touching[b] && firsts.normal_x[a] == rows.normal_x[b] &&
           firsts.normal_y[a] == rows.normal_y[b] && firsts.normal_z[a] == rows.normal_z[b] &&
           (firsts.normal_double_x.empty() ||
            (firsts.normal_double_x[a] == rows.normal_double_x[b] &&
             firsts.normal_double_y[a] == rows.normal_double_y[b] &&
             firsts.normal_double_z[a] == rows.normal_double_z[b]));
}

std::string Tally::report() const {
    std::string text = std::to_string(lines) + " lines, " + std::to_string(rays) + " rays, " +
                       std::to_string(hits) + " hits, " + std::to_string(crossings) +
                       " crossings, " + std::to_string(wrong()) + " wrong\n";
    for (std::size_t i = 0; i < std::size(faults); ++i) {
        if (faults[i] == 0) continue;
        text += std::to_string(faults[i]) + " of " + fault_names[i] + ", the first:\n" + first[i];
    }
    return text;
}

Exam::Exam(std::vector<AnyShape> shapes, Sides sides)
    : shapes_(valid(std::move(shapes))), sides_(sides), counts_(which_count(shapes_, sides)),
      neighbours_(shapes_), scene_(scene_of(shapes_, sides)), tracer_(scene_, {.threads = 1}) {}

void Exam::ask(std::span<const core::Ray<float>> rays, Limits limits, Ways ways, Tally& tally) {
    Questions questions;
    for (const core::Ray<float>& ray : rays) {
        const core::Ray<double> wide{core::convert<double>(ray.origin),
                                     core::convert<double>(ray.direction)};
        questions.sights.emplace_back(
            shapes_, neighbours_, wide,
            [&](ShapeId shape, bool entering) { return is_seen(shape, sides_, entering); });
        add(questions, ray, 0.0F, infinity);
        if (limits == Limits::at_crossings) add_limited(questions, ray);
    }
    tally.lines += static_cast<long>(rays.size());
    tally.rays += static_cast<long>(questions.rays.size());
    Answers answers{intersect(tracer_, questions.rays), occluded(tracer_, questions.rays)};
    tracer_.crossings(questions.rays.span(), answers.rows, {.normals = true});
    tracer_.crossings(questions.rays.span(), answers.firsts, {.most = 1, .normals = true});
    for (std::size_t i = 0; i < questions.rays.size(); ++i)
        check(questions, i, answers, tally);
    check_others(questions.rays, answers, ways, tally);
}

void Exam::add(Questions& questions, const core::Ray<float>& ray, float t_min, float t_max) {
    questions.rays.add({ray.origin.x, ray.origin.y, ray.origin.z},
                       {ray.direction.x, ray.direction.y, ray.direction.z});
    questions.rays.t_min.push_back(t_min);
    questions.rays.t_max.push_back(t_max);
    questions.sight_of.push_back(questions.sights.size() - 1);
}

void Exam::add_limited(Questions& questions, const core::Ray<float>& ray) {
    constexpr int most = 6; // crossings
    float last = 0.0F;
    int count = 0;
    for (const oracle::Found& found : questions.sights.back().all()) {
        if (found.t == last) continue;
        if (++count > most) return;
        last = found.t;
        const float before = std::nextafter(last, 0.0F), behind = std::nextafter(last, infinity);
        for (const float limit : {before, last, behind}) {
            add(questions, ray, limit, infinity);
            add(questions, ray, 0.0F, limit);
        }
        add(questions, ray, before, last);
    }
}

void Exam::check(Questions& questions, std::size_t i, const Answers& answers, Tally& tally) const {
    const Rays& rays = questions.rays;
    const Hits& hits = answers.hits;
    oracle::Sight& sight = questions.sights[questions.sight_of[i]];
    const oracle::Found* const truth = sight.first(rays.t_min[i], rays.t_max[i]);
    const auto wrong = [&](Fault fault) { blame(fault, rays, i, answers, truth, tally); };
    const bool any = truth != nullptr;
    tally.hits += any ? 1 : 0;
    if (answers.blocked[i] != (any ? 1 : 0)) wrong(Fault::occlusion);
    tally.crossings += static_cast<long>(answers.rows.first[i + 1] - answers.rows.first[i]);
    if (!is_right(answers.rows, i, sight, [&](const oracle::Found& found) {
            return rays.t_min[i] < found.t && found.t <= rays.t_max[i] && counts_[found.shape] != 0;
        }))
        wrong(Fault::crossings);
    if (!is_first(answers.firsts, answers.rows, i)) wrong(Fault::crossings);
    if (const std::uint64_t first = answers.rows.first[i];
        any && answers.rows.first[i + 1] != first &&
        Vec3f(answers.rows.normal_x[first], answers.rows.normal_y[first],
              answers.rows.normal_z[first]) != sight.normal_of(*truth, shapes_[truth->shape]))
        wrong(Fault::normal);
    if (any ? hits.shape[i] != truth->shape : !hits.is_none(i)) wrong(Fault::shape);
    if (!any || hits.shape[i] != truth->shape) return;
    if (hits.t[i] != truth->t) wrong(Fault::t);
    if (hits.entering[i] != (truth->hit.entering ? 1 : 0)) wrong(Fault::side);
    if (Vec3f(hits.nx[i], hits.ny[i], hits.nz[i]) != sight.normal_of(*truth, shapes_[truth->shape]))
        wrong(Fault::normal);
}

/// Checks that StreamTracer gives the same bits with each instruction set, on one thread and on
/// several.
void Exam::check_others(const Rays& rays, const Answers& answers, Ways ways, Tally& tally) const {
    static std::size_t turn = 0;
    const auto isas = simd::available_isas();
    const std::size_t only = turn++ % (2 * isas.size());
    std::size_t way = 0;
    for (const simd::Isa isa : isas)
        for (const int threads : {1, 3}) {
            if (ways == Ways::one && way++ != only) continue;
            const simd::StreamTracer tracer(library::Internals::of(scene_), threads, isa);
            const simd::RayStream<float> stream{rays.size(),
                                                {rays.x.data(), rays.y.data(), rays.z.data()},
                                                {rays.dx.data(), rays.dy.data(), rays.dz.data()},
                                                rays.t_min.data(),
                                                rays.t_max.data()};
            Answers same{Hits(rays.size()), std::vector<std::uint8_t>(rays.size(), 77), {}};
            Hits& hits = same.hits;
            tracer.nearest(stream, {hits.t.data(),
                                    {hits.nx.data(), hits.ny.data(), hits.nz.data()},
                                    hits.shape.data(),
                                    hits.entering.data()});
            tracer.occluded(stream, same.blocked.data());
            simd::CrossingRows found;
            simd::CrossingCounters counters;
            tracer.crossings(stream, {}, found, counters);
            const CrossingRows& of_one = answers.rows;
            const bool has_same_rows = found.first == of_one.first && found.t == of_one.t &&
                                       found.shape == of_one.shape_id &&
                                       found.entering == of_one.entering &&
                                       found.face == of_one.face && found.tied == of_one.tied &&
                                       found.touching == of_one.touching;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                if (has_same_rows && hits.is_same(i, answers.hits) &&
                    same.blocked[i] == answers.blocked[i])
                    continue;
                blame(Fault::other, rays, i, same, nullptr, tally);
                break;
            }
        }
}

void Exam::blame(Fault fault, const Rays& rays, std::size_t i, const Answers& answers,
                 const oracle::Found* truth, Tally& tally) const {
    const auto which = static_cast<std::size_t>(fault);
    if (tally.faults[which]++ == 0) tally.first[which] = described(rays, i, answers, truth);
}

std::string Exam::described(const Rays& rays, std::size_t i, const Answers& answers,
                            const oracle::Found* truth) const {
    const Hits& hits = answers.hits;
    std::ostringstream out;
    out << std::hexfloat << "  ray";
    for (const float value : {rays.x[i], rays.y[i], rays.z[i], rays.dx[i], rays.dy[i], rays.dz[i],
                              rays.t_min[i], rays.t_max[i]})
        out << ' ' << value;
    out << "\n  answered: ";
    describe(out, shapes_, hits.shape[i], hits.t[i], hits.entering[i] != 0);
    out << ", normal " << hits.nx[i] << ' ' << hits.ny[i] << ' ' << hits.nz[i]
        << (answers.blocked[i] != 0 ? ", occluded" : ", not occluded") << "\n  truly:    ";
    if (truth == nullptr)
        out << "nothing";
    else
        describe(out, shapes_, truth->shape, truth->t, truth->hit.entering);
    out << '\n';
    return out.str();
}

} // namespace raylane::tests
