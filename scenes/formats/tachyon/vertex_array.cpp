#include "scenes/formats/tachyon/vertex_array.hpp"

#include <cmath>

namespace raylane::scenes {

core::Color mean_color(const core::Color& a, const core::Color& b, const core::Color& c) {
    core::Color mean = (a + b + c) / 3.0F;
    for (int channel = 0; channel < 3; ++channel)
        mean[channel] = std::round(255.0F * mean[channel]) / 255.0F;
    return mean;
}

void TachyonVertexArray::read(const Use& use) {
    words_.expect("NUMVERTS");
    count_ = words_.whole_number("NUMVERTS", 0, max_int);
    while (!words_.accept("END_VERTEXARRAY")) {
        if (words_.accept("COORDS")) {
            read_vectors("COORDS", points_, /*are_vectors=*/true);
        } else if (words_.accept("NORMALS")) {
            read_vectors("NORMALS", normals_, /*are_vectors=*/true);
        } else if (words_.accept("COLORS")) {
            read_vectors("COLORS", colors_, /*are_vectors=*/false);
        } else if (words_.accept("TRISTRIP")) {
            const int corners = words_.whole_number("TRISTRIP", 3, max_int);
            int a = corner(), b = corner();
            for (int i = 2; i < corners; ++i) {
                const int c = corner();
                use_triangle(use, a, b, c);
                a = b;
                b = c;
            }
        } else if (words_.accept("TRIMESH")) {
            const int triangles = words_.whole_number("TRIMESH", 0, max_int);
            for (int i = 0; i < triangles; ++i) {
                const int a = corner(), b = corner(), c = corner();
                use_triangle(use, a, b, c);
            }
        } else if (is_keyword(words_.peek(), "TEXTURE")) {
            texture_ = read_texture_();
        } else {
            words_.refuse_next("COORDS, NORMALS, COLORS, TEXTURE, TRISTRIP, TRIMESH or "
                               "END_VERTEXARRAY");
        }
    }
}

void TachyonVertexArray::read_vectors(std::string_view field, std::vector<core::Vec3f>& list,
                                      bool are_vectors) {
    list.clear();
    for (int i = 0; i < count_; ++i)
        list.push_back(are_vectors ? words_.vector(field) : words_.triple(field));
}

int TachyonVertexArray::corner() {
    if (points_.empty()) words_.refuse_next("COORDS of more than 0 corners before triangles");
    return words_.whole_number("corner", 0, count_ - 1);
}

void TachyonVertexArray::use_triangle(const Use& use, int a, int b, int c) {
    const auto at = [](const std::vector<core::Vec3f>& list, int i) {
        return list.empty() ? core::Vec3f(0.0F) : list[static_cast<std::size_t>(i)];
    };
    TachyonTexture texture = texture_;
    if (!colors_.empty()) {
        const core::Color color_a = at(colors_, a), color_b = at(colors_, b),
                          color_c = at(colors_, c);
        texture.color = mean_color(color_a, color_b, color_c);
        if (color_a != color_b || color_b != color_c)
            words_.remark(
                "colours at the corners of a triangle are not supported: their mean is used");
        else
            texture.color = color_a;
    }
    use({at(points_, a), at(points_, b), at(points_, c), at(normals_, a), at(normals_, b),
         at(normals_, c)},
        texture);
}

} // namespace raylane::scenes
