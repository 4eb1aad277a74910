#include "core/numbers/more_functions.hpp"
#include "core/scene/transfer.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/module.hpp"
#include "scenes/images/writer.hpp"
#include "scenes/tool/annotator.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/loading.hpp"
#include "scenes/tool/options/render_options.hpp"
#include "scenes/tool/window/image_maker.hpp"
#include "scenes/tool/window/mouse.hpp"
#include "scenes/tool/window/window.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

namespace raylane::scenes {

namespace {

/// Opens a window by a module that is loaded on demand, because loading the libraries for windows
/// takes longer than rendering many an image. Throws SystemRefused if there is no display or no
/// such module.
std::unique_ptr<Window> open_window(const std::string& title, int width, int height) {
    constexpr const char* failure = "view: cannot open a window";
    static const auto open = reinterpret_cast<OpenWindow>(function_of(
        {"raylane-window.so", open_window_name, "SDL2 at build time (Debian: libsdl2-dev)"},
        failure));
    const char* why = "";
    Window* window = open(title.c_str(), width, height, &why);
    if (window == nullptr) throw SystemRefused(std::string(failure) + ": " + printable(why, 400));
    return std::unique_ptr<Window>(window);
}

struct ViewCommandArguments : OptionTable {
    Option<std::string> scene = {
        *this, "SCENE", file_argument(),
        "Scene or atoms, in any format that render reads. The window reloads the file "
        "when it changes."};
    Option<ImageSize> size = {
        *this, "--size", image_size_on_paper(),
        "Window width and height in pixels, or on paper, at the resolution of --dpi."};
    EncodingArguments encoding{*this, "8"}; // of saved images, which are PNGs
    SettingArguments setting{*this};
    ThreadsOption threads{*this};
    AnnotationArguments annotation{*this};
    SceneArguments scene_arguments{*this};
};

/// The meaning of a scene's shapes, and its annotations.
struct AnnotatedScene {
    Legend legend;
    std::optional<SheetComposer> composer; ///< unset: no annotations

    std::optional<Sheet> sheet(const core::Scene& scene, const core::Settings& settings) const {
        if (!composer) return std::nullopt;
        return composer->compose(
            {scene.camera(), settings.width, settings.height, scene.background(), &scene}, {});
    }
};

/// Returns a name that no file has yet: "scene-1.png", "scene-2.png", ...
std::string free_name(const std::string& scene) {
    const std::string stem = default_output(scene, "");
    for (int number = 1;; ++number) {
        std::string name = stem + "-" + std::to_string(number) + ".png";
        std::error_code unknown;
        if (!std::filesystem::exists(name, unknown)) return name;
    }
}

constexpr int longest_wait = 250; // milliseconds between checks whether the file was written

class Viewer {
  public:
    explicit Viewer(const ViewCommandArguments& arguments)
        : arguments_(arguments), name_(*arguments.scene),
          verbosity_(arguments.scene_arguments.verbosity.verbosity()),
          threads_(arguments.threads.count()), written_(time_of_file()) {
        arguments.encoding.require_fit(ImageFormat::png);
        annotations_ = arguments.annotation.annotations_at(
            dpi(), arguments.scene_arguments.drawing.axes.is_given());
        annotations_.is_steady = true;
        if (annotations_.any())
            overlay_ =
                overlay_for(arguments.annotation.first_given() + ": cannot write on an image",
                            arguments.annotation.font.value(), remarks());
        core::Scene scene = loaded();
        std::pair<int, int> size = {own_.width, own_.height};
        if (arguments.size) size = arguments.size->in_pixels(double(dpi().value_or(0.0F)), size);
        set_size(size.first, size.second);
        scene = seen(std::move(scene), arguments_.scene_arguments.view.change(), settings_);
        first_ = view_of(scene);
        orbit_.emplace(first_);
        window_ = open_window(title(), settings_.width, settings_.height);
        simd::RenderOptions options;
        options.threads = threads_;
        maker_ = std::make_unique<ImageMaker>(std::move(scene), overlays(), options,
                                              [this] { window_->wake(); });
        begin();
    }

    void run() {
        while (!is_closed_) {
            act(window_->wait(longest_wait));
            maker_->rethrow();
            if (std::optional<ImageMaker::Image> image = maker_->take()) show(*image);
            reload_if_written();
            if (is_moved_) begin();
        }
    }

  private:
    std::string title() const { return printable(name_, 200) + " - raylane"; }

    std::optional<float> dpi() const { return arguments_.encoding.dpi_for(arguments_.size); }

    OnRemark remarks() const {
        if (verbosity_ == Verbosity::quiet) return {};
        return [](const std::string& remark) { std::fprintf(stderr, "%s\n", remark.c_str()); };
    }

    /// Loads the scene, its settings and its annotations. Changes nothing if it throws.
    core::Scene loaded() {
        LoadOptions options = arguments_.scene_arguments.load_options();
        const auto result = std::make_shared<AnnotatedScene>();
        options.legend = &result->legend;
        core::Scene scene = load_with_progress(name_, std::move(options), verbosity_, threads_);
        if (annotations_.any()) result->composer.emplace(annotations_, result->legend, remarks());
        static_cast<void>(settings_for(scene.settings(), 1, 1)); // may throw
        annotated_ = result;
        own_ = scene.settings();
        return scene;
    }

    /// Returns a function that the thread of the image maker calls.
    MakeOverlay overlays() const {
        if (!annotations_.any()) return {};
        return [annotated = annotated_, &overlay = *overlay_](const core::Scene& scene,
                                                              const core::Settings& settings) {
            const std::optional<Sheet> sheet = annotated->sheet(scene, settings);
            return std::make_shared<const ImageOverlay>(
                ImageOverlay{sheet->width, sheet->height, overlay.pixels(*sheet)});
        };
    }

    core::Settings settings_for(const core::Settings& own, int width, int height) const {
        return arguments_.setting.settings_of(own, {width, height},
                                              arguments_.scene_arguments.drawing.look.is_given());
    }
    void set_size(int width, int height) { settings_ = settings_for(own_, width, height); }

    std::filesystem::file_time_type time_of_file() const {
        std::error_code unknown;
        return std::filesystem::last_write_time(name_, unknown);
    }

    void begin() {
        is_moved_ = false;
        maker_->show(orbit_->view(), settings_);
    }

    void show(const ImageMaker::Image& image) {
        const core::Encoder encode(settings_.transfer);
        const core::Film& film = image.film;
        std::vector<std::uint32_t> pixels;
        pixels.reserve(film.pixels().size());
        for (const core::Color& color : film.pixels())
            pixels.push_back(static_cast<std::uint32_t>(encode(color.x)) << 16 |
                             static_cast<std::uint32_t>(encode(color.y)) << 8 | encode(color.z));
        if (image.overlay == nullptr) {
            window_->show(pixels.data(), film.width(), film.height());
            return;
        }
        const std::vector<std::uint32_t> covered =
            covered_by(*image.overlay, pixels, film.width(), film.height());
        window_->show(covered.data(), image.overlay->width, image.overlay->height);
    }

    /// Returns pixels of an overlay over pixels of an image, which may be coarser.
    static std::vector<std::uint32_t> covered_by(const ImageOverlay& overlay,
                                                 const std::vector<std::uint32_t>& pixels,
                                                 int width, int height) {
        const auto size = [](int pixels_of_side) {
            return static_cast<std::size_t>(pixels_of_side);
        };
        std::vector<std::uint32_t> result;
        result.reserve(overlay.pixels.size());
        for (std::size_t y = 0; y < size(overlay.height); ++y)
            for (std::size_t x = 0; x < size(overlay.width); ++x) {
                const std::size_t row = y * size(height) / size(overlay.height);
                const std::size_t column = x * size(width) / size(overlay.width);
                result.push_back(
                    over(overlay.pixels[result.size()], pixels[row * size(width) + column]));
            }
        return result;
    }

    void reload_if_written() {
        const auto time = time_of_file();
        if (time == written_) return;
        written_ = time;
        try {
            core::Scene scene = loaded();
            set_size(settings_.width, settings_.height);
            maker_->replace(std::move(scene), overlays());
            is_moved_ = true;
        } catch (const BadInput& bad) { // the file may be incomplete while it is written
            std::fprintf(stderr, "raylane: %s\n", bad.what());
        }
    }

    void act(const WindowEvent& event) {
        using Kind = WindowEvent::Kind;
        const double height = settings_.height;
        switch (event.kind) {
        case Kind::turned:
            orbit_->turn(-360.0 * event.across / height, 360.0 * event.down / height);
            break;
        case Kind::moved:
            orbit_->pan(-event.across / height, event.down / height);
            break;
        case Kind::zoomed:
            orbit_->zoom(core::power(2.0, event.notches / 4.0));
            break;
        case Kind::resized:
            set_size(window_->width(), window_->height());
            break;
        case Kind::clicked:
            maker_->with_scene([&](const core::Scene& scene) {
                std::printf(
                    "%s\n",
                    what_is_at(scene, settings_, event.x, event.y, annotated_->legend).c_str());
            });
            std::fflush(stdout);
            break; // with_scene() stopped the rendering, so start again
        case Kind::key:
            press(event.key);
            return;
        case Kind::closed:
            is_closed_ = true;
            return;
        case Kind::none:
        case Kind::woken:
            return;
        }
        is_moved_ = true;
    }

    void press(char key) {
        switch (key) {
        case 'q':
            is_closed_ = true;
            break;
        case 'r':
            orbit_.emplace(first_);
            is_moved_ = true;
            break;
        case 'c':
            std::printf("%s\n", camera_text(orbit_->view().camera).c_str());
            std::fflush(stdout);
            break;
        case 's':
            save();
            is_moved_ = true;
            break;
        default:
            break;
        }
    }

    void save() {
        const std::string name = free_name(name_);
        window_->set_title(("saving " + name).c_str());
        maker_->with_scene([&](const core::Scene& scene) {
            OutputFile output(name);
            simd::RenderOptions options;
            options.threads = threads_;
            core::Film film = simd::render(scene, settings_, options).film;
            if (const auto sheet = annotated_->sheet(scene, settings_))
                overlay_->cover(*sheet, {0, 0, film.width(), film.height()}, settings_.transfer,
                                film);
            output.commit(film,
                          {settings_.transfer, arguments_.encoding.bits.value_or(8), dpi(), {}});
        });
        window_->set_title(title().c_str());
        std::printf("%s\n", name.c_str());
        std::fflush(stdout);
    }

    const ViewCommandArguments& arguments_;
    std::string name_;
    Verbosity verbosity_;
    int threads_;
    std::filesystem::file_time_type written_;
    Annotations annotations_;
    std::optional<Overlay> overlay_;
    std::shared_ptr<const AnnotatedScene> annotated_;
    core::Settings own_, settings_; // of the file, and of the window
    core::View first_;
    std::optional<Orbit> orbit_;
    std::unique_ptr<Window> window_;
    std::unique_ptr<ImageMaker> maker_; // last, because its thread wakes the window
    bool is_moved_ = false, is_closed_ = false;
};

} // namespace

Command add_view_command(CLI::App& app) {
    return add_command<ViewCommandArguments>(
        app,
        {.name = "view",
         .help = "Show a scene in a window",
         .example = "raylane view scenes/birthday.json",
         .details = "Mouse: drag to orbit, drag with shift to pan, turn the wheel to come closer, "
                    "click to print the shape under the pointer.\nKeys: s saves the image, c "
                    "prints the camera, r resets it, q quits."},
        [](const ViewCommandArguments& arguments) {
            Viewer(arguments).run();
            return 0;
        });
}

} // namespace raylane::scenes
