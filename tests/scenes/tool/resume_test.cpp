#include "tests/catch.hpp"
#include "tests/sanitized.hpp"
#include "tests/scenes/tool/workshop.hpp"

#include <csignal>
#include <random>
#include <sys/resource.h>
#include <thread>

using namespace raylane::tests;

namespace {

using std::chrono::milliseconds;
using Options = std::vector<std::string>;

/// Seconds of work, in many tiles.
const Options seconds = {"--size", sanitized ? "800x800" : "2000x2000", "--spp", "16", "--threads",
                         "2"};

Options drawing(const Options& options = {}) {
    return joined(joined({"render", "scene.json", "-o", "out/picture.png"}, seconds), options);
}

std::string picture_of(const Workshop& workshop) {
    return content_of(workshop.output() / "picture.png");
}

/// What it is without any interruption.
std::string whole(const Workshop& workshop) {
    REQUIRE(workshop.run(drawing({"--no-resume"})).code == 0);
    std::string picture = picture_of(workshop);
    std::filesystem::remove(workshop.output() / "picture.png");
    REQUIRE(workshop.is_output_empty());
    return picture;
}

bool has_journal(const Workshop& workshop) {
    return std::filesystem::exists(workshop.output() / "picture.png.part");
}

/// Interrupted in the middle, by SIGINT.
void interrupt(const Workshop& workshop) {
    Process process = workshop.start(drawing());
    REQUIRE(workshop.wait_for_files(process, 1));
    std::this_thread::sleep_for(milliseconds(300));
    process.send(SIGINT);
    REQUIRE(process.wait().code == 128 + SIGINT);
    REQUIRE(has_journal(workshop));
}

} // namespace

TEST_CASE("the first SIGINT or SIGTERM finishes what is under way, and the picture goes on") {
    const Workshop workshop;
    const std::string expected = whole(workshop);
    for (const int signal : {SIGINT, SIGTERM}) {
        Process process = workshop.start(drawing());
        REQUIRE(workshop.wait_for_files(process, 1));
        std::this_thread::sleep_for(milliseconds(300));
        process.send(signal);
        const Outcome stopped = process.wait();
        CHECK(stopped.code == 128 + signal);
        CHECK(stopped.exited);
        CHECK(is_one_line(stopped.err));
        CHECK(stopped.err.starts_with("raylane: stopped at "));
        CHECK(stopped.err.ends_with(" %; the same command goes on with out/picture.png.part\n"));
        CHECK(workshop.wait_for_files(process, 1));

        const Outcome resumed = workshop.run(drawing());
        CHECK(resumed.code == 0);
        CHECK(resumed.err.starts_with("raylane: out/picture.png.part: goes on at "));
        CHECK(picture_of(workshop) == expected);
        CHECK(!has_journal(workshop));
        std::filesystem::remove(workshop.output() / "picture.png");
    }
}

TEST_CASE("the second signal ends a rendering at once, and what it had is not lost") {
    const Workshop workshop;
    Process process =
        workshop.start(joined({"render", "scene.json", "-o", "out/picture.png"}, hours));
    REQUIRE(workshop.wait_for_files(process, 1));
    std::this_thread::sleep_for(milliseconds(100));
    process.send(SIGTERM);
    std::this_thread::sleep_for(milliseconds(50));
    process.send(SIGINT);
    const auto start = std::chrono::steady_clock::now();
    CHECK(process.wait().code == 128 + SIGINT);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(sanitized ? 20 : 1));
    CHECK(workshop.is_output_empty()); // not one tile
}

TEST_CASE("a rendering that is killed fifty times at any moment has the same bits in the end") {
    const Workshop workshop;
    const std::string expected = whole(workshop);
    interrupt(workshop); // now each tile is in the journal as soon as it is drawn
    std::mt19937 random(7);
    int killed = 0;
    for (int i = 0; i < 50; ++i) {
        Process process = workshop.start(drawing());
        std::this_thread::sleep_for(milliseconds(random() % 60));
        process.send(SIGKILL);
        killed += process.wait().exited ? 0 : 1;
        if (!has_journal(workshop)) interrupt(workshop); // it was done
    }
    CHECK(killed > 25);
    CHECK(workshop.run(drawing()).code == 0);
    CHECK(picture_of(workshop) == expected);
    CHECK(workshop.names().size() == 2);
    CHECK(std::distance(std::filesystem::directory_iterator(workshop.output()), {}) == 1);
}

TEST_CASE("a journal of another scene or other options is said to be one, and is begun anew") {
    const Workshop workshop;
    const std::string expected = whole(workshop);
    interrupt(workshop);
    const auto begun_anew = [&](const Options& options, const std::string& what) {
        const std::string journal = content_of(workshop.output() / "picture.png.part");
        const Outcome outcome = workshop.run(drawing(options));
        CHECK(outcome.code == 0);
        CHECK(outcome.err == "raylane: out/picture.png.part: is of " + what + ", and begun anew\n");
        CHECK(!has_journal(workshop));
        workshop.write("out/picture.png.part", journal);
    };
    begun_anew({"--max-depth", "1"}, "other options or another version");
    begun_anew({"--alpha"}, "other options or another version");
    begun_anew({"--crop", "0,0,100x100"}, "other options or another version");
    begun_anew({"--engine", "reference", "--crop", "0,0,10x10"},
               "other options or another version");
    const std::string scene = content_of(workshop.path() / "scene.json");
    std::string other = scene;
    other.replace(other.find("0.5]"), 4, "0.4]");
    workshop.write("scene.json", other);
    begun_anew({}, "another scene");
    workshop.write("scene.json", scene);
    CHECK(workshop.run(drawing()).err.starts_with("raylane: out/picture.png.part: goes on at "));
    CHECK(picture_of(workshop) == expected);
}

TEST_CASE("a file that is none of raylane's is left alone, and so is a journal in use") {
    const Workshop workshop;
    workshop.write("out/picture.png.part", "mine");
    const Outcome outcome = workshop.run(drawing());
    CHECK(outcome.code == 0);
    CHECK(outcome.err == "raylane: out/picture.png.part: is none of raylane's, so the picture is "
                         "drawn without a journal\n");
    CHECK(content_of(workshop.output() / "picture.png.part") == "mine");
    const std::string expected = picture_of(workshop);
    std::filesystem::remove(workshop.output() / "picture.png.part");

    interrupt(workshop);
    Process first = workshop.start(drawing());
    std::this_thread::sleep_for(milliseconds(100));
    const Outcome second = workshop.run(drawing());
    CHECK(second.code == 0);
    CHECK(second.err.find("is in use, so the picture is drawn without a journal") !=
          std::string::npos);
    CHECK(first.wait().code == 0);
    CHECK(picture_of(workshop) == expected);
}

TEST_CASE("where there is no room for a journal, the picture is drawn all the same") {
    const Workshop workshop;
    const std::string expected = whole(workshop);
    interrupt(workshop);
    const auto had = std::filesystem::file_size(workshop.output() / "picture.png.part");
    Setup limited;
    limited.in_child = [had] {
        const rlimit limit{had + 1'000'000, had + 1'000'000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    };
    const Outcome outcome = workshop.run(drawing(), limited);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.find("raylane: out/picture.png.part: cannot write: File too large\n") !=
          std::string::npos);
    CHECK(picture_of(workshop) == expected);
    CHECK(!has_journal(workshop));
}
