#include "scenes/files/errors.hpp"
#include "tests/support/catch.hpp"

using namespace raylane::scenes;

TEST_CASE("a quotation in a message fits on one line") {
    CHECK(printable("plain") == "plain");
    CHECK(printable("a\nb\x7F\x01") == "a\\x0Ab\\x7F\\x01");
    CHECK(printable("gr\xC3\xBC\xC3\x9F") == "gr\xC3\xBC\xC3\x9F");
    CHECK(printable("\xC3(\xFF\xE0\x80\x80") == "\\xC3(\\xFF\\xE0\\x80\\x80");
    CHECK(printable(std::string(200, 'a')) == std::string(40, 'a') + "...");
}

TEST_CASE("an unknown word suggests the nearest known one") {
    CHECK(suggestion("raduis", {"center", "radius"}) == ", did you mean \"radius\"?");
    CHECK(suggestion("colour", {"color", "center"}) == ", did you mean \"color\"?");
    CHECK(suggestion("zzz", {"color", "center"}).empty());
    CHECK(suggestion("srbg", {"linear", "srgb"}) == ", did you mean \"srgb\"?");
    CHECK(suggestion("chane", {"element", "chain"}) == ", did you mean \"chain\"?");
    // Words with few letters in common do not match, and a number is never misspelled.
    for (const char* other : {"box", "top", "not", "fog", "form"}) {
        CAPTURE(other);
        CHECK(suggestion("foo", {other}).empty() == (std::string(other) != "fog"));
    }
    CHECK(suggestion("12", {"8", "16", "32"}).empty());
    CHECK(suggestion("$y", {"$x"}) == ", did you mean \"$x\"?");
    CHECK(suggestion("anything", {}).empty());
    CHECK(suggestion("sise", {"size", "spp"}, "--") == ", did you mean \"--size\"?");
    CHECK(suggestion("zzz", {"size"}, "--").empty());
    // Names that other programs use.
    CHECK(suggestion("fov", {"from", "field_of_view"}) == ", did you mean \"field_of_view\"?");
    CHECK(suggestion("spp", {"image", "sampling"}) == ", did you mean \"sampling\"?");
    CHECK(suggestion("ior", {"color", "index"}) == ", did you mean \"index\"?");
    CHECK(suggestion("look_at", {"from", "at"}) == ", did you mean \"at\"?");
    CHECK(suggestion("transparency", {"exponent", "transmission"}) ==
          ", did you mean \"transmission\"?");
    CHECK(suggestion("transparency", {"center"}).empty());
}

TEST_CASE("alternatives read as in a sentence") {
    CHECK(alternatives({}).empty());
    CHECK(alternatives({"a"}) == "a");
    CHECK(alternatives({"a", "b"}) == "a or b");
    CHECK(alternatives({"a", "b", "c"}) == "a, b or c");
}

TEST_CASE("an error reads as file and place and message") {
    CHECK(std::string(BadInput("a.json", "/objects/3/radius", "must be positive, got -1").what()) ==
          "a.json: /objects/3/radius: must be positive, got -1");
    CHECK(std::string(BadInput("a.json", "", "no such file").what()) == "a.json: no such file");
    CHECK(text_of({"a.json", {3, 14}, "/camera", "must be"}) == "a.json:3:14: /camera: must be");
    CHECK(text_of({"a.nff", {3, 0}, "", "must be"}) == "a.nff:3: must be");
}

TEST_CASE("ten errors are collected with a note that there were more") {
    InputErrors errors;
    CHECK_NOTHROW(errors.report());
    for (std::size_t line = 10; line > 0; --line)
        errors.add(InputError{"a", {line, 1}, "", "wrong"});
    CHECK(!errors.overflowed());
    errors.add(BadInput("a", "", "wrong"));
    CHECK(errors.overflowed());
    try {
        errors.report();
        FAIL("must throw");
    } catch (const BadInput& bad) {
        const std::string text = bad.what();
        CHECK(text.starts_with("a:1:1: wrong\na:2:1: wrong\n"));
        CHECK(text.ends_with("\na:10:1: wrong\na: and more"));
        CHECK(bad.errors().size() == 10);
    }
}
