#include "bench/peers/measure.hpp"
#include "bench/peers/workload.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <new>

/// Measures raylane and Embree, in turn, with the same scenes and rays. See run.sh.

namespace {

using namespace raylane;
using namespace raylane::bench;
using Json = nlohmann::ordered_json;

struct Arguments {
    std::vector<std::string> scenes = {"spheres/10000"};
    std::vector<std::string> wanted{std::begin(ray_set_names), std::end(ray_set_names)};
    std::string isa, json;
    int threads = 1, repetitions = 5, side = 1024, call = 8192;
};

class Unwritable : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Parses the command line. Throws CLI11's exceptions.
Arguments parse(CLI::App& app, int argc, char** argv) {
    Arguments arguments;
    std::vector<std::string> sets = arguments.wanted, isas;
    sets.insert(sets.end(), {"crossings", "build", "picture"});
    for (const simd::Isa isa : simd::available_isas())
        isas.emplace_back(name_of(isa));
    app.add_option("SCENE", arguments.scenes,
                   "Scenes: spheres/N, sticks/N, or a file. Default: spheres/10000.");
    app.add_option("--rays", arguments.wanted,
                   "Sets of rays or other measurements. crossings: all crossings of each ray, in "
                   "order, on one thread. build: the hierarchy, on one thread. picture: a whole "
                   "image, also with Embree's traversal. Default: all sets of rays.")
        ->check(CLI::IsMember(sets));
    app.add_option("--isa", arguments.isa,
                   "Instruction set of raylane and Embree. Default: the widest available.")
        ->check(CLI::IsMember(isas));
    app.add_option("--threads", arguments.threads,
                   "Number of threads. With several, also measures the gain over one. Default: 1.")
        ->check(CLI::Range(1, 1024));
    app.add_option("--repetitions", arguments.repetitions,
                   "Number of runs, of which the median counts. Default: 5.")
        ->check(CLI::Range(1, 1000));
    app.add_option("--size", arguments.side, "Side of square images, in pixels. Default: 1024.")
        ->check(CLI::Range(1, 8192));
    app.add_option("--call", arguments.call,
                   "Rays in each call of the library. Embree's calls with more rays are left out. "
                   "Default: 8192.")
        ->check(CLI::Range(1, 8192));
    app.add_option("--json", arguments.json, "File to which all figures are written.");
    app.parse(argc, argv);
    return arguments;
}

void measure(const std::string& name, const std::vector<std::string>& wanted, const Measuring& how,
             const std::function<void(const Row&)>& report) {
    const core::Scene scene = make_workload(name, how.isa);
    const simd::SceneData data(scene);
    std::printf("%s: %zu shapes, %.1f MB, %s, %d thread%s; million rays per second\n", name.c_str(),
                scene.shape_count(), static_cast<double>(scene.bytes()) / 1e6,
                std::string(name_of(how.isa)).c_str(), how.threads, how.threads == 1 ? "" : "s");
    measure_rays(data, wanted, how, report);
    const auto wants = [&](const char* what) {
        return std::find(wanted.begin(), wanted.end(), what) != wanted.end();
    };
    if (wants("crossings")) report(measure_crossings(data, how));
    if (wants("build")) report(measure_building(scene, how));
    if (wants("picture")) report(measure_image(data, how));
}

/// Measures all scenes. Returns true if all of raylane's answers are right.
bool measure_all(const Arguments& arguments, simd::Isa isa) {
    const char* const embree = embree_version();
    std::printf("Embree %s\n", embree != nullptr ? embree : "is missing in this build, left out");
    Json rows = Json::array();
    bool right = true;
    for (const std::string& name : arguments.scenes)
        measure(name, arguments.wanted,
                {isa, arguments.threads, arguments.repetitions, arguments.side, arguments.call},
                [&](const Row& row) {
                    row.print();
                    right = right && row.by[0].wrong.value_or(0) == 0;
                    Json json = {{"scene", name}};
                    json.update(row.json());
                    json.update({{"isa", name_of(isa)},
                                 {"threads", arguments.threads},
                                 {"call", arguments.call}});
                    rows.push_back(std::move(json));
                });
    if (!arguments.json.empty()) {
        std::ofstream file(arguments.json);
        file << Json{{"embree", embree != nullptr ? Json(embree) : Json()}, {"rows", rows}}.dump(2)
             << std::endl;
        if (!file) throw Unwritable(arguments.json + ": cannot be written");
    }
    return right;
}

int fail(int code, const char* message) {
    std::fprintf(stderr, "raylane-peers: %s\n", message);
    return code;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Times raylane and Embree, in turn, on the same scenes and rays. Exit code 1: "
                 "raylane gave a wrong answer.");
    try {
        const Arguments arguments = parse(app, argc, argv);
        simd::Isa isa = simd::best_isa();
        for (const simd::Isa each : simd::all_isas)
            if (name_of(each) == arguments.isa) isa = each;
        return measure_all(arguments, isa) ? 0 : 1;
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        return fail(2, error.what());
    } catch (const Unwritable& error) {
        return fail(3, error.what());
    } catch (const std::bad_alloc&) {
        return fail(3, "out of memory");
    } catch (const std::exception& error) {
        return fail(2, error.what());
    }
}
