#include "bench/peers/contender.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>

/// Rays per second by raylane and by Embree, in turn, on the same rays. See run.sh.

namespace {

using namespace raylane;
using namespace raylane::bench;
using Json = nlohmann::ordered_json;

double seconds_of(const auto& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// All contenders on one set, alternating; the first round warms up. The first contender is
/// raylane.
Json measure(const RaySet& rays, std::vector<std::unique_ptr<Contender>>& contenders,
             int repetitions) {
    std::vector<std::vector<double>> seconds(contenders.size());
    std::vector<std::uint32_t> right;
    Json json = {{"rays", rays.name}, {"count", rays.count}};
    std::printf("  %-10s", rays.name.c_str());
    double own = 0.0, best = 0.0;
    for (auto& contender : contenders)
        contender->prepare(rays);
    for (int round = 0; round <= repetitions; ++round)
        for (std::size_t who = 0; who < contenders.size(); ++who) {
            const double time = seconds_of([&] { contenders[who]->run(); });
            if (round != 0) seconds[who].push_back(time);
        }
    for (std::size_t who = 0; who < contenders.size(); ++who) {
        const std::vector<std::uint32_t> answers = contenders[who]->answers();
        if (who == 0) right = answers;
        std::size_t different = 0;
        for (std::size_t i = 0; i < answers.size(); ++i)
            different += static_cast<std::size_t>(answers[i] != right[i]);
        const double speed = static_cast<double>(rays.count) / median(seconds[who]) / 1e6;
        const auto [least, most] = std::minmax_element(seconds[who].begin(), seconds[who].end());
        (who == 0 ? own : best) = std::max(who == 0 ? own : best, speed);
        std::printf("  %s %.2f", contenders[who]->name().c_str(), speed);
        if (who != 0 && different != 0)
            std::printf(" (%.2g wrong)",
                        static_cast<double>(different) / static_cast<double>(rays.count));
        json["by"].push_back({{"name", contenders[who]->name()},
                              {"mrays_per_second", speed},
                              {"least", static_cast<double>(rays.count) / *most / 1e6},
                              {"most", static_cast<double>(rays.count) / *least / 1e6},
                              {"different", different}});
    }
    if (best > 0.0) {
        std::printf("  ratio %.2f", own / best);
        json["ratio"] = own / best;
    }
    std::printf("\n");
    std::fflush(stdout);
    return json;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Rays per second by raylane and by Embree on the same scenes and rays");
    std::vector<std::string> names = {"spheres/10000"}, wanted;
    std::string isa_name, output;
    int repetitions = 5, side = 1024;
    app.add_option("SCENE", names, "spheres/N, sticks/N, or a file");
    app.add_option("--rays", wanted, "camera, mirror, shadow, incoherent, occlusion (all)");
    app.add_option("--isa", isa_name, "sse4.2, avx2 or avx512 (the best there is)");
    app.add_option("--repetitions", repetitions)->check(CLI::Range(1, 1000));
    app.add_option("--size", side, "of the camera's picture, in pixels")
        ->check(CLI::Range(1, 8192));
    app.add_option("--json", output, "where all figures go");
    CLI11_PARSE(app, argc, argv);

    std::optional<simd::Isa> isa = simd::best_isa();
    for (const simd::Isa each : simd::all_isas)
        if (name_of(each) == isa_name) isa = each;
    if (!isa || !simd::is_available(*isa)) {
        std::fprintf(stderr, "raylane-peers: this processor has no such instructions\n");
        return 2;
    }
    Json json = {{"isa", name_of(*isa)}, {"scenes", Json::array()}};
    try {
        for (const std::string& name : names) {
            const core::Scene scene = make_workload(name);
            const simd::SceneData data(scene);
            std::vector<std::unique_ptr<Contender>> contenders;
            contenders.push_back(make_own(data, *isa));
            for (auto& peer : make_embree(scene, *isa))
                contenders.push_back(std::move(peer));
            std::printf("%s: %zu shapes, %.1f MB, %s; million rays per second, one thread\n",
                        name.c_str(), scene.shape_count(), static_cast<double>(scene.bytes()) / 1e6,
                        std::string(name_of(*isa)).c_str());
            Json results = {
                {"scene", name}, {"shapes", scene.shape_count()}, {"bytes", scene.bytes()}};
            for (const RaySet& rays : make_ray_sets(scene, data, side)) {
                if (!wanted.empty() &&
                    std::find(wanted.begin(), wanted.end(), rays.name) == wanted.end())
                    continue;
                results["sets"].push_back(measure(rays, contenders, repetitions));
            }
            json["scenes"].push_back(std::move(results));
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "raylane-peers: %s\n", error.what());
        return 2;
    }
    if (!output.empty()) std::ofstream(output) << json.dump(2) << "\n";
    return 0;
}
