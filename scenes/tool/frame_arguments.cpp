#include "scenes/tool/frame_arguments.hpp"

#include "scenes/tool/arguments.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace raylane::scenes {

FrameRange FrameRange::of(long count) const {
    const auto place = [&](std::optional<long> at) -> std::optional<long> {
        if (!at || *at >= 0) return at;
        return std::max(0L, *at + count);
    };
    FrameRange range{place(start), place(stop), step, is_one};
    // A single frame before the first one does not exist.
    if (is_one && *start < -count) range.start = std::numeric_limits<long>::max();
    return range;
}

void FrameArguments::add_to(CLI::App& command) {
    const auto add = [&](const char* name, Argument& value, const char* help, const char* type) {
        add_option(command, name, value, help, type)->group(group_of_several);
    };
    add("--frames", frames,
        "Frames of a trajectory of atoms: one number, or START:STOP:STEP as in Python, with a step "
        "of at least 1. Images are numbered by frame. Default: 0.",
        "WHICH");
    add("--turn", turn,
        "Turn the camera to its right around the point that it looks at: IMAGES images, each "
        "turned by DEGREES/IMAGES from the one before.",
        "DEGREES/IMAGES");
    add("--camera-from", camera_from,
        "Frames that an automatic camera and the ranges of colours are fitted to: the first one, "
        "all, or each one separately. Default: first.",
        "first|all|each");
    add_flag(command, "--overwrite,--force", overwrite,
             "Render images of a sequence again that exist already.");
    command.get_option("--overwrite")->group(group_of_several);
}

std::vector<std::pair<std::string, std::string>> FrameArguments::given() const {
    std::vector<std::pair<std::string, std::string>> all;
    const std::pair<const char*, const Argument&> values[] = {
        {"--frames", frames}, {"--turn", turn}, {"--camera-from", camera_from}};
    for (const auto& [name, value] : values)
        if (value) all.emplace_back(name, *value);
    return all;
}

std::optional<FrameRange> FrameArguments::range() const {
    if (!frames) return std::nullopt;
    const auto refuse = [&] {
        throw BadInput("--frames", "",
                       "must be a number or START:STOP:STEP, such as 0:100:2, with a step from 1, "
                       "got \"" +
                           printable(*frames) + "\"");
    };
    const std::vector<std::string_view> parts = parts_of(*frames, ':');
    std::optional<long> numbers[3];
    if (parts.size() > 3) refuse();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].empty()) continue;
        const std::optional<int> number = to_int(parts[i]);
        if (!number) refuse();
        numbers[i] = *number;
    }
    FrameRange range{numbers[0], numbers[1], numbers[2].value_or(1), parts.size() == 1};
    if (range.step < 1 || (range.is_one && !range.start)) refuse();
    return range;
}

bool FrameArguments::is_one() const {
    const std::optional<FrameRange> asked = range();
    return asked && asked->is_one && !turn;
}

std::optional<Turn> FrameArguments::turning() const {
    if (!turn) return std::nullopt;
    const std::vector<std::string_view> parts = parts_of(*turn, '/');
    const std::optional<float> degrees = to_float(parts[0]);
    const int count = parts.size() == 2 ? to_int(parts[1]).value_or(0) : 0;
    if (!degrees || count < 1 || count > most_pictures)
        throw BadInput("--turn", "",
                       "must be DEGREES/IMAGES, such as 360/120, got \"" + printable(*turn) + "\"");
    return Turn{static_cast<double>(*degrees), static_cast<std::size_t>(count)};
}

FitTo FrameArguments::fit_to() const {
    return choice_argument<FitTo>(
        "--camera-from", camera_from.value_or("first"),
        {{"first", FitTo::first}, {"all", FitTo::all}, {"each", FitTo::each}});
}

} // namespace raylane::scenes
