#include "scenes/formats/json/inclusion.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/formats/json/surroundings.hpp"

#include <algorithm>
#include <system_error>

namespace raylane::scenes {

namespace {

bool contains(const std::vector<std::filesystem::path>& files, const std::filesystem::path& path) {
    return std::any_of(files.begin(), files.end(), [&](const std::filesystem::path& file) {
        std::error_code none;
        return std::filesystem::equivalent(file, path, none);
    });
}

void take_all(InputFile& file, std::span<const RootKey> keys, Inclusion& inclusion,
              Parameters& parameters) {
    InputErrors untold;
    const auto take = [&](const RootKey& key, std::string_view name, const JsonDocument& item) {
        if (key.name == "parameters") read_parameter(name, item.root(), parameters);
        if (key.name == "include")
            inclusion.include(item.root(), [&](InputFile& included) {
                take_all(included, keys, inclusion, parameters);
            });
    };
    const auto miss = [&](std::string_view key) { parameters.miss(key); };
    try {
        read_items(file, keys, take, miss, untold, parameters);
    } catch (const BadInput&) { // as far as can be read
        return;
    }
}

} // namespace

void Inclusion::include(const JsonValue& value, const std::function<void(InputFile&)>& read) {
    const std::filesystem::path path = files_.back().parent_path() / value.string();
    if (contains(files_, path))
        value.fail("must not include a file that includes it, got " + value.quoted());
    if (contains(read_, path)) return;
    const auto file = checked(value, [&] { return opener_.open(path, value.string(), depth()); });
    files_.push_back(path);
    try {
        read(*file);
    } catch (...) {
        files_.pop_back();
        throw;
    }
    files_.pop_back();
    read_.push_back(path);
}

void take_parameters(InputFile& file, std::span<const RootKey> keys, Parameters& parameters) {
    Inclusion inclusion(file.name());
    take_all(file, keys, inclusion, parameters);
    parameters.forget_missing(); // none of them has been reported
}

} // namespace raylane::scenes
