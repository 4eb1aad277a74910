#pragma once

#include "scenes/formats/tachyon/texture.hpp"

#include <functional>
#include <vector>

namespace raylane::scenes {

/// Reads the statement after VERTEXARRAY: separate lists of corners, and triangles that refer to
/// them.
class TachyonVertexArray {
  public:
    /// Receives each triangle and its texture, with the colour of its corners if these have
    /// colours. Normals that are not given are 0.
    using Use = std::function<void(const core::SmoothTriangle&, const TachyonTexture&)>;

    TachyonVertexArray(TachyonWords& words, const std::function<TachyonTexture()>& read_texture)
        : words_(words), read_texture_(read_texture) {}

    void read(const Use& use);

  private:
    void read_vectors(std::string_view field, std::vector<core::Vec3f>& list, bool are_vectors);
    void use_triangle(const Use& use, int a, int b, int c);
    int corner();

    TachyonWords& words_;
    const std::function<TachyonTexture()>& read_texture_;
    int count_ = 0;
    std::vector<core::Vec3f> points_, normals_, colors_;
    TachyonTexture texture_;
};

/// Returns the mean of three colours in steps of 1/255, to limit the number of different materials.
core::Color mean_color(const core::Color& a, const core::Color& b, const core::Color& c);

} // namespace raylane::scenes
