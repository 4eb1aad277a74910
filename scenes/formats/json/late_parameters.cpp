#include "scenes/formats/json/late_parameters.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/formats/json/inclusion.hpp"
#include "scenes/formats/json/surroundings.hpp"

namespace raylane::scenes {

namespace {

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

void take_parameters(InputFile& file, std::span<const RootKey> keys, Parameters& parameters) {
    Inclusion inclusion(file.name());
    take_all(file, keys, inclusion, parameters);
    parameters.forget_missing(); // none of them has been reported
}

} // namespace raylane::scenes
