#include "scenes/formats/json/parameters.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace raylane::scenes {

namespace {

std::string text_of(double value) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

bool is_negated(std::string_view reference) {
    return reference.starts_with('-');
}

std::string_view name_in(std::string_view reference) {
    return reference.substr(is_negated(reference) ? 2 : 1);
}

} // namespace

bool is_reference(std::string_view text) {
    return text.starts_with('$') || text.starts_with("-$");
}

bool is_parameter_name(std::string_view name) {
    const auto is_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    return !name.empty() && is_letter(name[0]) &&
           std::all_of(name.begin(), name.end(),
                       [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

Parameters::Parameters(const std::map<std::string, double>& given) {
    for (const auto& [name, value] : given)
        parameters_[name] = {.value = value, .given = true};
}

void Parameters::add_default(std::string_view name, double value) {
    parameters_.try_emplace(std::string(name), Parameter{.value = value});
}

void Parameters::add_wrong(std::string_view name) {
    parameters_.try_emplace(std::string(name), Parameter{.value = 0.0, .wrong = true});
}

void Parameters::forget_wrong(std::string_view name) {
    const auto found = parameters_.find(name);
    if (found != parameters_.end() && found->second.wrong) parameters_.erase(found);
}

bool Parameters::is_wrong(std::string_view reference) const {
    const auto found = parameters_.find(name_in(reference));
    return found != parameters_.end() && found->second.wrong;
}

std::optional<Parameters::Number> Parameters::find(std::string_view reference) {
    const bool negated = is_negated(reference);
    const auto found = parameters_.find(name_in(reference));
    if (found == parameters_.end() || found->second.wrong) return std::nullopt;
    found->second.used = true;
    const double value = negated ? -found->second.value : found->second.value;
    return Number{text_of(value), value};
}

std::vector<std::string_view> Parameters::names() const {
    std::vector<std::string_view> names;
    for (const auto& [name, parameter] : parameters_)
        names.push_back(name);
    return names;
}

std::optional<std::string> Parameters::first_unused() const {
    for (const auto& [name, parameter] : parameters_)
        if (parameter.given && !parameter.used) return name;
    return std::nullopt;
}

} // namespace raylane::scenes
