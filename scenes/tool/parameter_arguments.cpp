#include "scenes/tool/parameter_arguments.hpp"

#include "scenes/json/parameters.hpp"
#include "scenes/tool/arguments.hpp"
#include "scenes/tool/frame_arguments.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace raylane::scenes {

namespace {

std::optional<double> to_double(std::string_view word) {
    if (!is_number(word)) return std::nullopt;
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || !(std::abs(value) <= 1e30)) return std::nullopt;
    return value;
}

struct Setting {
    std::string name;
    std::vector<double> values;
    bool is_sweep = false;
};

Setting setting_argument(const std::string& text) {
    const auto refuse = [&] {
        throw BadInput("--set", "",
                       "must be NAME=NUMBER, or NAME=FIRST:LAST:COUNT for a sequence, got \"" +
                           printable(text) + "\"");
    };
    const std::size_t equals = text.find('=');
    Setting setting{text.substr(0, equals), {}, false};
    if (equals == std::string::npos || !is_parameter_name(setting.name)) refuse();
    const std::vector<std::string_view> parts =
        parts_of(std::string_view(text).substr(equals + 1), ':');
    const std::optional<double> first = to_double(parts[0]);
    if (!first || (parts.size() != 1 && parts.size() != 3)) refuse();
    if (parts.size() == 1) {
        setting.values = {*first};
        return setting;
    }
    setting.is_sweep = true;
    const std::optional<double> last = to_double(parts[1]);
    const std::optional<int> count = to_int(parts[2]);
    if (!last || !count || *count < 1 || *count > most_pictures) refuse();
    setting.values.resize(static_cast<std::size_t>(*count), *last);
    // The division comes last, so that whole numbers stay whole.
    for (int i = 0; i + 1 < *count; ++i)
        setting.values[static_cast<std::size_t>(i)] = *first + i * (*last - *first) / (*count - 1);
    if (*count == 1) setting.values = {*first};
    return setting;
}

} // namespace

void ParameterArguments::add_to(CLI::App& command, bool sweeps) {
    command
        .add_option("--set", set,
                    sweeps ? "Value of \"$NAME\" in a JSON scene: a number, or FIRST:LAST:COUNT "
                             "for a sequence of COUNT images. Several of these advance together."
                           : "Value of \"$NAME\" in a JSON scene, a number.")
        ->type_name("NAME=VALUE")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->group(group_of_several);
}

std::vector<std::map<std::string, double>> ParameterArguments::values(bool sweeps) const {
    std::vector<Setting> settings;
    std::size_t count = 1;
    for (const std::string& text : set) {
        const Setting setting = setting_argument(text);
        for (const Setting& other : settings)
            if (other.name == setting.name)
                throw BadInput("--set", "",
                               "must set \"" + printable(setting.name) + "\" only once");
        const std::size_t values = setting.values.size();
        if (values > 1 && !sweeps)
            throw BadInput("--set", "",
                           "must be NAME=NUMBER for this command, got \"" + printable(text) + "\"");
        if (values > 1 && count > 1 && values != count)
            throw BadInput("--set", "",
                           "must have the same number of values in all sweeps, got " +
                               std::to_string(count) + " and " + std::to_string(values));
        if (values > 1) count = values;
        settings.push_back(setting);
    }
    std::vector<std::map<std::string, double>> pictures(count);
    for (const Setting& setting : settings)
        for (std::size_t i = 0; i < count; ++i)
            pictures[i][setting.name] = setting.values[setting.values.size() == 1 ? 0 : i];
    return pictures;
}

bool ParameterArguments::has_sweep() const {
    return std::any_of(set.begin(), set.end(),
                       [](const std::string& text) { return setting_argument(text).is_sweep; });
}

} // namespace raylane::scenes
