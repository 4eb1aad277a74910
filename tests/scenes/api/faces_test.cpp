#include "tests/scenes/api/ray_arrays.hpp"
#include "tests/support/catch.hpp"

#include <string>
#include <vector>

/// Tests of the rule for lines that run in faces of a solid's parts, and of points in such faces.
using namespace raylane;
using namespace raylane::tests;

namespace {

using Part = raylane::Solid;

enum class Where : std::uint8_t { inside, surface, outside };

/// A solid, a point, and a line through this point that runs in a face of a part.
struct Case {
    std::string name;
    Part solid;
    Vec3 point;
    Where where;
    Vec3 along;
    double length; ///< of the line inside of the solid
};

Part box(const Vec3& lower, const Vec3& upper) {
    return Part(Box{
        lower, {upper.x - lower.x, 0, 0}, {0, upper.y - lower.y, 0}, {0, 0, upper.z - lower.z}});
}

std::vector<Case> cases() {
    const Part cube = box({0, 0, 0}, {2, 2, 2}), next = box({2, 0, 0}, {4, 2, 2}),
               over = box({1, 0, 0}, {4, 2, 2}), inner = box({1, 0.5F, 0.5F}, {4, 1.5F, 1.5F}),
               diagonal = box({2, 2, 0}, {4, 4, 2}), below(Plane{{0, 0, 1}, {0, 0, 1}}),
               ball(Sphere{{3, 1, 1}, 1}), rod(CappedCylinder{{3, 1, 0}, {0, 0, 2}, 1});
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    const Where surface = Where::surface, inside = Where::inside, outside = Where::outside;
    return {
        // Lines in the face of one part: inside of a box, outside of a half-space.
        {"box", union_of({cube}), {0, 1, 1}, surface, y, 2},
        {"half-space", intersection_of({below, cube}), {1, 1, 1}, surface, x, 0},
        {"not half-space", difference_of(cube, {below}), {1, 1, 1}, surface, x, 2},
        // Unions.
        {"united, common face", union_of({cube, next}), {2, 1, 1}, surface, y, 2},
        {"united, own face", union_of({cube, next}), {3, 0, 1}, surface, x, 4},
        {"united, face inside of the other", union_of({cube, over}), {2, 1, 1}, inside, y, 2},
        {"united, common edge", union_of({cube, diagonal}), {2, 2, 1}, surface, z, 2},
        {"united, side that touches", union_of({cube, ball}), {2, 1, 1}, surface, z, 2},
        {"united with a rod, line along it", union_of({cube, rod}), {2, 1, 1}, surface, z, 2},
        // Intersections.
        {"common part, flush faces", intersection_of({cube, over}), {1.5F, 0, 1}, surface, z, 2},
        {"common part, own face", intersection_of({cube, inner}), {1, 1, 1}, surface, z, 1},
        {"contact by a face alone", intersection_of({cube, next}), {2, 1, 1}, surface, z, 2},
        {"contact by an edge alone", intersection_of({cube, diagonal}), {2, 2, 1}, surface, z, 2},
        // Differences. A flush cut leaves nothing there, but the point is on both surfaces.
        {"cut, face of the cut", difference_of(cube, {inner}), {1, 1, 1}, surface, z, 1},
        {"cut, flush faces", difference_of(cube, {over}), {1.5F, 0, 1}, surface, z, 0},
        {"cut, face that is left", difference_of(cube, {over}), {0.5F, 0, 1}, surface, z, 2},
        {"cut, face inside of the cut", difference_of(cube, {over}), {1.5F, 1, 1}, outside, z, 0},
        {"cut by a neighbour", difference_of(cube, {next}), {2, 1, 1}, surface, z, 0},
        {"cut by a rod that touches", difference_of(cube, {rod}), {2, 1, 1}, surface, z, 0},
    };
}

struct Cell {
    ShapeId shape_id = 77;
    MaterialIndex material = 77;
    std::uint8_t on_surface = 77;
};

Cell cell_of(const Tracer& tracer, const Vec3& point) {
    Cell cell;
    tracer.cells(PointSpan{{&point.x, 1}, {&point.y, 1}, {&point.z, 1}},
                 {{&cell.shape_id, 1}, {&cell.material, 1}, {&cell.on_surface, 1}});
    return cell;
}

} // namespace

TEST_CASE(
    "lines in faces of a solid's parts follow one rule, and their points are on the surface") {
    for (const Case& one : cases()) {
        CAPTURE(one.name);
        SceneBuilder builder;
        builder.add(one.solid, builder.add_material({}));
        const Tracer tracer(builder.build());
        Rays rays;
        rays.add({one.point.x - 16 * one.along.x, one.point.y - 16 * one.along.y,
                  one.point.z - 16 * one.along.z},
                 one.along);
        CrossingRows rows;
        tracer.crossings(rays.span(), rows);
        double between = 0.0;
        for (std::size_t k = 0; k < rows.t.size(); ++k)
            between += (rows.entering[k] != 0 ? -1.0 : 1.0) * rows.t[k];
        CHECK(between == one.length);
        // The side of the line at the point, which is at t = 16.
        std::uint8_t is_inside = 0;
        for (std::size_t k = 0; k < rows.t.size() && rows.t[k] < 16.0; ++k)
            is_inside = rows.entering[k];
        CHECK((occluded(tracer, rays)[0] != 0) == (one.length != 0.0));
        LengthRows lengths;
        tracer.path_lengths(rays.span(), lengths);
        CHECK((lengths.length.empty() ? 0.0 : lengths.length[0]) == one.length);
        SolidLengthRows of_solids;
        tracer.solid_lengths(rays.span(), of_solids);
        CHECK(of_solids.length == lengths.length);

        const float px[] = {one.point.x}, py[] = {one.point.y}, pz[] = {one.point.z};
        SolidRows solids;
        tracer.contains(PointSpan{px, py, pz}, solids);
        const Where where = solids.shape_id.empty()     ? Where::outside
                            : solids.on_surface[0] != 0 ? Where::surface
                                                        : Where::inside;
        CHECK(static_cast<int>(where) == static_cast<int>(one.where));
        CHECK((solids.inside.empty() ? 0 : solids.inside[0]) == is_inside);
        CHECK(cell_of(tracer, one.point).shape_id == (is_inside != 0 ? 0 : no_shape));
    }
}

TEST_CASE("points and lines in the common face of two solids are in both") {
    SceneBuilder builder;
    const MaterialIndex water = builder.add_material({}), steel = builder.add_material({});
    builder.add(Box{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, water);
    builder.add(Box{{2, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, steel);
    const Tracer tracer(builder.build());
    Rays rays;
    rays.add({2, 1, -9}, {0, 0, 1});
    LengthRows lengths;
    tracer.path_lengths(rays.span(), lengths);
    CHECK(lengths.length == std::vector<double>{2, 2});
    const float x[] = {2}, one[] = {1};
    SolidRows solids;
    tracer.contains(PointSpan{x, one, one}, solids);
    CHECK(solids.shape_id == std::vector<ShapeId>{0, 1});
    CHECK(solids.on_surface == std::vector<std::uint8_t>{1, 1});
    const Cell cell = cell_of(tracer, {2, 1, 1});
    CHECK(cell.shape_id == 1);
    CHECK(cell.material == steel);
    CHECK(cell.on_surface == 1);
}

TEST_CASE("the cell of a point in a cut face is the body that fills the cut") {
    for (const bool filled_first : {false, true}) {
        CAPTURE(filled_first);
        SceneBuilder builder;
        const MaterialIndex water = builder.add_material({}), steel = builder.add_material({});
        const Part cube = box({0, 0, 0}, {2, 2, 2}),
                   rod(CappedCylinder{{1, 1, 0}, {0, 0, 2}, 0.5F});
        const auto add_cut = [&] { return builder.add(difference_of(cube, {rod}), water); };
        const ShapeId cut = filled_first ? 1 : add_cut();
        const ShapeId filling = builder.add(CappedCylinder{{1, 1, 0}, {0, 0, 2}, 0.5F}, steel);
        if (filled_first) CHECK(add_cut() == cut);
        const Tracer tracer(builder.build());
        // On the rod, inside of it, beside it.
        CHECK(cell_of(tracer, {1.5F, 1, 1}).shape_id == filling);
        CHECK(cell_of(tracer, {1.5F, 1, 1}).on_surface == 1);
        CHECK(cell_of(tracer, {1.25F, 1, 1}).material == steel);
        CHECK(cell_of(tracer, {1.75F, 1, 1}).shape_id == cut);
        CHECK(cell_of(tracer, {1.75F, 1, 1}).material == water);
        CHECK(cell_of(tracer, {5, 1, 1}).shape_id == no_shape);
        CHECK(cell_of(tracer, {5, 1, 1}).material == no_material);
        const float x[] = {1.5F}, one[] = {1};
        SolidRows solids;
        tracer.contains(PointSpan{x, one, one}, solids);
        CHECK(solids.on_surface == std::vector<std::uint8_t>{1, 1});
        CHECK(solids.inside[filled_first ? 0 : 1] == 1);
        CHECK(solids.inside[filled_first ? 1 : 0] == 0);
    }
}
