#include "scenes/image/compare.hpp"
#include "scenes/image/exr.hpp"
#include "scenes/image/writer.hpp"
#include "scenes/tool/arguments.hpp"
#include "scenes/tool/command.hpp"
#include "scenes/tool/picture_arguments.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

namespace raylane::scenes {

namespace {

struct CompareArguments {
    Argument a, b, tolerance = "0", difference;
    bool json = false;
};

/// JSON has no infinity.
nlohmann::ordered_json finite_or_null(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nullptr;
}

void print_json(const Comparison& comparison, float tolerance) {
    const nlohmann::ordered_json json = {{"rmse", finite_or_null(comparison.rmse)},
                                         {"psnr", finite_or_null(comparison.psnr)},
                                         {"largest", finite_or_null(comparison.largest)},
                                         {"x", comparison.x},
                                         {"y", comparison.y},
                                         {"tolerance", as_printed(tolerance)},
                                         {"differing", comparison.differing},
                                         {"pixels", comparison.pixels}};
    std::printf("%s\n", json.dump(2).c_str());
}

void print(const Comparison& comparison, float tolerance) {
    std::printf("RMSE       %.9g\n", comparison.rmse);
    std::printf("PSNR       %.2f dB\n", comparison.psnr);
    std::printf("largest    %.9g", comparison.largest);
    if (comparison.largest > 0.0) std::printf(" at pixel %d, %d", comparison.x, comparison.y);
    std::printf("\ndiffering  %lld of %lld pixels, by more than %.9g\n",
                static_cast<long long>(comparison.differing),
                static_cast<long long>(comparison.pixels), static_cast<double>(tolerance));
}

int compare(const CompareArguments& arguments) {
    const float tolerance = number_argument("--tolerance", *arguments.tolerance, 0.0F,
                                            std::numeric_limits<float>::max());
    const std::string& name_of_a = file_argument("A", *arguments.a);
    const std::string& name_of_b = file_argument("B", *arguments.b);
    std::optional<OutputFile> output;
    if (arguments.difference) {
        const std::string& name = file_argument("--diff", *arguments.difference);
        require_other_file("--diff", name, "A", name_of_a);
        require_other_file("--diff", name, "B", name_of_b);
        require_other_output("--diff", name, "standard output, which receives the result", "-");
        output.emplace(name, exr_of);
        require_writable("--diff", output->format());
    }
    const Image a = read_image(name_of_a), b = read_image(name_of_b);
    const Comparison comparison = scenes::compare(a, b, tolerance);
    if (output) output->commit(difference_image(a, b), core::Transfer::linear);
    if (arguments.json)
        print_json(comparison, tolerance);
    else
        print(comparison, tolerance);
    return comparison.differing > 0 ? 1 : 0;
}

} // namespace

Command add_compare_command(CLI::App& app) {
    CLI::App& command =
        add_command(app, "compare", "Compare two images; exit code 1 if they differ",
                    "raylane compare before.png after.png --diff difference.png");
    auto arguments = std::make_shared<CompareArguments>();
    add_positional(command, "A", arguments->a, "First image, PNG, EXR, HDR or PFM.");
    add_positional(command, "B", arguments->b, "Second image, of the same size.");
    add_option(command, "--tolerance", arguments->tolerance,
               "Largest difference of a component that is ignored; 1 is white. Default: 0.", "T");
    add_option(command, "--diff", arguments->difference,
               "Write an image of the differences, amplified to white.", "FILE");
    add_flag(command, "--json", arguments->json, "Print the result as JSON.");
    return {&command, [arguments] { return compare(*arguments); }};
}

} // namespace raylane::scenes
