#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sanitized.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <random>
#include <sys/resource.h>

using namespace raylane::tests;

namespace {

/// In MiB. Sanitizers keep freed memory for a while.
constexpr long little_memory = sanitized ? 1024 : 64;

/// Returns the peak memory of this process, in MiB.
long peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}

} // namespace

TEST_CASE("a syntax error in JSON has a line and a column") {
    const auto complaint = placed_complaint_about_text;
    CHECK(complaint("") == "1:1: must be a scene, got an empty file");
    CHECK(complaint(" \n\t// nothing\n") == "3:1: must be a scene, got an empty file");
    CHECK(complaint("{\"camera\":\n  {\"from\": [0, 0") ==
          "2:17: must be ',' or ']', got the end of the file");
    CHECK(complaint("{\"camera\":\n  {\"from\": [0, 0], ") ==
          "2:20: must be a key in double quotes, got the end of the file");
    CHECK(complaint("{\"camera\":\n") == "2:1: must be a value, got the end of the file");
    CHECK(complaint("{\"camera") == "1:2: must be a string that ends on its line, got \"camera");
    CHECK(complaint("{\"camera\n\": 1}") ==
          "1:2: must be a string that ends on its line, got \"camera");
    CHECK(complaint("{\"background\": [NaN, 0, 0]}") == "1:17: must be a value, got NaN");
    CHECK(complaint("{\"background\": [0, -Infinity, 0]}") ==
          "1:20: must be JSON (invalid number; expected digit after '-'), got "
          "-Infinity");
    CHECK(complaint("{\"background\": [1., 0, 0]}") ==
          "1:17: must be JSON (invalid number; expected digit after '.'), got 1.");
    CHECK(complaint("{\"background\": [1 0, 0]}") == "1:19: must be ',' or ']', got 0");
    CHECK(complaint("{\"background\": [1, 0, 0,]}") == "1:25: must be a value, got ']'");
    CHECK(complaint("{\"image\": {\"width\": 1,}}") ==
          "1:23: must be a key in double quotes, got '}'");
    CHECK(complaint("{camera: 1}") == "1:2: must be a key in double quotes, got camera");
    CHECK(complaint("{'camera': 1}") == "1:2: must be a key in double quotes, got 'camera'");
    CHECK(complaint("{\"camera\" {}}") == "1:11: must be ':', got '{'");
    CHECK(complaint("{\"objects\": [] \"camera\": 1}") ==
          "1:16: must be ',' or '}', got \"camera\"");
    CHECK(complaint("{\"fog\": tru}") == "1:9: must be a value, got tru");
    CHECK(complaint(with_objects("") + "\n}") == "5:1: must be the end of the file, got '}'");
    CHECK(complaint("{\"a\\q\": 1}") == "1:2: must be JSON (invalid string: forbidden "
                                        "character after backslash), got \"a\\q\"");
    CHECK(complaint("{\"a\xFF\": 1}") ==
          "1:2: must be JSON (invalid string: ill-formed UTF-8 byte), got \"a\\xFF\"");
    CHECK(complaint("{\n /* gr\xC3\xBC\xC3\x9F*/ x") ==
          "2:12: must be a key in double quotes, got x");
    CHECK(complaint("{ /* for ever") == "1:3: must be a comment that ends with */");
    CHECK(complaint("{ / }") == "1:3: must be JSON, got /");
}

TEST_CASE("binary files are not JSON") {
    CHECK(placed_complaint_about_text(std::string("\x89PNG\r\n\x1A\n\0\0", 10)) ==
          "1:1: must be a value, got \\x89PNG");
    CHECK(placed_complaint_about_text(std::string("\x7F"
                                                  "ELF\2\1\1\0",
                                                  8)) == "1:1: must be a value, got \x5Cx7FELF");
    CHECK(placed_complaint_about_text(std::string("{\0}", 3)) ==
          "1:2: must be JSON, got the byte \\x00");
    CHECK(placed_complaint_about_text(std::string("\xFF\xFE{\0}\0", 6)) ==
          "1:1: must be a value, got \\xFF\\xFE");
    std::mt19937 random(1);
    for (int file = 0; file < 20; ++file) {
        std::string bytes(100000, '\0');
        for (char& byte : bytes)
            byte = static_cast<char>(random());
        const std::string complaint = placed_complaint_about_text(bytes);
        CHECK(complaint.starts_with("1:"));
        CHECK(complaint.size() < 300);
    }
}

TEST_CASE("nesting bombs are refused") {
    const std::string brackets(100000, '[');
    CHECK(placed_complaint_about_text(brackets) == "1:1: must be an object, got an array");
    CHECK(placed_complaint_about_text("{\"camera\": " + brackets) ==
          "1:12: /camera: must not be nested more than 16 deep");
    std::string braces = "{\"objects\": [";
    for (int i = 0; i < 100000; ++i)
        braces += "{\"a\":";
    CHECK(placed_complaint_about_text(braces) ==
          "1:14: /objects/0: must not be nested more than 256 deep");
}

TEST_CASE("one item cannot fill the memory") {
    std::string numbers = "{\"camera\": {\"from\": [";
    for (int i = 0; i < 5000; ++i)
        numbers += "0,";
    CHECK(placed_complaint_about_text(numbers) ==
          "1:12: /camera: must not hold more than 4096 values or 1048576 bytes of text");
    std::string texts = "{\"camera\": {\"from\": [";
    for (int i = 0; i < 20; ++i)
        texts += '"' + std::string(60000, 'x') + "\",";
    CHECK(placed_complaint_about_text(texts) ==
          "1:12: /camera: must not hold more than 4096 values or 1048576 bytes of text");
}

TEST_CASE("a line of 200 MB gives an error of one short line") {
    static constexpr std::uintmax_t huge = 200'000'000;
    static const std::string forty_a(40, 'a'), forty_ones(40, '1');
    struct Case {
        const char* start;
        char filling;
        std::string complaint;
    };
    const Case c = GENERATE(
        Case{"", 'a', "1:1: must be a value, got " + forty_a + "..."},
        Case{"{\"", 'a',
             "1:2: must be a string of at most 65536 bytes, got \"" + forty_a.substr(1) + "..."},
        Case{"{\"background\": ", '1',
             "1:16: must be a value of at most 1024 bytes, got " + forty_ones + "..."},
        Case{"", '[', "1:1: must be an object, got an array"},
        Case{"", '\0', "1:1: must be JSON, got the byte \\x00"},
        Case{"{ /*", '\0', "1:3: must be a comment that ends with */"},
        Case{"{", ' ', "1:200000001: must be a key in double quotes, got the end of the file"});
    const long before = peak_memory();
    std::string complaint;
    {
        const TemporaryFile file(c.start);
        // A file of zeros takes no disk space. The others are written in pieces.
        if (c.filling != '\0') {
            std::ofstream stream(file.path(), std::ios::binary | std::ios::app);
            const std::string piece(1 << 20, c.filling);
            for (std::uintmax_t size = std::strlen(c.start); size < huge; size += piece.size())
                stream.write(piece.data(), static_cast<std::streamsize>(std::min<std::uintmax_t>(
                                               piece.size(), huge - size)));
        }
        std::filesystem::resize_file(file.path(), huge);
        complaint = placed_complaint_about(file.path());
    }
    CHECK(complaint == c.complaint);
    CHECK(peak_memory() - before < little_memory);
}

TEST_CASE("a long list of objects is not held in memory") {
    std::string text = with_objects("");
    text.resize(text.size() - 2);
    const std::string bad =
        "{\"type\": \"sphere\", \"material\": \"clay\", \"center\": [0, 0, 0], \"radius\": 1},";
    {
        const TemporaryFile file(text);
        std::ofstream stream(file.path(), std::ios::binary | std::ios::app);
        for (int i = 0; i < 200000; ++i)
            stream << bad;
        stream << "{}";
        stream.close();
        const long before = peak_memory();
        CHECK(placed_complaint_about(file.path()) ==
              "4:14600028: /objects/200000: must have the key \"type\"\n"
              "4:14600030: must be ',' or ']', got the end of the file");
        CHECK(peak_memory() - before < little_memory);
    }
}
