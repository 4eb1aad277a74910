#pragma once

#include "scenes/errors.hpp"
#include "scenes/json/reader.hpp"
#include "tests/scenes/temporary_file.hpp"

#include <stdexcept>
#include <string>

/// The scene that this text is.
inline raylane::core::Scene scene_of(const std::string& text) {
    const TemporaryFile written(text);
    raylane::scenes::InputFile file(written.path());
    return raylane::scenes::read_json(file);
}

/// Why the file is no scene, without its name in front; "" if it is one.
inline std::string complaint_about(const std::filesystem::path& path) {
    try {
        raylane::scenes::InputFile file(path);
        raylane::scenes::read_json(file);
    } catch (const raylane::scenes::BadInput& error) {
        const std::string text = error.what(), name = path.string() + ": ";
        return text.starts_with(name) ? text.substr(name.size())
                                      : "without the file's name: " + text;
    }
    return "";
}

inline std::string complaint_about_text(const std::string& text) {
    return complaint_about(TemporaryFile(text).path());
}

/// A scene but for what is inside of its list of objects.
inline std::string with_objects(const std::string& objects) {
    return R"({"camera": {"from": [0, 0, 50], "at": [0, 0, 0]},
               "lights": [{"type": "point", "position": [30, 30, 30]}],
               "materials": {"clay": {}, "glass": {"transmission": 1}},
               "objects": [)" +
           objects + "]}";
}

/// The shape with this id.
template <class Shape>
Shape shape(const raylane::core::Scene& scene, raylane::core::ShapeId id) {
    for (const auto& block : std::get<raylane::core::Table<Shape>>(scene.shapes()).blocks())
        for (int lane = 0; lane < raylane::core::block_size; ++lane)
            if (block.ids[lane] == id) return block.get(lane);
    throw std::out_of_range("no such shape of this kind");
}
