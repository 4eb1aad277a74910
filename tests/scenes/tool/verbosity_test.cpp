#include "simd/isa/isa.hpp"
#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

#include <chrono>
#include <cmath>
#include <csignal>

using namespace raylane::tests;

namespace {

/// A scene that gives a remark.
const std::string with_remark = "camera { location <0, 0, -5> look_at 0 }\n"
                                "light_source { <1, 2, -3> color rgb 1 shadowless }\n"
                                "sphere { 0, 1 pigment { color rgb 1 } }\n";
const std::string remark = "scene.pov:2:39: shadowless is ignored: the lights cast shadows\n";

Setup with_threads(const char* count) {
    Setup setup;
    setup.in_child = [count] { ::setenv("RAYLANE_THREADS", count, 1); };
    return setup;
}

} // namespace

TEST_CASE("the option --quiet suppresses all messages but errors") {
    const ToolFixture fixture;
    fixture.write("scene.pov", with_remark);
    const std::vector<std::string> small = {"render",    "scene.pov", "-o",
                                            "scene.png", "--size",    "16x12"};
    CHECK(fixture.run(small).err == remark);
    CHECK(fixture.run(joined(small, {"--quiet"})).err.empty());
    CHECK(fixture.run(joined(small, {"-q"}), on_terminal()).err.empty());
    CHECK(fixture.run({"convert", "scene.pov", "scene.json", "-q"}).err.empty());
    CHECK(fixture.run({"info", "scene.pov", "-q"}).err.empty());
    CHECK(fixture.run({"render", "none.pov", "-q"}).err == "raylane: none.pov: no such file\n");
    CHECK(fixture.run(joined(small, {"-q", "-v"})).err ==
          "raylane: --quiet: goes without --verbose\n");
}

TEST_CASE("the option --verbose reports the work in a pipe") {
    const ToolFixture fixture;
    const std::string isa(raylane::simd::name_of(raylane::simd::narrowest_isa()));
    const std::string said =
        fixture.render("picture.png", {"-v", "--threads", "1", "--isa", isa}).err;
    CHECK(said.starts_with("scene.json: 1 shapes, read and built in "));
    CHECK(said.find("\nvector engine, " + isa + ", exact precision, 1 threads\n") !=
          std::string::npos);
    CHECK(said.find("\npicture.png: 16 x 12 pixels, ") != std::string::npos);
}

TEST_CASE("progress is a line now and then in a pipe and on a terminal without a cursor") {
    const ToolFixture fixture;
    const auto start = std::chrono::steady_clock::now();
    const auto draw = [&](const char* name, Setup setup) {
        return fixture.start(
            joined({"render", "scene.json", "-o", name, "-v", "--threads", "1"}, hours),
            std::move(setup));
    };
    Process piped = draw("out/a.png", {}), dumb = draw("out/b.png", on_terminal("dumb"));
    for (Process* process : {&piped, &dumb}) {
        CAPTURE(process == &dumb);
        REQUIRE(process->wait_for_err("] "));
        REQUIRE(process->wait_for_further_err("] "));
        process->send(SIGHUP);
        const std::string said = process->wait().err;
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        CHECK(said.find('\x1B') == std::string::npos);
        // After one second, two more, four more. A busy machine writes later, never earlier.
        CHECK(std::exp2(count_of("[", said)) - 1.0 <= took.count());
    }
}

TEST_CASE("RAYLANE_THREADS sets the number of threads unless --threads does") {
    const ToolFixture fixture;
    const std::vector<std::string> render = {"render", "scene.json", "-o", "picture.png", "-v"};
    CHECK(fixture.run(render, with_threads("3")).err.find(" 3 threads\n") != std::string::npos);
    CHECK(fixture.run(joined(render, {"--threads", "2"}), with_threads("3"))
              .err.find(" 2 threads\n") != std::string::npos);
    for (const char* none : {"0", "-1", "two", "2 ", "4097", "99999999999999999999"}) {
        CAPTURE(none);
        const Outcome outcome = fixture.run(render, with_threads(none));
        CHECK(outcome.code == 2);
        CHECK(outcome.err == "raylane: RAYLANE_THREADS: must be a whole number from 1 to 4096\n");
    }
    CHECK(fixture.run(render, with_threads("")).code == 0);
}
