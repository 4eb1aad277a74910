#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"
#include "tests/support/sanitized.hpp"

#include <csignal>
#include <grp.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

using namespace raylane::tests;

namespace {

/// Checks that a refusal by the system gives one line and exit code 3.
void check(const Outcome& outcome, const std::string& message) {
    CHECK(outcome.code == 3);
    CHECK(outcome.exited);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == "raylane: " + message + "\n");
}

/// Renders an invalid scene, a missing one, and one that takes hours. The same refusal for all
/// shows that it comes before the scene is read.
void check_at_once(const ToolFixture& fixture, const std::vector<std::string>& outputs,
                   const std::string& message, const Setup& setup = {}) {
    fixture.write("bad.json", "{");
    for (const char* scene : {"scene.json", "bad.json", "none.json"})
        check(fixture.run(joined(joined({"render", scene}, outputs), hours), setup), message);
}

Setup with_limit(int resource, rlim_t value) {
    Setup setup;
    setup.in_child = [=] {
        const rlimit limit{value, value};
        ::setrlimit(static_cast<__rlimit_resource>(resource), &limit);
    };
    return setup;
}

/// Returns a setup that becomes an unprivileged user if the process runs as root, who may write
/// everywhere.
Setup as_nobody() {
    Setup setup;
    setup.in_child = [] {
        constexpr unsigned nobody = 65534;
        if (::geteuid() != 0) return;
        if (::setgroups(0, nullptr) != 0 || ::setgid(nobody) != 0 || ::setuid(nobody) != 0)
            ::_exit(126);
    };
    return setup;
}

} // namespace

TEST_CASE("an output that cannot be written is reported before the scene is read") {
    const ToolFixture fixture;
    std::filesystem::create_directory(fixture.path() / "picture.png");
    fixture.write("file", "");
    check_at_once(fixture, {"-o", "none/picture.png"},
                  "none/picture.png: cannot write: No such file or directory");
    check_at_once(fixture, {"-o", "picture.png"}, "picture.png: cannot write: Is a directory");
    check_at_once(fixture, {"-o", "file/picture.png"},
                  "file/picture.png: cannot write: Not a directory");
    check_at_once(fixture, {"-o", "out/picture.png", "--stats", "none/stats.json"},
                  "none/stats.json: cannot write: No such file or directory");
    check_at_once(fixture, {"-o", "out/picture.png", "--stats", "out"},
                  "out: cannot write: Is a directory");
    CHECK(fixture.is_output_empty());
    check(fixture.run({"compare", "none.png", "none.png", "--diff", "none/difference.png"}),
          "none/difference.png: cannot write: No such file or directory");
}

TEST_CASE("a missing permission to write is reported before the scene is read") {
    using std::filesystem::perms;
    const ToolFixture fixture;
    const auto protected_file = fixture.write("out/protected.png", "old");
    std::filesystem::permissions(fixture.path(), perms(0755));
    std::filesystem::permissions(protected_file, perms(0444));
    std::filesystem::permissions(fixture.output(), perms(0777));
    check_at_once(fixture, {"-o", "out/protected.png"},
                  "out/protected.png: cannot write: Permission denied", as_nobody());
    std::filesystem::permissions(fixture.output(), perms(0555));
    check_at_once(fixture, {"-o", "out/new.png"}, "out/new.png: cannot write: Permission denied",
                  as_nobody());
    CHECK(content_of(protected_file) == "old");
    CHECK(std::distance(std::filesystem::directory_iterator(fixture.output()), {}) == 1);
    std::filesystem::permissions(fixture.output(), perms(0755));

    std::filesystem::permissions(fixture.path() / "scene.json", perms(0));
    check(fixture.run({"info", "scene.json"}, as_nobody()),
          "scene.json: cannot open: Permission denied");
}

TEST_CASE("a full disk gives an error of one line and leaves no file") {
    const ToolFixture fixture;
    for (const char* name : {"full.png", "full.hdr", "full.pfm"}) {
        std::filesystem::create_symlink("/dev/full", fixture.path() / name);
        check(fixture.render(name), std::string(name) + ": cannot write: No space left on device");
    }
    check(fixture.render("out/picture.png", {"--stats", "/dev/full"}),
          "/dev/full: cannot write: No space left on device");
    CHECK(std::filesystem::remove(fixture.output() / "picture.png"));

    // An image larger than the limit. The size of a PFM is known in advance.
    for (const char* name : {"out/picture.png", "out/picture.hdr"})
        check(fixture.run({"render", "scene.json", "-o", name, "--size", "300x300"},
                          with_limit(RLIMIT_FSIZE, 500)),
              std::string(name) + ": cannot write: File too large");
    check(fixture.run(joined({"render", "scene.json", "-o", "out/picture.pfm"}, hours),
                      with_limit(RLIMIT_FSIZE, 500)),
          "out/picture.pfm: cannot write: File too large");
    CHECK(fixture.is_output_empty());
}

TEST_CASE("a disk without space is reported before the rendering starts") {
    const ToolFixture fixture;
    const bool mounted = ::unshare(CLONE_NEWNS) == 0 &&
                         ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                         ::mount("none", fixture.output().c_str(), "tmpfs", 0, "size=64k") == 0;
    if (!mounted) {
        WARN("skipped: no file system can be mounted here");
        return;
    }
    // First there is space for a name but for no content, then for some of the content.
    fixture.write("out/all", std::string(64 << 10, 'x'));
    for (const char* name : {"out/picture.png", "out/picture.hdr", "out/picture.pfm"})
        check(fixture.run(joined({"render", "scene.json", "-o", name}, hours)),
              std::string(name) + ": cannot write: No space left on device");
    std::filesystem::resize_file(fixture.output() / "all", 48 << 10);
    check(fixture.run(joined({"render", "scene.json", "-o", "out/picture.pfm"}, hours)),
          "out/picture.pfm: cannot write: No space left on device");
    check(fixture.render("out/picture.hdr", {"--size", "300x300"}),
          "out/picture.hdr: cannot write: No space left on device");
    CHECK(std::distance(std::filesystem::directory_iterator(fixture.output()), {}) == 1);
    CHECK(::umount(fixture.output().c_str()) == 0);
}

TEST_CASE("standard output that cannot be written gives an error of one line") {
    const ToolFixture fixture;
    REQUIRE(fixture.render("a.png").code == 0);
    const std::vector<std::vector<std::string>> commands = {{"info", "scene.json"},
                                                            {"info", "scene.json", "--json"},
                                                            {"compare", "a.png", "a.png"},
                                                            {"compare", "a.png", "a.png", "--json"},
                                                            {"--help"},
                                                            {"--version"},
                                                            {"render", "--help"}};
    for (const auto& arguments : commands) {
        Setup full;
        full.out = "/dev/full";
        check(fixture.run(arguments, full),
              "standard output: cannot write: No space left on device");
        Setup closed;
        closed.in_child = [] { ::close(STDOUT_FILENO); };
        check(fixture.run(arguments, closed), "standard output: cannot write: Bad file descriptor");
    }
    Setup full;
    full.out = "/dev/full";
    CHECK(fixture.run({"render", "scene.json", "-o", "out/b.png"}, full).code == 0);
}

TEST_CASE("text for a closed stream does not get into the image") {
    const ToolFixture fixture;
    REQUIRE(fixture.render("a.png").code == 0);
    const std::string expected = content_of(fixture.path() / "a.png");
    const auto render = [&](std::vector<int> closed, const std::vector<std::string>& options) {
        Setup setup;
        setup.in_child = [closed] {
            for (const int stream : closed)
                ::close(stream);
        };
        std::filesystem::remove(fixture.output() / "a.png");
        return fixture.run(joined({"render", "scene.json", "-o", "out/a.png"}, options), setup);
    };
    CHECK(render({2}, {"-v"}).code == 0);
    CHECK(content_of(fixture.output() / "a.png") == expected);
    CHECK(render({0, 1, 2}, {"-v"}).code == 0);
    CHECK(content_of(fixture.output() / "a.png") == expected);
    check(render({1}, {"--stats", "-"}), "standard output: cannot write: Bad file descriptor");
    Setup no_input;
    no_input.in_child = [] { ::close(STDIN_FILENO); };
    check(fixture.run({"render", "-", "-o", "out/b.png"}, no_input),
          "standard input: cannot read: Bad file descriptor");
}

TEST_CASE("memory that is refused gives an error of one line and leaves no file") {
    if (sanitized) {
        WARN("skipped: a sanitizer takes more memory than any limit");
        return;
    }
    const ToolFixture fixture;
    const std::vector<std::string> render = {"render", "scene.json", "-o", "out/picture.png"};
    check(fixture.run(joined(render, {"--size", "16000x16000"}), with_limit(RLIMIT_AS, 512 << 20)),
          "not enough memory");
    CHECK(fixture.is_output_empty());
    // Enough memory for the image but not for the stacks of all threads. Any of the threads may be
    // the first to notice.
    std::vector<rlim_t> limits = {100 << 20, 200 << 20};
    // The stack of the main thread is refused in a narrow range of limits, somewhere here.
    for (rlim_t kilobytes = 30000; kilobytes < 44000;
         kilobytes += raylane::tests::is_full() ? 4 : 24)
        limits.push_back(kilobytes << 10);
    for (const rlim_t limit : limits) {
        INFO(limit);
        const Outcome outcome =
            fixture.run(joined(render, {"--size", "300x300", "--spp", "65536", "--threads", "200"}),
                        with_limit(RLIMIT_AS, limit));
        CHECK(outcome.code == 3);
        CHECK(outcome.exited);
        CHECK(is_one_line(outcome.err));
        CHECK(outcome.err.starts_with("raylane: "));
        CHECK(fixture.is_output_empty());
    }
}
