#include "raylane/raylane.hpp"
#include "tests/places.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/support/catch.hpp"

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace raylane;

namespace {

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string with_objects(const std::string& objects) {
    return R"({"camera": {"from": [0, 0, 90], "at": [0, 0, 0]},
        "lights": [{"type": "directional", "direction": [0, -1, 0]}], "materials": {"m": {}},
        "objects": [)" +
           objects + "]}";
}

std::string refusal_of(const auto& act) {
    return tests::message_of<BadInput>(act);
}

} // namespace

TEST_CASE("a scene is loaded from a file or refused with an error of one line") {
    CHECK(load(RAYLANE_SOURCE_DIR "/scenes/sphere.json").shape_count() > 0);
    const tests::TemporaryDirectory directory;
    const auto message = [&](const std::string& name) {
        return refusal_of([&] { load(directory.path() / name); });
    };
    const std::string folder = directory.path().string() + "/";
    CHECK(message("none.json") == folder + "none.json: no such file");
    CHECK(message("") == folder + ": must be a file, got a directory");
    directory.write(
        "a.json",
        with_objects(R"({"type": "sphere", "material": "m", "center": [0, 0, 0], "radius": -1})"));
    CHECK(message("a.json") == folder + "a.json:3:88: /objects/0/radius: must be positive, got -1");
}

TEST_CASE("each error of a file is available by itself") {
    try {
        parse(with_objects("3,\n {\"a\": 1}"), "x.json");
        FAIL("must throw");
    } catch (const BadInput& bad) {
        REQUIRE(bad.errors().size() == 2);
        const InputError& error = bad.errors()[1];
        CHECK(error.file == "x.json");
        CHECK(error.line == 4);
        CHECK(error.column == 2);
        CHECK(error.place == "/objects/1");
        CHECK(error.message == "must have the key \"type\"");
        CHECK(bad.what() == std::string("x.json:3:21: /objects/0: must be an object, got 3\n"
                                        "x.json:4:2: /objects/1: must have the key \"type\""));
    }
    try {
        load("/none.json");
        FAIL("must throw");
    } catch (const BadInput& bad) {
        REQUIRE(bad.errors().size() == 1);
        CHECK(bad.errors()[0].line == 0);
        CHECK(bad.errors()[0].message == "no such file");
    }
}

TEST_CASE("scenes are parsed from text") {
    const std::string nff =
        "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\nresolution 8 9\n"
        "l 0 9 9\nf 1 1 1 1 0 0 0 1\ns 0 0 0 1\n";
    CHECK(parse(nff).shape_count() == 1);
    CHECK(parse(nff, "x.nff").settings().height == 9);
    const auto message = [](const std::string& text, const std::string& name) {
        return refusal_of([&] { parse(text, name); });
    };
    CHECK(message("", "x") == "x: must be a scene or atoms, got an empty file");
    CHECK(message("\xEF\xBB\xBF", "x") == "x: must be a scene or atoms, got an empty file");
    CHECK(message(nff, "x.json").starts_with("x.json:1:1: "));
    CHECK(message(nff + "s 0 0 0\n", "x").starts_with("x:11: "));
    CHECK(message("{}", "x") ==
          "x:1:1: must have the key \"camera\"\nx:1:1: must have the key \"objects\"");
    CHECK(refusal_of([] { parse("\x01"); }) ==
          "scene: must be a scene or atoms in a text format, got a binary file");
    // Longer than the part that is examined to find the format.
    const std::string blank(200'000, ' ');
    CHECK(parse(blank + with_objects("") + blank, "x.json").shape_count() == 0);
}

TEST_CASE("atoms are read with or without the edges of their cell") {
    const std::string atom = "1\nLattice=\"3 0 0 0 4 0 0 0 5\"\nC 1 1 1\n";
    CHECK(parse_atoms(atom, "a.xyz", {{"cell", "off"}}).shape_count() == 1);
    CHECK(parse_atoms(atom, "a.xyz", {{"cell", "on"}}).shape_count() == 1 + 8 + 12);
    CHECK(refusal_of([] {
              parse_atoms("1\n\nC 1 1 1\n", "a.xyz", {{"cell", "on"}});
          }) == "--cell: must have a cell to show, but a.xyz has none");
}

TEST_CASE("atoms are read in the representations that select them") {
    const std::string atoms = "2\n\nC 0 0 0\nO 1.2 0 0\n";
    const auto looks = [](const std::vector<std::string>& texts) {
        AtomOptions options;
        for (const std::string& text : texts)
            options.emplace_back("representations", text);
        return options;
    };
    CHECK(
        parse_atoms(atoms, "a.xyz", looks({"all: points", "element O: licorice"})).shape_count() ==
        2);
    CHECK(parse_atoms(atoms, "a.xyz", looks({"element O: spheres"})).shape_count() == 1);
    CHECK(refusal_of([&] {
              parse_atoms(atoms, "a.xyz", looks({"all", "all: opacity 2"}));
          }) == "representations/1: column 14: opacity must be above 0 and at most 1, got \"2\"");
    const tests::TemporaryFile file(atoms, ".xyz"), scene(R"({"objects": []})");
    CHECK(load_atoms(file.path(), looks({"element O: spheres"})).shape_count() == 1);
    CHECK(load_atoms(file.path(), {}).shape_count() == load(file.path()).shape_count());
    CHECK(refusal_of([&] { load_atoms(scene.path(), looks({"all"})); }) ==
          "representations: goes with a file of atoms, but " + scene.path().string() +
              " is a scene");
}

TEST_CASE("options of atoms have the names and words of the command line") {
    const std::string salt = "2\nLattice=\"4 0 0 0 4 0 0 0 4\"\nNa 0 0 0\nCl 2 2 2\n";
    const auto count = [&](const AtomOptions& options) {
        return parse_atoms(salt, "a.xyz", options).shape_count();
    };
    CHECK(count({{"style", "spheres"}}) == 9);
    CHECK(count({{"style", "spheres"}, {"boundary", "off"}}) == 2);
    CHECK(count({{"style", "spheres"}, {"repeat", "2x1x1"}, {"cell", "on"}}) == 14 + 2 * 20);
    CHECK(count({{"show", "element Na: spheres"}, {"show", "element Cl: spheres"}}) == 9);
    // The plane cuts four copies of Na, and removes the others.
    CHECK(count({{"style", "spheres"}, {"look", "flat"}, {"view", "best"}, {"cut", "z<0"}}) ==
          4 + 1);
    CHECK(refusal_of([&] {
              count({{"polyhedron", "Na"}});
          }) == "polyhedron: must be the name of an option, did you mean \"polyhedra\"?");
    CHECK(refusal_of([&] {
              parse_atoms("{}", "a.json", {{"cell", "on"}});
          }) == "cell: goes with a file of atoms, but a.json is a scene");
}

TEST_CASE("the pages contain the example program that is tested") {
    const std::string program =
        tests::content_of(RAYLANE_SOURCE_DIR "/scenes/api/examples/hits.cpp");
    REQUIRE(!program.empty());
    for (const char* const page : {"/README.md", "/scenes/api/cpp/README.md"}) {
        CAPTURE(page);
        const std::string text = tests::content_of(std::string(RAYLANE_SOURCE_DIR) + page);
        CHECK(text.find("```cpp\n" + program + "```") != std::string::npos);
    }
}

TEST_CASE("a saved scene is the same when it is loaded again") {
    const tests::TemporaryDirectory directory;
    const auto hits_of = [](const Scene& scene) {
        const float origins[3][3] = {{0, 0, 9}, {0.5F, 0.25F, 9}, {3, 0.125F, 9}};
        float x[3], y[3], z[3], zero[3] = {0, 0, 0}, back[3] = {-1, -1, -1};
        for (int i = 0; i < 3; ++i) {
            x[i] = origins[i][0];
            y[i] = origins[i][1];
            z[i] = origins[i][2];
        }
        const Tracer tracer(scene);
        std::vector<float> t(3);
        std::vector<ShapeId> shape(3);
        RaySpan rays;
        rays.origin_x = x;
        rays.origin_y = y;
        rays.origin_z = z;
        rays.direction_x = rays.direction_y = zero;
        rays.direction_z = back;
        HitSpan hits;
        hits.t = t;
        hits.shape_id = shape;
        tracer.intersect(rays, hits);
        return std::pair(t, shape);
    };
    const std::string balls =
        R"({"type": "sphere", "material": "m", "center": [0.1, 0, 0], "radius": 1},
        {"type": "sphere", "material": "m", "center": [3, 0, 0], "radius": 0.3})";
    const std::string solid = R"({"type": "difference", "material": "m", "objects": [
        {"type": "sphere", "center": [0.1, 0, 0], "radius": 1},
        {"type": "sphere", "center": [0, 0, 1], "radius": 0.5}]})";
    const auto path = [&](const char* name) { return directory.path() / name; };
    for (const std::string& objects : {balls, balls + "," + solid}) {
        const Scene scene = parse(with_objects(objects), "x.json");
        for (const char* name : {"a.json", "a.rl"}) {
            CAPTURE(objects, name);
            if (objects != balls && std::string(name) == "a.rl") {
                CHECK(refusal_of([&] {
                          save(scene, path(name));
                      }).ends_with("cannot store constructed solids: use .json or .pov"));
                continue;
            }
            save(scene, path(name), [](const std::string& remark) { FAIL(remark); });
            const Scene again = load(path(name));
            CHECK(again.shape_count() == scene.shape_count());
            CHECK(hits_of(again) == hits_of(scene));
            std::filesystem::remove(path(name));
        }
    }
    const Scene scene = parse(
        R"({"camera": {"type": "orthographic", "from": [0, 0, 9], "at": [0, 0, 0], "height": 4},
        "fog": {"type": "linear", "start": 1, "end": 9}, "lights": [{"type": "point", "position": [1, 1, 1]}],
        "materials": {"m": {}}, "objects": [)" +
            balls + "]}",
        "x.json");
    std::vector<std::string> remarks;
    save(scene, path("a.pov"), [&](const std::string& remark) { remarks.push_back(remark); });
    REQUIRE(!remarks.empty());
    CHECK(remarks[0].starts_with(path("a.pov").string() +
                                 ": differs from the scene, because the format cannot express: "));
    CHECK(refusal_of([&] {
              save(scene, path("a.xyz"));
          }).ends_with("must end in .json, .nff, .pov or .rl"));
    CHECK(refusal_of([&] { save(scene, "-"); }).ends_with("must end in .json, .nff, .pov or .rl"));
    CHECK_THROWS_AS(save(scene, path("none/a.json")), SystemRefused);
    CHECK(directory.names() == std::vector<std::string>{"a.pov"});

    SceneBuilder dark; // no lights: for rays alone
    dark.add(Sphere{{0, 0, 0}, 1}, dark.add_material(Material()));
    save(dark.build(), path("dark.json"));
    CHECK(load(path("dark.json")).shape_count() == 1);
}

TEST_CASE("the library treats - as an ordinary file name") {
    CHECK(refusal_of([] { load("-"); }) == "./-: no such file");
}

namespace {

/// Sets RAYLANE_THREADS during its lifetime.
class ThreadsInEnvironment {
  public:
    explicit ThreadsInEnvironment(const char* text) {
        if (const char* before = std::getenv("RAYLANE_THREADS")) before_ = before;
        ::setenv("RAYLANE_THREADS", text, 1);
    }
    ~ThreadsInEnvironment() {
        if (before_)
            ::setenv("RAYLANE_THREADS", before_->c_str(), 1);
        else
            ::unsetenv("RAYLANE_THREADS");
    }
    ThreadsInEnvironment(const ThreadsInEnvironment&) = delete;
    ThreadsInEnvironment& operator=(const ThreadsInEnvironment&) = delete;

  private:
    std::optional<std::string> before_;
};

} // namespace

TEST_CASE("an invalid RAYLANE_THREADS is an InvalidValue wherever it is used") {
    const Scene scene = parse(with_objects(""));
    SceneBuilder builder;
    builder.add(Sphere{{0, 0, 0}, 1}, builder.add_material({}));
    for (const char* text : {"abc", "0", "99999"}) {
        const ThreadsInEnvironment environment(text);
        const auto field_of = [](const auto& act) -> std::string {
            try {
                act();
            } catch (const InvalidValue& invalid) {
                return invalid.field;
            }
            return "";
        };
        CHECK(field_of([] { load(RAYLANE_SOURCE_DIR "/scenes/sphere.json"); }) ==
              "RAYLANE_THREADS");
        CHECK(field_of([] { parse(with_objects("")); }) == "RAYLANE_THREADS");
        CHECK(field_of([&] { builder.build(); }) == "RAYLANE_THREADS");
        CHECK(builder.shape_count() == 1); // the builder keeps its shape
        CHECK(field_of([&] { render(scene); }) == "RAYLANE_THREADS");
        CHECK(field_of([&] { Tracer asked(scene); }) == "RAYLANE_THREADS");
        CHECK(field_of([&] {
                  render(scene, {.threads = 1});
                  Tracer asked(scene, {.threads = 1});
              }).empty());
    }
    CHECK(builder.build().shape_count() == 1);
}

TEST_CASE("a scene of atoms that is saved as JSON has light from every view") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path path = directory.path() / "a.json";
    const Scene scene = parse("3\n\nC 0 0 0\nO 2 1 -3\nN 0 3 1\n", "atoms.xyz");
    save(scene, path, [](const std::string& remark) { FAIL(remark); });
    const Scene again = load(path);
    Settings settings = scene.settings();
    settings.width = 40;
    settings.height = 30;
    const auto drawn = [&](const Scene& loaded) {
        return render(loaded, {.settings = settings}).rgb;
    };
    CHECK(drawn(again) == drawn(scene));
    for (const Vec3 direction : {Vec3{0, -1, 0}, Vec3{1, 2, -3}}) {
        const Camera camera = scene.camera_on_all(direction);
        const Scene seen = scene.seen_by(camera);
        CHECK(drawn(again.seen_by(camera)) == drawn(seen));
        std::vector<std::string> remarks;
        save(seen, path, [&](const std::string& remark) { remarks.push_back(remark); });
        REQUIRE(remarks.size() == 1);
        CHECK(remarks[0].ends_with(": automatic fog"));
        CHECK(drawn(load(path)) == drawn(seen));
    }
}

TEST_CASE("parsing reports features of a file that the scene does not have") {
    const std::string pov = "camera { location <0, 0, -5> look_at 0 }\n"
                            "light_source { <1, 2, -3> color rgb 1 shadowless }\n"
                            "sphere { 0, 1 pigment { color rgb 1 } }\n";
    std::vector<std::string> remarks;
    const Scene scene =
        parse(pov, "a.pov", [&](const std::string& remark) { remarks.push_back(remark); });
    CHECK(scene.shape_count() == 1);
    CHECK(remarks ==
          std::vector<std::string>{"a.pov:2:39: shadowless is ignored: the lights cast shadows"});
    CHECK(parse(pov, "a.pov").shape_count() == 1);
}

TEST_CASE("images of atoms have annotations, or an SVG file has them") {
    const std::string atoms = "2\n\nC 0 0 0\nO 3 0 0\n";
    const Scene plain = parse_atoms(atoms, "a.xyz", {});
    const Scene scene = parse_atoms(atoms, "a.xyz",
                                    {{"labels", "element C: {element}{index}"},
                                     {"distance", "index 1: index 2"},
                                     {"scale_bar", "auto"},
                                     {"legend", "on"}});
    const tests::TemporaryDirectory directory;
    RenderOptions options{.settings = scene.settings()};
    options.settings->width = 160;
    options.settings->height = 120;
    options.settings->grid = 1;
    options.settings->quality = 0.0F;
    const Image bare = render(plain, options);
    options.annotations = directory.path() / "a.svg";
    std::vector<std::string> remarks;
    options.on_remark = [&](const std::string& remark) { remarks.push_back(remark); };
    CHECK((render(scene, options).rgb == bare.rgb));
    const std::string svg = tests::content_of(options.annotations);
    CHECK(has(svg, ">C1</text>"));
    CHECK(has(svg, ">3.00 \u00c5</text>"));
    CHECK(has(svg, "id=\"scale-bar\""));
    REQUIRE(remarks.size() == 1);
    CHECK(remarks[0] == "scale_bar holds at the depth of the point that the camera looks at; "
                        "orthographic makes it hold everywhere");
    // They follow the camera.
    Camera camera = scene.camera();
    camera.from.x += 3.0F;
    const RenderOptions bare_options{.settings = options.settings};
    options.annotations = directory.path() / "b.svg";
    CHECK((render(scene.seen_by(camera), options).rgb ==
           render(plain.seen_by(camera), bare_options).rgb));
    CHECK(tests::content_of(options.annotations) != svg);

    const auto message = [&](const Scene& subject, const char* file) {
        options.annotations = file;
        return tests::message_of<InvalidValue>([&] { render(subject, options); });
    };
    CHECK(message(plain, "a.svg") == "annotations: goes with a scene of atoms that has "
                                     "annotations, such as label or scale_bar");
    CHECK(message(scene, "a.png") == "annotations: must end with .svg, got \"a.png\"");
    const auto refusal = [&](const AtomOptions& annotations) {
        return refusal_of([&] { parse_atoms(atoms, "a.xyz", annotations); });
    };
    CHECK(refusal({{"labels", "all: a"}, {"labels", "element Fe: a"}}) ==
          "labels/1: \"element Fe\" selects none of 2 atoms");
    CHECK(refusal({{"labels", "all"}}) ==
          "labels/0: must be SELECTION: TEXT, such as \"residue 25: Asp 25\", got \"all\"");
    CHECK(refusal({{"font", "serif"}}) ==
          "font: goes with legend, scale_bar, triad, label or distance");
    CHECK(refusal({{"triad", "abc"}}) == "triad: must be xyz: the atoms have no cell");
    std::vector<std::string> differences;
    save(scene, directory.path() / "a.json",
         [&](const std::string& remark) { differences.push_back(remark); });
    REQUIRE(differences.size() == 1);
    CHECK(differences[0].ends_with("cannot express: annotations"));

    options.annotations.clear();
    try {
        CHECK((render(scene, options).rgb != bare.rgb));
        options.crop = PixelRect{0, 0, 80, 120};
        CHECK(render(scene, options).width == 80);
    } catch (const SystemRefused& refused) { // built without Pango
        CHECK(has(refused.what(), "libpango1.0-dev"));
    }
}
