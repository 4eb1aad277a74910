#include "scenes/tool/checkpoint/checkpoint.hpp"
#include "scenes/tool/checkpoint/fingerprint.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/comes_true.hpp"

#include <atomic>
#include <csignal>
#include <fstream>
#include <memory>
#include <sys/resource.h>

using namespace raylane;
using scenes::Checkpoint;
using scenes::TileRecords;
using tests::scene_of;

namespace {

const std::string text = R"({
    "image": {"width": 20, "height": 12},
    "sampling": {"grid": 2},
    "camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
    "background": [0, 0, 0.5],
    "lights": [{"type": "directional", "direction": [-1, -2, -3]}],
    "materials": {"red": {"color": [1, 0, 0], "reflectivity": 0.5}},
    "objects": [{"type": "sphere", "material": "red", "center": [0, 0, 0], "radius": 1},
                {"type": "plane", "material": "red", "point": [0, -1, 0], "normal": [0, 1, 0]}]
})";

bool same(const core::Aovs& a, const core::Aovs& b) {
    return a.depth == b.depth && a.normal == b.normal && a.shape == b.shape &&
           a.material == b.material && a.samples == b.samples;
}

/// A scene with the options of its rendering, which a checkpoint may record.
struct Drawing {
    const core::Scene& scene;
    core::Settings settings;
    simd::RenderOptions options{};
    std::filesystem::path path;

    simd::Rendering draw(Checkpoint* checkpoint, int tiles_before_it_stops = 0) const {
        simd::RenderOptions with = options;
        simd::Progress progress;
        with.progress = &progress;
        std::atomic<int> tiles = 0;
        if (checkpoint != nullptr) {
            with.recall = [&](const simd::TileToFill& tile) { return checkpoint->recall(tile); };
            with.after_tile = [&](const simd::FinishedTile& tile) {
                checkpoint->note(tile);
                if (++tiles == tiles_before_it_stops) progress.stop = true;
            };
        }
        return simd::render(scene, settings, with);
    }
    scenes::CheckpointSubject subject() const { return {scenes::fingerprint_of(scene), "options"}; }
    TileRecords records() const { return {settings, options}; }
};

/// Limits the size of this process's files during its lifetime, as if the disk were full.
class Fullness {
  public:
    explicit Fullness(std::uintmax_t bytes) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
        REQUIRE(::getrlimit(RLIMIT_FSIZE, &before_) == 0);
        const rlimit limit{static_cast<rlim_t>(bytes), before_.rlim_max};
        REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    }
    ~Fullness() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        ::signal(SIGXFSZ, handler_);
    }
    Fullness(const Fullness&) = delete;
    Fullness& operator=(const Fullness&) = delete;

  private:
    void (*handler_)(int);
    rlimit before_{};
};

/// The checkpoint of an image of 20 x 12 pixels in tiles of 8 x 8. The bytes of its tiles are
/// arbitrary.
struct Notes {
    core::Scene scene = scene_of(text);
    tests::TemporaryDirectory directory{};
    Drawing drawing{scene, scene.settings(), {}, directory.path() / "picture"};
    std::filesystem::path path = drawing.path.string() + ".part";

    Notes() { drawing.options.tile = 8; }
    std::string bytes(std::size_t number) const {
        return std::string(drawing.records().bytes(number), static_cast<char>('a' + number));
    }
    /// Returns the number of finished tiles that a new checkpoint of this subject finds in the
    /// file.
    int found() const {
        const Checkpoint checkpoint(drawing.path, drawing.subject(), drawing.records());
        int count = 0;
        for (std::size_t number = 0; number < drawing.records().grid().count(); ++number)
            count += checkpoint.has(number) ? 1 : 0;
        return count;
    }
};

} // namespace

TEST_CASE("a checkpoint that is truncated or damaged at any byte does not change the image") {
    const core::Scene scene = scene_of(text);
    const tests::TemporaryDirectory directory;
    Drawing drawing{scene, scene.settings(), {}, directory.path() / "picture"};
    drawing.options.threads = 1;
    drawing.options.tile = 8;
    drawing.options.aovs = true;
    drawing.settings.alpha = true;
    const simd::Rendering whole_rendering = drawing.draw(nullptr);
    {
        Checkpoint checkpoint(drawing.path, drawing.subject(), drawing.records());
        CHECK(checkpoint.found() == Checkpoint::Found::nothing);
        CHECK(!drawing.draw(&checkpoint, 4).complete);
        CHECK(checkpoint.keep());
    }
    const std::string content = tests::content_of(drawing.path.string() + ".part");
    const auto goes_on = [&](const std::string& with, std::int64_t max_pixels) {
        directory.write("picture.part", with);
        Checkpoint checkpoint(drawing.path, drawing.subject(), drawing.records());
        CHECK(checkpoint.found_pixels() <= max_pixels);
        const simd::Rendering rendering = drawing.draw(&checkpoint);
        REQUIRE(rendering.complete);
        REQUIRE(rendering.film.pixels() == whole_rendering.film.pixels());
        REQUIRE(rendering.film.alphas() == whole_rendering.film.alphas());
        REQUIRE(same(rendering.aovs, whole_rendering.aovs));
        REQUIRE(rendering.counters.as_numbers() == whole_rendering.counters.as_numbers());
        return checkpoint.found_pixels();
    };
    std::int64_t first_four = 0;
    for (std::size_t i = 0; i < 4; ++i)
        first_four += drawing.records().grid().tile(drawing.records().grid().scattered(i)).pixels();
    CHECK(goes_on(content, 240) == first_four);
    std::int64_t before = 0;
    for (std::size_t end = 0; end < content.size(); end += 7) {
        CAPTURE(end);
        const std::int64_t pixels = goes_on(content.substr(0, end), 240);
        REQUIRE(pixels >= before);
        before = pixels;
        std::string damaged = content;
        damaged[end] ^= 0x10;
        if (end < 16) continue; // a damaged start makes it a foreign file
        static_cast<void>(goes_on(damaged, 240));
    }
}

TEST_CASE(
    "a damaged byte costs a checkpoint one tile and records of another checkpoint are ignored") {
    const core::Scene scene = scene_of(text);
    const tests::TemporaryDirectory directory;
    Drawing drawing{scene, scene.settings(), {}, directory.path() / "picture"};
    drawing.options.threads = 1;
    drawing.options.tile = 8;
    {
        Checkpoint checkpoint(drawing.path, drawing.subject(), drawing.records());
        static_cast<void>(drawing.draw(&checkpoint));
        CHECK(checkpoint.keep());
    }
    const std::string content = tests::content_of(drawing.path.string() + ".part");
    const std::size_t head = content.find("\n\n") + 2;
    const auto pixels_of = [&](const std::string& with, const scenes::CheckpointSubject& subject) {
        directory.write("picture.part", with);
        return Checkpoint(drawing.path, subject, drawing.records()).found_pixels();
    };
    CHECK(pixels_of(content, drawing.subject()) == 20 * 12);
    std::string damaged = content;
    damaged[head + 100] ^= 0x10; // in the first tile's pixels
    CHECK(pixels_of(damaged, drawing.subject()) == 20 * 12 - 8 * 8);
    // Records of another image's checkpoint behind this checkpoint's head.
    const scenes::CheckpointSubject other{drawing.subject().scene, "others"};
    std::string mixed = content;
    mixed.replace(mixed.find("options options"), 15, "options others");
    CHECK(pixels_of(mixed, other) == 0);
}

TEST_CASE("any damaged byte of a tile's record costs that tile alone") {
    const Notes notes;
    const TileRecords records = notes.drawing.records();
    {
        Checkpoint checkpoint(notes.drawing.path, notes.drawing.subject(), records);
        for (std::size_t number = 0; number < records.grid().count(); ++number)
            checkpoint.note(number, notes.bytes(number));
        REQUIRE(checkpoint.keep());
    }
    const std::string content = tests::content_of(notes.path);
    const std::size_t begin = content.find("\n\n") + 2 + 16 + records.bytes(0), // the second tile
        end = begin + 16 + records.bytes(1);
    for (const char bits : {'\x01', '\x10', '\xff'})
        for (std::size_t at = begin; at < end; ++at) {
            CAPTURE(at - begin, int{bits});
            const auto put = [&](char byte) {
                std::fstream file(notes.path, std::ios::in | std::ios::out | std::ios::binary);
                REQUIRE(file.seekp(static_cast<std::streamoff>(at)).put(byte).flush());
            };
            put(static_cast<char>(content[at] ^ bits));
            const Checkpoint checkpoint(notes.drawing.path, notes.drawing.subject(), records);
            for (std::size_t number = 0; number < records.grid().count(); ++number)
                REQUIRE(checkpoint.has(number) == (number != 1));
            REQUIRE(std::filesystem::file_size(notes.path) == content.size());
            put(content[at]);
        }
    // The same holds for missing or additional bytes. Bytes behind the last record are removed.
    notes.directory.write("picture.part", std::string(content).erase(begin + 5, 100));
    CHECK(notes.found() == 5);
    notes.directory.write("picture.part", std::string(content).insert(begin + 5, 100, '\0'));
    CHECK(notes.found() == 5);
    notes.directory.write("picture.part", content + content.substr(begin, 200));
    CHECK(notes.found() == 6);
    CHECK(std::filesystem::file_size(notes.path) == content.size());
}

TEST_CASE("tiles that a full disk refuses are written when it has space again") {
    const Notes notes;
    std::vector<std::string> told;
    Checkpoint checkpoint(notes.drawing.path, notes.drawing.subject(), notes.drawing.records(),
                          [&](const std::string& problem) { told.push_back(problem); });
    const std::string problem = notes.path.string() + ": cannot write: File too large";
    checkpoint.note(0, notes.bytes(0));
    {
        const Fullness full(100); // before the file exists
        CHECK(!checkpoint.keep());
        CHECK(!std::filesystem::exists(notes.path));
        CHECK(checkpoint.problem() == problem);
    }
    CHECK(checkpoint.keep());
    CHECK(checkpoint.problem().empty());
    {
        const Fullness full(std::filesystem::file_size(notes.path) + 20);
        for (const std::size_t number : {1, 2, 3})
            checkpoint.note(number, notes.bytes(number));
        CHECK(!checkpoint.keep());
        CHECK(checkpoint.problem() == problem);
        checkpoint.note(4, notes.bytes(4));
        CHECK(checkpoint.problem() == problem);
    }
    // The checkpoint tries again by itself.
    CHECK(tests::comes_true([&] { return checkpoint.problem().empty(); }));
    checkpoint.note(5, notes.bytes(5));
    CHECK(checkpoint.keep());
    CHECK(told == std::vector{problem});
    const std::string content = tests::content_of(notes.path);
    notes.directory.write("picture.part.part", content);
    std::filesystem::rename(notes.path.string() + ".part", notes.path); // the original is locked
    CHECK(notes.found() == 6);
}

TEST_CASE("Checkpoints of other options or scenes or versions stay until the image is complete") {
    const Notes notes;
    const TileRecords records = notes.drawing.records();
    const scenes::CheckpointSubject subject = notes.drawing.subject();
    const auto text_of_subject = [&](const scenes::CheckpointSubject& of_it) {
        return std::make_unique<Checkpoint>(notes.drawing.path, of_it, records);
    };
    const auto keep_tile = [&](Checkpoint& checkpoint, std::size_t number) {
        checkpoint.note(number, notes.bytes(number));
        REQUIRE(checkpoint.keep());
    };
    keep_tile(*text_of_subject(subject), 0);
    const std::string first = tests::content_of(notes.path);
    const scenes::CheckpointSubject others[] = {{subject.scene, "others"}, {"0", subject.options}};
    const Checkpoint::Found kinds[] = {Checkpoint::Found::other_options,
                                       Checkpoint::Found::other_scene};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto checkpoint = text_of_subject(others[i]);
        CHECK(checkpoint->found() == kinds[i]);
        CHECK(checkpoint->found_at() == notes.path);
        CHECK(checkpoint->path() != notes.path);
        keep_tile(*checkpoint, i + 1);
    }
    CHECK(tests::content_of(notes.path) == first);
    for (std::size_t i = 0; i < 2; ++i) {
        const auto checkpoint = text_of_subject(others[i]);
        CHECK(checkpoint->found() == Checkpoint::Found::same);
        CHECK(checkpoint->found_at() == checkpoint->path());
        CHECK(checkpoint->has(i + 1));
        CHECK(!checkpoint->has(0));
    }
    const auto files = [&] {
        return std::distance(std::filesystem::directory_iterator(notes.directory.path()), {});
    };
    CHECK(files() == 3);

    // A complete image leaves checkpoints of other outputs, and files of other programs.
    for (const char* name : {"pictures.part", "picture.0123456789abcdeX.part", "picture.png.part"})
        notes.directory.write(name, first);
    notes.directory.write("picture.0123456789abcdef.part", "mine");
    notes.directory.write("picture", "drawn");
    const auto goes_on = text_of_subject(subject);
    CHECK(goes_on->found() == Checkpoint::Found::same);
    CHECK(goes_on->has(0));
    const auto in_use = text_of_subject(others[0]);
    goes_on->remove();
    CHECK(!std::filesystem::exists(notes.path));
    CHECK(std::filesystem::exists(in_use->path()));
    CHECK(files() == 6);
    in_use->remove();
    CHECK(files() == 5);
    CHECK(notes.found() == 0);
}

TEST_CASE("A complete image without a checkpoint removes the checkpoints of other options") {
    const Notes notes;
    notes.directory.write("picture.part", "raylane journal 0\nscene 0\noptions 0\n\nmuch");
    notes.directory.write("picture", "drawn");
    Checkpoint checkpoint(notes.drawing.path, notes.drawing.subject(), notes.drawing.records());
    CHECK(checkpoint.found() == Checkpoint::Found::other_options);
    checkpoint.note(0, notes.bytes(0));
    checkpoint.remove();
    CHECK(!std::filesystem::exists(notes.path));
    CHECK(!std::filesystem::exists(checkpoint.path()));
}

TEST_CASE("A truncated checkpoint is replaced as soon as the disk has space for the new one") {
    const Notes notes;
    notes.directory.write("picture.part", "raylane jour");
    Checkpoint checkpoint(notes.drawing.path, notes.drawing.subject(), notes.drawing.records());
    CHECK(checkpoint.found() == Checkpoint::Found::cut_off);
    {
        const Fullness full(20); // the space ends in the head
        checkpoint.note(0, notes.bytes(0));
        CHECK(!checkpoint.keep());
    }
    {
        const Fullness full(300); // the space ends in the tile
        CHECK(!checkpoint.keep());
    }
    CHECK(checkpoint.keep());
    const std::string content = tests::content_of(notes.path);
    notes.directory.write("copy", content);
    std::filesystem::rename(notes.directory.path() / "copy", notes.path);
    CHECK(notes.found() == 1);
}

TEST_CASE("A truncated checkpoint is written from the first tile on and removed") {
    const Notes notes;
    notes.directory.write("picture.part", "");
    Checkpoint checkpoint(notes.drawing.path, notes.drawing.subject(), notes.drawing.records());
    CHECK(checkpoint.found() == Checkpoint::Found::cut_off);
    checkpoint.note(0, notes.bytes(0));
    CHECK(tests::content_of(notes.path).find(notes.bytes(0)) != std::string::npos);
    notes.directory.write("picture", "drawn");
    checkpoint.remove();
    CHECK(!std::filesystem::exists(notes.path));
}

TEST_CASE("a checkpoint that has given up its space or was removed accepts no more tiles") {
    const Notes notes;
    {
        Checkpoint checkpoint(notes.drawing.path, notes.drawing.subject(), notes.drawing.records());
        checkpoint.note(0, notes.bytes(0));
        REQUIRE(checkpoint.keep());
        {
            const Fullness full(std::filesystem::file_size(notes.path));
            checkpoint.note(1, notes.bytes(1));
            CHECK(!checkpoint.keep());
        }
        CHECK(checkpoint.give_room(1));
        checkpoint.note(2, notes.bytes(2));
        CHECK(!checkpoint.keep());
        CHECK(std::filesystem::file_size(notes.path) == 0);
        notes.directory.write("picture", "drawn");
        checkpoint.remove();
        CHECK(!std::filesystem::exists(notes.path));
    }
    Checkpoint checkpoint(notes.drawing.path, notes.drawing.subject(), notes.drawing.records());
    checkpoint.note(0, notes.bytes(0));
    checkpoint.remove(); // before the file exists
    CHECK(!checkpoint.keep());
    CHECK(!std::filesystem::exists(notes.path));
}

TEST_CASE("a checkpoint continues only for the same scene and options and tiles") {
    const core::Scene scene = scene_of(text);
    const tests::TemporaryDirectory directory;
    Drawing drawing{scene, scene.settings(), {}, directory.path() / "picture"};
    drawing.options.tile = 8;
    {
        Checkpoint checkpoint(drawing.path, drawing.subject(), drawing.records());
        static_cast<void>(drawing.draw(&checkpoint));
        CHECK(checkpoint.keep());
        CHECK(Checkpoint(drawing.path, drawing.subject(), drawing.records()).found() ==
              Checkpoint::Found::in_use);
    }
    const std::string content = tests::content_of(drawing.path.string() + ".part");
    const auto found = [&](const scenes::CheckpointSubject& subject) {
        directory.write("picture.part", content);
        return Checkpoint(drawing.path, subject, drawing.records()).found();
    };
    CHECK(found(drawing.subject()) == Checkpoint::Found::same);
    CHECK(found({drawing.subject().scene, "others"}) == Checkpoint::Found::other_options);
    CHECK(found({"0", "options"}) == Checkpoint::Found::other_scene);
    for (const std::size_t end : {0, 7, 15, 16, 30}) {
        directory.write("picture.part", content.substr(0, end));
        CHECK(Checkpoint(drawing.path, drawing.subject(), drawing.records()).found() ==
              Checkpoint::Found::cut_off);
    }
    for (const char* content_of_another : {"mine", "raylanes", "raylane journey", "\x89PNG"}) {
        directory.write("picture.part", content_of_another);
        CHECK(Checkpoint(drawing.path, drawing.subject(), drawing.records()).found() ==
              Checkpoint::Found::none_of_ours);
        CHECK(tests::content_of(drawing.path.string() + ".part") == content_of_another);
    }
}

TEST_CASE("scenes that look different have different fingerprints") {
    const std::string own = scenes::fingerprint_of(scene_of(text));
    CHECK(own.size() == 32);
    CHECK(scenes::fingerprint_of(scene_of(text)) == own);
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"[0, 0, 5]", "[0, 0, 5.5]"},
             {"0.5]", "0.25]"},
             {"[-1, -2, -3]", "[-1, -2, -4]"},
             {"[1, 0, 0]", "[1, 0, 0.1]"},
             {"\"reflectivity\": 0.5", "\"reflectivity\": 0.6"},
             {"\"radius\": 1", "\"radius\": 1.0000001"},
             {"\"radius\": 1", "\"radius\": 1.00000000001"},
             {"\"type\": \"sphere\"", "\"type\": \"sphere\", \"material\": {}, \"radius\": 1, "
                                      "\"center\": [0, 0, 0]}, {\"type\": \"sphere\""},
             {"\"point\": [0, -1, 0]", "\"point\": [0, -1.5, 0]"}}) {
        CAPTURE(from, to);
        std::string other = text;
        other.replace(other.find(from), from.size(), to);
        CHECK(scenes::fingerprint_of(scene_of(other)) != own);
    }
    // The settings are not part of the fingerprint.
    std::string renamed = text; // names do not change the image
    for (std::size_t at = 0; (at = renamed.find("\"red\"", at)) != std::string::npos;)
        renamed.replace(at, 5, "\"blue\"");
    REQUIRE(scene_of(renamed).material_name(0) == "blue");
    CHECK(scenes::fingerprint_of(scene_of(renamed)) == own);
    std::string larger = text;
    larger.replace(larger.find("20"), 2, "30");
    CHECK(scenes::fingerprint_of(scene_of(larger)) == own);
}
