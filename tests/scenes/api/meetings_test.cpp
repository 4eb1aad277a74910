#include "tests/meetings/gathering.hpp"
#include "tests/scenes/api/exam.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <cstdio>

/// Tests of the library's answers for shapes that meet, against the oracle.
using namespace raylane;
using namespace raylane::tests;
using meetings::Meeting;
using meetings::Way;

namespace {

void ask(const Meeting& meeting, Limits limits, Sides sides, Ways ways, Tally& tally) {
    Exam(meeting.shapes, sides).ask(meeting.rays, limits, ways, tally);
}
/// Returns Sides::some in every fourth round.
Sides sides_of(int round) {
    return round % 4 == 3 ? Sides::some : Sides::both;
}

/// Checks that no answer was wrong and that enough rays hit.
void check(const char* what, const Tally& tally) {
    std::printf("%s: %s", what, tally.report().c_str());
    std::fflush(stdout);
    CHECK(tally.wrong() == 0);
    CHECK(tally.hits > tally.rays / 4);
}

} // namespace

TEST_CASE("pairs of shapes that meet are hit in the order of real arithmetic", "[meetings]") {
    ray_sets::Random random(seed(20261122));
    for (const Way way : meetings::all_ways) {
        Tally tally;
        for (int round = 0; round < rounds(2, 1, 4); ++round)
            for (int kind = 0; kind < core::kind_count; ++kind)
                for (int other = 0; other < core::kind_count; ++other) {
                    meetings::MeetingMaker maker(kind, other, way, random);
                    ask(maker.make(20), round % 2 == 0 ? Limits::none : Limits::at_crossings,
                        sides_of(round), Ways::one, tally);
                }
        check(meetings::way_names[static_cast<int>(way)], tally);
    }
}

TEST_CASE("many shapes that meet are hit in the order of real arithmetic", "[meetings]") {
    ray_sets::Random random(seed(20261123));
    for (const meetings::Kind& kind : meetings::gatherings) {
        Tally tally;
        for (int round = 0; round < rounds(1, 1, 2); ++round) {
            const int size = random.integer(kind.least, kind.most);
            ask(kind.make(size, random, 200), Limits::none, Sides::both, Ways::one, tally);
            ask(kind.make(size, random, 100), Limits::at_crossings, sides_of(round), Ways::all,
                tally);
        }
        check(kind.name, tally);
    }
}
