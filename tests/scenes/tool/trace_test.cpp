#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

/// Tests of rays from a file in NumPy's format.
using namespace raylane::tests;

namespace {

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

/// Returns a file with this header.
std::string npy(const std::string& head, const std::string& content) {
    const auto length = static_cast<std::uint16_t>(head.size());
    std::string file("\x93NUMPY\x01\x00", 8);
    file.append(reinterpret_cast<const char*>(&length), sizeof length);
    return file + head + content;
}

/// Two rays: the first hits the ball, and the second would if columns were read as rows.
const std::string by_rows = bytes_of<float>({0, 0, 5, 0, 0, -1, 0, 0, 9, 0, 0, 1});
const std::string by_columns = bytes_of<float>({0, 0, 0, 0, 5, 9, 0, 0, 0, 0, -1, 1});

std::string occluded(const ToolFixture& fixture, const std::string& rays, Setup setup = {}) {
    const Outcome outcome = fixture.run(
        {"trace", "scene.json", rays, "-o", "hits.npy", "--occluded", "-q"}, std::move(setup));
    CHECK(outcome.err.empty());
    if (outcome.code != 0) return "none";
    const std::string hits = content_of(fixture.path() / "hits.npy");
    return hits.substr(hits.size() - 2);
}
const std::string first_alone("\x01\x00", 2);

} // namespace

TEST_CASE("headers of ray files are read as Python reads them") {
    const ToolFixture fixture;
    for (const char* head :
         {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 6), }\n",
          "{'descr': '<f4', 'fortran_order':\tFalse, 'shape': (2, 6)}",
          "\t{\r\n\"shape\"\t:\n(\t2\t,\f6\t,\t)\t,'fortran_order':False,'descr':\t'<f4'\t}\t",
          "{'descr':'<f4','fortran_order' : False,'shape':(2,2,3)}"}) {
        CAPTURE(head);
        fixture.write("rays.npy", npy(head, by_rows));
        CHECK(occluded(fixture, "rays.npy") == first_alone);
    }
    for (const char* head : {"{'descr': '<f4', 'fortran_order': True, 'shape': (2, 6), }\n",
                             "{'descr': '<f4', 'fortran_order':\tTrue, 'shape': (2, 6), }",
                             "{'fortran_order'\n:\n\tTrue\n,'shape':(2, 6), 'descr': \"<f4\"}"}) {
        CAPTURE(head);
        fixture.write("rays.npy", npy(head, by_columns));
        CHECK(occluded(fixture, "rays.npy") == first_alone);
    }
}

TEST_CASE("invalid headers of ray files are refused") {
    const ToolFixture fixture;
    const auto refused = [&](const std::string& head, const std::string& message) {
        CAPTURE(head);
        fixture.write("rays.npy", npy(head, by_rows));
        const Outcome outcome =
            fixture.run({"trace", "scene.json", "rays.npy", "-o", "out/hits.npy"});
        CHECK(outcome.code == 2);
        CHECK(outcome.err == "raylane: rays.npy: " + message + "\n");
        CHECK(fixture.is_output_empty());
    };
    for (const char* order : {"1", "0", "TrueX", "FalseX", "True_", "true", "'True'", "None", ""})
        refused("{'descr': '<f4', 'fortran_order': " + std::string(order) + ", 'shape': (2, 6)}",
                "must have a fortran_order of True or False");
    for (const char* shape : {"2, 6", "[2, 6]", "(2 6)", "(2,, 6)", "(, 2, 6)", "(2, 6", "(2, -6)",
                              "(2)", "(02, 6)", "(2.0, 6)", "(2, 6x)", "(0x2, 6)", "()x"})
        refused("{'descr': '<f4', 'fortran_order': False, 'shape': " + std::string(shape) + "}",
                std::string(shape) == "()x" ? "has a header that is not a Python dictionary"
                                            : "has a malformed shape");
    for (const char* type : {"f4", "[('x', '<f4')]", "'<f4", "u'<f4'", ""})
        refused("{'fortran_order': False, 'shape': (2, 6), 'descr': " + std::string(type) + "}",
                "must have numbers of one type, float32 or float64");
    refused("{'descr': '<f4' '<f4', 'fortran_order': False, 'shape': (2, 6)}",
            "has a header that is not a Python dictionary");
    refused("'descr': '<f4', 'fortran_order': False, 'shape': (2, 6)",
            "has a header that is not a Python dictionary");
    refused("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 6)",
            "has a header that is not a Python dictionary");
    refused("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 6)} x",
            "has a header that is not a Python dictionary");
    refused("{'descr': '<f4', 'fortran_order': False 'shape': (2, 6)}",
            "has a header that is not a Python dictionary");
    refused("{'descr': '<f4', 'shape': (2, 6)}", "has no fortran_order in its header");
    refused("{'fortran_order': False, 'shape': (2, 6)}", "has no descr in its header");
    refused("{'descr': '<f4', 'fortran_order': False}", "has no shape in its header");
    refused("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 6), 'order': 1}",
            "has an unknown key in its header, \"order\"");
}

TEST_CASE("rays from standard input are read from the file's current offset") {
    const ToolFixture fixture;
    const std::string rays =
        npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 6), }\n", by_rows);
    const auto from = [&](const std::string& content, off_t place) {
        Setup setup;
        setup.in_child = [file = fixture.write("input", content), place] {
            ::dup2(::open(file.c_str(), O_RDONLY), STDIN_FILENO);
            ::lseek(STDIN_FILENO, place, SEEK_SET);
        };
        return setup;
    };
    CHECK(occluded(fixture, "-", from(rays, 0)) == first_alone);
    CHECK(occluded(fixture, "-", from("before" + rays, 6)) == first_alone);
    for (const off_t place : {1, 1000}) {
        const Outcome outcome =
            fixture.run({"trace", "scene.json", "-", "-o", "out/a"}, from(rays, place));
        CHECK(outcome.code == 2);
        CHECK(outcome.err ==
              "raylane: standard input: must be an array in NumPy's format (.npy)\n");
    }
    Setup pipe;
    pipe.in_child = [] {
        int ends[2] = {};
        if (::pipe(ends) == 0) ::dup2(ends[0], STDIN_FILENO);
    };
    Outcome outcome = fixture.run({"trace", "scene.json", "-", "-o", "out/a"}, pipe);
    CHECK(outcome.code == 2);
    CHECK(outcome.err == "raylane: standard input: must be a regular file\n");
    outcome = fixture.run({"trace", "-", "-", "-o", "out/a"}, from(rays, 0));
    CHECK(outcome.code == 2);
    CHECK(outcome.err == "raylane: RAYS: must be another file than SCENE, got \"-\"\n");
    CHECK(fixture.is_output_empty());
}
