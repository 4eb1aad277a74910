#pragma once

#include "core/scene/scene.hpp"
#include "scenes/formats/tachyon/clip.hpp"
#include "scenes/formats/tachyon/texture.hpp"

#include <string>
#include <unordered_map>
#include <vector>

namespace raylane::scenes {

/// Reads the objects of a Tachyon scene, and their textures.
class TachyonObjects {
  public:
    TachyonObjects(core::SceneBuilder& builder, TachyonWords& words, const TachyonShading& shading)
        : builder_(builder), words_(words), materials_(builder, words, shading) {}

    /// Reads the statement if it is that of an object, a texture or a clip group. Returns false if
    /// it is another statement.
    bool read();

  private:
    void read_sphere();
    void read_cylinder();
    void read_finite_cylinder();
    void read_polycylinder();
    void read_triangle();
    void read_smooth_triangle();
    void read_colored_triangle();
    void read_plane();
    void read_ring();
    void read_box();
    void read_vertex_array();
    void read_texture_definition();
    void read_texture_alias();
    void read_clip_group();
    void end_clip_group();
    void skip_landscape();
    void skip_volume();
    void skip_polygons();
    void skip_image();

    /// Reads TEXTURE, or the name of a texture.
    TachyonTexture texture();
    core::MaterialIndex material() { return materials_.index_of(texture()); }
    core::SmoothTriangle corners_and_normals();

    template <class Shape>
    void add(const Shape& shape, core::MaterialIndex material);
    /// Adds the part of the solid's surface that is inside of `by` and of all clip planes.
    void add_cut(core::Solid solid, std::vector<core::Solid> by, core::MaterialIndex material);
    void add_finite_cylinder(const core::Vec3f& base, const core::Vec3f& apex, float radius,
                             core::MaterialIndex material);
    void add_triangle(const core::SmoothTriangle& triangle, core::MaterialIndex material);
    void leave_out() { words_.remark("objects without a size are omitted"); }

    core::SceneBuilder& builder_;
    TachyonWords& words_;
    TachyonMaterials materials_;
    std::unordered_map<std::string, TachyonTexture> textures_;
    std::vector<TachyonClip> clips_;
};

} // namespace raylane::scenes
