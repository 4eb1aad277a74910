#include "scenes/files/errors.hpp"
#include "scenes/images/reader.hpp"
#include "scenes/images/writer.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/support/catch.hpp"

#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <functional>
#include <memory>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace raylane;
using tests::content_of;
using tests::TemporaryDirectory;

namespace {

void write(const std::filesystem::path& path, int size = 4) {
    scenes::OutputFile file(path);
    file.commit(core::Film(size, size), core::Transfer::srgb);
}

/// Returns the error of writing an image to `path`, without the directory.
std::string refusal_of(const std::filesystem::path& path, int size = 4) {
    return tests::message_in<scenes::SystemRefused>(path.parent_path(), [&] { write(path, size); });
}

unsigned mode_of(const std::filesystem::path& path) {
    struct stat status {};
    REQUIRE(::stat(path.c_str(), &status) == 0);
    return status.st_mode & 07777;
}

bool is_image(const std::filesystem::path& path) {
    return scenes::read_image(path).width == 4;
}

/// Returns true if `test` does in a child process, whose limits and user it may change.
bool holds_in_child(const std::function<bool()>& test) {
    std::fflush(nullptr); // otherwise the thread sanitizer's _exit() writes the text again
    const pid_t child = ::fork();
    if (child == 0) {
        bool holds = false;
        try {
            holds = test();
        } catch (...) {
        }
        ::_exit(holds ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Becomes an unprivileged user if the process runs as root, who may write everywhere.
void become_nobody() {
    constexpr unsigned nobody = 65534;
    if (::geteuid() != 0) return;
    if (::setgid(nobody) != 0 || ::setuid(nobody) != 0) throw std::runtime_error("setuid");
}

} // namespace

TEST_CASE("the ending of a file name selects the image format") {
    const TemporaryDirectory directory;
    const auto error_of = [&](const char* name) {
        return tests::message_in<scenes::BadInput>(
            directory.path(), [&] { const scenes::OutputFile file(directory.path() / name); });
    };
    CHECK(error_of("a.jpg") ==
          "a.jpg: must end in .png, .hdr, .pfm, .tga, .bmp or .ppm, got \".jpg\"");
    CHECK(error_of("png") ==
          "png: must end in .png, .hdr, .pfm, .tga, .bmp or .ppm, got no ending");
    for (const char* name : {"a.png", "a.hdr", "a.pfm", "a.tga", "a.bmp", "a.ppm", "a.b.PFM"})
        CHECK(error_of(name) == "no error");
    CHECK(directory.file_count() == 0);
}

TEST_CASE("an output file appears whole or not at all") {
    const TemporaryDirectory directory;
    const auto path = directory.write("out.png", "old");
    {
        const scenes::OutputFile file(path);
        CHECK(content_of(path) == "old");
        // The temporary file has no name, so a killed process leaves nothing behind.
        CHECK(directory.names() == std::vector<std::string>{"out.png"});
    }
    CHECK(content_of(path) == "old");
    CHECK(directory.file_count() == 1);
    write(path);
    CHECK(is_image(path));
    CHECK(directory.file_count() == 1);
    // The longest file name that the system accepts.
    const auto longest = directory.path() / (std::string(251, 'a') + ".png");
    write(longest);
    CHECK(is_image(longest));
}

TEST_CASE("a temporary with a name stands beside the output until it is committed") {
    const TemporaryDirectory directory;
    const auto path = directory.write("out.png", "old");
    for (const char* content : {"", "new", "newer"}) {
        scenes::AtomicFile file(path, scenes::AtomicFile::Temporary::named);
        const std::vector<std::string> names = directory.names();
        REQUIRE(names.size() == 2);
        CHECK(names[0].starts_with(".out.png."));
        CHECK(names[1] == "out.png");
        file.write({content, std::strlen(content)});
        if (*content == '\0') continue;
        file.commit();
        CHECK(content_of(path) == content);
        CHECK(directory.file_count() == 1);
    }
    CHECK(content_of(path) == "newer");
}

TEST_CASE("all temporaries with names can be removed at once") {
    constexpr auto named = scenes::AtomicFile::Temporary::named;
    const TemporaryDirectory directory;
    {
        scenes::OutputFile done(directory.path() / "done.png");
        done.commit(core::Film(4, 4), core::Transfer::srgb);
        const scenes::AtomicFile one(directory.path() / "one", named);
        const scenes::AtomicFile two(directory.path() / "two", named);
        const scenes::AtomicFile device("/dev/null");
        CHECK(directory.file_count() == 3);
        scenes::remove_temporaries();
        CHECK(directory.names() == std::vector<std::string>{"done.png"});
        directory.write("one", "mine");
    }
    scenes::remove_temporaries();
    CHECK(directory.names() == std::vector<std::string>{"done.png", "one"});
    // More temporaries at a time than the handler's table holds, and more in sequence.
    for (int i = 0; i < 3; ++i) {
        std::vector<std::unique_ptr<scenes::AtomicFile>> files;
        for (int k = 0; k < 20; ++k)
            files.push_back(std::make_unique<scenes::AtomicFile>(directory.path() / "many", named));
    }
    CHECK(directory.file_count() == 2);
    const scenes::AtomicFile last(directory.path() / "last", named);
    CHECK(directory.file_count() == 3);
    scenes::remove_temporaries();
    CHECK(directory.file_count() == 2);
}

TEST_CASE("a path that cannot be written is refused when it is opened") {
    const TemporaryDirectory directory;
    directory.write("file", "");
    std::filesystem::create_directory(directory.path() / "directory.png");
    std::filesystem::create_symlink("loop.png", directory.path() / "loop.png");
    const auto refusal = [&](const std::string& name) {
        return tests::message_in<scenes::SystemRefused>(
            directory.path(), [&] { const scenes::OutputFile file(directory.path() / name); });
    };
    CHECK(refusal("none/out.png") == "none/out.png: cannot write: No such file or directory");
    CHECK(refusal("file/out.png") == "file/out.png: cannot write: Not a directory");
    CHECK(refusal("directory.png") == "directory.png: cannot write: Is a directory");
    CHECK(refusal("loop.png") == "loop.png: cannot write: Too many levels of symbolic links");
    CHECK(refusal(std::string(252, 'a') + ".png").ends_with("cannot write: File name too long"));
    CHECK(directory.file_count() == 3);
}

TEST_CASE("a directory or file that may not be written is refused") {
    const TemporaryDirectory directory;
    const auto file = directory.write("protected.png", "old");
    std::filesystem::permissions(file, std::filesystem::perms(0444));
    std::filesystem::permissions(directory.path(), std::filesystem::perms(0777));
    CHECK(holds_in_child([&] {
        become_nobody();
        return refusal_of(file) == "protected.png: cannot write: Permission denied";
    }));
    std::filesystem::permissions(directory.path(), std::filesystem::perms(0555));
    CHECK(holds_in_child([&] {
        become_nobody();
        return refusal_of(directory.path() / "out.png") ==
               "out.png: cannot write: Permission denied";
    }));
    std::filesystem::permissions(directory.path(), std::filesystem::perms(0755));
    CHECK(content_of(file) == "old");
    CHECK(directory.file_count() == 1);
}

TEST_CASE("a symbolic link stays a link and its target is replaced") {
    const TemporaryDirectory directory;
    std::filesystem::create_directory(directory.path() / "far");
    const auto target = directory.write("far/target.png", "old");
    const auto link = directory.path() / "link.png";
    std::filesystem::create_symlink("far/second.png", link);
    std::filesystem::create_symlink("target.png", directory.path() / "far/second.png");
    write(link);
    CHECK(std::filesystem::is_symlink(link));
    CHECK(std::filesystem::is_symlink(directory.path() / "far/second.png"));
    CHECK(is_image(target));
    // A link whose target does not exist yet.
    const auto dangling = directory.path() / "dangling.png";
    std::filesystem::create_symlink(directory.path() / "far/new.png", dangling);
    write(dangling);
    CHECK(std::filesystem::is_symlink(dangling));
    CHECK(is_image(directory.path() / "far/new.png"));
}

TEST_CASE("a new file has the umask's permissions and a replaced one keeps its own") {
    const TemporaryDirectory directory;
    const auto path = directory.path() / "out.png";
    CHECK(holds_in_child([&] {
        ::umask(027);
        write(path);
        return true;
    }));
    CHECK(mode_of(path) == 0640);
    for (const unsigned mode : {0600U, 0666U, 0755U}) {
        std::filesystem::permissions(path, std::filesystem::perms(mode));
        write(path);
        CHECK(mode_of(path) == mode);
    }
}

TEST_CASE("a full disk is an error and leaves nothing behind") {
    const TemporaryDirectory directory;
    for (const char* name : {"full.png", "full.hdr", "full.pfm"}) {
        const auto full = directory.path() / name;
        std::filesystem::create_symlink("/dev/full", full);
        CHECK(refusal_of(full) == std::string(name) + ": cannot write: No space left on device");
        CHECK(std::filesystem::is_symlink(full));
    }
    CHECK(directory.file_count() == 3);
    // A size that is known in advance.
    CHECK(holds_in_child([&] {
        const rlimit file_size{1000, 1000};
        ::setrlimit(RLIMIT_FSIZE, &file_size);
        scenes::AtomicFile file(directory.path() / "out.pfm");
        file.reserve(1000);
        try {
            file.reserve(1001);
        } catch (const scenes::SystemRefused&) {
            return true;
        }
        return false;
    }));
    CHECK(directory.file_count() == 3);
    // Limits that are reached at the start, in the middle and in the last block.
    for (const rlim_t limit : {10, 100000, 1080000})
        CHECK(holds_in_child([&] {
            const rlimit file_size{limit, limit};
            ::setrlimit(RLIMIT_FSIZE, &file_size);
            std::signal(SIGXFSZ, SIG_IGN);
            return refusal_of(directory.path() / "out.pfm", 300) ==
                   "out.pfm: cannot write: File too large";
        }));
    CHECK(directory.file_count() == 3);
}

TEST_CASE("a file that is not a regular one is written directly") {
    const TemporaryDirectory directory;
    const auto null = directory.path() / "null.pfm";
    std::filesystem::create_symlink("/dev/null", null);
    write(null);
    CHECK(std::filesystem::is_symlink(null));

    const auto pipe = directory.path() / "pipe.pfm";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    REQUIRE(reader >= 0);
    {
        scenes::OutputFile file(pipe);
        CHECK(directory.file_count() == 2);
        file.commit(core::Film(1, 1), core::Transfer::srgb);
    }
    char text[64];
    CHECK(::read(reader, text, sizeof text) == 24);
    CHECK(std::string_view(text, 12) == "PF\n1 1\n-1.0\n");

    // A reader that closes the pipe.
    const auto previous = std::signal(SIGPIPE, SIG_IGN);
    {
        scenes::OutputFile file(pipe);
        ::close(reader);
        CHECK_THROWS_WITH(file.commit(core::Film(1, 1), core::Transfer::srgb),
                          pipe.string() + ": cannot write: Broken pipe");
    }
    std::signal(SIGPIPE, previous);
    CHECK(directory.file_count() == 2);
}

TEST_CASE("a path of an open descriptor is written from its current offset") {
    const TemporaryDirectory directory;
    const auto path = directory.write("log", "");
    const int log = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    REQUIRE(log >= 0);
    const auto put = [&](std::string_view text) {
        REQUIRE(::write(log, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    };
    const std::string number = std::to_string(log);
    std::filesystem::create_symlink("/dev/fd/" + number, directory.path() / "link");
    put("before ");
    for (const std::filesystem::path& name :
         {std::filesystem::path("/proc/self/fd/" + number), directory.path() / "link"}) {
        scenes::AtomicFile file(name);
        file.write(std::string_view("amid "));
        file.commit();
    }
    put("behind");
    ::close(log);
    CHECK(content_of(path) == "before amid amid behind");
    CHECK(directory.file_count() == 2);

    const int reading = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const std::filesystem::path read_only = "/dev/fd/" + std::to_string(reading);
    CHECK(tests::message_of<scenes::SystemRefused>([&] { scenes::AtomicFile file(read_only); }) ==
          read_only.string() + ": cannot write: Bad file descriptor");
    ::close(reading);
}

TEST_CASE("a dash is standard output") {
    const TemporaryDirectory directory;
    const auto path = directory.path() / "out";
    CHECK(holds_in_child([&] {
        const int out = ::open(path.c_str(), O_WRONLY | O_CREAT, 0600);
        ::dup2(out, STDOUT_FILENO);
        write("-");
        return true;
    }));
    std::filesystem::rename(path, directory.path() / "out.png");
    CHECK(is_image(directory.path() / "out.png"));
    CHECK(directory.file_count() == 1);
}

TEST_CASE("a replaced file keeps its owner and permissions") {
    const TemporaryDirectory directory;
    const auto owner_of = [](const std::filesystem::path& path) {
        struct stat status {};
        REQUIRE(::stat(path.c_str(), &status) == 0);
        return std::pair(status.st_uid, status.st_gid);
    };
    const auto path = directory.write("out.png", "old");
    if (::geteuid() == 0) REQUIRE(::chown(path.c_str(), 1234, 4321) == 0);
    std::filesystem::permissions(path, std::filesystem::perms(0640));
    const auto owner = owner_of(path);
    write(path);
    CHECK(is_image(path));
    CHECK(owner_of(path) == owner);
    CHECK(mode_of(path) == 0640);

    // A user who may write the file but not change its owner.
    const auto shared = directory.write("shared.png", std::string(100000, 'x'));
    std::filesystem::permissions(shared, std::filesystem::perms(0666));
    std::filesystem::permissions(directory.path(), std::filesystem::perms(0777));
    const auto first_owner = owner_of(shared);
    CHECK(holds_in_child([&] {
        become_nobody();
        write(shared);
        return true;
    }));
    CHECK(is_image(shared));
    CHECK(owner_of(shared) == first_owner);
    CHECK(mode_of(shared) == 0666);
    CHECK(directory.file_count() == 2);
}
