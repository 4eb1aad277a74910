#include "scenes/tool/ranks/ranks.hpp"

#include <chrono>
#include <cstdio>
#include <dlfcn.h>
#include <vector>

/// What rank 0 can do for the others: pieces of work that they take by its counter, and tiles that
/// it gets from them. Of each, how many a second.
///
///   mpirun -n 8 raylane-ranks RAYLANE-MPI.SO
using namespace raylane::scenes;

namespace {

using Clock = std::chrono::steady_clock;

constexpr int count = 20'000;
/// Of 32 x 32 pixels, with what comes along.
constexpr std::size_t tile_bytes = 12'400;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

void wait_for_all(Ranks& ranks) {
    while (!ranks.all_are_here()) {
    }
}

double take_pieces(Ranks& ranks) {
    ranks.reset_counter();
    const Clock::time_point start = Clock::now();
    if (ranks.rank() != 0)
        for (int i = 0; i < count; ++i)
            ranks.add_to_counter(1);
    wait_for_all(ranks);
    return seconds_since(start);
}

double send_tiles(Ranks& ranks) {
    std::vector<char> tile(tile_bytes);
    const Clock::time_point start = Clock::now();
    if (ranks.rank() != 0) {
        for (int i = 0; i < count; ++i) {
            ranks.send(tile.data(), tile.size());
            while (!ranks.sent()) {
            }
        }
    } else {
        std::size_t bytes = 0;
        for (int got = 0; got < count * (ranks.size() - 1);)
            if (ranks.has_message(bytes)) {
                ranks.receive(tile.data());
                ++got;
            }
    }
    wait_for_all(ranks);
    return seconds_since(start);
}

} // namespace

int main(int argc, char** argv) {
    void* const module = argc > 1 ? ::dlopen(argv[1], RTLD_NOW | RTLD_GLOBAL) : nullptr;
    const auto join =
        module != nullptr ? reinterpret_cast<JoinRanks>(::dlsym(module, join_ranks_name)) : nullptr;
    const char* why = "usage: mpirun -n 8 raylane-ranks RAYLANE-MPI.SO";
    Ranks* const ranks = join != nullptr ? join(&why) : nullptr;
    if (ranks == nullptr || ranks->size() < 2) {
        std::fprintf(stderr, "%s\n", why);
        return 2;
    }
    const double pieces = take_pieces(*ranks), tiles = send_tiles(*ranks);
    if (ranks->rank() == 0) {
        const double all = static_cast<double>(count) * (ranks->size() - 1);
        std::printf(
            "%d ranks: %.0f pieces a second by the counter; %.0f tiles a second, %.0f MB/s\n",
            ranks->size(), all / pieces, all / tiles,
            all / tiles * static_cast<double>(tile_bytes) / 1e6);
    }
    delete ranks;
    return 0;
}
