#include "tests/scenes/api/exam_in_double.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace raylane::tests {

namespace {

struct Question {
    std::size_t sight;
    double t_min, t_max;
};

template <oracle::Variant Any>
std::string described(const Question& question, const DoubleRays& rays, std::size_t i,
                      const oracle::Found* truth, const std::vector<Any>& shapes) {
    std::ostringstream out;
    out << std::setprecision(17) << shapes.size() << " shapes; ray";
    for (int axis = 0; axis < 3; ++axis)
        out << ' ' << rays.origin[axis][i];
    out << " towards";
    for (int axis = 0; axis < 3; ++axis)
        out << ' ' << rays.direction[axis][i];
    out << ", t from " << question.t_min << " to " << question.t_max;
    if (truth != nullptr) out << "; shape " << truth->shape << " at " << truth->t;
    for (std::size_t id = 0; id < shapes.size(); ++id) {
        if (shapes.size() > 40 && (truth == nullptr || id != truth->shape)) continue;
        out << "; shape " << id << ", kind " << shapes[id].index() << ':';
        std::visit(
            [&](const auto& shape) {
                for (const auto value : core::numbers_of(shape))
                    out << ' ' << value;
            },
            shapes[id]);
    }
    return out.str();
}

/// Returns the number of crossings in a row whose normals in double are wrong.
template <oracle::Variant Any, class Counts>
long wrong_normals(const CrossingRows& rows, std::size_t row, oracle::Sight& sight,
                   const std::vector<Any>& shapes, const Counts& counts) {
    long wrong = 0;
    std::uint64_t at = rows.first[row];
    for (const oracle::Found& found : sight.all()) {
        if (!counts(found)) continue;
        if (at == rows.first[row + 1]) return wrong + 1;
        const core::Vec3d normal(rows.normal_double_x[at], rows.normal_double_y[at],
                                 rows.normal_double_z[at]);
        wrong += normal != sight.double_normal_of(found, shapes[found.shape]) ? 1 : 0;
        ++at;
    }
    return wrong;
}

} // namespace

template <oracle::Variant Any>
void ask(const std::vector<Any>& given_shapes, const std::vector<core::Ray<double>>& rays,
         DoubleFaults& faults) {
    const std::vector<Any> shapes = valid(given_shapes);
    const oracle::Neighbours neighbours(shapes);
    const std::vector<char> counts = which_count(shapes);
    const Tracer tracer(scene_of(shapes), {.threads = 1});
    std::vector<oracle::Sight> sights;
    std::vector<Question> questions;
    DoubleRays asked;
    const auto add = [&](const core::Ray<double>& ray, double t_min, double t_max) {
        asked.add(ray, t_min, t_max);
        questions.push_back({sights.size() - 1, t_min, t_max});
    };
    for (const core::Ray<double>& ray : rays) {
        sights.emplace_back(shapes, neighbours, ray, [](ShapeId, bool) { return true; });
        add(ray, 0.0, endless);
        int count = 0;
        for (const oracle::Found& found : sights.back().all()) {
            if (++count > 3) break;
            const double t = found.t_double;
            for (const double limit : {std::nextafter(t, 0.0), t, std::nextafter(t, endless)}) {
                add(ray, limit, endless);
                add(ray, 0.0, limit);
            }
        }
    }
    const DoubleAnswers answers(tracer, asked);
    const long known = faults.all();
    const oracle::Found* before = nullptr;
    for (std::size_t i = 0; i < questions.size(); ++i) {
        const Question& question = questions[i];
        oracle::Sight& sight = sights[question.sight];
        const oracle::Found* truth = nullptr;
        for (const oracle::Found& found : sight.all()) {
            if (found.t_double <= question.t_min) continue;
            if (found.t_double <= question.t_max) truth = &found;
            break;
        }
        ++faults.rays;
        if (faults.all() > known && faults.first.empty())
            faults.first = described(questions[i - 1], asked, i - 1, before, shapes);
        before = truth;
        const auto is_between = [&](const oracle::Found& found) {
            return counts[found.shape] != 0 && found.t_double > question.t_min &&
                   found.t_double <= question.t_max;
        };
        faults.crossings += is_right(answers.rows, i, sight, is_between) ? 0 : 1;
        faults.crossings += is_first(answers.firsts, answers.rows, i) ? 0 : 1;
        const std::uint64_t count = answers.rows.first[i + 1] - answers.rows.first[i];
        faults.crossings += answers.counts[i] == count ? 0 : 1;
        if (question.t_max == endless)
            faults.double_normal += wrong_normals(answers.rows, i, sight, shapes, is_between);
        const Hits& hits = answers.hits;
        faults.occlusion += answers.blocked[i] != (truth != nullptr ? 1 : 0) ? 1 : 0;
        if (truth == nullptr) {
            faults.shape += hits.is_none(i) && answers.t_double[i] == endless ? 0 : 1;
            faults.double_normal += answers.normals[i] == core::Vec3d(0.0) ? 0 : 1;
            continue;
        }
        ++faults.hits;
        if (hits.shape[i] != truth->shape) {
            ++faults.shape;
            continue;
        }
        faults.t += hits.t[i] != truth->t ? 1 : 0;
        faults.t_double += answers.t_double[i] != truth->t_double ? 1 : 0;
        faults.side += hits.entering[i] != (truth->hit.entering ? 1 : 0) ? 1 : 0;
        faults.normal += core::Vec3f(hits.nx[i], hits.ny[i], hits.nz[i]) !=
                                 sight.normal_of(*truth, shapes[truth->shape])
                             ? 1
                             : 0;
        const core::Vec3d& normal = sight.double_normal_of(*truth, shapes[truth->shape]);
        faults.double_normal += answers.normals[i] != normal ? 1 : 0;
    }
}

template void ask(const std::vector<AnyShape>&, const std::vector<core::Ray<double>>&,
                  DoubleFaults&);
template void ask(const std::vector<AnyShapeInDouble>&, const std::vector<core::Ray<double>>&,
                  DoubleFaults&);

} // namespace raylane::tests
