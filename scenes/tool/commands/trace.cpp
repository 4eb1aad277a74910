#include "scenes/tool/checkpoint/fingerprint.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/loading.hpp"
#include "scenes/tool/options/option.hpp"
#include "scenes/tool/options/scene_options.hpp"
#include "scenes/tool/progress_bar.hpp"
#include "scenes/tool/ranks/job.hpp"
#include "scenes/tool/ranks/shared_work.hpp"
#include "scenes/tool/trace/ray_file.hpp"
#include "simd/stream/stream_tracer.hpp"
#include "simd/threads/threads.hpp"
#include "simd/wavefront/render.hpp"

#include <algorithm>
#include <atomic>
#include <memory>

namespace raylane::scenes {

namespace {

struct TraceArguments : OptionTable {
    Option<std::string> scene = {*this, "SCENE", file_argument(), any_scene};
    Option<std::string> rays = {
        *this, "RAYS", file_argument(),
        "Rays, a NumPy file (.npy) of float32 or float64. Shape (n, 6): origins and "
        "directions; (n, 8): t_min and t_max as well. - is standard input, which must be "
        "a regular file."};
    Option<std::string> output = {
        *this, "-o,--output", file_name().otherwise("RAYS-hits.npy"),
        "Hits, a NumPy file with a record per ray: t, normal, shape, entering and face."};
    Flag occluded = {*this, "--occluded", flag(),
                     "Write only whether each ray hits a shape, a bool per ray."};
    Option<core::Precision> precision = {*this, "--precision",
                                         precisions().initially(core::Precision::exact),
                                         "Arithmetic of intersections, same as in render."};
    ThreadsOption threads{*this};
    SceneArguments scene_arguments{*this};
};

/// Answers the rays of a file, piece by piece.
class Answers {
  public:
    static constexpr std::size_t piece_rays = std::size_t{1} << 16;

    Answers(const core::Scene& scene, const RayFile& rays, core::Precision precision, bool occluded)
        : rays_(rays), occluded_(occluded), tracer_(scene, 1, simd::best_isa(), precision) {}

    std::size_t pieces() const { return (rays_.count() + piece_rays - 1) / piece_rays; }
    std::size_t count_in(std::size_t piece) const {
        return std::min<std::uint64_t>(piece_rays, rays_.count() - piece * piece_rays);
    }
    /// Returns the type of an element of the output, for npy_head().
    std::string type() const {
        if (occluded_) return "'|b1'";
        return std::string("[('t', '") + (rays_.has_doubles() ? "<f8" : "<f4") +
               "'), ('normal', '<f4', (3,)), ('shape', '<u4'), ('entering', '|u1'), "
               "('face', '|u1')]";
    }
    /// Returns the elements of a piece. Thread-safe.
    std::string of(std::size_t piece) const {
        return rays_.has_doubles() ? of_numbers<double>(piece) : of_numbers<float>(piece);
    }

  private:
    template <class Real>
    std::string of_numbers(std::size_t piece) const {
        const std::size_t count = count_in(piece);
        std::vector<Real> numbers;
        rays_.read(piece * piece_rays, count, numbers);
        const auto column = [&](std::size_t k) { return numbers.data() + k * count; };
        simd::RayStream<Real> stream;
        stream.count = count;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            stream.origin[axis] = column(axis);
            stream.direction[axis] = column(3 + axis);
        }
        if (rays_.columns() == 8) {
            stream.t_min = column(6);
            stream.t_max = column(7);
        }
        if (occluded_) {
            std::string bytes(count, '\0');
            tracer_.occluded(stream, reinterpret_cast<std::uint8_t*>(bytes.data()));
            return bytes;
        }
        std::vector<Real> t(count);
        std::vector<float> normal[3];
        std::vector<core::ShapeId> shape(count);
        std::vector<std::uint8_t> entering(count), face(count);
        simd::HitStream hits;
        if constexpr (sizeof(Real) == sizeof(double))
            hits.t_double = t.data();
        else
            hits.t = t.data();
        for (int axis = 0; axis < 3; ++axis) {
            normal[axis].resize(count);
            hits.normal[axis] = normal[axis].data();
        }
        hits.shape = shape.data();
        hits.entering = entering.data();
        hits.face = face.data();
        tracer_.nearest(stream, hits);
        std::string bytes;
        bytes.reserve(count * (sizeof(Real) + 3 * sizeof(float) + sizeof(core::ShapeId) + 2));
        const auto append = [&](const auto& value) {
            bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        };
        for (std::size_t i = 0; i < count; ++i) {
            append(t[i]);
            for (const auto& component : normal)
                append(component[i]);
            append(shape[i]);
            append(entering[i]);
            append(face[i]);
        }
        return bytes;
    }

    const RayFile& rays_;
    bool occluded_;
    simd::StreamTracer tracer_;
};

/// Returns how many pieces may be begun ahead of the next one to write.
std::size_t window_for(const Job& job, int threads) {
    return 4 * static_cast<std::size_t>(threads) * static_cast<std::size_t>(job.size());
}

/// Answers all pieces with `threads` threads here and with the other ranks. `output` receives the
/// answers; it is null except at rank 0. `progress` counts rays both as rays and as pixels.
void answer_all(const Answers& answers, Job& job, int threads, simd::Progress& progress,
                OrderedOutput* output) {
    std::atomic<bool> stop = false;
    std::optional<SharedWork> shared;
    if (job.ranks() != nullptr)
        shared.emplace(*job.ranks(), answers.pieces(), threads, stop, window_for(job, threads));
    std::atomic<std::size_t> taken = 0;
    const auto next = [&]() -> std::optional<SharedWork::Piece> {
        if (stop) return std::nullopt;
        if (shared) return shared->next();
        const std::size_t number = taken++;
        if (number >= answers.pieces() || !output->wait_for(number)) return std::nullopt;
        return SharedWork::Piece{number, false, {}};
    };
    const auto answer_some = [&](std::size_t) {
        try {
            while (std::optional<SharedWork::Piece> piece = next()) {
                const std::size_t number = piece->number;
                if (!piece->is_done) piece->bytes = answers.of(number);
                progress.rays += answers.count_in(number);
                progress.pixels += static_cast<std::int64_t>(answers.count_in(number));
                if (output == nullptr) {
                    shared->done(number, piece->bytes);
                    continue;
                }
                const std::size_t next_to_write = output->add(number, std::move(piece->bytes));
                if (shared) shared->written(next_to_write);
            }
        } catch (...) {
            stop = true;
            if (shared) shared->cancel();
            if (output != nullptr) output->cancel();
            throw;
        }
    };
    simd::on_threads(threads,
                     [&] { simd::parallel_for(static_cast<std::size_t>(threads), answer_some); });
    if (shared) shared->finish();
}

int trace(const TraceArguments& arguments) {
    int threads = arguments.threads.count();
    const LoadOptions load_options = arguments.scene_arguments.load_options();
    const std::string &scene_file = *arguments.scene, &ray_file = *arguments.rays;
    const std::string output = arguments.output.value_or(default_output(ray_file, "-hits.npy"));
    require_other_than_scene("--output", output, scene_file);
    require_other_file("--output", output, "RAYS", ray_file);
    if (ray_file == "-" && scene_file == "-")
        throw BadInput("RAYS", "", "must be another file than SCENE, got \"-\"");
    const Verbosity asked = arguments.scene_arguments.verbosity.verbosity();

    Job job;
    const Verbosity verbosity = job.is_first() ? asked : Verbosity::quiet;
    const int threads_to_load = threads;
    if (!arguments.threads) threads = job.share_of_threads(threads);
    std::optional<RayFile> rays;
    std::optional<AtomicFile> file;
    std::optional<core::Scene> scene;
    std::optional<Answers> answers;
    std::string fingerprint;
    if (ray_file == "-") job.share_standard_input();
    job.together([&] {
        rays.emplace(ray_file);
        if (job.is_first()) file.emplace(output);
    });
    scene = load_together(job, scene_file, threads_to_load, [&](int with) {
        return load_with_progress(scene_file, load_options, verbosity, with);
    });
    job.together([&] {
        answers.emplace(*scene, *rays, *arguments.precision, arguments.occluded.is_given());
        fingerprint = fingerprint_of(*scene);
        if (file) file->write(npy_head(answers->type(), rays->count()));
    });
    job.require_same(fingerprint, "the scene");
    job.require_same(answers->type() + std::to_string(rays->count()), "the file of rays");

    std::optional<OrderedOutput> ordered;
    if (file) ordered.emplace(*file, window_for(job, threads));
    simd::Progress progress;
    const auto start = std::chrono::steady_clock::now();
    {
        const ProgressBar bar(verbosity, progress,
                              std::max<std::int64_t>(1, static_cast<std::int64_t>(rays->count())));
        answer_all(*answers, job, threads, progress, ordered ? &*ordered : nullptr);
    }
    job.part();
    if (!file) return 0;
    file->commit();
    if (verbosity == Verbosity::verbose || (verbosity == Verbosity::normal && is_terminal())) {
        const double seconds = seconds_since(start);
        std::fprintf(stderr, "%s: %s rays in %s, %srays/s\n", printable(output, 4096).c_str(),
                     std::to_string(rays->count()).c_str(), duration_text(seconds).c_str(),
                     with_prefix(static_cast<double>(rays->count()) / seconds).c_str());
    }
    return 0;
}

} // namespace

Command add_trace_command(CLI::App& app) {
    Command command = add_command<TraceArguments>(
        app,
        {.name = "trace",
         .help = "Intersect rays from a file with a scene",
         .example = "raylane trace scenes/birthday.json rays.npy -o hits.npy"},
        trace);
    command.by_ranks = true;
    return command;
}

} // namespace raylane::scenes
