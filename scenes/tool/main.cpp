#include "scenes/api/cpp/raylane/version.h"
#include "scenes/files/atomic_file.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/exit.hpp"
#include "scenes/tool/options/command_line.hpp"
#include "scenes/tool/options/option_files.hpp"
#include "scenes/tool/ranks/ranks.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace raylane::scenes {

namespace {

/// Prints each line of the message and returns the exit code. Allocates no memory, because memory
/// may have run out.
int complain(std::string_view message, int code) {
    if (message.empty()) return code;
    if (first_rank_says_the_same()) return done; // a failure makes mpirun end rank 0 too early
    while (true) {
        const std::string_view line = message.substr(0, message.find('\n'));
        std::fprintf(stderr, "raylane: %.*s\n", static_cast<int>(line.size()), line.data());
        if (line.size() == message.size()) return code;
        message.remove_prefix(line.size() + 1);
    }
}

std::string exit_codes_text() {
    std::string text;
    for (const auto& [code, meaning] : exit_codes)
        text.append(text.empty() ? "Exit codes: " : ", ").append(code).append(" ").append(meaning);
    return text + ".";
}

int run(int argc, const char* const* argv) {
    CLI::App app("raylane renders scenes of spheres, cylinders, cones, boxes and other quadrics.",
                 "raylane");
    app.set_version_flag("--version", "raylane " RAYLANE_VERSION, "Print the version and exit");
    app.footer("Example: raylane render scenes/birthday.json -o birthday.png\n" +
               exit_codes_text());
    app.require_subcommand(1);
    const std::array<Command, 13> commands = {
        add_render_command(app),    add_info_command(app),  add_compare_command(app),
        add_convert_command(app),   add_build_command(app), add_tachyon_command(app),
        add_trace_command(app),     add_merge_command(app), add_verify_command(app),
        add_view_command(app),      add_help_command(app),  add_manual_command(app),
        add_completion_command(app)};
    name_commands(app);
    std::vector<std::string> arguments(argv + 1, argv + argc);
    std::optional<OptionFiles> files;
    for (const Command& command : commands)
        if (!arguments.empty() && arguments.front() == command.arguments->get_name() &&
            command.options != nullptr) {
            files.emplace(std::vector<std::string>(arguments.begin() + 1, arguments.end()),
                          *command.options, *commands.front().options);
            arguments.resize(1);
            arguments.insert(arguments.end(), files->arguments().begin(), files->arguments().end());
        }
    std::reverse(arguments.begin(), arguments.end()); // as CLI11 takes them
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::Success& request) {
        std::ostringstream text;
        const int code = app.exit(request, text, text);
        std::fputs(text.str().c_str(), stdout);
        return code;
    } catch (const CLI::ParseError& error) {
        return complain(usage_message(app, error), bad_input);
    }
    for (const Command& command : commands)
        if (command.arguments->parsed()) {
            if (!command.by_ranks) each_rank_speaks();
            try {
                return command.run();
            } catch (const BadInput& bad) {
                if (files) throw files->with_place(bad);
                throw;
            }
        }
    return bad_input;
}

/// If a standard stream is closed, the next opened file would take its descriptor, and messages
/// would be written into an image. So /dev/null takes the descriptor, opened such that reading
/// standard input, or writing the others, still fails.
void hold_places_of_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0) // open() returns the lowest free descriptor
            static_cast<void>(::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

/// Reports the exception that is being handled, for main and the handler below.
int complain_about_exception() {
    const Failure failure = failure_being_handled();
    return complain(failure.text, failure.code);
}

/// Several threads may fail at once. The first one reports its failure and ends the program; the
/// others wait here.
void be_the_first_to_fail() {
    static std::atomic_flag has_failed;
    while (has_failed.test_and_set())
        ::pause();
}

/// Ends the program after an exception that nothing can catch: oneTBB's threads start each other,
/// and the system may refuse a thread.
[[noreturn]] void end_by_terminate() {
    be_the_first_to_fail();
    remove_temporaries();
    ::_exit(std::current_exception() ? complain_about_exception() : refused);
}

constexpr std::size_t stack_bytes = std::size_t{1} << 20;

[[gnu::noinline]] void touch_stack() {
    [[maybe_unused]] volatile char stack[stack_bytes];
    for (std::size_t i = 0; i < stack_bytes; i += 4096)
        stack[i] = 0;
}

/// Takes memory for the stack of the main thread. A limit that refused it later would end the
/// program by a signal, without a message.
void take_stack() {
    rlimit limit{};
    if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur < 2 * stack_bytes) return;
    constexpr std::size_t margin = std::size_t{1} << 16;
    void* const trial =
        mmap(nullptr, stack_bytes + margin, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (trial == MAP_FAILED) return; // the next request fails, with a message
    munmap(trial, stack_bytes + margin);
    touch_stack();
}

} // namespace

} // namespace raylane::scenes

int main(int argc, char** argv) {
    using namespace raylane;
    scenes::take_stack();
    scenes::hold_places_of_streams();
    scenes::catch_signals();
    std::set_terminate(scenes::end_by_terminate);
    try {
        const int code = scenes::run(argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            throw scenes::SystemRefused("standard output", "write", errno);
        return code;
    } catch (...) {
        scenes::be_the_first_to_fail();
        return scenes::complain_about_exception();
    }
}
