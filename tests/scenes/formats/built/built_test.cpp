#include "scenes/export/export.hpp"
#include "scenes/export/writers.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/built/built_file.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/tool/checkpoint/fingerprint.hpp"
#include "simd/stream/stream_tracer.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/places.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <algorithm>
#include <cstring>
#include <random>
#include <string>

/// Tests of built files (.rl), which hold a scene in its memory layout.
using namespace raylane;
using namespace raylane::scenes;

namespace {

std::vector<core::Color> image_of(const core::Scene& scene, core::Precision precision,
                                  int width = 32) {
    core::Settings settings = scene.settings();
    settings.height = std::max(1, width * settings.height / settings.width);
    settings.width = width;
    settings.grid = 1;
    settings.quality = 0.0F;
    return simd::render(scene, settings, {.precision = precision}).film.pixels();
}

std::string json_of(const core::Scene& scene) {
    std::string json;
    TextFile text([&](std::string_view piece) { json += piece; });
    Differences differences;
    write_json(text, scene, differences, {});
    text.flush();
    return json;
}

void check_same(const core::Scene& again, const core::Scene& scene) {
    CHECK(json_of(again) == json_of(scene));
    CHECK(fingerprint_of(again) == fingerprint_of(scene));
    CHECK(again.bytes() <= scene.bytes());
    CHECK(again.hierarchy().bounds.lower == scene.hierarchy().bounds.lower);
    CHECK(again.hierarchy().bounds.upper == scene.hierarchy().bounds.upper);
    CHECK(again.own_light_count() == scene.own_light_count());
    CHECK(again.auto_camera().fit_camera.has_value() == scene.auto_camera().fit_camera.has_value());
    CHECK(again.auto_camera().lights == scene.auto_camera().lights);
    CHECK(again.auto_camera().depth_cue == scene.auto_camera().depth_cue);
    CHECK(again.polygons().size() == scene.polygons().size());
    for (const core::Precision precision : {core::Precision::exact, core::Precision::robust})
        CHECK(image_of(again, precision) == image_of(scene, precision));
}

/// Returns a scene of spheres in three materials, with some cylinders, boxes in double, polygons
/// and a plane. The spheres are packed if there are at least `pack_from`.
core::Scene mixture(int spheres, std::size_t pack_from) {
    std::mt19937 engine(4);
    std::uniform_real_distribution<float> coordinate(30.0F, 50.0F);
    core::SceneBuilder builder;
    builder.pack_from = pack_from;
    core::Material glass;
    glass.transmission = 0.5F;
    for (const core::Material& material : {core::Material{}, glass, core::Material{}})
        builder.add_material(material);
    builder.add_light({.position = {30, 40, 50}});
    builder.camera.from = {70, 43, 42};
    builder.camera.at = {40, 40, 40};
    const auto point = [&] {
        const float x = coordinate(engine), y = coordinate(engine), z = coordinate(engine);
        return core::Vec3f(x, y, z);
    };
    for (int i = 0; i < spheres; ++i)
        builder.add(core::Sphere{point(), i % 7 == 0 ? 0.5F : 0.25F},
                    static_cast<core::MaterialIndex>(i % 3));
    for (int i = 0; i < 40; ++i) {
        builder.add(core::CappedCylinder{point(), {0, 1, 0}, 0.125F}, 0);
        builder.add(
            core::BoxOf<double>{core::Vec3d(0.1 * i), {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}}, 1);
        const core::Vec3f a = point();
        const core::Triangle triangles[] = {
            {a, a + core::Vec3f(1, 0, 0), a + core::Vec3f(0, 1, 0)},
            {a, a + core::Vec3f(0, 1, 0), a + core::Vec3f(-1, 0, 0)}};
        builder.add_polygon(std::span<const core::Triangle>(triangles), 2);
    }
    builder.add(core::Plane{{0, -12, 0}, {0, 1, 0}}, 0);
    return std::move(builder).build();
}

std::string complaint(const std::filesystem::path& path) {
    try {
        load_scene(path);
    } catch (const BadInput& bad) {
        return bad.what();
    }
    return "";
}

} // namespace

TEST_CASE("a built file keeps every shipped scene unchanged or refuses its solids") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path built = directory.path() / "a.rl";
    int same = 0, solids = 0;
    for (const auto& entry : std::filesystem::directory_iterator(
             std::filesystem::path(RAYLANE_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() != ".json" || entry.path().stem().extension() == ".schema")
            continue;
        CAPTURE(entry.path());
        const core::Scene scene = load_scene(entry.path());
        if (scene.solids().any()) {
            CHECK_THROWS_AS(export_scene(built, scene), BadInput);
            ++solids;
            continue;
        }
        export_scene(built, scene);
        check_same(load_scene(built), scene);
        ++same;
    }
    CHECK(same >= 10);
    CHECK(solids >= 1);
}

TEST_CASE("a built file keeps packed spheres and atoms with an automatic camera unchanged") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path built = directory.path() / "a.rl";
    const core::Scene packed = mixture(3000, 0), plain = mixture(3000, 1'000'000);
    REQUIRE(std::get<core::Table<core::Sphere>>(packed.shapes()).is_packed());
    CHECK(fingerprint_of(packed) == fingerprint_of(plain));
    for (const core::Scene* scene : {&packed, &plain}) {
        export_scene(built, *scene);
        check_same(load_scene(built), *scene);
    }
    const std::filesystem::path atoms =
        directory.write("a.xyz", "3\n\nO 0 0 0\nH 1 0 0\nH 0 1 0\n");
    LoadOptions options;
    options.drawing.opacity = 0.5F;
    for (const LoadOptions& with : {LoadOptions{}, options}) {
        const core::Scene scene = load_scene(atoms, with);
        if (scene.solids().any()) continue;
        export_scene(built, scene);
        const core::Scene again = load_scene(built);
        check_same(again, scene);
        CHECK(again.lights().size() > again.own_light_count());
    }
    const core::Scene empty = parse_scene("e.json", R"({"camera": {"from": [0, 0, 5],
        "at": [0, 0, 0]}, "background": [1, 0, 0], "objects": []})");
    export_scene(built, empty);
    check_same(load_scene(built), empty);
}

TEST_CASE("a loaded scene stays valid when its built file is replaced or removed") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path built = directory.path() / "a.rl";
    const core::Scene scene = mixture(3000, 0);
    export_scene(built, scene);
    const core::Scene first = load_scene(built);
    const core::Scene copy = first; // shares the arrays
    CHECK(copy.hierarchy().nodes.data() == first.hierarchy().nodes.data());
    export_scene(built, mixture(10, 0));
    std::filesystem::remove(built);
    check_same(first, scene);
    check_same(copy, scene);
}

TEST_CASE("a built file is read if it is compressed or its name has no ending") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path built = directory.path() / "a.rl", other = directory.path() / "b";
    const core::Scene scene = mixture(100, 0);
    export_scene(built, scene);
    std::filesystem::copy(built, other);
    check_same(load_scene(other), scene);
    REQUIRE(std::system(("gzip " + built.string()).c_str()) == 0);
    check_same(load_scene(built.string() + ".gz"), scene);
}

TEST_CASE("a truncated built file or one of another version is refused") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path built = directory.path() / "a.rl";
    export_scene(built, mixture(40, 0));
    const std::string content = tests::content_of(built);
    for (std::size_t size = 0; size < content.size(); size += size < 4096 ? 1 : 977) {
        directory.write("a.rl", content.substr(0, size));
        CHECK(complaint(built).find("a.rl: ") != std::string::npos);
    }
    std::string other = content;
    other[16] = 99;
    directory.write("a.rl", other);
    CHECK(complaint(built).find("a.rl: was built by another version of raylane: build it again") !=
          std::string::npos);
    directory.write("a.rl", "raylane is a text");
    CHECK(complaint(built).find("a.rl: must be ") != std::string::npos);
}

TEST_CASE("a built file with any bit of its header changed is refused") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path built = directory.path() / "a.rl";
    export_scene(built, mixture(40, 0));
    const std::string content = tests::content_of(built);
    CHECK(complaint(built).empty());
    for (std::size_t bit = 0; bit < 64 * 8; ++bit) {
        CAPTURE(bit);
        std::string other = content;
        other[bit / 8] = static_cast<char>(other[bit / 8] ^ (1 << bit % 8));
        directory.write("a.rl", other);
        CHECK(complaint(built).find("a.rl: ") != std::string::npos);
    }
}

TEST_CASE("a built file includes no other file") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path built = directory.path() / "a.rl";
    export_scene(built, mixture(40, 0));
    directory.write("b", R"({"materials": {}})");
    std::string content = tests::content_of(built);
    const std::string said = "\"background\": [0, 0, 0]";
    std::string other = "\"include\": [\"b\"]";
    other.resize(said.size(), ' ');
    const std::size_t at = content.find(said);
    REQUIRE(at != std::string::npos);
    content.replace(at, said.size(), other);
    seal(content);
    directory.write("a.rl", content);
    CHECK(complaint(built).find("/include/0: must not be included by a built scene") !=
          std::string::npos);
}

namespace {

/// Renders the scene and traces rays through it.
void use(const core::Scene& scene) {
    image_of(scene, core::Precision::exact, 4);
    const std::vector<float> zero(8, 0.5F), one(8, 1.0F);
    std::vector<float> t(8), x(8), y(8), z(8);
    std::vector<core::ShapeId> shape(8);
    std::vector<std::uint8_t> entering(8);
    const simd::RayStream<float> rays = {8,
                                         {zero.data(), zero.data(), zero.data()},
                                         {one.data(), one.data(), one.data()},
                                         nullptr,
                                         nullptr,
                                         nullptr};
    simd::StreamTracer(scene, 1, simd::best_isa(), core::Precision::exact)
        .nearest(rays, {t.data(), {x.data(), y.data(), z.data()}, shape.data(), entering.data()});
}

/// Returns whether a built file with this content is read, and uses the scene if so.
bool is_read(const tests::TemporaryDirectory& directory, const std::string& content) {
    const std::filesystem::path path = directory.write("a.rl", content);
    try {
        use(load_scene(path));
        return true;
    } catch (const BadInput& bad) {
        CHECK(std::string(bad.what()).find("a.rl") != std::string::npos);
        return false;
    }
}

} // namespace

TEST_CASE("a built file with a changed byte is refused and does no harm with a valid checksum") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path built = directory.path() / "a.rl";
    std::mt19937 engine(9);
    for (const std::size_t pack_from : {std::size_t{0}, std::size_t{1'000'000}}) {
        const core::Scene scene = mixture(100, pack_from);
        CHECK(std::get<core::Table<core::Sphere>>(scene.shapes()).is_packed() == (pack_from == 0));
        export_scene(built, scene);
        const std::string content = tests::content_of(built);
        int refused = 0, read = 0;
        const int rounds = tests::fixed_rounds(800, 300, 3000);
        for (int round = 0; round < rounds; ++round) {
            std::string other = content;
            const std::size_t at = engine() % other.size();
            switch (engine() % 3) {
            case 0:
                other[at] = static_cast<char>(other[at] ^ (1 << engine() % 8));
                break;
            case 1:
                other[at] = static_cast<char>(engine());
                break;
            default: // an aligned number of four bytes, such as a count
                for (std::size_t i = at / 4 * 4; i < std::min(other.size(), at / 4 * 4 + 4); ++i)
                    other[i] = engine() % 2 == 0 ? '\xFF' : '\0';
            }
            if (other != content) CHECK(!is_read(directory, other));
            seal(other);
            (is_read(directory, other) ? read : refused) += 1;
        }
        CAPTURE(refused, read);
        CHECK(refused > rounds / 20);
        CHECK(read > rounds / 20);
    }
}

namespace {

/// Returns a deep copy of an array. A plain copy shares the elements.
template <class T>
core::BigArray<T> with_own(const core::BigArray<T>& array) {
    core::BigArray<T> own(array.size());
    std::copy(array.begin(), array.end(), own.begin());
    return own;
}

} // namespace

TEST_CASE("the check of a built file's shapes refuses inconsistent ones") {
    core::Workers alone;
    const auto shapes_of = [](const core::Scene& scene) {
        core::BuiltShapes shapes;
        shapes.tables = scene.shapes();
        shapes.material_of = scene.material_indices();
        shapes.polygons.assign(scene.polygons().begin(), scene.polygons().end());
        shapes.hierarchy = scene.hierarchy();
        return shapes;
    };
    const core::Scene plain = mixture(300, 1'000'000);
    const core::BuiltShapes right = shapes_of(plain);
    check(right, 3, alone);
    CHECK_THROWS_AS(check(right, 2, alone), core::InvalidValue);
    const auto refused = [&](const auto& change) {
        core::BuiltShapes shapes = right;
        shapes.hierarchy.nodes = with_own(right.hierarchy.nodes);
        change(shapes);
        try {
            check(shapes, 3, alone);
        } catch (const core::InvalidValue& invalid) {
            return std::string(invalid.what());
        }
        return std::string("nothing");
    };
    const auto nodes = [](core::BuiltShapes& shapes) { return shapes.hierarchy.nodes.data(); };
    CHECK(refused([&](auto& shapes) { nodes(shapes)[0].upper[1][0] -= 1.0F; }) ==
          "a shape outside of its bounds");
    CHECK(refused([](auto& shapes) {
              core::BigArray<core::WideNode>& new_nodes = shapes.hierarchy.nodes;
              constexpr int last = core::block_size - 1;
              core::WideNode* const node =
                  std::find_if(new_nodes.begin(), new_nodes.end(), [](const auto& wide_node) {
                      return wide_node.children[last].empty();
                  });
              REQUIRE(node != new_nodes.end());
              node->lower[2][last] = -1.0F;
          }) == "a shape outside of its bounds");
    // A plane in an unused lane, which has no id: filters would report a shape that does not exist.
    CHECK(refused([](auto& shapes) {
              auto& planes = std::get<core::Table<core::Plane>>(shapes.tables);
              core::Blocks<core::Plane> blocks;
              blocks.floats = with_own(planes.plain_blocks());
              for (auto& row : blocks.floats[0].values)
                  row[1] = row[0];
              planes = {std::move(blocks), planes.size()};
          }) == "an invalid shape");
    CHECK(refused([&](auto& shapes) { nodes(shapes)[0].children[0] = core::Child::node(0); }) ==
          "nodes that do not form a tree");
    CHECK(refused([&](auto& shapes) { nodes(shapes)[0].children[0] = core::Child(); }) ==
          "a child after an empty one");
    CHECK(refused([&](auto& shapes) {
              nodes(shapes)[0].children[0] = core::Child::block(core::Kind::sphere, 1 << 20);
          }) == "a missing or repeated block");
    CHECK(refused([](auto& shapes) { shapes.polygons[1].last = shapes.polygons[2].first; }) ==
          "polygons out of order");
    CHECK(refused([](auto& shapes) { shapes.material_of.truncate(10); }) ==
          "inconsistent numbers of shapes");
    CHECK(refused([](auto& shapes) { shapes.tables = core::Tables(); }) != "nothing");
    // Shapes that count as another one of their kind.
    const auto merge = [](core::BuiltShapes& shapes, core::Kind kind, core::MergedShape merged,
                          std::size_t more) {
        shapes.merged[static_cast<std::size_t>(kind)] = {merged};
        core::with_table(shapes.tables, kind, [&]<class Shape>(core::Table<Shape>& table) {
            core::Blocks<Shape> blocks;
            blocks.floats = table.plain_blocks();
            blocks.doubles = table.doubles();
            table = {std::move(blocks), table.size() + more};
        });
        if (more != 0) shapes.material_of.push_back(0); // an id for the additional shape
    };
    const auto with_merged = [&](core::Kind kind, core::MergedShape merged, std::size_t more) {
        return refused([&](auto& shapes) { merge(shapes, kind, merged, more); });
    };
    const auto count = static_cast<core::ShapeId>(plain.shape_count());
    const core::ShapeId box = 301; // behind 300 spheres and a cylinder
    CHECK(with_merged(core::Kind::box, {count, box}, 1) == "nothing");
    CHECK(with_merged(core::Kind::box, {count, box}, 0) == "other numbers of shapes than stated");
    CHECK(with_merged(core::Kind::box, {count, 300}, 1) == "merged shapes out of order");
    CHECK(with_merged(core::Kind::box, {count + 1, box}, 1) == "merged shapes out of order");
    CHECK(with_merged(core::Kind::box, {box, box}, 1) == "merged shapes out of order");
    // An id that is stored in a table of another kind, and one that is merged twice.
    CHECK(with_merged(core::Kind::box, {box + 1, box}, 1) == "merged shapes out of order");
    CHECK(refused([&](auto& shapes) {
              merge(shapes, core::Kind::sphere, {count, 0}, 1);
              merge(shapes, core::Kind::box, {count, box}, 1);
          }) == "merged shapes out of order");
}
