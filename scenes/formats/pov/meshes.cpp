#include "scenes/formats/pov/expressions.hpp"
#include "scenes/formats/pov/finishes.hpp"
#include "scenes/formats/pov/objects.hpp"
#include "scenes/formats/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raylane::scenes::pov {

namespace {

using core::Vec3d;

void read_mesh_triangle(Tokens& tokens, Mesh& mesh, bool is_smooth) {
    const Place place = tokens.peek().place;
    tokens.expect("{");
    Vec3d v[6];
    for (int i = 0; i < (is_smooth ? 6 : 3); ++i) {
        v[i] = read_vector(tokens);
        skip_comma(tokens);
    }
    MeshTriangle triangle;
    while (!tokens.accept("}")) {
        const Token word = tokens.next();
        if (word.is("texture")) {
            triangle.texture = static_cast<int>(mesh.textures.size());
            mesh.textures.push_back(read_texture(tokens));
        } else if (word.is("uv_vectors")) {
            for (int i = 0; i < 3; ++i) {
                read_tuple(tokens);
                skip_comma(tokens);
            }
        } else {
            fail(word.place, "must be of a triangle, got " + word.quoted());
        }
    }
    core::TriangleOf<double> flat{v[0], is_smooth ? v[2] : v[1], is_smooth ? v[4] : v[2]};
    if (has_no_area(tokens, flat, place)) return;
    if (is_smooth)
        triangle.shape = smooth_or_flat({flat.a, flat.b, flat.c, v[1], v[3], v[5]});
    else
        triangle.shape = flat;
    mesh.triangles.push_back(triangle);
    tokens.budget.keep(sizeof(triangle), place);
}

/// Reads "3, ", the count of the items that follow.
std::size_t read_count(Tokens& tokens) {
    const Place place = tokens.peek().place;
    const double count = read_number(tokens);
    if (!(count >= 0.0 && count <= static_cast<double>(max_shapes)))
        fail(place, "must be a number of vectors or triangles");
    skip_comma(tokens);
    return static_cast<std::size_t>(count);
}

std::vector<Vec3d> read_vectors(Tokens& tokens) {
    std::vector<Vec3d> vectors;
    tokens.expect("{");
    for (std::size_t left = read_count(tokens); left > 0; --left) {
        vectors.push_back(read_vector(tokens));
        skip_comma(tokens);
    }
    tokens.expect("}");
    return vectors;
}

struct Face {
    std::array<std::size_t, 3> corners{};
    int texture = -1;
    Place place{};
};

/// Accepts the vector that gives a mesh an inside, which has no effect. Returns whether it is
/// there.
bool accept_inside(Tokens& tokens) {
    if (!tokens.at("inside_vector")) return false;
    tokens.remark(tokens.next().place, "inside_vector is ignored: the mesh is a surface");
    read_vector(tokens);
    return true;
}

class Mesh2Reader {
  public:
    explicit Mesh2Reader(Tokens& tokens) : tokens_(tokens) {}

    Shared<Mesh> read() {
        while (read_part())
            ;
        if (!normal_faces_.empty() && normal_faces_.size() != faces_.size())
            fail(normal_faces_[0].place, "must be as many as face_indices, " +
                                             std::to_string(faces_.size()) + ", got " +
                                             std::to_string(normal_faces_.size()));
        if (normal_faces_.empty() && normals_.size() == vertices_.size()) normal_faces_ = faces_;
        if (normals_.empty()) normal_faces_.clear();
        for (std::size_t i = 0; i < faces_.size(); ++i)
            add(faces_[i], normal_faces_.empty() ? nullptr : &normal_faces_[i]);
        return std::make_shared<const Mesh>(std::move(mesh_));
    }

  private:
    /// Returns false at a word that is not a part of a mesh2.
    bool read_part() {
        if (tokens_.accept("vertex_vectors")) {
            vertices_ = read_vectors(tokens_);
        } else if (tokens_.accept("normal_vectors")) {
            normals_ = read_vectors(tokens_);
        } else if (tokens_.accept("uv_vectors") || tokens_.accept("uv_indices")) {
            tokens_.skip_braces();
        } else if (tokens_.accept("texture_list")) {
            tokens_.expect("{");
            for (std::size_t left = read_count(tokens_); left > 0; --left) {
                tokens_.expect("texture");
                mesh_.textures.push_back(read_texture(tokens_));
                skip_comma(tokens_);
            }
            tokens_.expect("}");
        } else if (tokens_.accept("face_indices")) {
            faces_ = read_faces(true);
        } else if (tokens_.accept("normal_indices")) {
            normal_faces_ = read_faces(false);
        } else {
            return accept_inside(tokens_);
        }
        return true;
    }

    std::vector<Face> read_faces(bool with_textures) {
        std::vector<Face> faces;
        tokens_.expect("{");
        for (std::size_t left = read_count(tokens_); left > 0; --left) {
            Face face{.place = tokens_.peek().place};
            const Vec3d corners = read_vector(tokens_);
            for (int i = 0; i < 3; ++i) {
                if (!(corners[i] >= 0.0 && corners[i] <= static_cast<double>(max_shapes)))
                    fail(face.place, "must be three indices");
                face.corners[static_cast<std::size_t>(i)] = static_cast<std::size_t>(corners[i]);
            }
            skip_comma(tokens_);
            if (with_textures && !tokens_.at("<") && !tokens_.at("}")) read_textures(face);
            faces.push_back(face);
        }
        tokens_.expect("}");
        return faces;
    }

    /// Reads one texture, or one for each corner.
    void read_textures(Face& face) {
        std::size_t of_corners[3] = {};
        int count = 0;
        while (count < 3 && !tokens_.at("<") && !tokens_.at("}")) {
            of_corners[count++] = read_count(tokens_);
            if (of_corners[count - 1] >= mesh_.textures.size())
                fail(face.place, "must have indices into texture_list, below " +
                                     std::to_string(mesh_.textures.size()) + ", got " +
                                     std::to_string(of_corners[count - 1]));
        }
        face.texture = static_cast<int>(of_corners[0]);
        const auto color = [&](int i) { return mesh_.textures[of_corners[i]]->pigment.color.at; };
        if (count == 3 && (color(0) != color(1) || color(0) != color(2))) {
            tokens_.remark(face.place, "different colours at the corners of a triangle are not "
                                       "supported: the first one is used");
            if (color(1) == color(2)) face.texture = static_cast<int>(of_corners[1]);
        }
    }

    const Vec3d& at(const std::vector<Vec3d>& vectors, std::size_t index, const Place& place) {
        if (index >= vectors.size())
            fail(place, "must have indices below " + std::to_string(vectors.size()) + ", got " +
                            std::to_string(index));
        return vectors[index];
    }

    void add(const Face& face, const Face* normals) {
        const auto corner = [&](std::size_t i) {
            return at(vertices_, face.corners[i], face.place);
        };
        const core::TriangleOf<double> flat{corner(0), corner(1), corner(2)};
        if (has_no_area(tokens_, flat, face.place)) return;
        MeshTriangle triangle{flat, face.texture};
        if (normals != nullptr) {
            const auto normal = [&](std::size_t i) {
                return at(normals_, normals->corners[i], normals->place);
            };
            triangle.shape =
                smooth_or_flat({flat.a, flat.b, flat.c, normal(0), normal(1), normal(2)});
        }
        mesh_.triangles.push_back(triangle);
        tokens_.budget.keep(sizeof(triangle), face.place);
    }

    Tokens& tokens_;
    Mesh mesh_;
    std::vector<Vec3d> vertices_, normals_;
    std::vector<Face> faces_, normal_faces_;
};

} // namespace

Shared<Mesh> read_mesh(Tokens& tokens) {
    Mesh mesh;
    for (;;) {
        if (tokens.accept("triangle"))
            read_mesh_triangle(tokens, mesh, false);
        else if (tokens.accept("smooth_triangle"))
            read_mesh_triangle(tokens, mesh, true);
        else if (!accept_inside(tokens))
            return std::make_shared<const Mesh>(std::move(mesh));
    }
}

Shared<Mesh> read_mesh2(Tokens& tokens) {
    return Mesh2Reader(tokens).read();
}

/// Returns whether all corners are as near to a plane as POV-Ray wants them.
bool are_coplanar(const std::vector<Vec3d>& corners) {
    constexpr double tolerance = 1e-10, too_small = 1e-10; // POV-Ray's
    Vec3d along(0.0), normal(0.0);
    for (const Vec3d& corner : corners) {
        const Vec3d offset = corner - corners[0];
        if (core::squared_length(along) <= too_small)
            along = offset;
        else if (core::squared_length(normal) <= too_small)
            normal = core::cross(along, offset);
    }
    if (!(core::squared_length(normal) > 0.0)) return true; // has no area
    normal = core::normalized(normal);
    return std::all_of(corners.begin(), corners.end(), [&](const Vec3d& corner) {
        return std::abs(core::dot(corner - corners[0], normal)) <= tolerance;
    });
}

/// Reads a polygon of one outline. Its last corner may repeat the first.
Shared<Mesh> read_polygon(Tokens& tokens) {
    const Place place = tokens.peek().place;
    std::vector<Vec3d> corners;
    std::vector<core::Vec3f> outline;
    for (std::size_t left = read_count(tokens); left > 0; --left) {
        corners.push_back(read_vector(tokens));
        skip_comma(tokens);
    }
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        outline.push_back(core::convert<float>(corners[i]));
        if (i != 0 && corners[i] == corners[0])
            fail(place, "must be a polygon of one outline, got one of several");
    }
    if (!are_coplanar(corners)) {
        tokens.remark(place, "polygons with corners outside their plane are omitted");
        return std::make_shared<const Mesh>();
    }
    Mesh mesh;
    Triangulator triangulator;
    for (const auto& [a, b, c] : triangulator.triangulate(outline))
        mesh.triangles.push_back(
            {core::TriangleOf<double>{corners[a], corners[b], corners[c]}, -1});
    if (mesh.triangles.empty()) fail(place, "must be a polygon that has an area");
    return std::make_shared<const Mesh>(std::move(mesh));
}

} // namespace raylane::scenes::pov
