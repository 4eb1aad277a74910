#include "scenes/tool/options/sequence_options.hpp"

#include "scenes/json/parameters.hpp"
#include "scenes/number.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace raylane::scenes {

namespace {

constexpr int most_images = 1'000'000;

std::optional<double> to_double(std::string_view word) {
    if (!is_number(word)) return std::nullopt;
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || !(std::abs(value) <= 1e30)) return std::nullopt;
    return value;
}

std::optional<FrameRange> frame_range_of(const std::string& text) {
    const std::vector<std::string_view> parts = parts_of(text, ':');
    std::optional<long> numbers[3];
    if (parts.size() > 3) return std::nullopt;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].empty()) continue;
        const std::optional<int> number = to_int(parts[i]);
        if (!number) return std::nullopt;
        numbers[i] = *number;
    }
    const FrameRange range{numbers[0], numbers[1], numbers[2].value_or(1), parts.size() == 1};
    if (range.step < 1 || (range.is_one && !range.start)) return std::nullopt;
    return range;
}

std::optional<ParameterSweep> parameter_sweep_of(const std::string& text) {
    const std::size_t equals = text.find('=');
    ParameterSweep sweep{text.substr(0, equals), {}, false};
    if (equals == std::string::npos || !is_parameter_name(sweep.name)) return std::nullopt;
    const std::vector<std::string_view> parts =
        parts_of(std::string_view(text).substr(equals + 1), ':');
    const std::optional<double> first = to_double(parts[0]);
    if (!first || (parts.size() != 1 && parts.size() != 3)) return std::nullopt;
    sweep.values = {*first};
    if (parts.size() == 1) return sweep;
    sweep.is_sweep = true;
    const std::optional<double> last = to_double(parts[1]);
    const std::optional<int> count = to_int(parts[2]);
    if (!last || !count || *count < 1 || *count > most_images) return std::nullopt;
    // The division comes last, so that whole numbers stay whole.
    for (int i = 1; i + 1 < *count; ++i)
        sweep.values.push_back(*first + i * (*last - *first) / (*count - 1));
    if (*count > 1) sweep.values.push_back(*last);
    return sweep;
}

} // namespace

FrameRange FrameRange::of(long count) const {
    const auto place = [&](std::optional<long> at) -> std::optional<long> {
        if (!at || *at >= 0) return at;
        return std::max(0L, *at + count);
    };
    FrameRange range{place(start), place(stop), step, is_one};
    // A single frame before the first one does not exist.
    if (is_one && *start < -count) range.start = std::numeric_limits<long>::max();
    return range;
}

Values<FrameRange> frame_ranges() {
    return {"WHICH", "", [](const std::string& option, const std::string& text) {
                const std::optional<FrameRange> range = frame_range_of(text);
                if (!range)
                    refuse(option,
                           "a number or START:STOP:STEP, such as 0:100:2, with a step from 1",
                           text);
                return *range;
            }};
}

Values<Turn> turns() {
    return {"DEGREES/IMAGES", "", [](const std::string& option, const std::string& text) {
                const std::vector<std::string_view> parts = parts_of(text, '/');
                const std::optional<float> degrees = to_float(parts[0]);
                const int count = parts.size() == 2 ? to_int(parts[1]).value_or(0) : 0;
                if (!degrees || count < 1 || count > most_images)
                    refuse(option, "DEGREES/IMAGES, such as 360/120", text);
                return Turn{static_cast<double>(*degrees), static_cast<std::size_t>(count)};
            }};
}

Values<ParameterSweep> parameter_values(bool sweeps) {
    return {"NAME=VALUE", "", [=](const std::string& option, const std::string& text) {
                const std::optional<ParameterSweep> sweep = parameter_sweep_of(text);
                if (!sweep)
                    refuse(option, "NAME=NUMBER, or NAME=FIRST:LAST:COUNT for a sequence", text);
                if (sweep->values.size() > 1 && !sweeps)
                    refuse(option, "NAME=NUMBER for this command", text);
                return *sweep;
            }};
}

ParameterArguments::ParameterArguments(OptionTable& whole, bool sweeps)
    : OptionTable(whole, group_of_several),
      set(*this, "--set", parameter_values(sweeps).recorded(),
          sweeps ? "Value of \"$NAME\" in a JSON scene: a number, or FIRST:LAST:COUNT for "
                   "a sequence of COUNT images. Several of these advance together."
                 : "Value of \"$NAME\" in a JSON scene, a number.") {}

std::vector<std::map<std::string, double>> ParameterArguments::values() const {
    std::vector<std::map<std::string, double>> images(1);
    for (const ParameterSweep& sweep : *set) {
        if (images.front().contains(sweep.name))
            throw BadInput("--set", "", "must set \"" + printable(sweep.name) + "\" only once");
        const std::size_t count = sweep.values.size();
        if (count > 1 && images.size() > 1 && count != images.size())
            throw BadInput("--set", "",
                           "must have the same number of values in all sweeps, got " +
                               std::to_string(images.size()) + " and " + std::to_string(count));
        if (count > 1) images.resize(count, images.front());
        for (std::size_t i = 0; i < images.size(); ++i)
            images[i][sweep.name] = sweep.values[count == 1 ? 0 : i];
    }
    return images;
}

bool ParameterArguments::has_sweep() const {
    return std::any_of((*set).begin(), (*set).end(),
                       [](const ParameterSweep& sweep) { return sweep.is_sweep; });
}

} // namespace raylane::scenes
