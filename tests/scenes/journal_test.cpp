#include "scenes/tool/checkpoint/fingerprint.hpp"
#include "scenes/tool/checkpoint/journal.hpp"
#include "tests/catch.hpp"
#include "tests/comes_true.hpp"
#include "tests/scenes/json_scenes.hpp"
#include "tests/scenes/temporary_directory.hpp"

#include <csignal>
#include <fstream>
#include <memory>
#include <sys/resource.h>

using namespace raylane;
using scenes::Journal;
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

bool same(const core::Layers& a, const core::Layers& b) {
    return a.depth == b.depth && a.normal == b.normal && a.shape == b.shape &&
           a.material == b.material && a.samples == b.samples;
}

/// A scene with the options of its rendering, which a journal may record.
struct Drawing {
    const core::Scene& scene;
    core::Settings settings;
    simd::RenderOptions options{};
    std::filesystem::path path;

    simd::Rendering draw(Journal* journal, int tiles_before_it_stops = 0) const {
        simd::RenderOptions with = options;
        simd::Progress progress;
        with.progress = &progress;
        int tiles = 0;
        if (journal != nullptr) {
            with.recall = [&](const simd::TileToFill& tile) { return journal->recall(tile); };
            with.after_tile = [&](const simd::FinishedTile& tile) {
                journal->note(tile);
                if (++tiles == tiles_before_it_stops) progress.stop = true;
            };
        }
        return simd::render(scene, settings, with);
    }
    scenes::JournalSubject subject() const { return {scenes::fingerprint_of(scene), "options"}; }
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

/// The journal of an image of 20 x 12 pixels in tiles of 8 x 8. The bytes of its tiles are
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
    /// Returns the number of finished tiles that a new journal of this subject finds in the file.
    int found() const {
        const Journal journal(drawing.path, drawing.subject(), drawing.records());
        int count = 0;
        for (std::size_t number = 0; number < drawing.records().grid().count(); ++number)
            count += journal.has(number) ? 1 : 0;
        return count;
    }
};

} // namespace

TEST_CASE("a journal that is truncated or damaged at any byte does not change the image") {
    const core::Scene scene = scene_of(text);
    const tests::TemporaryDirectory directory;
    Drawing drawing{scene, scene.settings(), {}, directory.path() / "picture"};
    drawing.options.threads = 1;
    drawing.options.tile = 8;
    drawing.options.layers = true;
    drawing.settings.alpha = true;
    const simd::Rendering whole = drawing.draw(nullptr);
    {
        Journal journal(drawing.path, drawing.subject(), drawing.records());
        CHECK(journal.found() == Journal::Found::nothing);
        CHECK(!drawing.draw(&journal, 4).complete);
        CHECK(journal.keep());
    }
    const std::string content = tests::content_of(drawing.path.string() + ".part");
    const auto goes_on = [&](const std::string& with, std::int64_t max_pixels) {
        directory.write("picture.part", with);
        Journal journal(drawing.path, drawing.subject(), drawing.records());
        CHECK(journal.found_pixels() <= max_pixels);
        const simd::Rendering rendering = drawing.draw(&journal);
        REQUIRE(rendering.complete);
        REQUIRE(rendering.film.pixels() == whole.film.pixels());
        REQUIRE(rendering.film.alphas() == whole.film.alphas());
        REQUIRE(same(rendering.layers, whole.layers));
        REQUIRE(rendering.counters.as_numbers() == whole.counters.as_numbers());
        return journal.found_pixels();
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

TEST_CASE("a damaged byte costs a journal one tile and records of another journal are ignored") {
    const core::Scene scene = scene_of(text);
    const tests::TemporaryDirectory directory;
    Drawing drawing{scene, scene.settings(), {}, directory.path() / "picture"};
    drawing.options.threads = 1;
    drawing.options.tile = 8;
    {
        Journal journal(drawing.path, drawing.subject(), drawing.records());
        static_cast<void>(drawing.draw(&journal));
        CHECK(journal.keep());
    }
    const std::string content = tests::content_of(drawing.path.string() + ".part");
    const std::size_t head = content.find("\n\n") + 2;
    const auto pixels_of = [&](const std::string& with, const scenes::JournalSubject& subject) {
        directory.write("picture.part", with);
        return Journal(drawing.path, subject, drawing.records()).found_pixels();
    };
    CHECK(pixels_of(content, drawing.subject()) == 20 * 12);
    std::string damaged = content;
    damaged[head + 100] ^= 0x10; // in the first tile's pixels
    CHECK(pixels_of(damaged, drawing.subject()) == 20 * 12 - 8 * 8);
    // Records of another image's journal behind this journal's head.
    const scenes::JournalSubject other{drawing.subject().scene, "others"};
    std::string mixed = content;
    mixed.replace(mixed.find("options options"), 15, "options others");
    CHECK(pixels_of(mixed, other) == 0);
}

TEST_CASE("any damaged byte of a tile's record costs that tile alone") {
    const Notes notes;
    const TileRecords records = notes.drawing.records();
    {
        Journal journal(notes.drawing.path, notes.drawing.subject(), records);
        for (std::size_t number = 0; number < records.grid().count(); ++number)
            journal.note(number, notes.bytes(number));
        REQUIRE(journal.keep());
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
            const Journal journal(notes.drawing.path, notes.drawing.subject(), records);
            for (std::size_t number = 0; number < records.grid().count(); ++number)
                REQUIRE(journal.has(number) == (number != 1));
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
    Journal journal(notes.drawing.path, notes.drawing.subject(), notes.drawing.records(),
                    [&](const std::string& problem) { told.push_back(problem); });
    const std::string problem = notes.path.string() + ": cannot write: File too large";
    journal.note(0, notes.bytes(0));
    {
        const Fullness full(100); // before the file exists
        CHECK(!journal.keep());
        CHECK(!std::filesystem::exists(notes.path));
        CHECK(journal.problem() == problem);
    }
    CHECK(journal.keep());
    CHECK(journal.problem().empty());
    {
        const Fullness full(std::filesystem::file_size(notes.path) + 20);
        for (const std::size_t number : {1, 2, 3})
            journal.note(number, notes.bytes(number));
        CHECK(!journal.keep());
        CHECK(journal.problem() == problem);
        journal.note(4, notes.bytes(4));
        CHECK(journal.problem() == problem);
    }
    // The journal tries again by itself.
    CHECK(tests::comes_true([&] { return journal.problem().empty(); }));
    journal.note(5, notes.bytes(5));
    CHECK(journal.keep());
    CHECK(told == std::vector{problem});
    const std::string content = tests::content_of(notes.path);
    notes.directory.write("picture.part.part", content);
    std::filesystem::rename(notes.path.string() + ".part", notes.path); // the original is locked
    CHECK(notes.found() == 6);
}

TEST_CASE("Journals of other options or scenes or versions stay until the image is complete") {
    const Notes notes;
    const TileRecords records = notes.drawing.records();
    const scenes::JournalSubject subject = notes.drawing.subject();
    const auto of = [&](const scenes::JournalSubject& of_it) {
        return std::make_unique<Journal>(notes.drawing.path, of_it, records);
    };
    const auto keep_tile = [&](Journal& journal, std::size_t number) {
        journal.note(number, notes.bytes(number));
        REQUIRE(journal.keep());
    };
    keep_tile(*of(subject), 0);
    const std::string first = tests::content_of(notes.path);
    const scenes::JournalSubject others[] = {{subject.scene, "others"}, {"0", subject.options}};
    const Journal::Found kinds[] = {Journal::Found::other_options, Journal::Found::other_scene};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto journal = of(others[i]);
        CHECK(journal->found() == kinds[i]);
        CHECK(journal->found_at() == notes.path);
        CHECK(journal->path() != notes.path);
        keep_tile(*journal, i + 1);
    }
    CHECK(tests::content_of(notes.path) == first);
    for (std::size_t i = 0; i < 2; ++i) {
        const auto journal = of(others[i]);
        CHECK(journal->found() == Journal::Found::same);
        CHECK(journal->found_at() == journal->path());
        CHECK(journal->has(i + 1));
        CHECK(!journal->has(0));
    }
    const auto files = [&] {
        return std::distance(std::filesystem::directory_iterator(notes.directory.path()), {});
    };
    CHECK(files() == 3);

    // A complete picture leaves journals of other outputs, and files of other programs.
    for (const char* name : {"pictures.part", "picture.0123456789abcdeX.part", "picture.png.part"})
        notes.directory.write(name, first);
    notes.directory.write("picture.0123456789abcdef.part", "mine");
    notes.directory.write("picture", "drawn");
    const auto goes_on = of(subject);
    CHECK(goes_on->found() == Journal::Found::same);
    CHECK(goes_on->has(0));
    const auto in_use = of(others[0]);
    goes_on->remove();
    CHECK(!std::filesystem::exists(notes.path));
    CHECK(std::filesystem::exists(in_use->path()));
    CHECK(files() == 6);
    in_use->remove();
    CHECK(files() == 5);
    CHECK(notes.found() == 0);
}

TEST_CASE("A complete image without a journal removes the journals of other options") {
    const Notes notes;
    notes.directory.write("picture.part", "raylane journal 0\nscene 0\noptions 0\n\nmuch");
    notes.directory.write("picture", "drawn");
    Journal journal(notes.drawing.path, notes.drawing.subject(), notes.drawing.records());
    CHECK(journal.found() == Journal::Found::other_options);
    journal.note(0, notes.bytes(0));
    journal.remove();
    CHECK(!std::filesystem::exists(notes.path));
    CHECK(!std::filesystem::exists(journal.path()));
}

TEST_CASE("A truncated journal is replaced as soon as the disk has space for the new one") {
    const Notes notes;
    notes.directory.write("picture.part", "raylane jour");
    Journal journal(notes.drawing.path, notes.drawing.subject(), notes.drawing.records());
    CHECK(journal.found() == Journal::Found::cut_off);
    {
        const Fullness full(20); // the space ends in the head
        journal.note(0, notes.bytes(0));
        CHECK(!journal.keep());
    }
    {
        const Fullness full(300); // the space ends in the tile
        CHECK(!journal.keep());
    }
    CHECK(journal.keep());
    const std::string content = tests::content_of(notes.path);
    notes.directory.write("copy", content);
    std::filesystem::rename(notes.directory.path() / "copy", notes.path);
    CHECK(notes.found() == 1);
}

TEST_CASE("A truncated journal is written from the first tile on and removed") {
    const Notes notes;
    notes.directory.write("picture.part", "");
    Journal journal(notes.drawing.path, notes.drawing.subject(), notes.drawing.records());
    CHECK(journal.found() == Journal::Found::cut_off);
    journal.note(0, notes.bytes(0));
    CHECK(tests::content_of(notes.path).find(notes.bytes(0)) != std::string::npos);
    notes.directory.write("picture", "drawn");
    journal.remove();
    CHECK(!std::filesystem::exists(notes.path));
}

TEST_CASE("a journal that has given up its space or was removed accepts no more tiles") {
    const Notes notes;
    {
        Journal journal(notes.drawing.path, notes.drawing.subject(), notes.drawing.records());
        journal.note(0, notes.bytes(0));
        REQUIRE(journal.keep());
        {
            const Fullness full(std::filesystem::file_size(notes.path));
            journal.note(1, notes.bytes(1));
            CHECK(!journal.keep());
        }
        CHECK(journal.give_room(1));
        journal.note(2, notes.bytes(2));
        CHECK(!journal.keep());
        CHECK(std::filesystem::file_size(notes.path) == 0);
        notes.directory.write("picture", "drawn");
        journal.remove();
        CHECK(!std::filesystem::exists(notes.path));
    }
    Journal journal(notes.drawing.path, notes.drawing.subject(), notes.drawing.records());
    journal.note(0, notes.bytes(0));
    journal.remove(); // before the file exists
    CHECK(!journal.keep());
    CHECK(!std::filesystem::exists(notes.path));
}

TEST_CASE("a journal continues only for the same scene and options and tiles") {
    const core::Scene scene = scene_of(text);
    const tests::TemporaryDirectory directory;
    Drawing drawing{scene, scene.settings(), {}, directory.path() / "picture"};
    drawing.options.tile = 8;
    {
        Journal journal(drawing.path, drawing.subject(), drawing.records());
        static_cast<void>(drawing.draw(&journal));
        CHECK(journal.keep());
        CHECK(Journal(drawing.path, drawing.subject(), drawing.records()).found() ==
              Journal::Found::in_use);
    }
    const std::string content = tests::content_of(drawing.path.string() + ".part");
    const auto found = [&](const scenes::JournalSubject& subject) {
        directory.write("picture.part", content);
        return Journal(drawing.path, subject, drawing.records()).found();
    };
    CHECK(found(drawing.subject()) == Journal::Found::same);
    CHECK(found({drawing.subject().scene, "others"}) == Journal::Found::other_options);
    CHECK(found({"0", "options"}) == Journal::Found::other_scene);
    for (const std::size_t end : {0, 7, 15, 16, 30}) {
        directory.write("picture.part", content.substr(0, end));
        CHECK(Journal(drawing.path, drawing.subject(), drawing.records()).found() ==
              Journal::Found::cut_off);
    }
    for (const char* content_of_another : {"mine", "raylanes", "raylane journey", "\x89PNG"}) {
        directory.write("picture.part", content_of_another);
        CHECK(Journal(drawing.path, drawing.subject(), drawing.records()).found() ==
              Journal::Found::none_of_ours);
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
