#include "core/scene/formula.hpp"
#include "simd/isa/by_isa.hpp"
#include "simd/isa/isa.hpp"
#include "tests/simd/kernel/shade/formulas_check.hpp"
#include "tests/support/catch.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace raylane;
using namespace raylane::simd;

namespace {

constexpr std::size_t count = 4096;

/// Returns numbers of both signs and of all sizes, whole numbers, and special ones.
std::vector<double> numbers(std::mt19937_64& engine) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double special[] = {0.0,          -0.0,      1.0,    -1.0,   0.5,    infinity, -infinity,
                              std::nan(""), 0x1p-1074, 1e308,  -2e20,  3e9,    0x1p51,   0x1p52,
                              -0x1p51,      709.8,     -745.2, 1e-300, 0x1p20, -7.0};
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
        const double uniform = static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0;
        const double numbers[] = {special[engine() % std::size(special)], 8.0 * uniform,
                                  std::floor(40.0 * uniform),
                                  std::ldexp(uniform, static_cast<int>(engine() % 120) - 60)};
        values.push_back(numbers[engine() % 8 == 0 ? 0 : 1 + engine() % 3]);
    }
    return values;
}

/// Returns a random expression.
std::string expression(std::mt19937_64& engine, int depth) {
    const auto one_of = [&](const std::vector<std::string>& names) {
        return names[engine() % names.size()];
    };
    if (depth == 0) return one_of({"x", "y", "z", "u", "v", "2", "0.5", "0", "150", "pi"});
    const auto part = [&] { return expression(engine, depth - 1); };
    switch (engine() % 5) {
    case 0:
        return "(" + part() + one_of({" + ", " - ", " * ", " / ", " ^ "}) + part() + ")";
    case 1:
        return one_of({"abs(", "floor(", "sqrt(", "sin(", "cos(", "exp(", "log("}) + part() + ")";
    case 2:
        return one_of({"min(", "max(", "mod("}) + part() + ", " + part() + ")";
    case 3:
        return "(" + part() + one_of({" < ", " <= ", " > ", " >= ", " == ", " != "}) + part() +
               " ? " + part() + " : " + part() + ")";
    default:
        return "noise(" + part() + ", " + part() + ", " + part() + ")";
    }
}

int differing(const core::FormulaProgram& program, const std::vector<double> (&inputs)[5],
              const std::vector<double> (&channels)[3]) {
    int differ = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const core::Vec3d expected = core::color_of(
            program, {inputs[0][i], inputs[1][i], inputs[2][i]}, {inputs[3][i], inputs[4][i]});
        for (int channel = 0; channel < 3; ++channel)
            differ += std::bit_cast<std::uint64_t>(channels[channel][i]) ==
                              std::bit_cast<std::uint64_t>(expected[channel])
                          ? 0
                          : 1;
    }
    return differ;
}

} // namespace

TEST_CASE("formulas have the same bits in every lane as in scalars") {
    std::mt19937_64 engine(1);
    std::vector<double> inputs[5], channels[3];
    for (std::vector<double>& input : inputs)
        input = numbers(engine);
    for (std::vector<double>& channel : channels)
        channel.resize(count);
    std::vector<core::FormulaTexts> triples = {
        {"x + y", "x - y", "x * y"},
        {"x / y", "x ^ y", "mod(x, y)"},
        {"min(x, y)", "max(x, y)", "abs(x)"},
        {"floor(x)", "sqrt(x)", "sin(x)"},
        {"cos(x)", "exp(x)", "log(x)"},
        {"noise(x, y, z)", "noise(u, v, x)", "noise(y, y, y)"},
        {"x < y", "x <= y", "x == y"},
        {"x != y", "x ? y : z", "x > y ? 1 : z >= y"}};
    for (int i = 0; i < 150; ++i)
        triples.push_back({expression(engine, 3), expression(engine, 3), expression(engine, 2)});
    int compiled = 0;
    for (const core::FormulaTexts& texts : triples) {
        const core::Formula formula(texts);
        if (formula.mistake()) continue; // too many operations
        ++compiled;
        INFO(texts[0] << "\n" << texts[1] << "\n" << texts[2]);
        for (const Isa isa : available_isas()) {
            CAPTURE(name_of(isa));
            of_isa(isa, []<Isa which>() { return &formulas<which>; })(
                {&formula.program(),
                 {inputs[0].data(), inputs[1].data(), inputs[2].data(), inputs[3].data(),
                  inputs[4].data()},
                 {channels[0].data(), channels[1].data(), channels[2].data()},
                 count});
            CHECK(differing(formula.program(), inputs, channels) == 0);
        }
    }
    CHECK(compiled > 130);
}
