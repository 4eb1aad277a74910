#include "bench/peers/measure.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

namespace raylane::bench {

namespace {

bool is_of_library(const Result& result) {
    return result.name.starts_with("library");
}
bool is_own(const Result& result) {
    return result.name.starts_with("raylane") || is_of_library(result);
}

double median_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

} // namespace

double seconds_of(const std::function<void()>& run) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    run();
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<Result> alternate(const std::vector<TimedRun>& runs, const Measuring& how) {
    std::vector<std::vector<double>> seconds(runs.size()), alone(runs.size());
    for (int round = 0; round <= how.repetitions; ++round)
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const double time = runs[i].seconds(how.threads);
            const double time_alone = how.threads > 1 ? runs[i].seconds(1) : time;
            if (round == 0) continue;
            seconds[i].push_back(time);
            alone[i].push_back(time_alone);
        }
    std::vector<Result> results;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const auto [least, most] = std::minmax_element(seconds[i].begin(), seconds[i].end());
        Result& result = results.emplace_back(
            Result{runs[i].name, median_of(seconds[i]), *least, *most, {}, {}});
        if (how.threads > 1) result.alone = median_of(alone[i]);
    }
    return results;
}

std::optional<double> Row::ratio() const {
    std::optional<double> best;
    for (const Result& result : by)
        if (!is_own(result) &&
            (!best || (is_speed ? result.median > *best : result.median < *best)))
            best = result.median;
    if (!best) return std::nullopt;
    const double own = users().median;
    return is_speed ? own / *best : *best / own;
}

void Result::in_millions_per_second(std::size_t count) {
    const auto speed = [&](double seconds) { return static_cast<double>(count) / seconds / 1e6; };
    median = speed(median);
    least = std::exchange(most, speed(least));
    least = speed(least);
    if (alone) alone = speed(*alone);
}

const Result& Row::users() const {
    const auto found = std::find_if(by.begin(), by.end(), is_of_library);
    return found != by.end() ? *found : by[0];
}

nlohmann::ordered_json Row::json() const {
    nlohmann::ordered_json json = {
        {"what", what}, {"count", count}, {"unit", is_speed ? "Mrays/s" : "s"}};
    for (const Result& result : by) {
        json["by"].push_back({{"name", result.name},
                              {"median", result.median},
                              {"least", result.least},
                              {"most", result.most}});
        if (result.wrong) json["by"].back()["wrong"] = *result.wrong;
        if (result.alone) json["by"].back()["alone"] = *result.alone;
    }
    if (const std::optional<double> times = ratio()) json["ratio"] = *times;
    json["own"] = users().name;
    return json;
}

void Row::print() const {
    std::printf("  %-10s", what.c_str());
    for (const Result& result : by) {
        std::printf(is_speed ? "  %s %.2f" : "  %s %.4f s", result.name.c_str(), result.median);
        if (result.alone)
            std::printf(" (%.2f times one thread)",
                        is_speed ? result.median / *result.alone : *result.alone / result.median);
        if (result.wrong.value_or(0) != 0) std::printf(" (%zu wrong)", *result.wrong);
    }
    if (const std::optional<double> times = ratio()) std::printf("  ratio %.2f", *times);
    std::printf("\n");
    std::fflush(stdout);
}

} // namespace raylane::bench
