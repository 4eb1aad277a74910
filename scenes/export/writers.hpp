#pragma once

#include "core/scene/solid_description.hpp"
#include "scenes/export/text_file.hpp"
#include "scenes/files/errors.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace raylane::scenes {

/// Phrases for features that another program, or a reader of the file, treats differently.
using Differences = std::set<std::string>;
inline constexpr const char* lost_polygons = "polygons made of triangles";

/// Writes the automatic camera in place of the view that follows from it, as far as JSON can
/// express the auto_camera. Throws core::InvalidValue for a solid that is nested deeper than the
/// reader accepts, for an image that comes from no file, and for patterns that have moved with
/// their objects. `folder`: that of the file; names of images are relative to it.
void write_json(TextFile& file, const core::Scene& scene, Differences& differences,
                const std::filesystem::path& folder);
/// Writes only the settings, on one line.
void write_json_settings(TextFile& file, const core::Settings& settings);
/// Writes everything except the settings, the names of materials, images, and the shapes outside of
/// constructed solids. Writes the view itself, not the automatic camera.
void write_json_without_shapes(TextFile& file, const core::Scene& scene);
/// Writes everything except the objects. Writes the view itself, not the automatic camera.
void write_json_without_objects(TextFile& file, const core::Scene& scene);
/// These also throw core::InvalidValue for content that the format cannot express at all.
void write_nff(TextFile& file, const core::Scene& scene, Differences& differences);
void write_pov(TextFile& file, const core::Scene& scene, Differences& differences);

/// The places of a scene's shapes in its tables, by id.
class PlacesById {
  public:
    explicit PlacesById(const core::Scene& scene)
        : scene_(scene), listed_(scene.material_indices().stored_count()) {
        core::for_each_table(scene.shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
            for (std::uint32_t block = 0; block < table.blocks().size(); ++block)
                core::for_each_in_block(table, block, [&](core::Place place, core::ShapeId id) {
                    listed_[scene.material_indices().stored_index(id)] = {
                        place, core::kind_of<Shape>, true};
                });
        });
        if (scene.copies() == nullptr) return;
        for (const core::Copies::Set& set : scene.copies()->sets())
            of_prototypes_.emplace_back(*set.prototype);
    }

    /// Calls visit(shape) if the tables have the shape.
    template <class Visit>
    void visit(core::ShapeId id, const Visit& visit) const {
        const std::size_t stored = scene_.material_indices().stored_index(id);
        if (stored == core::MaterialIndices::no_index) return visit_in_copy(id, visit);
        visit_stored(stored, visit);
    }

  private:
    template <class Visit>
    void visit_stored(std::size_t stored, const Visit& visit) const {
        const Listed& listed = listed_[stored];
        if (listed.exists)
            core::with_table(scene_.shapes(), listed.kind,
                             [&](const auto& table) { visit(table.get(listed.place)); });
    }
    /// Prototypes have no copies themselves.
    template <class Visit>
    void visit_in_copy(core::ShapeId id, const Visit& visit) const {
        const core::Copies& copies = *scene_.copies();
        const core::Copies::Copy copy = copies.copy_with(id);
        const auto set = static_cast<std::size_t>(&copy.set - copies.sets().data());
        const core::Placer placer(copies.placement(copy.set.first_copy + copy.number));
        const PlacesById& prototype = of_prototypes_[set];
        const core::ShapeId original = id - core::Copies::first_id_of(copy);
        prototype.visit_stored(prototype.scene_.material_indices().stored_index(original),
                               [&](const auto& shape) {
                                   if constexpr (requires { placer(shape); }) visit(placer(shape));
                               });
    }

    struct Listed {
        core::Place place;
        core::Kind kind;
        bool exists;
    };
    const core::Scene& scene_;
    std::vector<Listed> listed_; // without those of copies
    std::vector<PlacesById> of_prototypes_;
};

/// Calls visit(shape, id) for each shape in the tables outside of constructed solids, and
/// visit_solid(description, id) for each constructed solid. Goes in the order of ids, which decides
/// where surfaces coincide.
template <class Visit, class VisitSolid>
void for_each_by_id(const core::Scene& scene, const Visit& visit, const VisitSolid& visit_solid) {
    const PlacesById places(scene);
    for (std::size_t i = 0; i < scene.shape_count(); ++i) {
        const auto id = static_cast<core::ShapeId>(i);
        if (!scene.solids().has(id))
            places.visit(id, [&](const auto& shape) { visit(shape, id); });
        else if (scene.solids().solid_of(id) == id)
            visit_solid(
                core::description_of(scene, scene.solids().root_of(scene.solids().part_of(id))),
                id);
    }
}

/// Skips constructed solids and their parts.
template <class Visit>
void for_each_by_id(const core::Scene& scene, const Visit& visit) {
    for_each_by_id(scene, visit, [](const core::Solid&, core::ShapeId) {});
}

} // namespace raylane::scenes
