#include "scenes/tool/arguments.hpp"

#include "core/scene/surroundings.hpp"
#include "scenes/format.hpp"
#include "simd/threads.hpp"

#include <cmath>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace raylane::scenes {

namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& must,
                         const std::string& got) {
    throw BadInput(option, "", "must be " + must + ", got \"" + printable(got) + "\"");
}

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

const std::string& file_argument(const std::string& option, const std::string& text) {
    if (text.empty()) refuse(option, "the name of a file", text);
    return text;
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

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (true) {
        const std::size_t end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

int whole_argument(const std::string& option, const std::string& text, int least, int most) {
    const std::optional<int> value = to_int(text);
    if (!value || *value < least || *value > most)
        refuse(option,
               "a whole number from " + std::to_string(least) + " to " + std::to_string(most),
               text);
    return *value;
}

int threads_argument(const std::optional<std::string>& text) {
    return text ? whole_argument("--threads", *text, 1, simd::max_threads)
                : simd::default_threads();
}

float number_argument(const std::string& option, const std::string& text, float least, float most) {
    const std::optional<float> value = to_float(text);
    if (!value || *value < least || *value > most)
        refuse(option, "a number from " + to_text(least) + " to " + to_text(most), text);
    return *value;
}

std::pair<int, int> size_argument(const std::string& option, const std::string& text) {
    constexpr int most = core::Settings::max_size;
    const std::size_t x = text.find_first_of("xX");
    std::optional<int> width, height;
    if (x != std::string::npos) {
        width = to_int(std::string_view(text).substr(0, x));
        height = to_int(std::string_view(text).substr(x + 1));
    }
    if (!width || !height || *width < 1 || *height < 1 || *width > most || *height > most)
        refuse(option,
               "WIDTHxHEIGHT in pixels, each from 1 to " + std::to_string(most) +
                   ", such as 640x480",
               text);
    if (std::int64_t{*width} * *height > core::Settings::max_pixels)
        refuse(option, "at most " + std::to_string(core::Settings::max_pixels) + " pixels in all",
               text);
    return {*width, *height};
}

int square_argument(const std::string& option, const std::string& text, int most_root) {
    const std::optional<int> value = to_int(text);
    const int root = value && *value > 0
                         ? static_cast<int>(std::lround(std::sqrt(static_cast<double>(*value))))
                         : 0;
    if (root < 1 || root > most_root || root * root != *value)
        refuse(option,
               "a square number from 1 to " + std::to_string(most_root * most_root) +
                   ", such as 1, 4, 9 or 16",
               text);
    return root;
}

} // namespace raylane::scenes
