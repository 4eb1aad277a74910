#include "scenes/images/compare.hpp"

#include "scenes/files/number.hpp"
#include "scenes/images/exr.hpp"
#include "scenes/images/writer.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/options/option.hpp"
#include "scenes/tool/options/render_options.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

namespace raylane::scenes {

namespace {

struct CompareArguments : OptionTable {
    Option<std::string> a = {*this, "A", file_argument(),
                             "First image, PNG, TIFF, EXR, HDR or PFM."};
    Option<std::string> b = {*this, "B", file_argument(), "Second image, of the same size."};
    Option<float> tolerance = {*this, "--tolerance",
                               number(0.0F, std::numeric_limits<float>::max(), "T").initially(0.0F),
                               "Largest difference of a component that is ignored; 1 is white."};
    Option<std::string> difference = {*this, "--diff", file_name(),
                                      "Write an image of the differences, amplified to white."};
    Flag json = {*this, "--json", flag(), "Print the result as JSON."};
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

int compare_files(const CompareArguments& arguments) {
    const float tolerance = *arguments.tolerance;
    std::optional<OutputFile> output;
    if (arguments.difference) {
        const std::string& name = *arguments.difference;
        require_other_file("--diff", name, "A", *arguments.a);
        require_other_file("--diff", name, "B", *arguments.b);
        require_other_output("--diff", name, "standard output, which receives the result", "-");
        output.emplace(name, more_encoders);
        require_writable("--diff", output->format());
    }
    const Image a = read_image(*arguments.a), b = read_image(*arguments.b);
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
    return add_command<CompareArguments>(
        app,
        {.name = "compare",
         .help = "Compare two images; exit code 1 if they differ",
         .example = "raylane compare before.png after.png --diff difference.png"},
        compare_files);
}

} // namespace raylane::scenes
