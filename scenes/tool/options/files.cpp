#include "scenes/tool/options/files.hpp"

#include "scenes/format.hpp"
#include "scenes/tool/options/option.hpp"

#include <sys/stat.h>
#include <unistd.h>

namespace raylane::scenes {

namespace {

/// Returns true if both names lead to the same file, whether or not it exists. Returns false for
/// devices, which can be written twice.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code unknown;
    if (a == "-" || b == "-") return false; // standard input and output
    if (std::filesystem::is_other(a, unknown)) return false;
    if (std::filesystem::equivalent(a, b, unknown)) return true;
    const auto resolved = [&](const std::filesystem::path& path) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path, unknown), unknown);
    };
    return !resolved(a).empty() && resolved(a) == resolved(b);
}

/// Returns true if both names lead to the same existing file or stream, where both outputs would
/// mingle.
bool same_stream(const std::string& a, const std::string& b) {
    const auto status_of = [](const std::string& name, struct stat& status) {
        return (name == "-" ? ::fstat(STDOUT_FILENO, &status) : ::stat(name.c_str(), &status)) == 0;
    };
    struct stat of_a {};
    struct stat of_b {};
    return status_of(a, of_a) && status_of(b, of_b) && of_a.st_dev == of_b.st_dev &&
           of_a.st_ino == of_b.st_ino &&
           // Writing twice to /dev/null and similar devices is harmless; to a terminal it is not.
           (!S_ISCHR(of_a.st_mode) || ((a == "-" || b == "-") && ::isatty(STDOUT_FILENO) == 1));
}

} // namespace

std::string default_output(const std::filesystem::path& scene, const std::string& ending) {
    // A name that ends in a slash has no stem. Reading it fails later.
    if (!scene.has_stem() || scene == "-") return "scene" + ending;
    std::filesystem::path name = scene.filename();
    if (name.extension() == ".gz") name = name.stem();
    return name.stem().string() + ending;
}

void require_other_file(const std::string& option, const std::string& file,
                        const std::string& other_option, const std::string& other_file) {
    if (same_file(file, other_file)) refuse(option, "another file than " + other_option, file);
}

void require_other_than_scene(const std::string& option, const std::string& file,
                              const std::string& scene) {
    std::error_code unknown;
    if (same_file(file, scene) && std::filesystem::is_regular_file(scene, unknown)) {
        InputFile input(scene);
        static_cast<void>(format_of(input));
    }
    require_other_file(option, file, "SCENE", scene);
}

void require_other_output(const std::string& option, const std::string& file,
                          const std::string& other_option, const std::string& other_file) {
    const bool is_one = file == other_file && file == "-";
    if (is_one || same_stream(file, other_file))
        refuse(option, "another file than " + other_option, file);
    require_other_file(option, file, other_option, other_file);
}

} // namespace raylane::scenes
