#include "tests/catch.hpp"
#include "tests/scenes/tool/workshop.hpp"

#include <csignal>
#include <fcntl.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

using namespace raylane::tests;

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// Of hours. Others may want the processor, and sanitizers look the memory over at the end.
constexpr std::chrono::seconds soon{20};

const std::vector<std::string> render_for_hours =
    joined({"render", "scene.json", "-o", "out/picture.png", "--stats", "out/stats.json"}, hours);

/// The process ends soon after the signal and leaves nothing.
void check_end(const Workshop& workshop, Process& process, int signal) {
    const auto start = Clock::now();
    process.send(signal);
    const Outcome outcome = process.wait();
    CHECK(Clock::now() - start < soon);
    CHECK(outcome.code == 128 + signal);
    CHECK(outcome.exited);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
    CHECK(workshop.is_output_empty());
}

} // namespace

TEST_CASE("an interrupted rendering ends soon and leaves nothing") {
    for (const int signal : {SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1}) {
        const Workshop workshop;
        Process process = workshop.start(render_for_hours);
        REQUIRE(workshop.wait_for_files(process, 2));
        REQUIRE(process.wait_for_work(milliseconds(100))); // amid the pixels
        check_end(workshop, process, signal);
    }
}

TEST_CASE("an interrupted rendering leaves the picture that was there") {
    const Workshop workshop;
    workshop.write("out/picture.png", "old");
    Process process = workshop.start(render_for_hours);
    REQUIRE(workshop.wait_for_files(process, 3));
    process.send(SIGHUP);
    CHECK(process.wait().code == 128 + SIGHUP);
    CHECK(std::distance(std::filesystem::directory_iterator(workshop.output()), {}) == 1);
    CHECK(content_of(workshop.output() / "picture.png") == "old");
}

TEST_CASE("reading a scene can be interrupted") {
    const Workshop workshop;
    const std::vector<std::string> arguments = {"render", "pipe", "-o", "out/picture.png"};
    const std::filesystem::path pipe = workshop.path() / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    {
        // Nobody has opened the other end.
        Process process = workshop.start(arguments);
        REQUIRE(workshop.wait_for_files(process, 1));
        check_end(workshop, process, SIGINT);
    }
    {
        // Somebody has, but says no more.
        Process process = workshop.start(arguments);
        const int writer = ::open(pipe.c_str(), O_WRONLY | O_CLOEXEC);
        CHECK(::write(writer, "v\nfrom 0", 8) == 8);
        REQUIRE(workshop.wait_for_files(process, 1));
        check_end(workshop, process, SIGINT);
        ::close(writer);
    }
    {
        // A scene that takes seconds and hundreds of megabytes to build.
        workshop.write("scene.json", R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
            "lights": [{"type": "directional", "direction": [-1, -2, -3]}],
            "objects": [{"type": "sphereflake", "material": {}, "center": [0, 0, 0], "radius": 1,
                         "depth": 7}]})");
        Process process = workshop.start({"render", "scene.json", "-o", "out/picture.png"});
        REQUIRE(workshop.wait_for_files(process, 1));
        REQUIRE(process.wait_for_work(milliseconds(200)));
        check_end(workshop, process, SIGTERM);
    }
}

TEST_CASE("waiting for a reader of the picture can be interrupted") {
    const Workshop workshop;
    REQUIRE(::mkfifo((workshop.path() / "pipe.png").c_str(), 0600) == 0);
    Process process =
        workshop.start({"render", "scene.json", "--stats", "out/stats.json", "-o", "pipe.png"});
    std::this_thread::sleep_for(std::chrono::seconds(1)); // nothing tells that it waits
    check_end(workshop, process, SIGINT);
}

TEST_CASE("a signal at any moment leaves the whole picture, or at most a journal") {
    const Workshop workshop;
    int interrupted = 0;
    for (int i = 0; i < 60; ++i) {
        Process process = workshop.start({"render", "scene.json", "-o", "out/picture.png"});
        std::this_thread::sleep_for(std::chrono::microseconds(100 * i));
        process.send(SIGINT);
        const Outcome outcome = process.wait();
        const bool there = std::filesystem::remove(workshop.output() / "picture.png");
        std::filesystem::remove(workshop.output() / "picture.png.part");
        CHECK(workshop.is_output_empty());
        CHECK((outcome.code == 0 || outcome.code == 128 + SIGINT));
        CHECK((there || outcome.code != 0));
        interrupted += outcome.code == 0 ? 0 : 1;
    }
    CHECK(interrupted > 0);
}

TEST_CASE("signals that the caller has ignored stay so") {
    const Workshop workshop;
    Setup ignoring;
    ignoring.in_child = [] { ::signal(SIGINT, SIG_IGN); };
    Process process = workshop.start(render_for_hours, ignoring);
    REQUIRE(workshop.wait_for_files(process, 2));
    process.send(SIGINT);
    CHECK(process.wait_for_work(milliseconds(200)));
    CHECK(workshop.wait_for_files(process, 2));
    check_end(workshop, process, SIGHUP);
}
