#include "scenes/errors.hpp"
#include "scenes/scene_file.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/temporary_directory.hpp"

using namespace raylane::scenes;
using raylane::tests::TemporaryFile;

namespace {

const std::string json = R"({"camera": {"from": [0, 0, 9], "at": [0, 0, 0]}, "objects": []})";
const std::string nff = "v\nfrom 0 0 7\nat 0 0 0\nup 0 1 0\nangle 30\nhither 1\nresolution 8 8\n";

float distance_in(const std::string& text, const std::string& ending) {
    return load_scene(TemporaryFile(text, ending).path()).camera().from.z;
}

} // namespace

TEST_CASE("a scene's format follows the ending") {
    CHECK(distance_in(json, ".json") == 9.0F);
    CHECK(distance_in(json, ".JSON") == 9.0F);
    CHECK(distance_in(nff, ".nff") == 7.0F);
    CHECK(distance_in(nff, ".Nff") == 7.0F);
    CHECK_THROWS_AS(distance_in(nff, ".json"), BadInput);
    CHECK_THROWS_AS(distance_in(json, ".nff"), BadInput);
}

TEST_CASE("a scene's format follows the content where the ending says nothing") {
    const std::string ending = GENERATE("", ".txt", ".json.bak");
    CHECK(distance_in(json, ending) == 9.0F);
    CHECK(distance_in("\xEF\xBB\xBF\r\n\t " + json, ending) == 9.0F);
    CHECK(distance_in("// a comment\n" + json, ending) == 9.0F);
    CHECK(distance_in(nff, ending) == 7.0F);
    CHECK(distance_in("# a comment {\n\n" + nff, ending) == 7.0F);
}
