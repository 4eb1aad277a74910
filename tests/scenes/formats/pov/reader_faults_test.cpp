#include "core/scene/scene.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/scenes/formats/pov/read.hpp"
#include "tests/support/catch.hpp"

#include <string>

using namespace raylane;
using namespace raylane::scenes;
using tests::camera, tests::complaint, tests::number, tests::read, tests::Read;

TEST_CASE("POV-Ray: an argument may redeclare names that its macro or array uses") {
    const std::string long_text = "\"" + std::string(100, 'a') + "\"";
    CHECK(read("#macro M(A, B, C, D) sphere { A, B } #end\n"
               "#macro N() #declare M = 5; #declare X = " +
               long_text + "; <0, 0, 0> #end\nM(N(), 1, 2, 3)")
              .scene.shape_count() == 1);
    CHECK(number("dimension_size(A, N())", "#declare A = array[3];\n"
                                           "#macro N() #declare A = array[1]; 1 #end") == "3");
}

TEST_CASE("POV-Ray: the number and the depth of nested clips have limits") {
    const auto many = [](const std::string& times, const std::string& next) {
        return complaint("#declare S = sphere { 0, 1 }\n#declare I = 0;\n#while (I < " + times +
                         ") #declare S = " + next + " #declare I = I + 1; #end\nS");
    };
    const std::string deep = "must not be nested more than 128 deep";
    CHECK(many("200000", "object { S rotate x*90 clipped_by { plane { y, 0 } } }").find(deep) !=
          std::string::npos);
    CHECK(many("200000", "sphere { 0, 1 clipped_by { S } }").find(deep) != std::string::npos);
    CHECK(many("26", "sphere { 0, 1 clipped_by { S } clipped_by { S } }")
              .find("must not be of more than 16777216 shapes") != std::string::npos);
    CHECK(complaint("#declare P = union { sphere { 0, 1 } sphere { x, 1 } }\n"
                    "#for (I, 1, 14) #declare P = union { object { P } object { P } } #end\n"
                    "object { P clipped_by { P } }")
              .find("must not be of more than 16777216 shapes") != std::string::npos);
}

TEST_CASE("POV-Ray: str formats a number as POV-Ray does") {
    const auto text = [](const std::string& expression) {
        const std::string told = complaint("#error " + expression), before = "#error: ";
        return told.substr(told.find(before) + before.size());
    };
    CHECK(text("str(7, 0, 0)") == "7");
    CHECK(text("str(7, 5, 1)") == "  7.0");
    CHECK(text("str(-7.25, -8, 3)") == "-007.250");
    CHECK(text("str(7.123456789, 0, -1)") == "7.123457");
    CHECK(text("vstr(3, <1, 2, 3>, \", \", 0, 1)") == "1.0, 2.0, 3.0");
    CHECK(text("concat(strupr(\"ab\"), substr(\"abcdef\", 2, 3), strlwr(\"XY\"))") == "ABbcdxy");
    CHECK(text("concat(chr(65), chr(233), chr(8364))") == "A\u00e9\u20ac");
    CHECK(complaint("#debug chr(0)") ==
          "a.pov:1:12: must be the code of a character, from 1 to 65535");
    CHECK(number("strlen(str(7, 0, 0))") == "1");
    for (const char* number : {"2 + tan(1e308*10)", "2 + sin(1e308*10)", "2 + cos(-1e308*10)",
                               "2 + exp(1e308*10 - 1e308*10)", "2 + cosh(1e308*10 - 1e308*10)"}) {
        CAPTURE(number);
        CHECK(complaint("sphere { 0, " + std::string(number) + " }")
                  .ends_with("must be a finite number"));
    }
    CHECK(complaint("sphere { 0, 1 pigment { color srgb <1e308*10 - 1e308*10, 0.5, 0.5> } }")
              .ends_with("must be of finite numbers"));
    CHECK(complaint("#debug str(1") == "a.pov:1:13: must be \",\", got the end of the file");
}

TEST_CASE("POV-Ray: val takes the number that a string begins with") {
    CHECK(number("val(\"3.5\")") == "3.5");
    CHECK(number("val(concat(\" +1\", \"e1 m\"))") == "10");
    CHECK(number("-val(\"-2\")") == "2");
    for (const char* none : {"", "  ", "m", "inf", "nan", "1e999"})
        CHECK(number("val(\"" + std::string(none) + "\")") == "0");
}

TEST_CASE("POV-Ray: an image outside of an animation has frame 0") {
    for (const char* name : {"frame_number", "initial_frame", "final_frame", "clock", "clock_delta",
                             "clock_on", "initial_clock", "final_clock"}) {
        CAPTURE(name);
        CHECK(number(name) == "0");
    }
}

TEST_CASE("POV-Ray: strings can be compared") {
    const std::string name = "#declare V = \"a\"; ";
    CHECK(number("(V = \"a\")", name) == "1");
    CHECK(number("(\"a\" != V)", name) == "0");
    CHECK(number("(V < \"b\" & \"ab\" > V)", name) == "1");
    CHECK(number("(concat(V, V) = \"aa\" | V = \"b\")", name) == "1");
    CHECK(complaint(name + "#if (V) #end") ==
          "a.pov:1:25: must compare the string with another, got \")\"");
    CHECK(complaint(name + "#if (V = 1) #end") == "a.pov:1:28: must be a string, got \"1\"");
}

TEST_CASE("POV-Ray: declaring a known name changes it in its scope") {
    CHECK(number("Outer()", "#macro Inc() #declare N = N + 1; #end\n"
                            "#macro Outer() #local N = 0; Inc() Inc() N #end") == "2");
    CHECK(number("N", "#macro M() #declare N = 4; #end M()") == "4");
}

TEST_CASE("POV-Ray: a macro changes an argument that is a name") {
    const std::string add = "#macro Add(A) #declare A = A + 2; #end #declare N = 1; ";
    CHECK(number("N", add + "Add(N)") == "3");
    CHECK(number("N", add + "Add(N + 0)") == "1");
    CHECK(number("N", add + "#macro Twice(B) Add(B) Add(B) #end Twice(N)") == "5");
    CHECK(number("N", add + "#macro Own(N) #local N = 9; #end Own(N)") == "9"); // as in POV-Ray
    CHECK(number("A[0]",
                 "#macro Set(X) #declare X[0] = 9; #end #declare A = array[1] {1} Set(A)") == "9");
    // The scope of L ends before the macro M is read.
    CHECK(number("K() 5)", "#macro M(A, B) A + B #end #macro K() #local L = 1; M(L, #end") == "6");
}

TEST_CASE("POV-Ray: an array is copied as a value") {
    const std::string array = "#declare A = array[2] {1, 2} ";
    CHECK(number("A[0]", array + "#declare B = A; #declare B[0] = 7;") == "1");
    CHECK(number("M(A)", array + "#macro M(X) X[1] #end") == "2");
    CHECK(number("A[1]", array + "#declare A[0] = A;") == "2");
    CHECK(read("#declare A = array[2] {sphere { 0, 1 }, sphere { x, 1 }} #declare B = A;\n"
               "object { B[1] }")
              .scene.shape_count() == 1);
    CHECK(complaint("#declare A = array[1]; #while (1) #declare A[0] = A; #end")
              .find("must not nest arrays more than 128 deep") != std::string::npos);
    CHECK(complaint("#declare A = array[1]; #while (1) #declare A = array[1] {A} #end")
              .find("must not nest arrays more than 128 deep") != std::string::npos);
}

TEST_CASE("POV-Ray: a directive follows an array without a semicolon") {
    CHECK(number("A[0]", "#declare A = array[2]\n#declare A[0] = 7;") == "7");
    CHECK(number("A[1][0]", "#declare A = array[2][2]\n#declare A[1][0] = 8;") == "8");
    CHECK(number("A[1]", "#if (1) #declare A = array[2]\n#end #declare A[1] = 9;") == "9");
}

TEST_CASE("POV-Ray: an object has the default texture that precedes it") {
    const Read result =
        read("#default { pigment { rgb <1, 0, 0> } } sphere { -2*x, 1 }\n"
             "#default { pigment { rgb <0, 0, 1> } } sphere { 2*x, 1 }\n" +
                 camera + "#default { pigment { rgb <0, 1, 0> } } sphere { 2*y, 1 }",
             "");
    CHECK(result.material_of(0).pattern.colors[0] == core::Color(1, 0, 0));
    CHECK(result.material_of(1).pattern.colors[0] == core::Color(0, 0, 1));
    CHECK(result.material_of(2).pattern.colors[0] == core::Color(0, 1, 0));
}

TEST_CASE("a scene may begin with a byte-order mark") {
    const std::string mark = "\xEF\xBB\xBF";
    CHECK(parse_scene("a.pov", mark + "#version 3.7; sphere { 0, 1 }").shape_count() == 1);
    CHECK(parse_scene("a", mark + "#version 3.7; sphere { 0, 1 }").shape_count() == 1);
    const std::string tachyon = mark + "BEGIN_SCENE\nRESOLUTION 8 8\nEND_SCENE\n";
    CHECK(parse_scene("a", tachyon).settings().width == 8);
    CHECK(tests::message_of<BadInput>([&] {
              parse_scene("a.pov", mark + "spheer { }");
          }).starts_with("a.pov:1:1: "));
    const tests::TemporaryDirectory directory;
    directory.write("b.inc", mark + "sphere { 0, 1 }");
    CHECK(load_scene(directory.write("a.pov", "#include \"b.inc\"")).shape_count() == 1);
}
