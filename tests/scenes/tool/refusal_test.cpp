#include "tests/catch.hpp"
#include "tests/sanitized.hpp"
#include "tests/scenes/tool/workshop.hpp"

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
void check_at_once(const Workshop& workshop, const std::vector<std::string>& outputs,
                   const std::string& message, const Setup& setup = {}) {
    workshop.write("bad.json", "{");
    for (const char* scene : {"scene.json", "bad.json", "none.json"})
        check(workshop.run(joined(joined({"render", scene}, outputs), hours), setup), message);
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
    const Workshop workshop;
    std::filesystem::create_directory(workshop.path() / "picture.png");
    workshop.write("file", "");
    check_at_once(workshop, {"-o", "none/picture.png"},
                  "none/picture.png: cannot write: No such file or directory");
    check_at_once(workshop, {"-o", "picture.png"}, "picture.png: cannot write: Is a directory");
    check_at_once(workshop, {"-o", "file/picture.png"},
                  "file/picture.png: cannot write: Not a directory");
    check_at_once(workshop, {"-o", "out/picture.png", "--stats", "none/stats.json"},
                  "none/stats.json: cannot write: No such file or directory");
    check_at_once(workshop, {"-o", "out/picture.png", "--stats", "out"},
                  "out: cannot write: Is a directory");
    CHECK(workshop.is_output_empty());
    check(workshop.run({"compare", "none.png", "none.png", "--diff", "none/difference.png"}),
          "none/difference.png: cannot write: No such file or directory");
}

TEST_CASE("a missing permission to write is reported before the scene is read") {
    using std::filesystem::perms;
    const Workshop workshop;
    const auto protected_file = workshop.write("out/protected.png", "old");
    std::filesystem::permissions(workshop.path(), perms(0755));
    std::filesystem::permissions(protected_file, perms(0444));
    std::filesystem::permissions(workshop.output(), perms(0777));
    check_at_once(workshop, {"-o", "out/protected.png"},
                  "out/protected.png: cannot write: Permission denied", as_nobody());
    std::filesystem::permissions(workshop.output(), perms(0555));
    check_at_once(workshop, {"-o", "out/new.png"}, "out/new.png: cannot write: Permission denied",
                  as_nobody());
    CHECK(content_of(protected_file) == "old");
    CHECK(std::distance(std::filesystem::directory_iterator(workshop.output()), {}) == 1);
    std::filesystem::permissions(workshop.output(), perms(0755));

    std::filesystem::permissions(workshop.path() / "scene.json", perms(0));
    check(workshop.run({"info", "scene.json"}, as_nobody()),
          "scene.json: cannot open: Permission denied");
}

TEST_CASE("a full disk gives an error of one line and leaves no file") {
    const Workshop workshop;
    for (const char* name : {"full.png", "full.hdr", "full.pfm"}) {
        std::filesystem::create_symlink("/dev/full", workshop.path() / name);
        check(workshop.render(name), std::string(name) + ": cannot write: No space left on device");
    }
    check(workshop.render("out/picture.png", {"--stats", "/dev/full"}),
          "/dev/full: cannot write: No space left on device");
    CHECK(std::filesystem::remove(workshop.output() / "picture.png"));

    // An image larger than the limit. The size of a PFM is known in advance.
    for (const char* name : {"out/picture.png", "out/picture.hdr"})
        check(workshop.run({"render", "scene.json", "-o", name, "--size", "300x300"},
                           with_limit(RLIMIT_FSIZE, 500)),
              std::string(name) + ": cannot write: File too large");
    check(workshop.run(joined({"render", "scene.json", "-o", "out/picture.pfm"}, hours),
                       with_limit(RLIMIT_FSIZE, 500)),
          "out/picture.pfm: cannot write: File too large");
    CHECK(workshop.is_output_empty());
}

TEST_CASE("a disk without space is reported before the rendering starts") {
    const Workshop workshop;
    const bool mounted = ::unshare(CLONE_NEWNS) == 0 &&
                         ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                         ::mount("none", workshop.output().c_str(), "tmpfs", 0, "size=64k") == 0;
    if (!mounted) {
        WARN("skipped: no file system can be mounted here");
        return;
    }
    // First there is space for a name but for no content, then for some of the content.
    workshop.write("out/all", std::string(64 << 10, 'x'));
    for (const char* name : {"out/picture.png", "out/picture.hdr", "out/picture.pfm"})
        check(workshop.run(joined({"render", "scene.json", "-o", name}, hours)),
              std::string(name) + ": cannot write: No space left on device");
    std::filesystem::resize_file(workshop.output() / "all", 48 << 10);
    check(workshop.run(joined({"render", "scene.json", "-o", "out/picture.pfm"}, hours)),
          "out/picture.pfm: cannot write: No space left on device");
    check(workshop.render("out/picture.hdr", {"--size", "300x300"}),
          "out/picture.hdr: cannot write: No space left on device");
    CHECK(std::distance(std::filesystem::directory_iterator(workshop.output()), {}) == 1);
    CHECK(::umount(workshop.output().c_str()) == 0);
}

TEST_CASE("standard output that cannot be written gives an error of one line") {
    const Workshop workshop;
    REQUIRE(workshop.render("a.png").code == 0);
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
        check(workshop.run(arguments, full),
              "standard output: cannot write: No space left on device");
        Setup closed;
        closed.in_child = [] { ::close(STDOUT_FILENO); };
        check(workshop.run(arguments, closed),
              "standard output: cannot write: Bad file descriptor");
    }
    Setup full;
    full.out = "/dev/full";
    CHECK(workshop.run({"render", "scene.json", "-o", "out/b.png"}, full).code == 0);
}

TEST_CASE("text for a closed stream does not get into the image") {
    const Workshop workshop;
    REQUIRE(workshop.render("a.png").code == 0);
    const std::string expected = content_of(workshop.path() / "a.png");
    const auto render = [&](std::vector<int> closed, const std::vector<std::string>& options) {
        Setup setup;
        setup.in_child = [closed] {
            for (const int stream : closed)
                ::close(stream);
        };
        std::filesystem::remove(workshop.output() / "a.png");
        return workshop.run(joined({"render", "scene.json", "-o", "out/a.png"}, options), setup);
    };
    CHECK(render({2}, {"-v"}).code == 0);
    CHECK(content_of(workshop.output() / "a.png") == expected);
    CHECK(render({0, 1, 2}, {"-v"}).code == 0);
    CHECK(content_of(workshop.output() / "a.png") == expected);
    check(render({1}, {"--stats", "-"}), "standard output: cannot write: Bad file descriptor");
    Setup no_input;
    no_input.in_child = [] { ::close(STDIN_FILENO); };
    check(workshop.run({"render", "-", "-o", "out/b.png"}, no_input),
          "standard input: cannot read: Bad file descriptor");
}

TEST_CASE("memory that is refused gives an error of one line and leaves no file") {
    if (sanitized) {
        WARN("skipped: a sanitizer takes more memory than any limit");
        return;
    }
    const Workshop workshop;
    const std::vector<std::string> render = {"render", "scene.json", "-o", "out/picture.png"};
    check(workshop.run(joined(render, {"--size", "16000x16000"}), with_limit(RLIMIT_AS, 512 << 20)),
          "not enough memory");
    CHECK(workshop.is_output_empty());
    // Enough memory for the image but not for the stacks of all threads. Any of the threads may be
    // the first to notice.
    for (const rlim_t megabytes : {40, 100, 200}) {
        const Outcome outcome = workshop.run(
            joined(render, {"--size", "300x300", "--spp", "65536", "--threads", "200"}),
            with_limit(RLIMIT_AS, megabytes << 20));
        CHECK(outcome.code == 3);
        CHECK(outcome.exited);
        CHECK(is_one_line(outcome.err));
        CHECK(outcome.err.starts_with("raylane: "));
        CHECK(workshop.is_output_empty());
    }
}
