#include "broadcast.hpp"
#include "values.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace raylane::python {

namespace {

/// Numbers of rays: at most `max_at_once` are traced between two checks for signals. `max_copied`
/// rays that are not contiguous are copied at a time, by the thread that then traces them from its
/// cache.
constexpr std::size_t max_at_once = std::size_t{1} << 20, max_copied = std::size_t{1} << 13;
/// Largest number of rays between two checks for signals if the results are rows, which are
/// concatenated.
constexpr std::size_t max_rows = std::size_t{1} << 18;

/// Sizes of parts of a call, such that each takes about a twentieth of a second if rays cost as
/// much as those of the part before. The first part is small, as a ray may take milliseconds.
class PartSize {
  public:
    explicit PartSize(std::size_t most) : most_(most) {}

    std::size_t size() const { return std::min(size_, most_); }
    void adapt(std::chrono::duration<double> taken) {
        constexpr double aim = 0.05, max_growth = 16.0;
        const double growth = std::min(aim / std::max(taken.count(), 1e-9), max_growth);
        const double wanted = growth * static_cast<double>(size());
        size_ = std::max(static_cast<std::size_t>(wanted), std::size_t{1});
    }

  private:
    std::size_t most_, size_ = 16;
};

/// A tracer and a task arena for rays that have to be copied. Each thread of the arena copies the
/// rays that it traces.
class SharedTracer {
  public:
    SharedTracer(const Scene& scene, const TracerOptions& options)
        : tracer_(scene, options), precision_(options.precision),
          arena_(threads_of(options.threads)) {}

    const Tracer& all() const { return tracer_; }
    /// Returns a tracer of one thread, for calls from threads of the arena. To be called under
    /// Python's lock.
    const Tracer& alone() {
        if (arena_.max_concurrency() == 1) return tracer_;
        if (!alone_)
            alone_.emplace(tracer_.scene(), TracerOptions{.threads = 1, .precision = precision_});
        return *alone_;
    }
    template <class Call>
    void for_each(std::size_t count, const Call& call) {
        arena_.execute([&] { tbb::parallel_for(std::size_t{0}, count, call); });
    }

  private:
    static int threads_of(int wanted) {
        const char* const told = std::getenv("RAYLANE_THREADS");
        if (wanted == 0 && told != nullptr) wanted = std::atoi(told); // validated by the tracer
        const int most = tbb::info::default_concurrency();
        return wanted > 0 ? std::min(wanted, most) : most;
    }
    Tracer tracer_;
    Precision precision_;
    std::optional<Tracer> alone_;
    tbb::task_arena arena_;
};

/// Calls call(from, to) for consecutive parts of 0 to `count`, of at most `most` elements each,
/// without Python's lock. Checks for signals between the parts, which are short.
template <class Call>
void in_turn(std::size_t count, std::size_t most, const Call& call) {
    const py::gil_scoped_release free;
    using Clock = std::chrono::steady_clock;
    PartSize part(most);
    for (std::size_t from = 0, to = 0; from < count; from = to) {
        to = from + std::min(count - from, part.size());
        const Clock::time_point begin = Clock::now();
        call(from, to);
        if (to == count) return;
        look_for_signals();
        part.adapt(Clock::now() - begin);
    }
}

/// Calls call(), and names an invalid ray by its number among all of the caller's rays. `from`:
/// that of the first ray of the call.
template <class Call>
void naming_rays(std::size_t from, const Call& call) {
    try {
        call();
    } catch (const InvalidRay& invalid) {
        std::string column = invalid.array.substr(std::string_view("origin_").size());
        if (column == "shape") column = "shape_id";
        throw InvalidValue("leaving." + column + "/" + std::to_string(from + invalid.ray),
                           invalid.expectation);
    }
}

/// The arrays of rays: origins, directions, t_min, t_max, and the shapes, faces and sides that the
/// rays leave. They broadcast with each other. All but the first two may be None.
class RayArrays {
  public:
    RayArrays(const py::object& origins, const py::object& directions, const py::tuple& rest) {
        arrays_ = {origins, directions};
        for (const py::handle& other : rest)
            arrays_.push_back(py::reinterpret_borrow<py::object>(other));
        for_each([&](py::object& array, const Axes& row, const char* name) {
            const py::array converted = any_array(array, name);
            broadcast(axes_, converted, row, name);
            array = converted;
        });
    }
    /// Returns the axes of the results.
    const Axes& axes() const { return axes_; }
    /// Gives all arrays the shapes (n, 3) and (n,), or (3,) and () if they have one row for all.
    /// Returns true if none had to be copied.
    bool flatten() {
        bool in_place = true;
        for_each([&](py::object& array, const Axes& row, const char*) {
            const auto full_array = py::reinterpret_borrow<py::array>(array);
            const py::array flat = flattened(full_array, row, axes_);
            in_place = in_place && flat.data() == full_array.data();
            array = flat;
        });
        return in_place;
    }
    const py::object& operator[](std::size_t i) const { return arrays_[i]; }

    static constexpr const char* names[] = {"origins",       "directions",       "t_min",
                                            "t_max",         "leaving.shape_id", "leaving.face",
                                            "leaving.inward"};

  private:
    template <class Call>
    void for_each(const Call& call) {
        for (std::size_t i = 0; i < arrays_.size(); ++i)
            if (i < 2 || !arrays_[i].is_none())
                call(arrays_[i], i < 2 ? Axes{3} : Axes{}, names[i]);
    }
    std::vector<py::object> arrays_;
    Axes axes_;
};

/// The arrays of n rays, with any strides.
template <class Real>
class RayColumns {
  public:
    /// Takes flattened arrays.
    explicit RayColumns(const RayArrays& arrays)
        : axes_(arrays.axes()), origins_(arrays[0], {3}, arrays.names[0], count_of(axes_)),
          directions_(arrays[1], {3}, arrays.names[1], count_of(axes_)) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            origin_[axis] = origins_.column(axis);
            direction_[axis] = directions_.column(axis);
        }
        const auto take = [&](std::size_t i, auto& values) {
            if (!arrays[i].is_none()) values = {arrays[i], count(), arrays.names[i]};
        };
        take(2, t_min_);
        take(3, t_max_);
        const auto take_whole = [&]<class Value>(std::size_t i, Values<Value>& values,
                                                 std::type_identity_t<Value> most) {
            const char* const name = arrays.names[i];
            if (!arrays[i].is_none())
                values = {whole_numbers(arrays[i], name, most), count(), name};
        };
        take_whole(4, shapes_, raylane::no_shape);
        take_whole(5, faces_, std::uint8_t{255});
        take_whole(6, inward_, std::uint8_t{2});
    }

    std::size_t count() const { return directions_.count(); }
    /// Returns the axes of the results, whose elements are the rays in the order of C.
    const Axes& axes() const { return axes_; }
    /// Returns true if all columns are contiguous, so that no ray has to be copied.
    bool is_spans() const {
        bool are_hits = true;
        for (std::size_t axis = 0; axis < 3; ++axis)
            are_hits = are_hits && origin_[axis].is_span() && direction_[axis].is_span();
        return are_hits && t_min_.column().is_span() && t_max_.column().is_span() &&
               shapes_.column().is_span() && faces_.column().is_span() &&
               inward_.column().is_span();
    }

    struct Rooms {
        Room<Real> origin[3], direction[3], limits[2];
        Room<ShapeId> shapes;
        Room<std::uint8_t> faces, inward;
    };
    BasicRaySpan<Real> part(std::size_t from, std::size_t to, Rooms& room) const {
        const auto origin = origins_.parts(from, to, room.origin);
        const auto direction = directions_.parts(from, to, room.direction);
        return {.origin_x = origin[0],
                .origin_y = origin[1],
                .origin_z = origin[2],
                .direction_x = direction[0],
                .direction_y = direction[1],
                .direction_z = direction[2],
                .t_min = t_min_.column().part(from, to, room.limits[0]),
                .t_max = t_max_.column().part(from, to, room.limits[1]),
                .origin_shape = shapes_.column().part(from, to, room.shapes),
                .origin_face = faces_.column().part(from, to, room.faces),
                .origin_inward = inward_.column().part(from, to, room.inward)};
    }
    /// Calls answer(tracer, rays, from, to) for parts of the rays, without Python's lock. If rays
    /// have to be copied, several threads call it.
    template <class Answer>
    void share_out(SharedTracer& tracer, const Answer& answer) const {
        const bool copied = !is_spans();
        const Tracer& asked = copied ? tracer.alone() : tracer.all();
        in_turn(count(), max_at_once, [&](std::size_t from, std::size_t to) {
            if (!copied) {
                Rooms rooms;
                return naming_rays(from, [&] { answer(asked, part(from, to, rooms), from, to); });
            }
            tbb::enumerable_thread_specific<Rooms> rooms;
            tracer.for_each((to - from + max_copied - 1) / max_copied, [&](std::size_t number) {
                const std::size_t first = from + number * max_copied;
                const std::size_t last = std::min(to, first + max_copied);
                naming_rays(first,
                            [&] { answer(asked, part(first, last, rooms.local()), first, last); });
            });
        });
    }
    /// Calls answer(tracer, rays) for one part of the rays after the other, for results in rows.
    template <class Answer>
    void one_by_one(SharedTracer& tracer, const Answer& answer) const {
        Rooms rooms;
        in_turn(count(), max_rows, [&](std::size_t from, std::size_t to) {
            naming_rays(from, [&] { answer(tracer.all(), part(from, to, rooms)); });
        });
    }

  private:
    Axes axes_;
    Rows<Real> origins_, directions_;
    Column<Real> origin_[3], direction_[3];
    Values<Real> t_min_, t_max_;
    Values<ShapeId> shapes_;
    Values<std::uint8_t> faces_, inward_;
};

/// Returns the caller's contiguous output array with the given axes as a span, which is empty for
/// None. Throws InvalidValue for an array of another type, shape or layout.
template <class Value>
std::span<Value> out(const py::object& array, const Axes& axes, const char* field) {
    if (array.is_none()) return {};
    refuse_masked(array, field);
    using Array = py::array_t<Value, py::array::c_style>;
    if (!py::isinstance<Array>(array))
        throw InvalidValue(field, "must be a contiguous array of its type");
    auto values = py::reinterpret_borrow<Array>(array);
    if (axes_of(values) != axes)
        throw InvalidValue(field, "must have the shape " + shape_text(axes) + ", got " +
                                      shape_text(values));
    return {values.mutable_data(), count_of(axes)};
}

/// Returns true if rays are float rays: all arrays are of float32, or limits with such values.
bool are_floats(const py::object& origins, const py::object& directions, const py::object& t_min,
                const py::object& t_max) {
    return is_float(origins) && is_float(directions) && are_floats_or_plain(t_min, "t_min") &&
           are_floats_or_plain(t_max, "t_max");
}

/// Calls `call` with the type float for float rays, otherwise with double.
template <class Call>
auto by_type(const py::object& origins, const py::object& directions, const py::object& t_min,
             const py::object& t_max, const Call& call) {
    return are_floats(origins, directions, t_min, t_max) ? call(std::type_identity<float>())
                                                         : call(std::type_identity<double>());
}

/// Calls `answer` with the rays. `rest`: the others of RayArrays.
template <class Answer>
auto with_rays(const py::object& origins, const py::object& directions, const py::tuple& rest,
               const Answer& answer) {
    RayArrays arrays(origins, directions, rest);
    arrays.flatten();
    return by_type(
        origins, directions, rest[0], rest[1],
        [&]<class Real>(std::type_identity<Real>) { return answer(RayColumns<Real>(arrays)); });
}

/// Returns the shape of the results for rays.
py::tuple shape_of(const py::object& origins, const py::object& directions, const py::tuple& rest) {
    return py::tuple(py::cast(RayArrays(origins, directions, rest).axes()));
}

/// Calls visit(column of each of these) for the columns that HitSpan and CrossingRows share.
template <class Visit, class... Of>
void for_each_shared_column(const Visit& visit, Of&... of) {
    visit(of.t...);
    visit(of.normal_x...);
    visit(of.normal_y...);
    visit(of.normal_z...);
    visit(of.shape_id...);
    visit(of.entering...);
    visit(of.face...);
    visit(of.normal_double_x...);
    visit(of.normal_double_y...);
    visit(of.normal_double_z...);
}

/// Each query returns the number of refused rays or points, or stores it as "refused".
std::uint64_t intersect(SharedTracer& tracer, const py::object& origins,
                        const py::object& directions, const py::tuple& rest, const py::tuple& to) {
    std::atomic<std::uint64_t> refused = 0;
    with_rays(origins, directions, rest, [&](const auto& rays) {
        const Axes& n = rays.axes();
        const auto t_double = out<double>(to[7], n, to[0].is_none() ? "out.t" : "out.t_double");
        const HitSpan hit_span{.t = out<float>(to[0], n, "out.t"),
                               .normal_x = out<float>(to[1], n, "out.normal"),
                               .normal_y = out<float>(to[2], n, "out.normal"),
                               .normal_z = out<float>(to[3], n, "out.normal"),
                               .shape_id = out<ShapeId>(to[4], n, "out.shape_id"),
                               .entering = out<std::uint8_t>(to[5], n, "out.entering"),
                               .face = out<std::uint8_t>(to[6], n, "out.face"),
                               .t_double = t_double,
                               .normal_double_x = out<double>(to[8], n, "out.normal_double"),
                               .normal_double_y = out<double>(to[9], n, "out.normal_double"),
                               .normal_double_z = out<double>(to[10], n, "out.normal_double")};
        rays.share_out(
            tracer, [&](const Tracer& asked, const auto& part, std::size_t from, std::size_t end) {
                const auto take_part = [&](auto& span) {
                    if (!span.empty()) span = span.subspan(from, end - from);
                };
                HitSpan hits = hit_span;
                for_each_shared_column(take_part, hits);
                take_part(hits.t_double);
                QueryStatistics statistics;
                asked.intersect(part, hits, &statistics);
                refused += statistics.refused;
            });
    });
    return refused;
}

/// Returns true if the rays are traced in place, without a copy.
bool reads_in_place(const py::object& origins, const py::object& directions,
                    const py::tuple& rest) {
    return RayArrays(origins, directions, rest).flatten() &&
           with_rays(origins, directions, rest, [](const auto& rays) { return rays.is_spans(); });
}

/// Fills an array with a value for each ray, by query(tracer, rays, values, statistics).
template <class Value, class Query>
std::uint64_t fill(SharedTracer& tracer, const py::object& origins, const py::object& directions,
                   const py::tuple& rest, const py::object& to, const Query& query) {
    std::atomic<std::uint64_t> refused = 0;
    with_rays(origins, directions, rest, [&](const auto& rays) {
        const auto answers = out<Value>(to, rays.axes(), "out");
        rays.share_out(
            tracer, [&](const Tracer& asked, const auto& part, std::size_t from, std::size_t end) {
                QueryStatistics statistics;
                query(asked, part, answers.subspan(from, end - from), &statistics);
                refused += statistics.refused;
            });
    });
    return refused;
}

std::uint64_t occluded(SharedTracer& tracer, const py::object& origins,
                       const py::object& directions, const py::tuple& rest, const py::object& to) {
    return fill<std::uint8_t>(tracer, origins, directions, rest, to,
                              [](const Tracer& asked, const auto& part, auto values,
                                 auto* statistics) { asked.occluded(part, values, statistics); });
}

std::uint64_t count_crossings(SharedTracer& tracer, const py::object& origins,
                              const py::object& directions, const py::tuple& rest,
                              const py::object& to) {
    return fill<std::uint64_t>(
        tracer, origins, directions, rest, to,
        [](const Tracer& asked, const auto& part, auto values, auto* statistics) {
            asked.count_crossings(part, values, statistics);
        });
}

/// Appends the values of a part's rows.
template <class Value>
void append(std::vector<Value>& to, std::vector<Value>& part) {
    if (to.empty())
        to.swap(part);
    else
        to.insert(to.end(), part.begin(), part.end());
}
/// Appends the first indices of a part's rows, which start with 0, shifted to follow the others.
void append_rows(std::vector<std::uint64_t>& first, const std::vector<std::uint64_t>& part) {
    const std::uint64_t before = first.back();
    for (std::size_t i = 1; i < part.size(); ++i)
        first.push_back(before + part[i]);
}

/// Returns an array (n, 3) of vectors.
template <class Real>
py::array_t<Real> vectors_from(const std::vector<Real>& x, const std::vector<Real>& y,
                               const std::vector<Real>& z) {
    py::array_t<Real> vectors(std::vector<py::ssize_t>{static_cast<py::ssize_t>(x.size()), 3});
    Real* const to = vectors.mutable_data();
    const py::gil_scoped_release free;
    for (std::size_t i = 0; i < x.size(); ++i) {
        to[3 * i] = x[i];
        to[3 * i + 1] = y[i];
        to[3 * i + 2] = z[i];
    }
    return vectors;
}

py::dict crossings(SharedTracer& tracer, const py::object& origins, const py::object& directions,
                   const py::tuple& rest, const py::object& at_most, const py::object& with_normals,
                   const py::object& with_normals_double) {
    const std::size_t most = count_from(at_most, "most");
    const bool normals = bool_from(with_normals, "normals");
    const bool normals_double = bool_from(with_normals_double, "normals_double");
    constexpr std::uint64_t CrossingStatistics::*counted[] = {
        &CrossingStatistics::by_bounds, &CrossingStatistics::by_digits,
        &CrossingStatistics::exactly, &CrossingStatistics::beyond_double,
        &CrossingStatistics::refused};
    CrossingRows crossings;
    CrossingStatistics counts;
    crossings.first = {0};
    with_rays(origins, directions, rest, [&](const auto& rays) {
        rays.one_by_one(tracer, [&](const Tracer& asked, const auto& part) {
            CrossingRows rows;
            CrossingStatistics statistics;
            asked.crossings(part, rows,
                            {.most = most, .normals = normals, .normals_double = normals_double},
                            &statistics);
            for (const auto count : counted)
                counts.*count += statistics.*count;
            append_rows(crossings.first, rows.first);
            for_each_shared_column([](auto& to, auto& more) { append(to, more); }, crossings, rows);
            append(crossings.tied, rows.tied);
            append(crossings.touching, rows.touching);
        });
    });
    py::dict result;
    result["first"] = array_from(std::move(crossings.first));
    result["t"] = array_from(std::move(crossings.t));
    result["shape_id"] = array_from(std::move(crossings.shape_id));
    result["entering"] = bools_from(std::move(crossings.entering));
    result["face"] = array_from(std::move(crossings.face));
    result["tied"] = bools_from(std::move(crossings.tied));
    result["touching"] = bools_from(std::move(crossings.touching));
    result["refused"] = counts.refused;
    result["statistics"] = py::make_tuple(counts.by_bounds, counts.by_digits, counts.exactly,
                                          counts.beyond_double, counts.refused);
    if (normals)
        result["normal"] = vectors_from(crossings.normal_x, crossings.normal_y, crossings.normal_z);
    if (normals_double)
        result["normal_double"] = vectors_from(crossings.normal_double_x, crossings.normal_double_y,
                                               crossings.normal_double_z);
    return result;
}

/// Returns lengths by a column of the rows, under its name. `query`: of the tracer.
template <class AnyRows, class Query>
py::dict lengths(SharedTracer& tracer, const py::object& origins, const py::object& directions,
                 const py::tuple& rest, const char* name,
                 std::vector<std::uint32_t> AnyRows::*column, const Query& query) {
    AnyRows answers;
    QueryStatistics statistics;
    std::uint64_t refused = 0;
    answers.first = {0};
    with_rays(origins, directions, rest, [&](const auto& rays) {
        rays.one_by_one(tracer, [&](const Tracer& asked, const auto& part) {
            AnyRows rows;
            query(asked, part, rows, &statistics);
            refused += statistics.refused;
            append_rows(answers.first, rows.first);
            append(answers.*column, rows.*column);
            append(answers.length, rows.length);
        });
    });
    py::dict result;
    result["first"] = array_from(std::move(answers.first));
    result[name] = array_from(std::move(answers.*column));
    result["length"] = array_from(std::move(answers.length));
    result["refused"] = refused;
    return result;
}

py::dict path_lengths(SharedTracer& tracer, const py::object& origins, const py::object& directions,
                      const py::tuple& rest) {
    return lengths(tracer, origins, directions, rest, "material", &LengthRows::material,
                   [](const Tracer& asked, const auto& part, auto& rows, auto* statistics) {
                       asked.path_lengths(part, rows, statistics);
                   });
}

py::dict solid_lengths(SharedTracer& tracer, const py::object& origins,
                       const py::object& directions, const py::tuple& rest) {
    return lengths(tracer, origins, directions, rest, "shape_id", &SolidLengthRows::shape_id,
                   [](const Tracer& asked, const auto& part, auto& rows, auto* statistics) {
                       asked.solid_lengths(part, rows, statistics);
                   });
}

/// Calls begin(axes of the results), which may broadcast these with others, then query(tracer,
/// points, from, to) for parts of the points, without Python's lock.
template <class Begin, class Query>
void ask_points(const SharedTracer& tracer, const py::object& points, const Begin& begin,
                const Query& query) {
    const py::array array = any_array(points, "points");
    Axes axes;
    broadcast(axes, array, {3}, "points");
    begin(axes);
    by_type(points, py::none(), py::none(), py::none(), [&]<class Real>(std::type_identity<Real>) {
        const Rows<Real> rows(flattened(array, {3}, axes), {3}, "points", count_of(axes));
        Room<Real> room[3];
        in_turn(rows.count(), max_rows, [&](std::size_t from, std::size_t to) {
            const auto [x, y, z] = rows.parts(from, to, room);
            query(tracer.all(), BasicPointSpan<Real>{x, y, z}, from, to);
        });
    });
}

py::dict contains(const SharedTracer& tracer, const py::object& points) {
    SolidRows rows;
    QueryStatistics statistics;
    std::uint64_t refused = 0;
    rows.first = {0};
    ask_points(
        tracer, points, [](const Axes&) {},
        [&](const Tracer& asked, const auto& point_columns, std::size_t, std::size_t) {
            SolidRows part;
            asked.contains(point_columns, part, &statistics);
            refused += statistics.refused;
            append_rows(rows.first, part.first);
            append(rows.shape_id, part.shape_id);
            append(rows.inside, part.inside);
            append(rows.on_surface, part.on_surface);
        });
    py::dict result;
    result["first"] = array_from(std::move(rows.first));
    result["shape_id"] = array_from(std::move(rows.shape_id));
    result["inside"] = bools_from(std::move(rows.inside));
    result["on_surface"] = bools_from(std::move(rows.on_surface));
    result["refused"] = refused;
    return result;
}

py::dict cells(const SharedTracer& tracer, const py::object& points) {
    py::array_t<ShapeId> shape_id;
    py::array_t<std::int64_t> material;
    py::array_t<bool> on_surface;
    std::uint64_t refused = 0;
    ShapeId* shapes = nullptr;
    std::int64_t* materials = nullptr;
    bool* on = nullptr;
    ask_points(
        tracer, points,
        [&](const Axes& axes) {
            shape_id = py::array_t<ShapeId>(axes);
            material = py::array_t<std::int64_t>(axes);
            on_surface = py::array_t<bool>(axes);
            shapes = shape_id.mutable_data();
            materials = material.mutable_data();
            on = on_surface.mutable_data();
        },
        [&](const Tracer& asked, const auto& point_columns, std::size_t from, std::size_t to) {
            const std::size_t count = to - from;
            std::vector<MaterialIndex> material_rows(count);
            std::vector<std::uint8_t> flags(count);
            QueryStatistics statistics;
            asked.cells(point_columns, {std::span(shapes + from, count), material_rows, flags},
                        &statistics);
            refused += statistics.refused;
            for (std::size_t i = 0; i < count; ++i) {
                materials[from + i] =
                    material_rows[i] == no_material ? -1 : std::int64_t{material_rows[i]};
                on[from + i] = flags[i] != 0;
            }
        });
    py::dict result;
    result["shape_id"] = shape_id;
    result["material"] = material;
    result["on_surface"] = on_surface;
    result["refused"] = refused;
    return result;
}

py::dict closest(const SharedTracer& tracer, const py::object& points,
                 const py::object& max_distance) {
    const py::array limits = any_array(max_distance, "max_distance");
    py::array_t<double> distance, point;
    py::array_t<ShapeId> shape_id;
    py::array_t<std::uint8_t> face;
    Values<double> limit;
    Room<double> room;
    ClosestSpan closest;
    std::uint64_t refused = 0;
    ask_points(
        tracer, points,
        [&](Axes& axes) {
            broadcast(axes, limits, {}, "max_distance");
            const std::size_t count = count_of(axes);
            limit = {flattened(limits, {}, axes), count, "max_distance"};
            distance = py::array_t<double>(axes);
            point = py::array_t<double>(joined({3}, axes));
            shape_id = py::array_t<ShapeId>(axes);
            face = py::array_t<std::uint8_t>(axes);
            double* const to = point.mutable_data();
            closest = {{distance.mutable_data(), count},
                       {to, count},
                       {to + count, count},
                       {to + 2 * count, count},
                       {shape_id.mutable_data(), count},
                       {face.mutable_data(), count}};
        },
        [&](const Tracer& asked, const auto& point_columns, std::size_t from, std::size_t to) {
            const auto part = [&](auto span) { return span.subspan(from, to - from); };
            QueryStatistics statistics;
            asked.closest(point_columns,
                          {part(closest.distance), part(closest.point_x), part(closest.point_y),
                           part(closest.point_z), part(closest.shape_id), part(closest.face)},
                          limit.column().part(from, to, room), &statistics);
            refused += statistics.refused;
        });
    py::dict result;
    result["distance"] = distance;
    result["point"] = point;
    result["shape_id"] = shape_id;
    result["face"] = face;
    result["refused"] = refused;
    return result;
}

} // namespace

void bind_tracer(py::module_& module) {
    py::class_<SharedTracer>(module, "Tracer")
        .def(py::init(
            [](const Scene& scene, const py::object& threads, const py::object& precision) {
                const TracerOptions options{.threads = threads_from(threads),
                                            .precision = precision_from(precision)};
                const py::gil_scoped_release free;
                return std::make_unique<SharedTracer>(scene, options);
            }))
        .def_static("reads_in_place", &reads_in_place)
        .def_static("are_floats", &are_floats)
        .def_static("shape_of", &shape_of)
        .def("intersect", &intersect)
        .def("occluded", &occluded)
        .def("crossings", &crossings)
        .def("count_crossings", &count_crossings)
        .def("path_lengths", &path_lengths)
        .def("solid_lengths", &solid_lengths)
        .def("contains", &contains)
        .def("cells", &cells)
        .def("closest", &closest);
}

} // namespace raylane::python
