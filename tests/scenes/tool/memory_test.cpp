#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <cstdlib>
#include <fstream>

/// Tests of the tool if memory runs out at any of its allocations: see failing_memory.c.
using namespace raylane::tests;

namespace {

const std::string molecule = "4\nammonia\nN 0 0 0.1\nH 0 0.94 -0.27\n"
                             "H 0.81 -0.47 -0.27\nH -0.81 -0.47 -0.27\n";
const std::string pov = R"(#version 3.7;
#declare R = 1;
#macro Ball(X) sphere { <X, 0, 0>, R pigment { color rgb <1, 0, 0> } finish { reflection 0.2 } } #end
camera { location <0, 0, -6> look_at 0 }
light_source { <4, 6, -5> color rgb 1 }
union { Ball(-0.5) Ball(0.5) }
difference { box { -1, 1 } sphere { 0, 1.2 } translate 2*y pigment { checker color rgb 1 color rgb 0 } }
)";

/// Settings of failing_memory.c. Allocation number `at` fails; 0: none does.
struct Heap {
    long at = 0;
    bool for_good = false; ///< all later allocations fail, too
};

Outcome render(const ToolFixture& fixture, const std::string& scene, const std::string& threads,
               const Heap& heap) {
    Setup setup;
    setup.in_child = [heap] {
        ::setenv("LD_PRELOAD", RAYLANE_FAILING_MEMORY, 1);
        ::setenv("RAYLANE_ALLOCATIONS", "allocations", 1);
        ::setenv("RAYLANE_FAIL_AT", std::to_string(heap.at).c_str(), 1);
        if (heap.for_good) ::setenv("RAYLANE_FAIL_ON", "1", 1);
    };
    return fixture.run({"render", scene, "-o", "out/picture.png", "--size", "40x30", "--quiet",
                        "--threads", threads},
                       setup);
}

/// Returns true if the tool made the expected image or ended with one line of error and no file.
/// Some allocations can be done without: then a refusal changes nothing.
bool is_right(const ToolFixture& fixture, const Outcome& outcome, const std::string& expected) {
    const auto image = fixture.output() / "picture.png";
    const bool is_there = std::filesystem::exists(image);
    if (is_there && content_of(image) != expected) return false;
    std::filesystem::remove(image);
    if (!fixture.is_output_empty() || !outcome.exited || !outcome.out.empty()) return false;
    if (outcome.code == 0) return is_there && outcome.err.empty();
    return outcome.code == 3 && is_one_line(outcome.err) && outcome.err.starts_with("raylane: ");
}

/// Step from one refused allocation to the next, which RAYLANE_TEST_STRIDE sets. The command line
/// comes first and takes most of the allocations.
long stride() {
    const char* const wanted = std::getenv("RAYLANE_TEST_STRIDE");
    return wanted != nullptr ? std::atol(wanted) : is_full() ? 137 : 311;
}

void check_all(const std::string& name, const std::string& scene) {
    const ToolFixture fixture;
    fixture.write(name, scene);
    for (const char* threads : {"1", "2"})
        for (const bool for_good : {false, true}) {
            const Outcome usual = render(fixture, name, threads, {});
            REQUIRE(usual.code == 0);
            const std::string expected = content_of(fixture.output() / "picture.png");
            std::filesystem::remove(fixture.output() / "picture.png");
            long count = 0;
            std::ifstream(fixture.path() / "allocations") >> count;
            REQUIRE(count > 500);
            long refused = 0;
            // The last thousand, which render and write, are tested more densely.
            for (long at = 1; at <= count; at += at + 1000 < count ? stride() : 1 + stride() / 4) {
                const Outcome outcome = render(fixture, name, threads, {at, for_good});
                CAPTURE(name, threads, for_good, at, count, outcome.code, outcome.err);
                REQUIRE(is_right(fixture, outcome, expected));
                refused += outcome.code == 3 ? 1 : 0;
            }
            CHECK(refused > 10);
        }
}

} // namespace

TEST_CASE("memory that runs out at any allocation gives an error of one line") {
    SECTION("JSON") {
        check_all("s.json", ball);
    }
    SECTION("a molecule") {
        check_all("s.xyz", molecule);
    }
    SECTION("POV-Ray's language") {
        check_all("s.pov", pov);
    }
}
