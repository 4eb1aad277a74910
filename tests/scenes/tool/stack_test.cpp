#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sanitized.hpp"

#include <sys/resource.h>

/// Tests that deep scenes need no more stack than README.md says or are refused.
using namespace raylane::tests;

namespace {

constexpr rlim_t stated = 1 << 20;                          // bytes
constexpr rlim_t allowed = sanitized ? 8 * stated : stated; // sanitizers' frames are larger

std::string times(int count, const std::string& text) {
    std::string joined;
    for (int i = 0; i < count; ++i)
        joined += text;
    return joined;
}

Outcome render(const ToolFixture& fixture, const std::string& scene,
               const std::vector<std::string>& options = {}) {
    Setup setup;
    setup.in_child = [] {
        const rlimit limit{allowed, allowed};
        ::setrlimit(RLIMIT_STACK, &limit);
    };
    return fixture.run(
        joined({"render", scene, "-o", "out/picture.png", "--size", "16x12", "-q"}, options),
        setup);
}

void check_drawn(const std::string& name, const std::string& scene) {
    const ToolFixture fixture;
    fixture.write(name, scene);
    const Outcome outcome = render(fixture, name);
    CAPTURE(name, scene.substr(0, 300), outcome.err);
    CHECK(outcome.code == 0);
}

/// Checks that the scene is refused in one line. JSON may have two errors, one a line.
void check_refused(const std::string& name, const std::string& scene) {
    const ToolFixture fixture;
    fixture.write(name, scene);
    const Outcome outcome = render(fixture, name);
    CAPTURE(name, scene.substr(0, 300), outcome.err);
    CHECK(outcome.code == 2);
    const auto lines = std::count(outcome.err.begin(), outcome.err.end(), '\n');
    CHECK(lines >= 1);
    CHECK(lines <= (name.ends_with(".json") ? 2 : 1));
    CHECK(fixture.is_output_empty());
}

std::string json(const std::string& objects, const std::string& more = "") {
    return R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]}, "background": [0, 0, 1],
        "lights": [{"type": "point", "position": [3, 3, 3]}],
        "materials": {"m": {"index": 1.5, "transmission": 1, "reflectivity": 0.5}}, )" +
           more + R"("objects": [)" + objects + "]}";
}

/// Returns solids that are nested this deep.
std::string nested(int depth) {
    std::string begin, end;
    for (int i = 0; i < depth; ++i) {
        constexpr const char* types[] = {"union", "difference", "intersection"};
        begin += std::string(R"({"material": "m", "type": ")") + types[i % 3] +
                 R"(", "rotate": [0, 3, 0], "objects": [)";
        end += R"(, {"type": "sphere", "center": [0, 0, 0.5], "radius": 0.75}]})";
    }
    return begin + R"({"type": "sphere", "center": [0, 0, 0], "radius": 1})" + end;
}

const std::string pov = "camera { location <0, 0, -6> look_at 0 }\nlight_source { 9, rgb 1 }\n";

} // namespace

TEST_CASE("the deepest scenes are rendered with the documented stack") {
    check_drawn("csg.json", json(nested(127)));
    std::string definitions =
        R"("definitions": {"d0": {"type": "sphere", "center": [0, 0, 0], "radius": 1})";
    for (int i = 1; i < 250; ++i)
        definitions +=
            ", \"d" + std::to_string(i) +
            R"(": {"type": "union", "objects": [{"type": "instance", "of": "d)" +
            std::to_string(i - 1) +
            R"(", "translate": [0.01, 0, 0]}, {"type": "sphere", "center": [0, 0, 0], "radius": 1}]})";
    check_drawn("instances.json", json(R"({"type": "instance", "of": "d249", "material": "m"})",
                                       definitions + "}, "));
    std::string shells;
    for (int i = 0; i < 300; ++i)
        shells += std::string(i == 0 ? "" : ", ") +
                  R"({"type": "sphere", "material": "m", "center": [0, 0, 0], "radius": )" +
                  std::to_string(2 - 0.005 * i) + "}";
    check_drawn("shells.json",
                json(shells, R"("limits": {"max_depth": 1000, "min_weight": 0.001}, )"));
    for (const char* engine : {"vector", "reference"}) { // two mirrors face each other
        const ToolFixture fixture;
        fixture.write("mirrors.json", R"({"camera": {"from": [0, 0, 0.5], "at": [0.1, 0, 0]},
            "limits": {"max_depth": 1000, "min_weight": 0},
            "lights": [{"type": "point", "position": [0, 0, 0.75]}],
            "materials": {"m": {"reflectivity": 1, "ambient": 1}},
            "objects": [{"type": "plane", "material": "m", "point": [0, 0, 0], "normal": [0, 0, 1]},
                        {"type": "plane", "material": "m", "point": [0, 0, 1], "normal": [0, 0, -1]}]})");
        const Outcome outcome = render(fixture, "mirrors.json", {"--engine", engine});
        CAPTURE(engine, outcome.err);
        CHECK(outcome.code == 0);
    }
    check_drawn("macros.pov", pov + "#macro M(I) #if (I < 120) union { M(I+1) sphere { I*x, 1 } } "
                                    "#else sphere { 0, 1 } #end #end\nM(1)");
    check_drawn("solids.pov", pov + times(120, "difference { ") + "sphere { 0, 1 }" +
                                  times(120, " sphere { x, 0.1 } }"));
    check_drawn("if.pov",
                pov + times(20'000, "#if (1)\n") + "sphere { 0, 1 }\n" + times(20'000, "#end\n"));
    check_drawn("brackets.pov",
                pov + "sphere { 0, " + times(60, "abs(") + "1" + times(60, ")") + " }");
}

TEST_CASE("scenes that are too deep are refused") {
    constexpr int many = 100'000;
    check_refused("csg.json", json(nested(2000)));
    for (const char* start : {"[", "{\"objects\": [", "{\"materials\": ", "{\"camera\": "})
        for (const char* more : {"[", "{\"a\": "})
            check_refused("deep.json", start + times(many, more));
    for (const char* start :
         {"(", "-", "abs(", "<", "(1?", "array[1] {", "!", "union { ", "sphere { 0, 1 texture { ",
          "1+(", "#if (1)\n", "#macro M(I) M(I+1) #end\nM(1)\n", "#while (1)\n"}) {
        const bool is_object = std::string(start).find_first_of("#{") != std::string::npos;
        check_refused("deep.pov",
                      pov + (is_object ? "" : "#declare A = ") + times(many / 10, start));
    }
    const ToolFixture fixture;
    fixture.write("a.xyz", "1\n\nC 0 0 0\n");
    for (const char* start : {"(", "not ", "within 1 of "}) {
        const Outcome outcome =
            render(fixture, "a.xyz", {"--select", times(many / 20, start) + "all"});
        CAPTURE(start, outcome.err);
        CHECK(outcome.code == 2);
        CHECK(is_one_line(outcome.err));
    }
}
