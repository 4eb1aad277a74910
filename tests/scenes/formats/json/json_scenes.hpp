#pragma once

#include "scenes/files/errors.hpp"
#include "scenes/formats/json/reader.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

#include <sstream>
#include <stdexcept>
#include <string>

namespace raylane::tests {

/// Returns the scene of a JSON text.
inline core::Scene scene_of(const std::string& text) {
    const TemporaryFile written(text);
    scenes::InputFile file(written.path());
    return scenes::read_json(file);
}

/// Returns the errors of a scene file, each line without the file's name ("3:14: ..."), or "" if
/// the file is valid.
inline std::string placed_complaint_about(const std::filesystem::path& path) {
    try {
        scenes::InputFile file(path);
        scenes::read_json(file);
    } catch (const scenes::BadInput& error) {
        const std::string name = path.string() + ":";
        std::string complaint;
        std::istringstream lines(error.what());
        for (std::string line; std::getline(lines, line);) {
            if (!line.starts_with(name)) return "without the file's name: " + line;
            complaint.append(complaint.empty() ? "" : "\n").append(line.substr(name.size()));
        }
        return complaint;
    }
    return "";
}

/// Returns the errors without line and column.
inline std::string complaint_about(const std::filesystem::path& path) {
    std::string complaint;
    std::istringstream lines(placed_complaint_about(path));
    for (std::string line; std::getline(lines, line);)
        complaint.append(complaint.empty() ? "" : "\n")
            .append(line, line.find_first_not_of("0123456789: "), std::string::npos);
    return complaint;
}

inline std::string complaint_about_text(const std::string& text) {
    return complaint_about(TemporaryFile(text).path());
}

inline std::string placed_complaint_about_text(const std::string& text) {
    return placed_complaint_about(TemporaryFile(text).path());
}

/// Returns the text of a scene with these elements in its list of objects.
inline std::string with_objects(const std::string& objects) {
    return R"({"camera": {"from": [0, 0, 50], "at": [0, 0, 0]},
               "lights": [{"type": "point", "position": [30, 30, 30]}],
               "materials": {"clay": {}, "glass": {"transmission": 1}},
               "objects": [)" +
           objects + "]}";
}

/// Objects of the materials "clay", "glass" and "red": a difference, a union that is clipped, and
/// an intersection with a quadric.
inline const std::string three_solids = R"(
        {"type": "difference", "material": "clay", "objects": [
            {"type": "intersection", "objects": [
                {"type": "box", "min": [-1, -1, -1], "max": [1, 1, 1]},
                {"type": "sphere", "center": [0, 0, 0], "radius": 1.3, "material": "red"}]},
            {"type": "difference", "objects": [
                {"type": "cylinder", "base": [0, 0, 0], "axis": [0, 2, 0], "radius": 0.6},
                {"type": "union", "objects": [
                    {"type": "plane", "point": [0, 0.1, 0], "normal": [1, 2, 0.5]},
                    {"type": "ellipsoid", "center": [0, 0.4, 0],
                     "axes": [[0.3, 0, 0], [0, 0.2, 0], [0, 0, 0.5]]}]}]}]},
        {"type": "clip", "material": "glass", "objects": [
            {"type": "union", "objects": [
                {"type": "cone", "base": [2, 0, 0], "axis": [0, 1, 0], "base_radius": 0.5},
                {"type": "sphere", "center": [2, 0.4, 0], "radius": 0.4}]},
            {"type": "plane", "point": [2, 0, 0.1], "normal": [0, 0, 1]},
            {"type": "difference", "objects": [
                {"type": "box", "min": [1, -1, -1], "max": [3, 2, 1]},
                {"type": "sphere", "center": [2, 0.9, 0], "radius": 0.4}]}]},
        {"type": "intersection", "material": "clay", "objects": [
            {"type": "quadric", "center": [-2, 0, 1],
             "matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, -0.1]]},
            {"type": "box", "min": [-3, -0.5, 0], "max": [-1, 0.5, 2]}]})";

/// Returns the text of an object with a shape's keys and a material.
inline std::string object_text(const std::string& shape, const std::string& material) {
    return "{" + shape + R"(, "material": )" + material + "}";
}

/// Returns the shape with this id. Throws std::out_of_range if no shape of this kind has it.
template <class Shape>
core::InDouble<Shape> shape(const core::Scene& scene, core::ShapeId id) {
    const auto& table = std::get<core::Table<Shape>>(scene.shapes());
    for (std::uint32_t block = 0; block < table.blocks().size(); ++block)
        for (std::uint8_t lane = 0; lane < core::block_size; ++lane)
            if (table.id({block, lane}) == id) return table.get({block, lane});
    throw std::out_of_range("no such shape of this kind");
}

} // namespace raylane::tests
