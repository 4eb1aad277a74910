#include "scenes/api/cpp/raylane/version.h"
#include "scenes/images/writer.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/loading.hpp"
#include "scenes/tool/options/option.hpp"
#include "scenes/tool/progress_bar.hpp"
#include "simd/threads/threads.hpp"
#include "simd/wavefront/render.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace raylane::scenes {

namespace {

constexpr const char* help =
    R"(Render a scene by the command line of Tachyon
Usage: raylane tachyon SCENE [OPTIONS]

  SCENE                  Tachyon scene (.dat), or any scene that raylane render reads
  -o FILE                Image. Default: outfile.tga.
  -format NAME           TARGA, PNG, BMP or PPM. Default: by the ending of FILE, otherwise TARGA.
  -res W H               Image width and height in pixels
  -aasamples N           Samples per pixel besides the first; the number is approximate
  -numthreads N          Number of threads. Default: all processors.
  -fullshade, -mediumshade
                         Full shading; -mediumshade omits the light of the sky
  -lowshade, -lowestshade
                         Colours only, without light
  -rescale_lights X      Factor of all lights; no effect beside -auto_skylight
  -auto_skylight X       Sky light of X; all other lights times 1 - X
  -add_skylight X        Sky light of X besides all other lights
  -skylight_samples N    Rays to the sky from each shaded point
  -shade_blinn, -shade_blinn_fast, -shade_phong, -shade_nullphong
                         Highlights: Blinn, Blinn, Phong, none
  -trans_orig, -trans_vmd, -trans_raster3d
                         Transparency model
  -trans_max_surfaces N  Maximum number of transparent surfaces one behind the other
  -raydepth N            Maximum number of rays along a path
  -fog_radial, -fog_vmd  Fog by distance, by depth
  Accepted without effect: +V, -V, -nobounding, -boundthresh N, -shadow_filter_on, -clamp.
  Accepted without effect, with a warning: -shadow_filter_off, -normalfixup NAME, -normalize,
  -gamma X.

Example: raylane tachyon vmdscene.dat -aasamples 12 -format TARGA -o vmdscene.tga
)";

/// The parsed command line of tachyon.
struct TachyonArguments {
    std::optional<std::string> scene;
    std::string output = "outfile.tga";
    std::optional<ImageFormat> format;
    std::optional<std::pair<int, int>> size;
    std::optional<int> samples, threads;
    TachyonShading shading;
    std::optional<float> rescale_lights;
    bool wants_help = false, wants_version = false;
    std::set<std::string> without_effect;
};

/// The table of options, each with the action that reads its values.
class TachyonOptions {
  public:
    explicit TachyonOptions(std::vector<std::string> words);
    TachyonArguments read();

  private:
    using Shading = TachyonShading;

    /// Returns the next value of the current option.
    const std::string& value();
    int whole(int least) {
        constexpr int largest = std::numeric_limits<int>::max();
        return scenes::whole(least, largest).parse(option_, value());
    }
    float number(float largest) { return scenes::number(0.0F, largest).parse(option_, value()); }

    void add_shading_options();
    void add_output_options();
    void add_options_without_effect();

    std::vector<std::string> words_;
    std::size_t next_ = 0;
    std::string option_;
    TachyonArguments arguments_;
    std::map<std::string, std::function<void()>, std::less<>> options_;
};

TachyonOptions::TachyonOptions(std::vector<std::string> words) : words_(std::move(words)) {
    add_shading_options();
    add_output_options();
    add_options_without_effect();
}

const std::string& TachyonOptions::value() {
    if (next_ == words_.size()) throw BadInput(option_, "", "must have a value");
    return words_[next_++];
}

void TachyonOptions::add_shading_options() {
    Shading& shading = arguments_.shading;
    const auto set = [this](const char* name, auto& field, auto value) {
        options_[name] = [&field, value] { field = value; };
    };
    set("-fullshade", shading.quality, Shading::Quality::full);
    set("-mediumshade", shading.quality, Shading::Quality::no_shadows);
    set("-lowshade", shading.quality, Shading::Quality::flat);
    set("-lowestshade", shading.quality, Shading::Quality::flat);
    set("-shade_phong", shading.highlight, Shading::Highlight::phong);
    set("-shade_blinn", shading.highlight, Shading::Highlight::blinn);
    set("-shade_blinn_fast", shading.highlight, Shading::Highlight::blinn);
    set("-shade_nullphong", shading.highlight, Shading::Highlight::none);
    set("-trans_orig", shading.weighed_by_opacity, false);
    set("-trans_vmd", shading.weighed_by_opacity, true);
    set("-trans_raster3d", shading.opaque_aslant, true);
    set("-fog_radial", shading.planar_fog, false);
    set("-fog_normal", shading.planar_fog, false);
    set("-fog_vmd", shading.planar_fog, true);
    options_["-trans_max_surfaces"] = [&] { shading.max_transparent_surfaces = whole(0); };
    options_["-raydepth"] = [&] { shading.ray_depth = whole(0); };
    options_["-rescale_lights"] = [this] { arguments_.rescale_lights = number(1e6F); };
    options_["-auto_skylight"] = [&] {
        const float sky = number(1.0F);
        shading.sky = core::Color(sky);
        shading.direct = 1.0F - sky;
    };
    options_["-add_skylight"] = [&] { shading.sky = core::Color(number(1e6F)); };
    options_["-skylight_samples"] = [&] { shading.sky_samples = whole(0); };
}

void TachyonOptions::add_output_options() {
    options_["-o"] = [this] { arguments_.output = file_name().parse("-o", value()); };
    options_["-format"] = [this] {
        arguments_.format = choice_named<ImageFormat>(option_, value(),
                                                      {{"TARGA", ImageFormat::tga},
                                                       {"PNG", ImageFormat::png},
                                                       {"BMP", ImageFormat::bmp},
                                                       {"PPM", ImageFormat::ppm}});
    };
    options_["-res"] = [this] {
        const Values<int> side = scenes::whole(1, core::Settings::max_size);
        const int width = side.parse(option_, value()), height = side.parse(option_, value());
        const Values<std::pair<int, int>> size = image_size();
        arguments_.size = size.parse(option_, size.text({width, height}));
    };
    options_["-aasamples"] = [this] { arguments_.samples = whole(0); };
    options_["-numthreads"] = [this] {
        arguments_.threads = scenes::whole(1, simd::max_threads).parse(option_, value());
    };
    options_["-help"] = options_["--help"] =
        options_["-h"] = [this] { arguments_.wants_help = true; };
    options_["-version"] = options_["--version"] =
        options_["-banner"] = [this] { arguments_.wants_version = true; };
}

void TachyonOptions::add_options_without_effect() {
    for (const char* const name : {"+V", "-V", "-nobounding", "-shadow_filter_on", "-clamp"})
        options_[name] = [] {};
    options_["-boundthresh"] = [this] { value(); };
    for (const char* const name : {"-shadow_filter_off", "-normalize"})
        options_[name] = [this] { arguments_.without_effect.insert(option_); };
    for (const char* const name : {"-normalfixup", "-gamma"})
        options_[name] = [this] {
            arguments_.without_effect.insert(option_);
            value();
        };
}

TachyonArguments TachyonOptions::read() {
    while (next_ < words_.size()) {
        option_ = words_[next_++];
        const auto option = options_.find(option_);
        if (option != options_.end()) {
            option->second();
        } else if (option_.size() > 1 && (option_[0] == '-' || option_[0] == '+')) {
            std::vector<std::string_view> known;
            for (const auto& [name, does] : options_)
                known.emplace_back(name);
            throw BadInput("tachyon", "",
                           "unknown argument \"" + printable(option_) + '"' +
                               suggestion(option_, known) + "; see raylane tachyon -help");
        } else if (arguments_.scene) {
            throw BadInput("tachyon", "",
                           "must be given one scene, got \"" + printable(option_) + "\" as well");
        } else {
            arguments_.scene = option_;
        }
    }
    if (!arguments_.shading.direct) arguments_.shading.direct = arguments_.rescale_lights;
    return arguments_;
}

ImageFormat format_of(const TachyonArguments& arguments) {
    if (arguments.format) return *arguments.format;
    try {
        return image_format_of(arguments.output);
    } catch (const BadInput&) {
        return ImageFormat::tga;
    }
}

int draw(const std::vector<std::string>& words) {
    const TachyonArguments arguments = TachyonOptions(words).read();
    if (arguments.wants_version || arguments.wants_help) {
        std::fputs(arguments.wants_help ? help : "raylane " RAYLANE_VERSION "\n", stdout);
        return 0;
    }
    if (!arguments.scene)
        throw BadInput("tachyon", "", "must be given a scene; see raylane tachyon -help");
    const std::string scene_name = file_name().parse("SCENE", *arguments.scene);
    require_other_than_scene("-o", arguments.output, scene_name);
    OutputFile output(arguments.output, format_of(arguments));
    for (const std::string& option : arguments.without_effect)
        std::fprintf(stderr, "%s: is ignored\n", option.c_str());

    simd::RenderOptions options;
    options.threads = arguments.threads ? *arguments.threads : simd::default_threads();
    const core::Scene scene = load_with_progress(scene_name, {.tachyon = arguments.shading},
                                                 Verbosity::normal, options.threads);
    core::Settings settings = scene.settings();
    if (arguments.size) std::tie(settings.width, settings.height) = *arguments.size;
    if (arguments.samples) settings.grid = grid_of_samples(*arguments.samples);
    output.reserve(settings.width, settings.height);

    simd::Progress progress;
    options.progress = &progress;
    const simd::Rendering rendering = [&] {
        const ProgressBar bar(Verbosity::normal, progress,
                              std::int64_t{settings.width} * settings.height);
        return simd::render(scene, settings, options);
    }();
    output.commit(rendering.film, settings.transfer);
    return 0;
}

} // namespace

/// Adds the command without CLI11's options, because tachyon's options have long names with one
/// dash.
Command add_tachyon_command(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("tachyon", "Render a scene by the command line of Tachyon");
    command->set_help_flag();
    command->footer(help);
    command->prefix_command();
    return {command, [command] { return draw(command->remaining()); }, nullptr};
}

} // namespace raylane::scenes
