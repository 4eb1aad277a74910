#include "scenes/tool/exit.hpp"
#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace raylane::tests;

namespace {

using Clock = std::chrono::steady_clock;

const std::vector<std::string> render_for_hours =
    joined({"render", "scene.json", "-o", "out/picture.png", "--stats", "out/stats.json"}, hours);

/// Checks that the signal ends the process, which leaves no file. Returns its standard error.
std::string end_of(const ToolFixture& fixture, Process& process, int signal) {
    process.send(signal);
    const Outcome outcome = process.wait();
    CHECK(outcome.code == 128 + signal);
    CHECK(outcome.exited);
    CHECK(outcome.out.empty());
    CHECK(fixture.is_output_empty());
    return outcome.err;
}

/// Checks the same, and that standard error is empty.
void check_end(const ToolFixture& fixture, Process& process, int signal) {
    CHECK(end_of(fixture, process, signal).empty());
}

/// Checks the same on a terminal, where the progress line ends in a line break.
void check_end_on_terminal(const ToolFixture& fixture, Process& process, int signal) {
    const std::string err = end_of(fixture, process, signal);
    CAPTURE(err);
    CHECK(err.ends_with("\x1B[K\r\n"));
    CHECK(count_of("\n", err) == 1);
}

} // namespace

TEST_CASE("an interrupted rendering ends and leaves no file") {
    for (const int signal : {SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1}) {
        const ToolFixture fixture;
        Process process = fixture.start(render_for_hours, on_terminal());
        REQUIRE(fixture.wait_for_files(process, 2));
        REQUIRE(process.wait_for_err("rays/s")); // the rendering has begun
        check_end_on_terminal(fixture, process, signal);
    }
    // A pipe gets its first progress line after a second.
    const ToolFixture fixture;
    Process process = fixture.start(joined(render_for_hours, {"--verbose"}));
    REQUIRE(process.wait_for_err("rays/s"));
    CHECK(end_of(fixture, process, SIGHUP).find("raylane") == std::string::npos);
}

TEST_CASE("an interrupted rendering keeps the existing image") {
    const ToolFixture fixture;
    fixture.write("out/picture.png", "old");
    Process process = fixture.start(render_for_hours);
    REQUIRE(fixture.wait_for_files(process, 3));
    process.send(SIGHUP);
    CHECK(process.wait().code == 128 + SIGHUP);
    CHECK(std::distance(std::filesystem::directory_iterator(fixture.output()), {}) == 1);
    CHECK(content_of(fixture.output() / "picture.png") == "old");
}

TEST_CASE("reading a scene can be interrupted") {
    const ToolFixture fixture;
    const std::vector<std::string> arguments = {"render", "pipe", "-o", "out/picture.png"};
    const std::filesystem::path pipe = fixture.path() / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    {
        // No process has opened the other end.
        Process process = fixture.start(arguments);
        REQUIRE(fixture.wait_for_files(process, 1));
        check_end(fixture, process, SIGINT);
    }
    {
        // A process has, but writes no more.
        Process process = fixture.start(arguments);
        const int writer = ::open(pipe.c_str(), O_WRONLY | O_CLOEXEC);
        CHECK(::write(writer, "v\nfrom 0", 8) == 8);
        REQUIRE(fixture.wait_for_files(process, 1));
        check_end(fixture, process, SIGINT);
        ::close(writer);
    }
    {
        // A scene that takes seconds and hundreds of megabytes to build. If it is built before the
        // first progress line, the rendering without a checkpoint ends in the same way.
        fixture.write("scene.json", R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
            "lights": [{"type": "directional", "direction": [-1, -2, -3]}],
            "objects": [{"type": "sphereflake", "material": {}, "center": [0, 0, 0], "radius": 1,
                         "depth": 7}]})");
        Process process = fixture.start(joined(render_for_hours, {"--no-resume"}), on_terminal());
        REQUIRE(process.wait_for_err("\r"));
        check_end_on_terminal(fixture, process, SIGTERM);
    }
}

TEST_CASE("the first signal ends a rendering whose tiles take hours") {
    for (const int signal : {SIGINT, SIGTERM}) {
        const ToolFixture fixture;
        Process process = fixture.start(
            {"render", "scene.json", "-o", "out/picture.png", "--spp", "65536", "--size", "32x32"},
            on_terminal());
        REQUIRE(process.wait_for_err("rays/s"));
        process.send(signal);
        const Outcome outcome = process.wait();
        CAPTURE(outcome.err);
        CHECK(outcome.code == 128 + signal);
        CHECK(outcome.err.find("stopped at 0 %") != std::string::npos);
    }
}

TEST_CASE("waiting for a reader of the image can be interrupted") {
    const ToolFixture fixture;
    REQUIRE(::mkfifo((fixture.path() / "pipe.png").c_str(), 0600) == 0);
    Process process =
        fixture.start({"render", "scene.json", "--stats", "out/stats.json", "-o", "pipe.png"});
    REQUIRE(comes_true([&] { return process.waits_in_open(); }));
    check_end(fixture, process, SIGINT);
}

TEST_CASE("a signal at any moment leaves the whole image or at most a checkpoint") {
    const ToolFixture fixture;
    const std::vector<std::string> arguments = {"render", "scene.json", "-o", "out/picture.png"};
    const auto start = Clock::now();
    REQUIRE(fixture.run(arguments).code == 0);
    const auto duration = Clock::now() - start;
    std::filesystem::remove(fixture.output() / "picture.png");
    constexpr int count = 60;
    for (int i = 0; i < count; ++i) {
        Process process = fixture.start(arguments);
        // The moments range from the start to after the end. Each check holds at any moment.
        std::this_thread::sleep_for(duration * i / (count - 10));
        process.send(SIGINT);
        const Outcome outcome = process.wait();
        const bool is_removed = std::filesystem::remove(fixture.output() / "picture.png");
        std::filesystem::remove(fixture.output() / "picture.png.part");
        CHECK(fixture.is_output_empty());
        CHECK((outcome.code == 0 || outcome.code == 128 + SIGINT));
        CHECK((is_removed || outcome.code != 0));
    }
}

TEST_CASE("signals that the caller ignores stay ignored") {
    const ToolFixture fixture;
    Setup ignoring = on_terminal();
    ignoring.in_child = [prepare = ignoring.in_child] {
        prepare();
        ::signal(SIGINT, SIG_IGN);
    };
    // A rendering with a checkpoint goes on for a while after the first signal. This one has none.
    Process process = fixture.start(joined(render_for_hours, {"--no-resume"}), ignoring);
    REQUIRE(process.wait_for_err("rays/s"));
    process.send(SIGINT);
    for (int line = 0; line < 3; ++line)
        CHECK(process.wait_for_further_err("rays/s"));
    CHECK(fixture.wait_for_files(process, 2));
    check_end_on_terminal(fixture, process, SIGHUP);
}

/// A signal may arrive between a call that fails and the code that reads its error.
TEST_CASE("the first signal leaves errno as it was") {
    const pid_t child = ::fork();
    if (child == 0) {
        ::close(STDERR_FILENO); // then isatty() fails and sets errno
        raylane::scenes::catch_signals();
        raylane::simd::Progress progress;
        const raylane::scenes::StopOnSignal stop(progress);
        errno = ENOSPC;
        ::raise(SIGTERM);
        const bool is_same = errno == ENOSPC;
        ::_exit(is_same && raylane::scenes::StopOnSignal::signal() == SIGTERM ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 0));
}
