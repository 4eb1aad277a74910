#include "scenes/json/reader.hpp"
#include "tests/catch.hpp"
#include "tests/places.hpp"
#include "tests/scenes/temporary_directory.hpp"

#include <vector>

using namespace raylane;

TEST_CASE("scene examples of the pages parse") {
    const std::string readme = tests::content_of(RAYLANE_SOURCE_DIR "/scenes/README.md");
    const std::string opening = "```json\n";
    const tests::TemporaryDirectory directory;
    std::vector<std::size_t> shapes;
    for (std::size_t begin = 0; (begin = readme.find(opening, begin)) != std::string::npos;) {
        begin += opening.size();
        const std::string text = readme.substr(begin, readme.find("```", begin) - begin);
        scenes::InputFile file(directory.write("my.json", text));
        shapes.push_back(scenes::read_json(file).shape_count());
    }
    CHECK(shapes == std::vector<std::size_t>{2, 4});
}
