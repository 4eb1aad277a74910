#include "scenes/json/reader.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/temporary_directory.hpp"

using namespace raylane;

TEST_CASE("the README's scene is one") {
    const std::string readme = tests::content_of(RAYLANE_SOURCE_DIR "/README.md");
    const std::string opening = "```json\n";
    const std::size_t begin = readme.find(opening);
    REQUIRE(begin != std::string::npos);
    const std::size_t first = begin + opening.size();
    const std::string text = readme.substr(first, readme.find("```", first) - first);

    const tests::TemporaryDirectory directory;
    scenes::InputFile file(directory.write("my.json", text));
    CHECK(scenes::read_json(file).shape_count() == 2);
}
