#pragma once

#include "tests/scenes/api/c_handles.hpp"
#include "tests/scenes/api/exam_in_double.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

/// Rays and rows of the C interface beside those of C++, for its tests.
namespace raylane::tests {

/// Describes rays to C. Stores the number of refused rays.
inline raylane_double_rays to_c(const DoubleRays& rays, std::uint64_t& refused) {
    return {rays.size(),
            rays.origin[0].data(),
            rays.origin[1].data(),
            rays.origin[2].data(),
            rays.direction[0].data(),
            rays.direction[1].data(),
            rays.direction[2].data(),
            rays.t_min.data(),
            rays.t_max.data(),
            nullptr,
            nullptr,
            nullptr,
            &refused};
}

/// Returns `count` rays through the cube from -2 to 2. Every other ray has a limit.
inline DoubleRays rays_through_all(int count, std::uint64_t seed) {
    Random random(seed);
    DoubleRays rays;
    for (int i = 0; i < count; ++i) {
        const core::Vec3d to = random.cube(2.0);
        const core::Vec3d from = random.direction() * 9.0;
        rays.add({from, to - from}, 0.0, i % 2 == 0 ? 1.0 : endless);
    }
    return rays;
}

/// Returns true if a column in C has the elements of one in C++; NULL stands for no elements.
template <class Element>
bool is_same(const Element* in_c, const std::vector<Element>& column) {
    if (column.empty()) return in_c == nullptr;
    return in_c != nullptr && std::equal(column.begin(), column.end(), in_c);
}

inline void check_offsets(const RowsHandle& in_c, const std::vector<std::uint64_t>& first) {
    REQUIRE(raylane_rows_count(in_c.get()) == first.size() - 1);
    CHECK(is_same(raylane_rows_first(in_c.get()), first));
}

inline void check_same(const RowsHandle& in_c, const CrossingRows& rows) {
    const raylane_rows* const c = in_c.get();
    check_offsets(in_c, rows.first);
    CHECK(is_same(raylane_rows_t(c), rows.t));
    CHECK(is_same(raylane_rows_shape_id(c), rows.shape_id));
    CHECK(is_same(raylane_rows_entering(c), rows.entering));
    CHECK(is_same(raylane_rows_face(c), rows.face));
    CHECK(is_same(raylane_rows_tied(c), rows.tied));
    CHECK(is_same(raylane_rows_touching(c), rows.touching));
    CHECK(is_same(raylane_rows_normal_x(c), rows.normal_x));
    CHECK(is_same(raylane_rows_normal_y(c), rows.normal_y));
    CHECK(is_same(raylane_rows_normal_z(c), rows.normal_z));
    CHECK(is_same(raylane_rows_normal_double_x(c), rows.normal_double_x));
    CHECK(is_same(raylane_rows_normal_double_y(c), rows.normal_double_y));
    CHECK(is_same(raylane_rows_normal_double_z(c), rows.normal_double_z));
    CHECK(raylane_rows_length(c) == nullptr);
    CHECK(raylane_rows_material(c) == nullptr);
    CHECK(raylane_rows_on_surface(c) == nullptr);
}

inline void check_same(const RowsHandle& in_c, const LengthRows& rows) {
    check_offsets(in_c, rows.first);
    CHECK(is_same(raylane_rows_material(in_c.get()), rows.material));
    CHECK(is_same(raylane_rows_length(in_c.get()), rows.length));
    CHECK(raylane_rows_shape_id(in_c.get()) == nullptr);
}

inline void check_same(const RowsHandle& in_c, const SolidLengthRows& rows) {
    check_offsets(in_c, rows.first);
    CHECK(is_same(raylane_rows_shape_id(in_c.get()), rows.shape_id));
    CHECK(is_same(raylane_rows_length(in_c.get()), rows.length));
    CHECK(raylane_rows_material(in_c.get()) == nullptr);
}

inline void check_same(const RowsHandle& in_c, const SolidRows& rows) {
    check_offsets(in_c, rows.first);
    CHECK(is_same(raylane_rows_shape_id(in_c.get()), rows.shape_id));
    CHECK(is_same(raylane_rows_inside(in_c.get()), rows.inside));
    CHECK(is_same(raylane_rows_on_surface(in_c.get()), rows.on_surface));
    CHECK(raylane_rows_t(in_c.get()) == nullptr);
}

/// Checks that both scenes give the same crossings with normals, and returns the crossings.
inline CrossingRows check_crossings(const SceneHandle& in_c, const Scene& scene,
                                    const DoubleRays& rays) {
    const TracerHandle tracer = tracer_of(in_c);
    std::uint64_t refused = 77;
    const raylane_double_rays asked = to_c(rays, refused);
    CrossingRows rows;
    Tracer(scene).crossings(rays.span(), rows, {.normals = true});
    check_same(made<RowsHandle>([&](raylane_rows** to) {
                   return raylane_crossings_doubles(tracer.get(), &asked, 0, 1, to);
               }),
               rows);
    CHECK(refused == 0);
    return rows;
}

/// Checks that a query of rows gives the same in C and in C++.
template <class Rows, class InC>
void check_rows(const SceneHandle& in_c, const Scene& scene, const DoubleRays& rays,
                const InC& query,
                void (Tracer::*in_cpp)(const DoubleRaySpan&, Rows&, QueryStatistics*) const) {
    const TracerHandle tracer = tracer_of(in_c);
    std::uint64_t refused = 77;
    const raylane_double_rays asked = to_c(rays, refused);
    Rows found;
    (Tracer(scene).*in_cpp)(rays.span(), found, nullptr);
    check_same(made<RowsHandle>([&](raylane_rows** to) { return query(tracer.get(), &asked, to); }),
               found);
}

/// Checks that a scene with each material of `scene`, and with its lengths in them, was made in C.
inline void check_lengths(const SceneHandle& in_c, const Scene& scene, const DoubleRays& rays) {
    check_rows<LengthRows>(in_c, scene, rays, raylane_path_lengths_doubles, &Tracer::path_lengths);
}

/// The same for lengths inside of solids.
inline void check_solid_lengths(const SceneHandle& in_c, const Scene& scene,
                                const DoubleRays& rays) {
    check_rows<SolidLengthRows>(in_c, scene, rays, raylane_solid_lengths_doubles,
                                &Tracer::solid_lengths);
}

} // namespace raylane::tests
