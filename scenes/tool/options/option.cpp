#include "scenes/tool/options/option.hpp"

#include "scenes/files/number.hpp"
#include "scenes/formats/format.hpp"
#include "scenes/formats/structure/drawing.hpp"
#include "simd/threads/threads.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
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

AnyOption::AnyOption(OptionTable& table, std::string names, std::string help)
    : names_(std::move(names)), group_(table.group()), help_(std::move(help)) {
    table.add(*this);
}

std::string AnyOption::name() const {
    const std::size_t start = names_.find("--");
    const std::string name = start == std::string::npos ? names_ : names_.substr(start);
    return name.substr(0, name.find(','));
}

const char* AnyOption::former_name() const {
    constexpr std::pair<std::string_view, const char*> former_names[] = {
        {"--aovs", "--layers"}, {"--max-transparent", "--max-see-through"}};
    for (const auto& [name, former] : former_names)
        if (names_ == name) return former;
    return nullptr;
}

std::string AnyOption::help() const {
    const OptionProperties& option = properties();
    std::string text = help_;
    if (!option.range.empty())
        text += " Range: " + option.range + (option.unit.empty() ? "" : " " + option.unit) + ".";
    if (!option.for_atoms.empty())
        text +=
            " Default for atoms: " + option.for_atoms + "; for scenes: " + option.standard + ".";
    else if (!option.standard.empty())
        text += " Default: " + option.standard + ".";
    return text;
}

std::vector<std::string> AnyOption::recorded(const Rendered&) const {
    return properties().is_recorded ? texts_ : std::vector<std::string>();
}

void OptionTable::add(AnyOption& option) {
    options_.push_back(&option);
    if (whole_ != nullptr) whole_->add(option);
}

void OptionTable::parse() {
    for (AnyOption* option : options_)
        option->parse();
    const auto is_given = [&](const std::string& name) {
        return std::any_of(options_.begin(), options_.end(), [&](const AnyOption* option) {
            return option->name() == name && option->is_given();
        });
    };
    for (const AnyOption* option : options_)
        for (const std::string& other : option->properties().excluded)
            if (option->is_given() && is_given(other))
                throw BadInput(option->name(), "", "goes without " + other);
}

void OptionTable::apply_to(core::Settings& settings) const {
    for (const AnyOption* option : options_)
        option->apply_to(settings);
}

std::vector<std::pair<std::string, std::string>>
OptionTable::recorded(const Rendered& rendered) const {
    std::vector<std::pair<std::string, std::string>> options;
    for (const AnyOption* option : options_)
        for (std::string& value : option->recorded(rendered))
            options.emplace_back(option->name(), std::move(value));
    return options;
}

std::string OptionTable::first_given() const {
    for (const AnyOption* option : options_)
        if (option->is_given()) return option->name();
    return "";
}

bool OptionTable::has(const std::string& name) const {
    return std::any_of(options_.begin(), options_.end(),
                       [&](const AnyOption* option) { return option->name() == name; });
}

ThreadsOption::ThreadsOption(OptionTable& table)
    : Option<int>(table, "--threads", whole(1, simd::max_threads).otherwise("all processors"),
                  "Number of threads.") {}

int ThreadsOption::count() const {
    return value() ? **this : simd::default_threads();
}

Values<bool> flag() {
    return {"", "", [](const auto&, const auto&) { return true; }};
}

Values<int> whole(int least, int most) {
    const std::string range = std::to_string(least) + " to " + std::to_string(most);
    return {"N", range,
            [=](const std::string& option, const std::string& text) {
                const std::optional<int> value = to_int(text);
                if (!value || *value < least || *value > most)
                    refuse(option, "a whole number from " + range, text);
                return *value;
            },
            [](const int& value) { return std::to_string(value); }};
}

Values<int> square_of(int max_root) {
    const std::string most = std::to_string(max_root * max_root);
    return {"N", "1 to " + most,
            [=](const std::string& option, const std::string& text) {
                const int value = to_int(text).value_or(0);
                const auto root = static_cast<int>(std::lround(std::sqrt(std::max(value, 0))));
                if (root < 1 || root > max_root || root * root != value)
                    refuse(option, "a square number from 1 to " + most + ", such as 1, 4, 9 or 16",
                           text);
                return root;
            },
            [](const int& root) { return std::to_string(root * root); }};
}

Values<float> number(float least, float most, std::string type) {
    const bool is_open = most == std::numeric_limits<float>::max();
    return {std::move(type), to_text(least) + (is_open ? " or more" : " to " + to_text(most)),
            [=](const std::string& option, const std::string& text) {
                return number_between(option, text, least, most);
            },
            [](const float& value) { return to_text(value); }};
}

Values<std::string> word(std::string type) {
    return {std::move(type), "", [](const std::string&, const std::string& text) { return text; }};
}

Values<std::string> file_name(std::string type) {
    return {std::move(type), "", [](const std::string& option, const std::string& text) {
                if (text.empty()) refuse(option, "the name of a file", text);
                return text;
            }};
}

Values<std::string> file_argument() {
    return file_name("").required();
}

Values<std::pair<int, int>> image_size() {
    const auto parse = [](const std::string& option, const std::string& text) {
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
            refuse(option,
                   "at most " + std::to_string(core::Settings::max_pixels) + " pixels in all",
                   text);
        return std::pair{*width, *height};
    };
    const auto text_of = [](const std::pair<int, int>& size) {
        return std::to_string(size.first) + "x" + std::to_string(size.second);
    };
    const Drawing drawing;
    return Values<std::pair<int, int>>("WxH", "", parse, text_of)
        .otherwise(as_in_file, text_of({drawing.width, drawing.height}));
}

std::pair<int, int> ImageSize::in_pixels(double dpi, const std::pair<int, int>& proportions) const {
    const double scale = on_paper ? dpi : 1.0;
    const double across = std::round(scale * width);
    const double upward =
        std::round(height > 0.0 ? scale * height : across * proportions.second / proportions.first);
    constexpr double most = core::Settings::max_size;
    if (!(across >= 1.0 && upward >= 1.0 && across <= most && upward <= most) ||
        across * upward > static_cast<double>(core::Settings::max_pixels))
        throw BadInput("--size", "",
                       "must have from 1 to " + std::to_string(core::Settings::max_size) +
                           " pixels on each side and at most " +
                           std::to_string(core::Settings::max_pixels) + " in all, got " +
                           to_text(static_cast<float>(across)) + " x " +
                           to_text(static_cast<float>(upward)));
    return {static_cast<int>(across), static_cast<int>(upward)};
}

Values<ImageSize> image_size_on_paper() {
    const auto parse = [](const std::string& option, const std::string& text) -> ImageSize {
        constexpr std::pair<std::string_view, double> units[] = {
            {"cm", 1.0 / 2.54}, {"mm", 1.0 / 25.4}, {"in", 1.0}};
        const std::vector<std::string_view> parts = parts_of(text, 'x');
        double lengths[2] = {0.0, 0.0}, unit = 0.0;
        // A unit behind the height is that of the width, too.
        for (std::size_t i = std::min<std::size_t>(parts.size(), 3); i-- > 0;) {
            std::string_view number = parts[i];
            for (const auto& [name, inches] : units)
                if (number.ends_with(name)) {
                    number.remove_suffix(name.size());
                    unit = inches;
                }
            const float length = to_float(number).value_or(0.0F);
            if (i > 1 || unit == 0.0) break;
            if (!(length > 0.0F && length <= 1e4F)) {
                unit = 0.0;
                break;
            }
            lengths[i] = unit * static_cast<double>(length);
        }
        if (unit > 0.0 && lengths[0] > 0.0) return {lengths[0], lengths[1], true};
        // Numbers with letters other than x are no pixels.
        if (text.find_first_of("0123456789") == 0 &&
            text.find_first_not_of("0123456789+-.xX ") != std::string::npos)
            refuse(option, "a size on paper such as 8.5cm, 85x60mm or 3.3in, or in pixels", text);
        const auto [width, height] = image_size().parse(option, text);
        return {static_cast<double>(width), static_cast<double>(height)};
    };
    const auto text_of = [](const ImageSize& size) {
        return std::to_string(std::lround(size.width)) + "x" +
               std::to_string(std::lround(size.height));
    };
    return Values<ImageSize>("WxH", "", parse, text_of)
        .otherwise(as_in_file, image_size().for_atoms);
}

Values<core::Precision> precisions() {
    std::vector<std::pair<std::string_view, core::Precision>> choices;
    for (const core::Precision precision : core::all_precisions)
        choices.emplace_back(core::name_of(precision), precision);
    return choice(choices);
}

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
