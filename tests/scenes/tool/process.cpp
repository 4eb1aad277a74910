#include "tests/scenes/tool/process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace raylane::tests {

namespace {

constexpr std::chrono::minutes patience{10};

/// The program that is started: raylane, or an emulator that runs it.
#ifdef RAYLANE_EMULATOR
constexpr const char* first_words[] = {RAYLANE_EMULATOR, RAYLANE_TOOL};
constexpr const char* started = first_words[0];
#else
constexpr const char* first_words[] = {"raylane"};
constexpr const char* started = RAYLANE_TOOL;
#endif

int checked(int result, const char* what) {
    if (result < 0) throw std::system_error(errno, std::generic_category(), what);
    return result;
}

/// Returns the two ends of a pipe: bytes written to the second are read from the first.
using Ends = std::array<int, 2>;

Ends pipe_ends() {
    Ends ends;
    checked(::pipe2(ends.data(), O_CLOEXEC), "pipe");
    return ends;
}

Ends terminal_ends() {
    Ends ends;
    ends[0] = checked(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC), "posix_openpt");
    checked(::grantpt(ends[0]), "grantpt");
    checked(::unlockpt(ends[0]), "unlockpt");
    ends[1] =
        checked(::open(::ptsname(ends[0]), O_RDWR | O_NOCTTY | O_CLOEXEC), "terminal's other end");
    return ends;
}

/// Restores default handlers and the mask. No signal may reach this program's handlers between the
/// fork and the start of the new program.
void restore_signals(const sigset_t& mask) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        ::signal(signal, SIG_DFL);
    ::sigprocmask(SIG_SETMASK, &mask, nullptr);
}

/// Appends the available bytes. Returns false at the end, for which a terminal without writers
/// gives EIO.
bool read_some(int descriptor, std::string& text) {
    std::array<char, 4096> buffer;
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
}

} // namespace

Process::Process(const std::vector<std::string>& arguments, const Setup& setup) {
    std::vector<std::string> words(std::begin(first_words), std::end(first_words));
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);

    // Opened here, because the child may become a user without access to the folder.
    const int program = checked(::open(started, O_RDONLY | O_CLOEXEC), started);
    const Ends out = pipe_ends();
    const Ends err = setup.terminal ? terminal_ends() : pipe_ends();
    sigset_t signals, mask;
    ::sigfillset(&signals);
    ::sigprocmask(SIG_SETMASK, &signals, &mask);
    child_ = ::fork();
    if (child_ == 0) {
        restore_signals(mask);
        const int out_file =
            setup.out.empty() ? out[1] : ::open(setup.out.c_str(), O_WRONLY | O_CLOEXEC);
        const bool ready = ::dup2(out_file, STDOUT_FILENO) >= 0 &&
                           ::dup2(err[1], STDERR_FILENO) >= 0 &&
                           ::chdir(setup.directory.c_str()) == 0;
        if (ready && setup.in_child) setup.in_child();
        if (ready) ::fexecve(program, argv.data(), environ);
        ::_exit(127);
    }
    ::sigprocmask(SIG_SETMASK, &mask, nullptr);
    checked(child_, "fork");
    for (const int unused : {program, out[1], err[1]})
        ::close(unused);
    out_ = out[0];
    err_ = err[0];
}

Process::~Process() {
    if (child_ > 0) {
        ::kill(child_, SIGKILL);
        ::waitpid(child_, nullptr, 0);
    }
    ::close(out_);
    ::close(err_);
}

void Process::send(int signal) const {
    checked(::kill(child_, signal), "kill");
}

bool Process::waits_in_open() const {
    const std::string folder = "/proc/" + std::to_string(child_);
    long call = -1; // the file has no number while the process runs
    std::ifstream(folder + "/syscall") >> call;
    if (call != SYS_openat) return false;
    std::string status;
    std::getline(std::ifstream(folder + "/stat"), status);
    // The state follows the name, which is in parentheses. Opening a regular file never sleeps in
    // S.
    return status.find(") S ") != std::string::npos;
}

int Process::unnamed_files_in(const std::filesystem::path& directory) const {
    const std::string start = std::filesystem::canonical(directory).string() + "/";
    int count = 0;
    std::error_code gone; // the process may close files at any time
    for (std::filesystem::directory_iterator file("/proc/" + std::to_string(child_) + "/fd", gone),
         end;
         !gone && file != end; file.increment(gone)) {
        const std::string path = std::filesystem::read_symlink(file->path(), gone).string();
        if (path.starts_with(start) && path.ends_with(" (deleted)")) ++count;
        gone.clear();
    }
    return count;
}

bool Process::wait_for_err(std::string_view text) {
    return collect(std::chrono::steady_clock::now() + patience, text);
}

bool Process::wait_for_further_err(std::string_view text) {
    return collect(std::chrono::steady_clock::now() + patience, text, err_text_.size());
}

Outcome Process::wait() {
    if (!collect(std::chrono::steady_clock::now() + patience, {})) send(SIGKILL);
    int status = 0;
    rusage usage{};
    checked(::wait4(child_, &status, 0, &usage), "wait4");
    child_ = -1;
    const bool exited = WIFEXITED(status);
    return {exited ? WEXITSTATUS(status) : 128 + WTERMSIG(status), exited, out_text_, err_text_,
            usage.ru_maxrss / 1024};
}

/// Reads until the process closes both ends, or until standard error has the expected text at or
/// after a character. Returns false at the deadline, and if the expected text is missing.
bool Process::collect(std::chrono::steady_clock::time_point end, std::string_view expected,
                      std::size_t from) {
    using std::chrono::milliseconds;
    std::array<pollfd, 2> sources = {pollfd{out_, POLLIN, 0}, pollfd{err_, POLLIN, 0}};
    const auto has_come = [&] {
        return !expected.empty() && err_text_.find(expected, from) != std::string::npos;
    };
    while (!has_come() && (sources[0].fd >= 0 || sources[1].fd >= 0)) {
        const auto left = std::chrono::ceil<milliseconds>(end - std::chrono::steady_clock::now());
        const int ready = ::poll(sources.data(), sources.size(),
                                 static_cast<int>(std::max(left, milliseconds(0)).count()));
        if (ready < 0 && errno == EINTR) continue;
        if (ready <= 0) return false;
        for (pollfd& source : sources) {
            std::string& text = source.fd == out_ ? out_text_ : err_text_;
            if (source.revents != 0 && !read_some(source.fd, text)) source.fd = -1;
        }
    }
    return expected.empty() || has_come();
}

Hold::Hold(const std::string& call, int count) {
    const std::string path = directory_.path() / "pipe";
    checked(::mkfifo(path.c_str(), 0666), "mkfifo");
    pipe_ = checked(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC), "open");
    text_ = call + ':' + std::to_string(count) + ':' + path;
}

Setup Hold::in(Setup setup) const {
    setup.in_child = [prepare = setup.in_child, text = text_] {
        if (prepare) prepare();
        ::setenv("LD_PRELOAD", RAYLANE_HELD_CALL, 1);
        ::setenv("RAYLANE_HOLD", text.c_str(), 1);
        // The address sanitizer wants to be loaded first, but only its allocator needs that.
        const char* const options = std::getenv("ASAN_OPTIONS");
        const std::string more = options != nullptr ? std::string(options) + ':' : "";
        ::setenv("ASAN_OPTIONS", (more + "verify_asan_link_order=0").c_str(), 1);
    };
    return setup;
}

bool Hold::wait() const {
    pollfd source{pipe_, POLLIN, 0};
    const auto milliseconds = std::chrono::milliseconds(patience).count();
    return ::poll(&source, 1, static_cast<int>(milliseconds)) == 1 && source.revents == POLLIN;
}

void Hold::release() {
    if (pipe_ >= 0) ::close(pipe_);
    pipe_ = -1;
}

} // namespace raylane::tests
