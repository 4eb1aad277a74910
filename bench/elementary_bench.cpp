#include "bench/elementary_unit.hpp"
#include "core/numbers/elementary.hpp"
#include "simd/isa/by_isa.hpp"
#include "simd/isa/isa.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

/// Measures each elementary function: its speed in numbers per second, and its error in ulps of
/// double against the C library in long double. Measures the C library in double in the same run.

namespace {

using namespace raylane;
using Function = bench::ElementaryUnit::Function;

constexpr int count = 1024;

struct Case {
    std::string name;
    Function bench::ElementaryUnit::*unit;
    double (*ours)(double, double);
    double (*library)(double, double);
    long double (*truth)(long double, long double);
    double low, high; ///< of x
};

struct Numbers {
    std::vector<double> x, y, out = std::vector<double>(count);

    explicit Numbers(const Case& c) {
        std::mt19937_64 engine(1);
        const auto uniform = [&](double low, double high) {
            return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1p-53);
        };
        for (int i = 0; i < count; ++i) {
            x.push_back(uniform(c.low, c.high));
            y.push_back(std::exp(uniform(0.0, 6.0)));
        }
    }
};

void report(benchmark::State& state, const Case& c, const Numbers& numbers) {
    std::vector<double> ulps;
    for (std::size_t i = 0; i < count; ++i) {
        const long double truth =
            c.truth(static_cast<long double>(numbers.x[i]), static_cast<long double>(numbers.y[i]));
        if (std::abs(static_cast<double>(truth)) < 0x1p-1000) continue;
        const long double ulp = std::ldexp(1.0L, std::ilogb(truth) - 52);
        ulps.push_back(
            static_cast<double>(std::abs(static_cast<long double>(numbers.out[i]) - truth) / ulp));
    }
    std::sort(ulps.begin(), ulps.end());
    state.SetItemsProcessed(state.iterations() * count);
    state.counters["ulp_median"] = ulps[ulps.size() / 2];
    state.counters["ulp_p99"] = ulps[ulps.size() * 99 / 100];
    state.counters["ulp_max"] = ulps.back();
}

void one_by_one(benchmark::State& state, const Case& c, double (*function)(double, double)) {
    Numbers numbers(c);
    for (auto _ : state) {
        for (std::size_t i = 0; i < count; ++i)
            numbers.out[i] = function(numbers.x[i], numbers.y[i]);
        benchmark::ClobberMemory();
    }
    report(state, c, numbers);
}

void in_registers(benchmark::State& state, const Case& c, Function function) {
    Numbers numbers(c);
    for (auto _ : state) {
        function(numbers.x.data(), numbers.y.data(), numbers.out.data(), count);
        benchmark::ClobberMemory();
    }
    report(state, c, numbers);
}

bench::ElementaryUnit unit_of(simd::Isa isa) {
    return simd::of_isa(isa, []<simd::Isa which>() { return bench::elementary<which>(); });
}

void add(const Case& c) {
    const std::string name = "elementary/" + c.name;
    benchmark::RegisterBenchmark((name + "/library").c_str(),
                                 [c](benchmark::State& state) { one_by_one(state, c, c.library); });
    benchmark::RegisterBenchmark((name + "/scalar").c_str(),
                                 [c](benchmark::State& state) { one_by_one(state, c, c.ours); });
    for (const simd::Isa isa : simd::available_isas()) {
        const Function function = unit_of(isa).*c.unit;
        benchmark::RegisterBenchmark(
            (name + "/" + simd::kernels_of(isa).name).c_str(),
            [c, function](benchmark::State& state) { in_registers(state, c, function); });
    }
}

const bool registered = [] {
    using Unit = bench::ElementaryUnit;
    using Long = long double;
    add({"exp", &Unit::exp, [](double x, double) { return core::exp(x); },
         [](double x, double) { return std::exp(x); }, [](Long x, Long) { return std::exp(x); },
         -30.0, 0.0});
    add({"expm1", &Unit::expm1, [](double x, double) { return core::expm1(x); },
         [](double x, double) { return std::expm1(x); }, [](Long x, Long) { return std::expm1(x); },
         -3.0, 0.0});
    add({"pow", &Unit::pow, [](double x, double y) { return core::pow(x, y); },
         [](double x, double y) { return std::pow(x, y); },
         [](Long x, Long y) { return std::pow(x, y); }, 0.0, 1.0});
    add({"sin", &Unit::sin, [](double x, double) { return core::sin(x); },
         [](double x, double) { return std::sin(x); }, [](Long x, Long) { return std::sin(x); },
         -100.0, 100.0});
    add({"atan", &Unit::atan, [](double x, double) { return core::atan(x); },
         [](double x, double) { return std::atan(x); }, [](Long x, Long) { return std::atan(x); },
         -10.0, 10.0});
    return true;
}();

} // namespace
