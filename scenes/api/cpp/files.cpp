#include "raylane/image.hpp"
#include "raylane/scene.hpp"
#include "scenes/api/cpp/convert.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "scenes/api/cpp/translate.hpp"
#include "scenes/export/export.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/images/writer.hpp"
#include "simd/threads/threads.hpp"

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

scenes::LoadOptions atom_options(const AtomOptions& options, core::Workers& workers,
                                 const OnRemark& on_remark) {
    scenes::LoadOptions result;
    result.workers = &workers;
    result.on_remark = on_remark;
    result.set_drawing(options);
    return result;
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
    return with_file_errors([&] {
        simd::ParallelWorkers workers;
        return owning(
            scenes::load_scene(file_named(path), atom_options(options, workers, on_remark)));
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
    return with_file_errors([&] {
        simd::ParallelWorkers workers;
        return owning(scenes::parse_scene(name, text, atom_options(options, workers, on_remark)));
    });
}

void save(const Scene& scene, const std::filesystem::path& path, const OnRemark& on_remark) {
    const std::filesystem::path file = file_named(path);
    const std::vector<std::string> differences =
        with_file_errors([&] { return scenes::export_scene(file, library::Internals::of(scene)); });
    if (on_remark)
        for (const std::string& what : differences)
            on_remark(file.string() +
                      ": differs from the scene, because the format cannot express: " + what);
}

void write_image(const std::filesystem::path& path, const Image& image, Transfer transfer) {
    require_side("width", image.width);
    require_side("height", image.height);
    if (transfer > Transfer::linear) throw InvalidValue("transfer", "must be a Transfer");
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
        core::Film film(image.width, image.height, !image.alpha.empty());
        std::size_t i = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x, ++i) {
                const Color pixel = image.at(x, y);
                film.at(x, y) = {pixel.x, pixel.y, pixel.z};
                if (film.has_alpha()) film.alpha_at(x, y) = image.alpha[i];
            }
        file.reserve(image.width, image.height);
        file.commit(film, converted<core::Transfer>(transfer));
    });
}

} // namespace raylane
