#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/support/catch.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <sys/stat.h>
#include <vector>
#include <zlib.h>

using namespace raylane::scenes;
using raylane::tests::TemporaryFile;
namespace tests = raylane::tests;

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

TEST_CASE("a scene's format follows the content if the ending is unknown") {
    const std::string ending = GENERATE("", ".txt", ".json.bak");
    CHECK(distance_in(json, ending) == 9.0F);
    CHECK(distance_in("\xEF\xBB\xBF\r\n\t " + json, ending) == 9.0F);
    CHECK(distance_in("// a comment\n" + json, ending) == 9.0F);
    CHECK(distance_in(nff, ending) == 7.0F);
    CHECK(distance_in("# a comment {\n\n" + nff, ending) == 7.0F);
}

TEST_CASE("lines may end as on any system and a byte order mark may come first") {
    // A file that is longer than the read buffer, in lines of all lengths.
    std::string balls = nff + "l 0 9 0\n";
    for (int i = 0; i < 20'000; ++i)
        balls += std::string(static_cast<std::size_t>(i % 7), ' ') + "s 0 0 0 1\n";
    const std::vector<std::pair<std::string, std::string>> files = {
        {"a.json", "// a remark\n" + json},
        {"a.nff", balls},
        {"a.pov", "// a remark\ncamera { location <0, 0, -5> look_at 0 }\nsphere { 0, 1 }\n"},
        {"a.dat", "BEGIN_SCENE\nRESOLUTION 8 8\n# a remark\nCAMERA ZOOM 1 ASPECTRATIO 1 "
                  "ANTIALIASING 0 RAYDEPTH 3\nCENTER 0 0 -5 VIEWDIR 0 0 1 UPDIR 0 1 0\n"
                  "END_CAMERA\nSPHERE CENTER 0 0 0 RAD 1 TEXTURE AMBIENT 0 DIFFUSE 1 SPECULAR 0 "
                  "OPACITY 1\nCOLOR 1 1 1 TEXFUNC 0\nEND_SCENE\n"},
        {"a.xyz", "2\na remark\nC 0 0 0\nO 0 0 5\n"},
        {"a.dump", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 9\n"
                   "0 9\n0 9\nITEM: ATOMS id type x y z\n1 1 4 4 4\n"},
    };
    for (const auto& [name, text] : files) {
        CAPTURE(name);
        const raylane::core::Scene expected = parse_scene(name, text);
        for (const std::string end : {"\r\n", "\r"})
            for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
                std::string other = mark;
                for (const char c : text)
                    other += c == '\n' ? end : std::string(1, c);
                CAPTURE(end == "\r", mark.empty());
                const TemporaryFile file(other, std::filesystem::path(name).extension().string());
                const raylane::core::Scene in_memory = parse_scene(name, other),
                                           on_disk = load_scene(file.path());
                CHECK(in_memory.shape_count() == expected.shape_count());
                CHECK(on_disk.shape_count() == expected.shape_count());
                CHECK(on_disk.camera().from.z == expected.camera().from.z);
            }
    }
    CHECK(raylane::tests::message_of<BadInput>([&] {
              parse_scene("a.nff", "# a remark\r\rv\rfrom 0 0 no\r");
          }).starts_with("a.nff:4: "));
}

TEST_CASE("a file of another kind is distinguished from a scene with a mistake") {
    const auto error_of = [](const std::string& text, const std::string& ending) {
        return raylane::tests::message_of<BadInput>([&] { parse_scene("a" + ending, text); });
    };
    const std::string neither =
        ": must be a scene (.json, .nff, .pov, Tachyon .dat, or .rl from \"raylane build\") or "
        "atoms (.pdb, .pqr, mmCIF or CIF .cif, .xyz, .gro, .mol, .sdf, .mol2, LAMMPS .dump or "
        ".data), got another format";
    const std::string pdb = "HEADER    HYDROLASE\nATOM      1  N   PRO A   1      29.361  39.686\n";
    const std::string obj = "# a cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
    CHECK(error_of(obj, ".obj") == "a.obj" + neither);
    CHECK(error_of("3\n\nC 0 0 0\n", ".txt") ==
          "a.txt:4: must be atom 2 of 3, got the end of the file");
    CHECK(error_of("s one\n", "") == "a" + neither);
    // Here the intended format is clear.
    CHECK(error_of(pdb, ".nff").starts_with("a.nff:1: "));
    CHECK(error_of("# nothing\n\nv\nfrom 0 0 no\n", "").starts_with("a:4: "));
}

TEST_CASE("A scene of any format without objects gives a remark") {
    const std::string tachyon = "BEGIN_SCENE\nRESOLUTION 8 8\nEND_SCENE\n";
    for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
             {"a.json", json}, {"a.nff", nff}, {"a.dat", tachyon}, {"a.pov", "#version 3.7;"}}) {
        std::vector<std::string> remarks;
        LoadOptions options;
        options.on_remark = [&](const std::string& remark) { remarks.push_back(remark); };
        parse_scene(name, text, options);
        REQUIRE_FALSE(remarks.empty());
        CHECK(remarks.back() == name + ": has no objects: the image shows only the background");
    }
}

TEST_CASE("a file that changes while it is read is refused") {
    std::string text = nff;
    while (text.size() < 300'000)
        text += "s 0 0 0 1\n";
    for (const bool longer : {false, true}) {
        const TemporaryFile file(text, ".nff");
        LoadOptions options;
        options.on_read = [&, changed = false](std::uint64_t, std::uint64_t) mutable {
            if (changed) return;
            changed = true;
            std::filesystem::resize_file(file.path(), text.size() + (longer ? 10 : -100'000));
        };
        const std::string message =
            raylane::tests::message_of<BadInput>([&] { load_scene(file.path(), options); });
        CHECK(message == file.path().string() + ": must not change while it is read: it had " +
                             std::to_string(text.size()) + " bytes, and now has " +
                             std::to_string(text.size() + (longer ? 10 : -100'000)));
    }
}

TEST_CASE("Scenes of each format include regular files alone and have a limit of their number") {
    struct Including {
        const char *name, *start, *before, *behind, *end;
    };
    const Including formats[] = {
        {"a.json", R"({"camera": "auto", "objects": [], "include": ["x")", ", \"", "\"", "]}"},
        {"a.pov", "", "#include \"", "\"\n", ""},
        {"a.dat", "BEGIN_SCENE\nRESOLUTION 4 4\n", "INCLUDE ", "\n", "END_SCENE"},
    };
    for (const Including& format : formats) {
        const char* const name = format.name;
        CAPTURE(name);
        const tests::TemporaryDirectory directory;
        directory.write("x", std::string(name) == "a.json" ? "{}" : "");
        const auto complaint = [&](const std::vector<std::string>& files) {
            std::string text = format.start;
            for (const std::string& file : files)
                text += format.before + file + format.behind;
            const auto path = directory.write(name, text + format.end);
            return tests::message_of<BadInput>([&] { load_scene(path); });
        };
        // No process writes into the pipe.
        REQUIRE(::mkfifo((directory.path() / "pipe").c_str(), 0600) == 0);
        CHECK(complaint({"pipe"}).find("must be") != std::string::npos);
        CHECK(complaint({"pipe"}).find("\"pipe\"") != std::string::npos);
        if (std::string(name) != "a.pov") { // POV-Ray's includes are looked for in several folders
            const std::string folder = directory.path().string();
            CHECK(complaint({"pipe"}).ends_with(", but " + folder + "/pipe is a pipe"));
            CHECK(complaint({"."}).ends_with(", but " + folder + "/. is a directory"));
            CHECK(complaint({"/dev/null"}).ends_with(", but /dev/null is not a regular file"));
            CHECK(complaint({"none"}).ends_with(", but " + folder + "/none does not exist"));
        }
        directory.write("large", "");
        std::filesystem::resize_file(directory.path() / "large", (std::uint64_t{1} << 30) + 1);
        CHECK(complaint({"large"}).find("must be a file of at most 1 GiB") != std::string::npos);
        std::vector<std::string> many;
        for (int i = 0; i <= 1000; ++i) {
            many.push_back("x" + std::to_string(i));
            directory.write(many.back(), std::string(name) == "a.json" ? "{}" : "");
        }
        CHECK(complaint(many).find("must be one of at most 1000 included files") !=
              std::string::npos);
    }
}

TEST_CASE("The size that a small file decompresses to has a limit") {
    const int members = GENERATE(1, 4);
    const tests::TemporaryDirectory directory;
    const auto path = directory.path() / "a.xyz.gz";
    for (int member = 0; member < members; ++member) {
        gzFile file = ::gzopen(path.c_str(), "ab9");
        REQUIRE(file != nullptr);
        for (int kilobyte = 0; kilobyte < 200 * 1024 / members; ++kilobyte)
            ::gzwrite(file, std::string(1023, ' ').append("\n").c_str(), 1024);
        REQUIRE(::gzclose(file) == Z_OK);
    }
    REQUIRE(std::filesystem::file_size(path) < (1 << 20));
    InputFile compressed(path);
    CHECK(tests::message_of<BadInput>([&] { compressed.read_all(); }) ==
          path.string() + ": must not expand to more than 200 times its compressed size");
}
