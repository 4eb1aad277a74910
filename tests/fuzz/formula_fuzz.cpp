#include "core/scene/formula.hpp"

#include <cmath>
#include <cstdint>
#include <string_view>

/// Compiles any texts as a formula, separated by zero bytes. A formula has colours from 0 to 1e10
/// at any point, and its texts compile to the same program. Otherwise it has one mistake, with line
/// and column. Anything else is a finding.
using namespace raylane::core;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view text(reinterpret_cast<const char*>(data), size);
    FormulaTexts texts;
    for (std::string& channel : texts) {
        channel = text.substr(0, text.find('\0'));
        text.remove_prefix(std::min(text.size(), channel.size() + 1));
    }
    const auto parameter_of = [](int, std::string_view name) {
        return 0.5 - static_cast<double>(name.size());
    };
    const Formula formula(texts, parameter_of,
                          {size % 2 == 0 ? "-2 * (y + 0.5) + 1e-3 * (z - 1)" : "", "", ""});
    if (formula.mistake()) {
        if (!formula.mistake()->message.starts_with("line ")) __builtin_trap();
        return 0;
    }
    const Formula again(formula.texts());
    if (again.mistake() || !(again == formula)) __builtin_trap();
    for (const double x : {0.0, -1.5, 3.0, 1e-300, -1e300, HUGE_VAL, std::nan("")})
        for (const double y : {0.0, 2.0, -0.25, 1e20}) {
            const Vec3d color = color_of(formula.program(), {x, y, x - y}, {0.25, y});
            const Vec3d same = color_of(again.program(), {x, y, x - y}, {0.25, y});
            for (int i = 0; i < 3; ++i)
                if (!(color[i] >= 0.0 && color[i] <= 1e10) || color[i] != same[i]) __builtin_trap();
        }
    return 0;
}
