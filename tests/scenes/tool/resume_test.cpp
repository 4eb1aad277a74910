#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sanitized.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <csignal>
#include <random>
#include <sched.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

using namespace raylane::tests;

namespace {

/// Returns the command that renders an image of many tiles.
Options drawing(const Options& options = {}, const char* threads = "2") {
    return joined({"render", "scene.json", "-o", "out/picture.png", "--spp", "4", "--size",
                   sanitized ? "800x800" : "1000x1000", "--threads", threads},
                  options);
}

/// An image of two tiles: the first is empty, the second shows glass.
const std::string two_tiles = R"({"image": {"width": 128, "height": 64},
    "camera": {"from": [0, 0, 5], "at": [0, 0, 0]}, "background": [0, 0, 0.5],
    "lights": [], "limits": {"max_depth": 12, "min_weight": 0},
    "materials": {"glass": {"reflection": "schlick", "transmission": 1, "index": 1.5}},
    "objects": [{"type": "sphere", "material": "glass", "center": [2, 0, 0], "radius": 1.5},
                {"type": "sphere", "material": "glass", "center": [2, 1, 2], "radius": 0.7},
                {"type": "sphere", "material": "glass", "center": [2, -1, 2], "radius": 0.7}]})";
Options drawing_two(const std::string& samples) {
    return {"render", "scene.json", "-o", "out/picture.png", "--tile",
            "64",     "--threads",  "1",  "--spp",           samples};
}
const Options second_takes_minutes = drawing_two("16384");

std::string image_of(const ToolFixture& fixture) {
    return content_of(fixture.output() / "picture.png");
}

/// Renders the image without any interruption, and returns its bytes.
std::string whole(const ToolFixture& fixture, const Options& command = drawing()) {
    REQUIRE(fixture.run(joined(command, {"--no-resume"})).code == 0);
    std::string image = image_of(fixture);
    std::filesystem::remove(fixture.output() / "picture.png");
    REQUIRE(fixture.is_output_empty());
    return image;
}

constexpr const char* kept_until_complete = "; not resumed, kept until this image is complete\n";

bool has_checkpoint(const ToolFixture& fixture) {
    return std::filesystem::exists(fixture.output() / "picture.png.part");
}

/// Writes an empty checkpoint. An existing checkpoint gets each tile as soon as it is rendered. The
/// first write to it is the head.
void begin_checkpoint(const ToolFixture& fixture) {
    fixture.write("out/picture.png.part", "");
}

/// Sends the signal to a held process, with a terminal as standard error, and releases it.
Outcome end_held(Process& process, Hold& hold, int signal) {
    if constexpr (thread_sanitized) FAIL("skipped: signals wait until the threads have ended");
    REQUIRE(hold.wait());
    process.send(signal);
    REQUIRE(process.wait_for_err("interrupt again to end at once"));
    hold.release();
    return process.wait();
}

/// Interrupts the rendering between two tiles, which leaves a checkpoint. Returns the outcome, with
/// a terminal as standard error.
Outcome interrupt(const ToolFixture& fixture, int signal = SIGINT) {
    if (!has_checkpoint(fixture)) begin_checkpoint(fixture);
    Hold hold("pwrite", 4);
    Process process = fixture.start(drawing(), hold.in(on_terminal()));
    Outcome outcome = end_held(process, hold, signal);
    REQUIRE(has_checkpoint(fixture));
    return outcome;
}

/// Leaves a checkpoint of the complete image, whose file could not get its name.
void leave_whole_checkpoint(const ToolFixture& fixture) {
    begin_checkpoint(fixture);
    Hold hold("pwrite", 1);
    Process process = fixture.start(drawing(), hold.in({}));
    REQUIRE(hold.wait());
    std::filesystem::create_directory(fixture.output() / "picture.png");
    hold.release();
    CHECK(process.wait().code == 3);
    std::filesystem::remove(fixture.output() / "picture.png");
    REQUIRE(has_checkpoint(fixture));
}

} // namespace

TEST_CASE("the first SIGINT or SIGTERM finishes tiles in progress and the image can be resumed") {
    const ToolFixture fixture;
    const std::string expected = whole(fixture);
    const std::string goes_on = " %; the same command resumes from out/picture.png.part";
    for (const int signal : {SIGINT, SIGTERM}) {
        const Outcome stopped = interrupt(fixture, signal);
        CAPTURE(stopped.err);
        CHECK(stopped.code == 128 + signal);
        CHECK(stopped.exited);
        CHECK(stopped.err.find(
                  "\nraylane: finishing tiles in progress; interrupt again to end at once\r\n") !=
              std::string::npos);
        CHECK(last_line(stopped.err).starts_with("raylane: stopped at "));
        CHECK(last_line(stopped.err).ends_with(goes_on));
        // The same with a pipe as standard error. A single thread gets the signal at the held call.
        Hold hold("pwrite", 1);
        Process process = fixture.start(drawing({}, "1"), hold.in({}));
        REQUIRE(hold.wait());
        process.send(signal);
        hold.release();
        const Outcome again = process.wait();
        CHECK(again.code == 128 + signal);
        CHECK(again.err.starts_with("raylane: out/picture.png.part: resumes at "));
        const std::string messages = messages_in(again.err);
        const std::string err = messages.substr(messages.find('\n') + 1);
        CHECK(is_one_line(err));
        CHECK(err.starts_with("raylane: stopped at "));
        CHECK(err.ends_with(goes_on + "\n"));
        const Outcome resumed = fixture.run(drawing());
        CHECK(resumed.code == 0);
        CHECK(resumed.err.starts_with("raylane: out/picture.png.part: resumes at "));
        CHECK(image_of(fixture) == expected);
        CHECK(!has_checkpoint(fixture));
        std::filesystem::remove(fixture.output() / "picture.png");
    }
}

TEST_CASE("the second signal ends a rendering at once and keeps the finished tiles") {
    const auto end_by_two = [](Process& process) {
        process.send(SIGTERM);
        static_cast<void>(process.wait_for_err("interrupt again to end at once"));
        process.send(SIGINT);
        return process.wait();
    };
    SECTION("without a checkpoint") {
        const ToolFixture fixture;
        Process process = fixture.start(
            joined({"render", "scene.json", "-o", "out/picture.png"}, hours), on_terminal());
        REQUIRE(process.wait_for_err("rays/s"));
        const Outcome outcome = end_by_two(process);
        CAPTURE(outcome.err);
        CHECK(outcome.exited);
        // The first signal is enough if no tile has begun.
        CHECK((outcome.code == 128 + SIGINT || outcome.code == 128 + SIGTERM));
        CHECK(fixture.is_output_empty()); // no tile was finished
    }
    SECTION("while a tile is written") {
        const ToolFixture fixture(two_tiles);
        for (const int kept : {0, 1}) {
            begin_checkpoint(fixture);
            Hold hold("pwrite", 2 + kept);
            Process process = fixture.start(drawing_two("16"), hold.in(on_terminal()));
            REQUIRE(hold.wait());
            const Outcome outcome = end_by_two(process);
            CAPTURE(outcome.err);
            CHECK(outcome.exited);
            CHECK(outcome.code == 128 + SIGINT);
            CHECK(messages_in(fixture.run(drawing_two("16")).err) ==
                  "raylane: out/picture.png.part: resumes at " + std::to_string(50 * kept) +
                      " %\n");
        }
    }
}

TEST_CASE("a rendering that is killed fifty times at any moment has the same bits in the end") {
    const ToolFixture fixture;
    const std::string expected = whole(fixture);
    static_cast<void>(interrupt(fixture));
    std::mt19937 random(7);
    for (int killed = 0; killed < 25; ++killed) { // while a new tile is written
        const Hold hold("pwrite", 1 + static_cast<int>(random() % 3));
        Process process = fixture.start(drawing(), hold.in({}));
        REQUIRE(hold.wait());
        process.send(SIGKILL);
        CHECK(!process.wait().exited);
    }
    for (int killed = 0; killed < 25; ++killed) { // at any moment, perhaps after its end
        if (!has_checkpoint(fixture)) static_cast<void>(interrupt(fixture));
        Process process = fixture.start(drawing());
        std::this_thread::sleep_for(std::chrono::milliseconds(random() % 120));
        process.send(SIGKILL);
        static_cast<void>(process.wait());
    }
    CHECK(fixture.run(drawing()).code == 0);
    CHECK(image_of(fixture) == expected);
    CHECK(fixture.names().size() == 2);
    CHECK(std::distance(std::filesystem::directory_iterator(fixture.output()), {}) == 1);
}

TEST_CASE("a checkpoint of another scene or other options is reported and not resumed") {
    const ToolFixture fixture;
    const std::string expected = whole(fixture);
    static_cast<void>(interrupt(fixture));
    const auto told = [&](const Options& options, const std::string& what) {
        const std::string checkpoint = content_of(fixture.output() / "picture.png.part");
        const Outcome outcome = fixture.run(drawing(options));
        CHECK(outcome.code == 0);
        CHECK(messages_in(outcome.err) ==
              "raylane: out/picture.png.part: belongs to " + what + kept_until_complete);
        CHECK(!has_checkpoint(fixture));
        fixture.write("out/picture.png.part", checkpoint);
    };
    told({"--max-depth", "1"}, "other options or another version");
    told({"--alpha"}, "other options or another version");
    told({"--crop", "0,0,100x100"}, "other options or another version");
    told({"--engine", "reference", "--crop", "0,0,10x10"}, "other options or another version");
    const std::string scene = content_of(fixture.path() / "scene.json");
    std::string other = scene;
    other.replace(other.find("0.5]"), 4, "0.4]");
    fixture.write("scene.json", other);
    told({}, "another scene");
    fixture.write("scene.json", scene);
    CHECK(fixture.run(drawing()).err.starts_with("raylane: out/picture.png.part: resumes at "));
    CHECK(image_of(fixture) == expected);
}

TEST_CASE("the rays per second of a resumed image are those of the last run alone") {
    const ToolFixture fixture;
    const auto figures = [&] {
        const Outcome outcome = fixture.run(drawing({"--stats", "stats.json"}));
        CHECK(outcome.code == 0);
        return nlohmann::json::parse(content_of(fixture.path() / "stats.json"));
    };
    const auto rays_now = [](const nlohmann::json& stats) {
        return stats["rays_per_second"].get<double>() * stats["seconds"]["render"].get<double>();
    };
    const nlohmann::json at_once = figures();
    const double total = at_once["rays"]["total"];
    CHECK(std::abs(rays_now(at_once) - total) < 0.5);
    std::filesystem::remove(fixture.output() / "picture.png");
    static_cast<void>(interrupt(fixture));
    const nlohmann::json resumed = figures();
    CHECK(resumed["rays"] == at_once["rays"]);
    CHECK(resumed["samples_per_pixel"] == 4);
    CHECK(rays_now(resumed) < total - 0.5);
}

TEST_CASE("a foreign file and a checkpoint in use are left alone") {
    const ToolFixture fixture;
    const std::string expected = whole(fixture);
    fixture.write("out/picture.png.part", "mine");
    const Outcome outcome = fixture.run(drawing());
    CHECK(outcome.code == 0);
    CHECK(messages_in(outcome.err) == "raylane: out/picture.png.part: is not a checkpoint of this "
                                      "user; rendering without a checkpoint\n");
    CHECK(content_of(fixture.output() / "picture.png.part") == "mine");
    CHECK((image_of(fixture) == expected));
    std::filesystem::remove(fixture.output() / "picture.png.part");

    static_cast<void>(interrupt(fixture));
    Hold hold("pwrite", 1);
    Process first = fixture.start(drawing(), hold.in({}));
    REQUIRE(hold.wait());
    const Outcome second = fixture.run(drawing());
    hold.release();
    CHECK(second.code == 0);
    CHECK(second.err.find("is in use; rendering without a checkpoint") != std::string::npos);
    CHECK(first.wait().code == 0);
    CHECK((image_of(fixture) == expected));
}

TEST_CASE("an image is rendered even if the disk has no space for a checkpoint") {
    const ToolFixture fixture;
    const std::string expected = whole(fixture);
    static_cast<void>(interrupt(fixture));
    const auto had = std::filesystem::file_size(fixture.output() / "picture.png.part");
    Setup limited;
    // Too little for all tiles, but enough for the image.
    const rlim_t room = std::max<rlim_t>(had, expected.size()) + 1000;
    limited.in_child = [room] {
        const rlimit limit{room, room};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    };
    const Outcome outcome = fixture.run(drawing(), limited);
    CHECK(outcome.code == 0);
    CHECK(count_of("raylane: out/picture.png.part: cannot write: File too large\n", outcome.err) ==
          1);
    CHECK(image_of(fixture) == expected);
    CHECK(!has_checkpoint(fixture));
}

TEST_CASE("a checkpoint that has filled the disk gives its space to the image") {
    const ToolFixture fixture;
    const std::string expected = whole(fixture);
    // The missing tiles have more bytes than the image.
    const std::filesystem::path checkpoint = fixture.output() / "picture.png.part";
    const std::size_t pixels = sanitized ? 800 * 800 : 1000 * 1000;
    static_cast<void>(interrupt(fixture));
    const std::string kept = content_of(checkpoint);
    REQUIRE(12 * pixels > kept.size() + expected.size() + (1 << 20));
    const std::string room =
        "size=" + std::to_string(std::max(kept.size(), expected.size()) + (1 << 18));
    const bool mounted = ::unshare(CLONE_NEWNS) == 0 &&
                         ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                         ::mount("none", fixture.output().c_str(), "tmpfs", 0, room.c_str()) == 0;
    if (!mounted) {
        WARN("skipped: no file system can be mounted here");
        return;
    }
    fixture.write("out/picture.png.part", kept);
    const Outcome outcome = fixture.run(drawing());
    CHECK(outcome.code == 0);
    CHECK(count_of("raylane: out/picture.png.part: cannot write: No space left on device\n",
                   outcome.err) == 1);
    CHECK(image_of(fixture) == expected);
    CHECK(!has_checkpoint(fixture));
    CHECK(::umount(fixture.output().c_str()) == 0);
}

TEST_CASE("a tile is kept while the next one takes long") {
    const ToolFixture fixture(two_tiles);
    Process process = fixture.start(second_takes_minutes);
    REQUIRE(fixture.wait_for(fixture.output() / "picture.png.part"));
    process.send(SIGKILL);
    CHECK(!process.wait().exited);
    Process again = fixture.start(second_takes_minutes);
    CHECK(again.wait_for_err("raylane: out/picture.png.part: resumes at 50 %\n"));
}

TEST_CASE("The same command with another option leaves the tiles of the first") {
    const ToolFixture fixture(two_tiles);
    const Options other = joined(second_takes_minutes, {"--max-depth", "11"});
    const auto checkpoints = [&] {
        return std::distance(std::filesystem::directory_iterator(fixture.output()), {});
    };
    std::ptrdiff_t count = 0;
    for (const Options& options : {second_takes_minutes, other}) {
        Process process = fixture.start(options);
        REQUIRE(comes_true([&] { return checkpoints() > count; }));
        count = checkpoints();
        process.send(SIGKILL);
        CHECK(!process.wait().exited);
    }
    CHECK(count == 2);
    for (const Options& options : {second_takes_minutes, other}) {
        Process process = fixture.start(options);
        CHECK(process.wait_for_err(": resumes at 50 %\n"));
    }
}

TEST_CASE("an empty image of a sequence is rendered again") {
    const ToolFixture fixture;
    const Options film = {"render", "scene.json", "-o", "out/f%d.png", "--turn", "90/3"};
    REQUIRE(fixture.run(film).code == 0);
    const std::string expected = content_of(fixture.output() / "f1.png");
    fixture.write("out/f1.png", "");
    CHECK(fixture.run(film).code == 0);
    CHECK(content_of(fixture.output() / "f1.png") == expected);
}

TEST_CASE("a signal while the last tile is written ends the program after the whole image") {
    const ToolFixture fixture(two_tiles);
    const std::string expected = whole(fixture, drawing_two("16"));
    const auto end_amid_the_last = [&](const Options& command, const std::string& name) {
        fixture.write("out/" + name + ".part", "");
        Hold hold("pwrite", 3);
        Process process = fixture.start(command, hold.in(on_terminal()));
        const Outcome outcome = end_held(process, hold, SIGTERM);
        CAPTURE(outcome.err);
        CHECK(outcome.code == 128 + SIGTERM);
        CHECK(last_line(outcome.err) == "raylane: stopped; out/" + name + " is complete");
        CHECK(std::filesystem::exists(fixture.output() / name));
        CHECK(std::distance(std::filesystem::directory_iterator(fixture.output()), {}) == 1);
    };
    end_amid_the_last(drawing_two("16"), "picture.png");
    CHECK((image_of(fixture) == expected));
    std::filesystem::remove(fixture.output() / "picture.png");
    // The first image of a sequence is whole, too, and the second is not begun.
    end_amid_the_last({"render", "scene.json", "-o", "out/f-%d.png", "--turn", "90/4", "--tile",
                       "64", "--threads", "1", "--spp", "16"},
                      "f-0.png");
}

TEST_CASE("a checkpoint distinguishes settings of a scene that no option has") {
    std::string scene = ball;
    const auto with_outline = [&](const char* color) {
        std::string text = scene;
        return text.insert(1, std::string(R"("outline": {"width": 3, "color": )") + color + "},");
    };
    const ToolFixture fixture(with_outline("[9, 0.3, 0.1]"));
    static_cast<void>(interrupt(fixture));
    fixture.write("scene.json", with_outline("[1, 0.3, 0.1]"));
    CHECK(messages_in(fixture.run(drawing()).err) ==
          "raylane: out/picture.png.part: belongs to other options or another version" +
              std::string(kept_until_complete));
    const std::string image = image_of(fixture);
    CHECK(fixture.run(drawing({"--no-resume"})).code == 0);
    CHECK(image_of(fixture) == image);
}

TEST_CASE("a checkpoint has the permissions of the existing image") {
    const ToolFixture fixture;
    fixture.write("out/picture.png", "old");
    const auto mode = std::filesystem::perms::owner_read | std::filesystem::perms::owner_write;
    std::filesystem::permissions(fixture.output() / "picture.png", mode);
    Process process =
        fixture.start(joined({"render", "scene.json", "-o", "out/picture.png"}, minutes));
    REQUIRE(fixture.wait_for(fixture.output() / "picture.png.part"));
    CHECK(std::filesystem::status(fixture.output() / "picture.png.part").permissions() == mode);
    process.send(SIGTERM);
    CHECK(process.wait().err.ends_with("; the same command resumes from out/picture.png.part\n"));
}

TEST_CASE("a signal after the last tile leaves the whole image or its checkpoint") {
    const ToolFixture fixture;
    const std::string expected = whole(fixture);
    leave_whole_checkpoint(fixture);
    const std::string checkpoint = content_of(fixture.output() / "picture.png.part");
    // The hundredth pread reads a tile. Then rename names the image, and unlink removes the
    // checkpoint.
    for (const auto& [call, count] :
         {std::pair{"pread", 100}, std::pair{"rename", 1}, std::pair{"unlink", 1}}) {
        CAPTURE(call);
        fixture.write("out/picture.png.part", checkpoint);
        Hold hold(call, count);
        Process process = fixture.start(drawing({}, "1"), hold.in({}));
        REQUIRE(hold.wait());
        process.send(SIGTERM);
        hold.release();
        const Outcome outcome = process.wait();
        CAPTURE(outcome.err);
        CHECK(outcome.code == 128 + SIGTERM);
        const std::string messages = messages_in(outcome.err);
        CHECK(messages.starts_with("raylane: out/picture.png.part: resumes at 100 %\n"));
        const std::string said = messages.substr(messages.find('\n') + 1);
        if (call == std::string("pread")) {
            CHECK(said.starts_with("raylane: stopped at "));
            CHECK(said.ends_with("; the same command resumes from out/picture.png.part\n"));
            continue;
        }
        CHECK(said == "raylane: stopped; out/picture.png is complete\n");
        CHECK((image_of(fixture) == expected)); // too long to be printed
        CHECK(!has_checkpoint(fixture));
        std::filesystem::remove(fixture.output() / "picture.png");
    }
}

TEST_CASE("a sequence reports a signal at any moment between its first and last image") {
    for (int i = 0; i < 40; ++i) {
        const ToolFixture fixture;
        Process film = fixture.start({"render", "scene.json", "-o", "out/f-%d.png", "--turn",
                                      "360/1000000", "--size", "8x8", "--threads", "1"});
        REQUIRE(fixture.wait_for(fixture.output() / ("f-" + std::to_string(i % 7) + ".png")));
        film.send(i % 2 == 0 ? SIGTERM : SIGINT);
        const Outcome outcome = film.wait();
        CAPTURE(outcome.err);
        REQUIRE(outcome.code == 128 + (i % 2 == 0 ? SIGTERM : SIGINT));
        REQUIRE(is_one_line(messages_in(outcome.err)));
        REQUIRE(messages_in(outcome.err).starts_with("raylane: stopped"));
    }
}

TEST_CASE("a full disk is reported at once and the checkpoint continues when it has space again") {
    const ToolFixture fixture;
    void* const shared =
        ::mmap(nullptr, sizeof(pid_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    REQUIRE(shared != MAP_FAILED);
    auto* const pid = static_cast<pid_t*>(shared);
    constexpr rlim_t room = 1'000'000;
    Setup limited;
    limited.in_child = [pid] {
        *pid = ::getpid();
        const rlimit limit{room, RLIM_INFINITY};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    };
    Process process =
        fixture.start(joined({"render", "scene.json", "-o", "out/picture.png"}, minutes), limited);
    REQUIRE(process.wait_for_err("raylane: out/picture.png.part: cannot write: File too large\n"));
    const rlimit unlimited{RLIM_INFINITY, RLIM_INFINITY};
    REQUIRE(::prlimit(*pid, RLIMIT_FSIZE, &unlimited, nullptr) == 0);
    ::munmap(shared, sizeof(pid_t));
    const std::filesystem::path checkpoint = fixture.output() / "picture.png.part";
    std::error_code none;
    CHECK(comes_true([&] {
        return std::filesystem::exists(checkpoint) &&
               std::filesystem::file_size(checkpoint, none) > room;
    }));
    process.send(SIGTERM);
    const Outcome outcome = process.wait();
    CHECK(outcome.code == 128 + SIGTERM);
    CHECK(count_of("cannot write", outcome.err) == 1);
    CHECK(outcome.err.ends_with(" %; the same command resumes from out/picture.png.part\n"));
    CHECK(std::filesystem::file_size(checkpoint) > room);
}

TEST_CASE("the target of a link has a checkpoint unless it is a device") {
    const ToolFixture fixture;
    std::filesystem::create_directories(fixture.path() / "dev");
    fixture.write("dev/real.png", "old");
    std::filesystem::create_symlink(fixture.path() / "dev/real.png",
                                    fixture.output() / "picture.png");
    static_cast<void>(interrupt(fixture));
    CHECK(has_checkpoint(fixture));
    // A checkpoint would be reported as a foreign file.
    fixture.write("out/stream.png.part", "mine");
    fixture.write("out/further.png.part", "mine");
    std::filesystem::create_symlink("/dev/stdout", fixture.output() / "stream.png");
    std::filesystem::create_symlink("stream.png", fixture.output() / "further.png");
    Setup to_file;
    to_file.out = fixture.write("file.png", "");
    for (const char* name : {"out/stream.png", "out/further.png"}) {
        const Outcome outcome = fixture.run({"render", "scene.json", "-o", name}, to_file);
        CHECK(outcome.code == 0);
        CHECK(outcome.err.empty());
    }
}

TEST_CASE("a checkpoint whose name would be too long is reported and omitted") {
    const ToolFixture fixture;
    for (const std::size_t length : {250, 251, 255}) {
        const std::string name = "out/" + std::string(length - 4, 'n') + ".png";
        const Outcome outcome = fixture.render(name);
        CHECK(outcome.code == 0);
        CHECK(outcome.err ==
              (length == 250 ? ""
                             : "raylane: " + name +
                                   ".part: has too long a name; rendering without a checkpoint\n"));
        CHECK(fixture.render(name, {"--no-resume"}).err.empty());
    }
}
