#include "tests/places.hpp"
#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

#include <regex>
#include <set>

using namespace raylane;
using namespace raylane::tests;

namespace {

std::string said(const ToolFixture& fixture, const std::vector<std::string>& arguments) {
    const Outcome outcome = fixture.run(arguments);
    CAPTURE(arguments, outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    return outcome.out;
}

/// Returns the first groups of all matches.
std::set<std::string> all_of(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    std::set<std::string> found;
    for (auto match = std::sregex_iterator(text.begin(), text.end(), regex);
         match != std::sregex_iterator(); ++match)
        found.insert((*match)[1]);
    return found;
}

std::set<std::string> commands_in_help(const ToolFixture& fixture) {
    const std::string help = said(fixture, {"--help"});
    return all_of(help.substr(help.find("Subcommands:")), "\n  ([a-z]+) ");
}

std::set<std::string> options_in_help(const ToolFixture& fixture, const std::string& command) {
    return all_of(said(fixture, {command, "--help"}), "\n  (?:-[a-z],)?--([a-z-]+)");
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("manual pages and completions have every command and option of the help") {
    const ToolFixture fixture;
    const std::set<std::string> commands = commands_in_help(fixture);
    CHECK(commands.size() >= 6);
    const std::string bash = said(fixture, {"completion", "bash"}),
                      whole = said(fixture, {"manual"});
    for (const std::string& command : commands) {
        CAPTURE(command);
        const std::string page = said(fixture, {"manual", command});
        CHECK(page.starts_with(".TH RAYLANE\\-"));
        CHECK(holds(whole, "raylane\\-" + command + " (1)"));
        if (command == "tachyon") { // has the options of another program
            CHECK(holds(page, "\n  \\-aasamples N"));
            continue;
        }
        CHECK(holds(bash, "        " + command + ":-*) words=\"-h --help"));
        for (const std::string& option : options_in_help(fixture, command)) {
            CAPTURE(option);
            CHECK(holds(bash, "--" + option));
            CHECK(holds(page, "\\-\\-" + std::regex_replace(option, std::regex("-"), "\\-")));
        }
    }
    CHECK(holds(bash, "render:--engine) words=\"vector reference\""));
    CHECK(holds(bash, "manual:*) words=\"render info "));
}

TEST_CASE("help has the ranges and defaults of options") {
    const ToolFixture fixture;
    const std::string render = said(fixture, {"render", "--help"}),
                      merge = said(fixture, {"merge", "--help"});
    for (const char* part :
         {"at the resolution of --dpi. Default for atoms: 1200x900; for scenes: as the file "
          "says.\n",
          "Range: 10 to 80 dB. Default for atoms: 46, or 40 for spheres and points;",
          "Range: 0 to 1000. Default for atoms: 8; for scenes: as the file says.\n",
          "slow. Default: vector.\n", "--bits 8|16|32 ", "Default: 8 (PNG, TIFF), 16 (EXR).\n"})
        CHECK(holds(render, part));
    CHECK(holds(merge, "Default: 8 (PNG), 32 (EXR), same as the parts.\n"));
    CHECK(holds(said(fixture, {"compare", "--help"}), "Range: 0 or more. Default: 0.\n"));
}

TEST_CASE("help prints each page that it lists and the help of commands") {
    const ToolFixture fixture;
    const std::string list = said(fixture, {"help"});
    const std::set<std::string> topics = all_of(list, "\n  ([a-z]+) ");
    CHECK(topics.size() == 10);
    for (const std::string& topic : topics) {
        CAPTURE(topic);
        CHECK(said(fixture, {"help", topic}).starts_with("# "));
    }
    CHECK(said(fixture, {"help", "raylane"}) == content_of(RAYLANE_SOURCE_DIR "/README.md"));
    CHECK(said(fixture, {"help", "render"}) == said(fixture, {"render", "--help"}));
    const Outcome unknown = fixture.run({"help", "scene"});
    CHECK(unknown.code == 2);
    CHECK(holds(unknown.err, "did you mean \"scenes\"?"));
}

TEST_CASE("a manual page has no unintended requests or escapes") {
    const ToolFixture fixture;
    const std::set<std::string> requests = {"TH", "SH", "SS", "TP", "BR", "EX", "EE"};
    for (const std::string& command : commands_in_help(fixture)) {
        const std::string page = said(fixture, {"manual", command});
        for (const std::string& request : all_of(page, "(?:^|\n)[.']([^ \n]*)"))
            CHECK(requests.contains(request));
        for (const std::string& escape : all_of(page, "\\\\(.)"))
            CHECK(std::string("-&efB").find(escape) != std::string::npos);
    }
}

TEST_CASE("manual writes the pages of all commands into a folder") {
    const ToolFixture fixture;
    CHECK(said(fixture, {"manual", "--all", "out"}).empty());
    for (const std::string& command : commands_in_help(fixture))
        CHECK(std::filesystem::exists(fixture.output() / ("raylane-" + command + ".1")));
    CHECK(std::filesystem::exists(fixture.output() / "raylane.1"));
    CHECK(fixture.run({"manual", "render", "--all", "out"}).err ==
          "raylane: --all: goes without COMMAND\n");
}

TEST_CASE("a manual page or a completion that does not exist gives an error of one line") {
    const ToolFixture fixture;
    const Outcome page = fixture.run({"manual", "rendr"});
    CHECK(page.code == 2);
    CHECK(is_one_line(page.err));
    CHECK(page.err.starts_with("raylane: COMMAND: must be render, info, "));
    CHECK(holds(page.err, "did you mean"));
    const Outcome shell = fixture.run({"completion", "csh"});
    CHECK(shell.code == 2);
    CHECK(shell.err.starts_with("raylane: SHELL: must be bash, got "));
}
