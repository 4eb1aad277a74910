#pragma once

#include "core/scene/solid_description.hpp"
#include "scenes/export/text_file.hpp"
#include "scenes/files/errors.hpp"

#include <set>
#include <string>
#include <vector>

namespace raylane::scenes {

/// Phrases for features that another program, or a reader of the file, treats differently.
using Differences = std::set<std::string>;
inline constexpr const char* lost_polygons = "polygons made of triangles";

/// Writes the automatic camera in place of the view that follows from it, as far as JSON can
/// express the auto_camera. Throws core::InvalidValue for a solid that is nested deeper than the
/// reader accepts.
void write_json(TextFile& file, const core::Scene& scene, Differences& differences);
/// Writes only the settings, on one line.
void write_json_settings(TextFile& file, const core::Settings& settings);
/// Writes everything except the settings, the names of materials, and the shapes outside of
/// constructed solids. Writes the view itself, not the automatic camera.
void write_json_without_shapes(TextFile& file, const core::Scene& scene);
/// Writes everything except the objects. Writes the view itself, not the automatic camera.
void write_json_without_objects(TextFile& file, const core::Scene& scene);
/// These also throw core::InvalidValue for content that the format cannot express at all.
void write_nff(TextFile& file, const core::Scene& scene, Differences& differences);
void write_pov(TextFile& file, const core::Scene& scene, Differences& differences);

/// Calls visit(shape, id) for each shape in the tables outside of constructed solids, and
/// visit_solid(description, id) for each constructed solid. Goes in the order of ids, which decides
/// where surfaces coincide.
template <class Visit, class VisitSolid>
void for_each_by_id(const core::Scene& scene, const Visit& visit, const VisitSolid& visit_solid) {
    struct Listed {
        core::Place place;
        core::Kind kind;
        bool exists;
    };
    std::vector<Listed> shapes(scene.shape_count());
    core::for_each_table(scene.shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
        for (std::uint32_t block = 0; block < table.blocks().size(); ++block)
            for (std::uint8_t lane = 0; lane < core::block_size; ++lane) {
                const core::Place place{block, lane};
                if (const core::ShapeId id = table.id(place); id != core::no_shape)
                    shapes[id] = {place, core::kind_of<Shape>, true};
            }
    });
    for (core::ShapeId id = 0; id < shapes.size(); ++id)
        if (scene.solids().has(id)) {
            if (scene.solids().solid_of(id) == id)
                visit_solid(
                    core::description_of(scene, scene.solids().root_of(scene.solids().part_of(id))),
                    id);
        } else if (shapes[id].exists)
            core::with_table(scene.shapes(), shapes[id].kind,
                             [&](const auto& table) { visit(table.get(shapes[id].place), id); });
}

/// Skips constructed solids and their parts.
template <class Visit>
void for_each_by_id(const core::Scene& scene, const Visit& visit) {
    for_each_by_id(scene, visit, [](const core::Solid&, core::ShapeId) {});
}

} // namespace raylane::scenes
