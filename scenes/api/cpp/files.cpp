#include "raylane/image.hpp"
#include "raylane/scene.hpp"
#include "scenes/annotation/composer.hpp"
#include "scenes/annotation/overlay.hpp"
#include "scenes/api/cpp/convert.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "scenes/api/cpp/translate.hpp"
#include "scenes/export/export.hpp"
#include "scenes/files/atomic_file.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/images/texture.hpp"
#include "scenes/images/writer.hpp"
#include "simd/threads/threads.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// The functions that read and write files. raylane::trace contains all others.
namespace raylane {

using library::converted;
using library::owning;

namespace {

/// Calls f() as library::translated() does, and also converts the errors of files.
template <class F>
decltype(auto) with_file_errors(const F& f) {
    try {
        return library::translated(f);
    } catch (const scenes::BadInput& error) {
        std::vector<InputError> errors;
        for (const scenes::InputError& e : error.errors())
            errors.push_back({e.file, e.position.line, e.position.column, e.place, e.message});
        throw BadInput(error.what(), std::move(errors));
    } catch (const scenes::SystemRefused& error) {
        throw SystemRefused(error.what());
    }
}

/// Returns a path that names the file "-", which the readers and writers take for standard input or
/// output.
std::filesystem::path file_named(const std::filesystem::path& path) {
    return path == "-" ? "./-" : path;
}

class AtomAnnotations final : public library::SceneAnnotations {
  public:
    explicit AtomAnnotations(scenes::Annotations annotations)
        : annotations_(std::move(annotations)) {}

    /// Returns the legend that loading the scene has to fill in for prepare().
    scenes::Legend& legend() { return legend_; }
    void prepare(const OnRemark& on_remark) { composer_.emplace(annotations_, legend_, on_remark); }

    std::function<void(core::Film&)>
    of_image(const core::Scene& scene, const core::Settings& settings, const core::Region& part,
             const std::filesystem::path& file, const OnRemark& on_remark) const override {
        return with_file_errors([&]() -> std::function<void(core::Film&)> {
            const core::Color background = settings.alpha ? core::Color(1.0F) : scene.background();
            const auto compose = [&] {
                return composer_->compose(
                    {scene.camera(), settings.width, settings.height, background, &scene},
                    on_remark);
            };
            if (!file.empty()) {
                const auto output = std::make_shared<scenes::AtomicFile>(file);
                return [output, text = scenes::svg_of(compose())](core::Film&) {
                    with_file_errors([&] {
                        output->write(text);
                        output->commit();
                    });
                };
            }
            const scenes::Overlay overlay(
                "annotations: cannot write on an image; an SVG file can have them");
            if (std::max(settings.width, settings.height) > scenes::Overlay::most)
                throw InvalidValue("settings/" + std::string(settings.width > settings.height
                                                                 ? "width"
                                                                 : "height"),
                                   "must be at most " + std::to_string(scenes::Overlay::most) +
                                       " with annotations over the image");
            const auto used = overlay.replaced_font(annotations_.font);
            if (used && on_remark)
                on_remark("font: \"" + scenes::printable(annotations_.font) +
                          "\" is not installed: texts are in " + scenes::printable(*used));
            return
                [overlay, part, transfer = settings.transfer, sheet = compose()](core::Film& film) {
                    with_file_errors([&] { overlay.cover(sheet, part, transfer, film); });
                };
        });
    }

  private:
    scenes::Annotations annotations_;
    scenes::Legend legend_;
    std::optional<scenes::SheetComposer> composer_; // of both
};

/// Moves options of annotations from `options` to a new value. Throws scenes::BadInput.
scenes::Annotations taken_annotations(AtomOptions& options) {
    scenes::Annotations result;
    result.has_dashes = false;
    std::string first; // option
    std::erase_if(options, [&](const auto& option) {
        if (!scenes::set_option(result, option.first, option.second)) return false;
        if (first.empty() && option.second != "off") first = option.first;
        return true;
    });
    if (!result.any() && !first.empty())
        throw scenes::BadInput(first, "", "goes with legend, scale_bar, triad, label or distance");
    return result;
}

/// Loads a scene of atoms by load(options).
template <class Load>
Scene with_options(AtomOptions options, const OnRemark& on_remark, const Load& load) {
    return with_file_errors([&] {
        simd::ParallelWorkers workers;
        scenes::LoadOptions loading;
        loading.workers = &workers;
        loading.on_remark = on_remark;
        scenes::Annotations annotations = taken_annotations(options);
        loading.set_drawing(options);
        if (!annotations.any()) return owning(load(loading));
        annotations.axes_on_right = loading.drawing.show_axes;
        const auto shared = std::make_shared<AtomAnnotations>(std::move(annotations));
        loading.legend = &shared->legend();
        core::Scene scene = load(loading);
        shared->prepare(on_remark);
        return owning(std::move(scene), shared);
    });
}

void require_side(const char* field, int pixels) {
    if (pixels < 1 || pixels > core::Settings::max_size)
        throw InvalidValue(field, "must be from 1 to " + std::to_string(core::Settings::max_size) +
                                      ", got " + std::to_string(pixels));
}

} // namespace

Scene load(const std::filesystem::path& path, const OnRemark& on_remark) {
    return with_file_errors([&] {
        simd::ParallelWorkers workers;
        return owning(
            scenes::load_scene(file_named(path), {.workers = &workers, .on_remark = on_remark}));
    });
}

Scene load_atoms(const std::filesystem::path& path, const AtomOptions& options,
                 const OnRemark& on_remark) {
    return with_options(options, on_remark, [&](const scenes::LoadOptions& loading) {
        return scenes::load_scene(file_named(path), loading);
    });
}

Scene parse(std::string_view text, const std::string& name, const OnRemark& on_remark) {
    return with_file_errors([&] {
        simd::ParallelWorkers workers;
        return owning(
            scenes::parse_scene(name, text, {.workers = &workers, .on_remark = on_remark}));
    });
}

Scene parse_atoms(std::string_view text, const std::string& name, const AtomOptions& options,
                  const OnRemark& on_remark) {
    return with_options(options, on_remark, [&](const scenes::LoadOptions& loading) {
        return scenes::parse_scene(name, text, loading);
    });
}

void save(const Scene& scene, const std::filesystem::path& path, const OnRemark& on_remark) {
    const std::filesystem::path file = file_named(path);
    std::vector<std::string> differences =
        with_file_errors([&] { return scenes::export_scene(file, library::Internals::of(scene)); });
    if (library::Internals::annotations_of(scene) != nullptr)
        differences.emplace_back("annotations");
    if (on_remark)
        for (const std::string& what : differences)
            on_remark(file.string() +
                      ": differs from the scene, because the format cannot express: " + what);
}

Texture read_texture(const std::filesystem::path& path) {
    return with_file_errors([&] {
        scenes::InputFile file(file_named(path));
        return library::Internals::texture(scenes::read_texture(file));
    });
}

void write_image(const std::filesystem::path& path, const Image& image,
                 const ImageEncoding& encoding) {
    require_side("width", image.width);
    require_side("height", image.height);
    if (encoding.transfer > Transfer::linear) throw InvalidValue("transfer", "must be a Transfer");
    if (image.rgb.size() != std::size_t{3} * image.width * image.height)
        throw InvalidValue("rgb", "must be 3 components for each of " +
                                      std::to_string(image.width) + " x " +
                                      std::to_string(image.height) + " pixels, got " +
                                      std::to_string(image.rgb.size()));
    if (!image.alpha.empty() && 3 * image.alpha.size() != image.rgb.size())
        throw InvalidValue("alpha", "must be empty, or one for each of " +
                                        std::to_string(image.width) + " x " +
                                        std::to_string(image.height) + " pixels, got " +
                                        std::to_string(image.alpha.size()));
    with_file_errors([&] {
        scenes::OutputFile file(path);
        const bool is_png = file.format() == scenes::ImageFormat::png;
        if (encoding.bits != 8 && !(is_png && encoding.bits == 16))
            throw InvalidValue("bits", is_png ? "must be 8 or 16" : "must be 8, except in .png");
        const bool has_dpi = encoding.dpi != 0.0F;
        if (has_dpi && !(is_png && encoding.dpi >= 1.0F && encoding.dpi <= 10'000.0F))
            throw InvalidValue("dpi", is_png ? "must be from 1 to 10000, or 0 for none"
                                             : "must be 0, except in .png");
        core::Film film(image.width, image.height, !image.alpha.empty());
        std::size_t i = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x, ++i) {
                const Color pixel = image.at(x, y);
                film.at(x, y) = {pixel.x, pixel.y, pixel.z};
                if (film.has_alpha()) film.alpha_at(x, y) = image.alpha[i];
            }
        file.reserve(image.width, image.height);
        scenes::ImageOptions options;
        options.transfer = converted<core::Transfer>(encoding.transfer);
        options.bits = encoding.bits;
        if (has_dpi) options.dpi = encoding.dpi;
        file.commit(film, options);
    });
}

} // namespace raylane
